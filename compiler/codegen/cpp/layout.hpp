#ifndef STRIDE_COMPILER_CODEGEN_CPP_LAYOUT_HPP
#define STRIDE_COMPILER_CODEGEN_CPP_LAYOUT_HPP
// What the types of a program look like in memory: their fields, defaults, address slots and
// hashes.

#include "compiler/codegen/cpp/names.hpp"
#include "compiler/semantics/storage.hpp"
#include "runtime/common/fnv.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace stc::codegen {

/// The attribute of a library's pin that has another default with `softmotion = "3"`, or null.
const ast::Attribute *softMotion3Default(const VarSymbol *variable);

/// Of layouts: FNV-1a of 64 bits, texts with an end mark each.
class Hash {
public:
  Hash &add(std::string_view text);
  Hash &add(uint64_t value);
  [[nodiscard]] uint64_t value() const { return hash_.value(); }

private:
  stride::common::Fnv1a<uint64_t> hash_;
};

/// Held as a pointer: VAR_IN_OUT of an instance, REFERENCE TO.
[[nodiscard]] inline bool isIndirect(const VarSymbol *v) {
  return v->section == ast::Section::InOut || v->type->kind == TypeKind::Reference;
}

/// The type of the elements of an array (of arrays …); every other type itself.
[[nodiscard]] inline const Type *innermost(const Type *type) {
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  return type;
}

/// A type as a declaration spells it, followed into arrays: where aliases with defaults are seen.
struct Written {
  const ast::TypeExpr *expr = nullptr;
  size_t dimension = 0; ///< of an array type with several ranges
  const Library *library = nullptr;
};

class Layouts {
public:
  /// `own` is the library whose code is generated: types of others are always initialised through
  /// their init__.
  Layouts(const Program &program, const Library *own);

  /// Whether memory of the type must be set after it has been zeroed.
  [[nodiscard]] bool needsInit(const Type *type);
  [[nodiscard]] bool needsInit(const VarSymbol *variable);
  /// The initial value that counts for a variable: its own, else its alias type's; null for the
  /// type's default.
  [[nodiscard]] const ast::Expr *initOf(const VarSymbol *variable);
  /// The type of a variable as written.
  [[nodiscard]] static Written written(const VarSymbol *variable);
  /// The default that an alias of this name gives to `type`, or null.
  [[nodiscard]] const ast::Expr *aliasDefault(const Written &written, const Type *type) const;
  /// Whether the elements of the array have such defaults, at any depth.
  [[nodiscard]] bool elementsHaveDefaults(const Written &written, const Type *type) const;
  /// The element type of an array as written.
  [[nodiscard]] Written elementOf(const Written &written, const Type *type) const;

  /// Equal for equal layouts in all builds.
  [[nodiscard]] uint64_t hash(const Type *type);
  /// It or something inside it is an address slot.
  [[nodiscard]] bool hasAddress(const Type *type);
  /// An instance of the type, or one inside of it, has a method that is called at the end of its
  /// life (`fb_exit`) or after its values were carried over (`fb_reinit`).
  [[nodiscard]] bool hasLifecycle(const Type *type, std::string_view lowerName);
  /// It is, or holds, a block with a VAR_IN_OUT, a slot of VAR_CONFIG or a type id, which an
  /// assignment leaves as they are: assigned by assign__.
  [[nodiscard]] bool hasBindings(const Type *type);

private:
  bool computeNeedsInit(const Type *type);
  uint64_t computeHash(const Type *type);
  void addMember(Hash &hash, const VarSymbol *v);
  void addStructure(Hash &hash, const StructType *type);
  void addInstance(Hash &hash, const PouType *type);
  bool computeNeedsInit(const PouSymbol *pou);

  const Library *own_;
  [[nodiscard]] const TypeSymbol *alias(const Written &written, const Type *type) const;
  std::unordered_map<Ident, std::vector<const TypeSymbol *>> aliases_;
  bool anyDefault_ = false;
  std::unordered_map<const Type *, bool> needsInit_;
  std::unordered_map<const Type *, uint64_t> hashes_;
  std::unordered_map<const Type *, bool> hasAddress_;
  std::unordered_map<const Type *, bool> hasBindings_;
};

/// The fields that get initial values: of a UNION the one that declares a value, else the first.
[[nodiscard]] std::vector<const VarSymbol *> initialisedFields(const StructType *type);
/// The value nearest to 0 that a subrange holds.
[[nodiscard]] int64_t subrangeDefault(const SubrangeType *type);
/// A literal or folded constant whose memory is all zero.
[[nodiscard]] bool isZero(const ast::Expr *init);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CPP_LAYOUT_HPP
