#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_SCOPE_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_SCOPE_HPP
// What is declared around a drawn body: types of variables, pins of blocks, names that are taken.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stc::import::networks {

/// A name with its type as text.
struct Declared {
  std::string name;
  std::string type;
};

/// A POU's pins in the order of their declaration.
struct Interface {
  enum class Kind { Program, Function, FunctionBlock };
  Kind kind = Kind::FunctionBlock;
  std::string name;
  std::string returnType; ///< of a function
  std::vector<Declared> inputs;
  std::vector<Declared> inOuts;
  std::vector<Declared> outputs;
};

/// Declarations, read from Structured Text. Bodies in it do not matter.
class Scope {
public:
  /// Adds the POUs, types and global lists of a text.
  void declare(std::string_view text);
  /// The declaration (with or without body) of the POU whose body is translated. What was made for
  /// another one before is forgotten.
  void enter(std::string_view text);

  [[nodiscard]] const Interface *interfaceOf(std::string_view type) const;
  /// Type of a variable, a member or an element (`a.b[1].c`) as text; empty: not known.
  [[nodiscard]] std::string typeOf(std::string_view path) const;
  /// Whether the POU that was entered has no memory.
  [[nodiscard]] bool inFunction() const { return inFunction_; }
  /// A name like `wish` that is nowhere in use; it is in use from now on.
  [[nodiscard]] std::string freshName(std::string_view wish);

private:
  friend class DeclarationReader;
  using Members = std::map<std::string, std::string>; ///< lower-case name -> type
  [[nodiscard]] std::string memberType(const std::string &type, const std::string &member) const;
  [[nodiscard]] std::string elementType(const std::string &type) const;

  std::map<std::string, Interface> interfaces_; ///< by lower-case name
  std::map<std::string, Members> structures_;   ///< members of STRUCTs and of blocks
  std::map<std::string, std::string> aliases_;
  Members globals_;
  Members locals_;
  std::set<std::string> taken_;       ///< lower case
  std::set<std::string> localTaken_;  ///< of the POU that was entered, and made for it
  std::map<std::string, int> number_; ///< that freshName() tries next, by lower-case name
  bool inFunction_ = false;
};

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_SCOPE_HPP
