#pragma once
// The application's description of its types, members and roots (runtime/app/abi.h).

#include "compiler/codegen/context/context.hpp"

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace stc::codegen {

/// The value of {attribute 'renamed_from'}, empty without one.
[[nodiscard]] std::string_view renamedFrom(const ast::Attributes &attributes);

/// Collects every type that can be reached from the roots, pointers included, and writes the
/// tables.
class TypeTable {
public:
  explicit TypeTable(Context &context) : c_(context) {}

  /// The type's index.
  std::uint32_t index(const Type *type, bool inOut = false);
  /// `{"limit", offsetof(…), type, flags}` of one variable that stands for itself.
  /// `listRenamedFrom`: the earlier name of its list, empty without one. `task`: the only one that
  /// writes it.
  void addRoot(std::string_view list, const VarSymbol *variable, const std::string &place,
               bool qualifiedOnly, std::string_view listRenamedFrom,
               std::optional<std::uint32_t> task);
  /// The areas of the process image, and the types of direct addresses.
  void addImage();
  /// An entry of VAR_ACCESS.
  void addAccess(const AccessPath &access);
  /// The memory of __NEW: a hidden root `__pool`, an array of BYTE.
  void addPool(std::uint64_t size);
  /// `task`: the only one that calls it.
  void addProgram(const PouSymbol *program, const std::string &place,
                  std::optional<std::uint32_t> task);

  /// `constexpr … kTypes[] = { … };` and the other tables.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::size_t typeCount() const { return types_.size(); }
  [[nodiscard]] std::size_t memberCount() const { return memberRows_.size(); }
  [[nodiscard]] std::size_t enumeratorCount() const { return enumeratorRows_.size(); }
  [[nodiscard]] std::size_t rootCount() const { return rootRows_.size(); }
  [[nodiscard]] Includes &includes() { return includes_; }

private:
  struct Key {
    const Type *type;
    bool inOut;
    bool operator==(const Key &) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key &k) const {
      return std::hash<const Type *>()(k.type) * 2 + (k.inOut ? 1 : 0);
    }
  };
  struct Row {
    std::string kind;
    unsigned flags = 0;
    std::string name;
    std::string cppType; ///< of which size and alignment are taken
    std::uint64_t hash = 0;
    std::size_t firstMember = 0;
    std::size_t memberCount = 0;
    std::int64_t element = -1;
    std::int64_t lowerBound = 0;
    std::uint64_t elementCount = 0;
    std::uint32_t stringLength = 0;
    std::uint32_t typeId = 0;
    std::string_view renamedFrom;
  };
  /// A row that has its number and no content yet.
  struct Pending {
    std::uint32_t at = 0;
    const Type *type = nullptr;
    bool inOut = false;
  };
  void fillPending();
  void fill(std::uint32_t at, const Type *type, bool inOut);
  void fillInOut(Row &row, const Type *type);
  void fillKind(Row &row, const Type *type);
  void fillEnumeration(Row &row, const EnumType *type);
  void fillInstance(Row &row, const PouType *type);
  std::string memberRow(const Type *type, const VarSymbol *v, std::uint32_t typeIndex,
                        const std::string &owner);
  void members(Row &row, const Type *type, const Type *base, const std::string &owner,
               const std::vector<const VarSymbol *> &variables, bool typeId = false);

  Context &c_;
  Includes includes_{c_.names};
  Storage storage_;
  std::unordered_map<Key, std::uint32_t, KeyHash> indices_;
  std::vector<Row> types_;
  std::vector<Pending> pending_;
  std::vector<std::string> memberRows_;
  std::vector<std::string> enumeratorRows_;
  std::vector<std::string> rootRows_;
};

} // namespace stc::codegen
