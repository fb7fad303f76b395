#ifndef STRIDE_COMPILER_SEMANTICS_LOOKUP_LOOKUP_HPP
#define STRIDE_COMPILER_SEMANTICS_LOOKUP_LOOKUP_HPP
// Names: what they stand for, what can be named somewhere, where it is declared. Who uses it:
// references.hpp. The checker asks while it checks; who keeps the Lookup can go on asking.

#include "compiler/semantics/lookup/module.hpp"
#include "compiler/semantics/reporter.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stc {

/// What a name stands for.
struct Found {
  Symbol *symbol = nullptr;
  Symbol *other = nullptr; ///< what another USING gives: nobody knows which one is meant
  bool isForeign = false;  ///< INTERNAL, and the place belongs to another namespace or library
  explicit operator bool() const { return symbol != nullptr; }
};

struct FoundEnumerator {
  EnumeratorSymbol *enumerator = nullptr;
  bool isAmbiguous = false;          ///< several enumerations of the place have one of this name
  EnumeratorSymbol *other = nullptr; ///< that of another library, if that makes it ambiguous
};

/// What CONFIGURATIONs and the like declare: it is no name, but found where files are declared.
struct ConfigurationParts {
  std::vector<ast::GlobalsDecl *> configs;  ///< VAR_CONFIG
  std::vector<ast::GlobalsDecl *> accesses; ///< VAR_ACCESS
  std::unordered_set<Ident> resourceNames;  ///< of CONFIGURATIONs and RESOURCEs
};

/// The enumerator of that name; null: none.
[[nodiscard]] EnumeratorSymbol *findEnumerator(const EnumType *type, Ident id);
/// A symbol for the declaration; neither its type nor its initial value is looked at.
VarSymbol *makeVariable(Arena &arena, ast::VarDecl *decl, Module &module, PouSymbol *owner);

class Lookup {
public:
  /// Both must outlive it. Diagnostics go to the program.
  Lookup(Program &program, const LibraryIndex &index);
  Lookup(const Lookup &) = delete;
  Lookup &operator=(const Lookup &) = delete;

  // -----------------------------------------------------------------------------------------------
  // What is known. Of libraries this is what has been used.

  /// The place of a source file of the project as a scope: a body, a type, or the project.
  /// Nothing before a file is declared.
  [[nodiscard]] std::optional<Scope> scopeAt(FileId file, uint32_t offset) const;
  /// What can be named there without anything in front. What is nearer comes first; what it hides
  /// is among the others. Names that only libraries have: libraryNames().
  [[nodiscard]] std::vector<const Symbol *> visible(const Scope &scope) const;
  /// Names of libraries that can be used everywhere, in lower case.
  [[nodiscard]] std::vector<LibraryIndex::Name> libraryNames() const { return index_.names(); }
  /// What can stand after the dot of a value: fields, variables, methods, properties, enumerators;
  /// inherited ones after one's own. Hidden and temporary ones are left out.
  [[nodiscard]] static std::vector<const Symbol *> members(const Type *type);
  /// What can stand after the dot of a library, namespace, list, type or POU.
  [[nodiscard]] std::vector<const Symbol *> members(const Symbol *symbol) const;
  /// Where a symbol is declared: its name there. Nothing for what the compiler knows by itself.
  [[nodiscard]] static std::optional<Span> declaration(const Symbol *symbol);

  /// The namespaces around, from inside to outside.
  [[nodiscard]] std::vector<NamespaceSymbol *> spaces(const Scope &scope) const;
  /// What is INTERNAL and declared there can be used in the scope.
  [[nodiscard]] bool seesInternals(const Scope &scope, const Library *library,
                                   const NamespaceSymbol *space) const;
  /// What a library or namespace has of this name; null: nothing.
  Symbol *memberOfSpace(Symbol *space, Ident id);
  /// The library that goes by this name; null: none.
  Symbol *library(const Scope &scope, const ast::Name &name);
  [[nodiscard]] bool isBuiltin(Ident id) const { return builtins_.contains(id); }
  /// `Standard.LEN`: the function of the compiler that stands for one of that library; null: there
  /// is none, or it is another library.
  [[nodiscard]] BuiltinSymbol *standardFunction(const Symbol *library, Ident id) const;
  [[nodiscard]] const ConfigurationParts &configuration() const { return configuration_; }
  /// The names of the own library of that name in lower case; null: there is none.
  [[nodiscard]] const Module *ownModule(std::string_view lowerName) const;
  /// Null: nothing of the library has been used.
  [[nodiscard]] Module *findModule(std::string_view library) const;
  [[nodiscard]] Module &moduleOf(const Symbol *symbol) const;

  // -----------------------------------------------------------------------------------------------
  // Looking up. Files of libraries are read where a name leads into them.

