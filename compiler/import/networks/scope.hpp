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
  /// The declaration (with or without body) of the POU whose body is translated; adds to declare().
  void enter(std::string_view text);
  /// A further name that must not be used for something new.
  void reserve(std::string_view name);

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
  std::set<std::string> taken_; ///< lower case
  bool inFunction_ = false;
};

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_SCOPE_HPP
