#ifndef STRIDE_COMPILER_CODEGEN_TYPE_TABLE_HPP
#define STRIDE_COMPILER_CODEGEN_TYPE_TABLE_HPP
// The application's description of its types, members and roots (runtime/app/abi.h).

#include "compiler/codegen/context/context.hpp"

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace stc::codegen {

/// The value of {attribute 'renamed_from'}, empty without one.
[[nodiscard]] std::string_view renamedFrom(const ast::Attributes &attributes);

/// Parts of app.cpp; empty where there are no types.
struct SymbolTexts {
  std::string declarations; ///< of numbers in other sources, for the global namespace
  std::string tables;       ///< `constexpr ::stride::SymbolLines kSymbols = …`, and what it names
};

/// Collects every type that can be reached from the roots, pointers included, and writes the
/// tables.
class TypeTable {
public:
  explicit TypeTable(Context &context) : c_(context) {}

  /// The type's index.
  uint32_t index(const Type *type, bool inOut = false);
  /// One variable that stands for itself.
  /// `listRenamedFrom`: the earlier name of its list, empty without one. `task`: the only one that
  /// writes it.
  void addRoot(std::string_view list, const VarSymbol *variable, const std::string &place,
               bool qualifiedOnly, std::string_view listRenamedFrom, std::optional<uint32_t> task);
  /// The areas of the process image, and the types of direct addresses.
  void addImage();
  /// An entry of VAR_ACCESS.
  void addAccess(const AccessPath &access);
  /// The memory of __NEW: a hidden root `__pool`, an array of BYTE.
  void addPool(uint64_t size);
  /// `task`: the only one that calls it.
  void addProgram(const PouSymbol *program, const std::string &place, std::optional<uint32_t> task);

  [[nodiscard]] SymbolTexts texts() const;
  /// The POUs whose sources have the numbers of their types.
  [[nodiscard]] std::vector<const PouSymbol *> withOwnNumbers() const;
  [[nodiscard]] bool empty() const { return types_.empty(); }
  [[nodiscard]] Includes &includes() { return includes_; }

private:
  struct Key {
    const Type *type;
    bool inOut;
    bool operator==(const Key &) const = default;
  };
  struct KeyHash {
    size_t operator()(const Key &k) const {
      return std::hash<const Type *>()(k.type) * 2 + (k.inOut ? 1 : 0);
    }
  };
  struct Row {
    std::string kind;
    unsigned flags = 0;
    std::string name;
    std::string cppType; ///< of which size and alignment are taken
    uint64_t hash = 0;
    int64_t element = -1;
    int64_t lowerBound = 0;
    uint64_t elementCount = 0;
    uint32_t stringLength = 0;
    uint32_t typeId = 0;
    std::string_view renamedFrom;
    std::vector<std::string> lines;       ///< of members or enumerators
    std::vector<std::string> offsets;     ///< of members, as expressions
    const PouSymbol *numbersOf = nullptr; ///< whose source has size, alignment and offsets
  };
  class Numbers;
  /// A row that has its number and no content yet.
  struct Pending {
    uint32_t at = 0;
    const Type *type = nullptr;
    bool inOut = false;
  };
  void fillPending();
  void fill(uint32_t at, const Type *type, bool inOut);
  void fillInOut(Row &row, const Type *type);
  void fillKind(Row &row, const Type *type);
  void fillEnumeration(Row &row, const EnumType *type);
  void fillInstance(Row &row, const PouType *type);
  void memberRow(Row &row, const Type *type, const VarSymbol *v, uint32_t typeIndex,
                 const std::string &owner);
  void addHidden(std::string_view name, uint32_t type, std::string_view place);
  void members(Row &row, const Type *type, const Type *base, const std::string &owner,
               const std::vector<const VarSymbol *> &variables, bool typeId = false);

  Context &c_;
  Includes includes_{c_.names};
  Storage storage_;
  std::unordered_map<Key, uint32_t, KeyHash> indices_;
  std::vector<Row> types_;
  std::vector<Pending> pending_;
  std::vector<std::string> rootLines_;
  std::vector<std::string> rootOffsets_;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_TYPE_TABLE_HPP