  /// What a plain name stands for in an expression. Enumerators: enumerator().
  Found find(const Scope &scope, const ast::Name &name);
  /// A name of the project (or library): in the namespaces around, outside of all, by USING.
  Found declared(const Scope &scope, Ident id);
  /// By the USING directives of the place.
  Found inUsings(const Scope &scope, Ident id);
  /// In the namespaces around.
  [[nodiscard]] Symbol *inSpaces(const Scope &scope, Ident id) const;
  /// A name that needs no library's name in front. Several libraries that the place uses may have
  /// it: the first one counts, and `other` is set.
  Found inLibraries(const Scope &scope, Ident id);
  /// The same in libraries of the user's own.
  [[nodiscard]] Found inOwnLibraries(const Scope &scope, Ident id) const;
  /// What the own library is called that a name, in lower case, stands for at the place; empty:
  /// none.
  [[nodiscard]] std::string ownLibrary(const Scope &scope, std::string_view lowerName) const;
  /// `Library.Name`
  Symbol *inLibrary(Ident library, Ident id);
  /// What `space.name` is, of a namespace or a library.
  Found inSpace(const Scope &scope, Symbol *space, Ident id);
  /// What a USING directive names: a namespace or a library; null: neither.
  Symbol *used(const Scope &scope, ast::NamePath path);
  /// The enumerator that a plain name stands for where a value of `expected` (null: any) is needed.
  FoundEnumerator enumerator(const Scope &scope, Ident id, const Type *expected);
  /// A variable, method or property of the POU, of its bases or of the block around.
  [[nodiscard]] static Symbol *inPou(PouSymbol *pou, Ident id);

  // -----------------------------------------------------------------------------------------------
  // Declaring.

  /// The names of a library (of the project: ""), made when they are new.
  Module &module(std::string_view library);
  /// Declares the libraries of the user's own (Program::librarySources) and what the project uses.
  void declareOwnLibraries();
  /// Reports values of parameters (Program::parameters) that no library has. These are declared.
  void reportUnknownParameters();
  /// Makes symbols of what the file declares, reports names that are declared twice.
  void declare(Module &module, ast::File *file);
  /// Reads a file of a library, unless that has been done.
  void load(const LibraryIndex::Entry &entry);
  /// Reads all files of a library.
  void loadAll(std::string_view library);
  /// Is called after each file that has been read: its enumerators can be named without their type,
  /// so whoever resolves types does that with enumerations at once.
  void onLoad(std::function<void(Module &)> action) { loaded_ = std::move(action); }

  [[nodiscard]] Reporter &reporter() { return reporter_; }
  [[nodiscard]] const LibraryIndex &index() const { return index_; }

private:
  void addName(Module &module, Symbol *symbol);
  /// It is INTERNAL, and the scope is in another namespace or library.
  [[nodiscard]] bool isForeign(const Scope &scope, const Symbol *symbol) const;
  void declarePou(Module &module, ast::PouDecl *decl);
  void declareType(Module &module, ast::Decl *decl);
  void declareGlobals(Module &module, ast::GlobalsDecl *decl);
  void setParameters(const Module &module, const ast::Name &list, ast::GlobalsDecl *decl);
  NamespaceSymbol *declareSpace(Module &module, ast::NamePath path);
  NamespaceSymbol *makeSpace(Module &module, NamespaceSymbol *around, const ast::Name &name);
  Symbol *declareCamTable(Ident id);

  Symbol *self(const Scope &scope, const ast::Name &name);
  Symbol *inStandardLibraries(const Scope &scope, Ident id);
  /// Where Stride's libraries declare it. One of the project replaces a foreign one of its name.
  [[nodiscard]] std::vector<LibraryIndex::Entry> standardEntries(Ident id) const;
  Symbol *listOfLibraries(const Scope &scope, Ident id) const;
  bool isStandardLibrary(Ident id);
  FoundEnumerator enumeratorOfLibraries(const Scope &scope, Ident id);
  FoundEnumerator usedEnumerator(const Scope &scope, Ident id);

  Program &program_;
  Arena &arena_;
  const LibraryIndex &index_;
  Reporter reporter_;
  std::function<void(Module &)> loaded_;
  std::unordered_map<std::string, std::unique_ptr<Module>> modules_; ///< by library
  std::unordered_map<Ident, BuiltinSymbol *> builtins_;
  std::unordered_map<Ident, Symbol *>
      inLibraries_;                           ///< of Stride: what has been found, also nothing
  std::unordered_map<Ident, bool> isLibrary_; ///< what the index has answered
  std::unordered_map<std::string, const Module *> own_; ///< own libraries, by name in lower case
  ConfigurationParts configuration_;
};

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_LOOKUP_LOOKUP_HPP
