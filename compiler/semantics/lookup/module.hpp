#ifndef STRIDE_COMPILER_SEMANTICS_LOOKUP_MODULE_HPP
#define STRIDE_COMPILER_SEMANTICS_LOOKUP_MODULE_HPP
// Where names are declared, and from where they are looked up.

#include "compiler/semantics/program.hpp"
#include "compiler/semantics/symbols.hpp"

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace stc {

/// The names of one library or of the project.
struct Module {
  Library *library = nullptr;
  /// POUs, types, variables of lists that need no qualification
  std::unordered_map<Ident, Symbol *> names;
  std::unordered_map<Ident, GlobalsSymbol *> lists;
  std::unordered_map<Ident, std::vector<EnumeratorSymbol *>> enumerators;
  std::unordered_map<Ident, NamespaceSymbol *> spaces; ///< outermost namespaces
  std::vector<TypeSymbol *> declaredTypes;             ///< in the order of the text
  std::unordered_set<std::string> loadedFiles;
  bool isWhole = false; ///< all files of the library are loaded

  /// What is declared outside of all namespaces; null: nothing.
  [[nodiscard]] Symbol *find(Ident id) const;
};

/// From where names are looked up.
struct Scope {
  Module *module = nullptr;
  PouSymbol *pou = nullptr;
  const ast::Decl *home = nullptr; ///< whose NAMESPACE and USING hold; null: the POU's
};

/// The declaration whose NAMESPACE and USING hold in the scope; null: none.
[[nodiscard]] const ast::Decl *homeOf(const Scope &scope);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_LOOKUP_MODULE_HPP
