#pragma once
// A checked program: what codegen works on.

#include "compiler/semantics/symbols.hpp"
#include "compiler/source/arena.hpp"
#include "compiler/source/diagnostic.hpp"
#include "compiler/source/source_manager.hpp"
#include "compiler/syntax/conditions.hpp"

#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace stc {

/// A library or the user's project, with what of it has been used (a library) or declared (the
/// project).
struct Library {
  std::string name; ///< `SM_PLCopen`; the project: empty
  bool isUser = false;
  std::vector<PouSymbol *> pous; ///< with resolved declarations and checked bodies
  std::vector<TypeSymbol *>
      types; ///< structures, enumerations, aliases; a type follows those it contains
  std::vector<GlobalsSymbol *> globals; ///< VAR_GLOBAL lists
};

/// Gives the checker the text of library declarations on demand, so that only what is used is
/// parsed.
class LibraryIndex {
public:
  virtual ~LibraryIndex() = default;
  struct Entry {
    std::string_view library;  ///< `SM_PLCopen`
    std::string_view fileName; ///< `<stdlib>/SM_PLCopen/MC_Power.st`
    std::string_view text;
  };
  /// The files that declare `lowerName` (a POU, type, global variable, or enumerator), best first:
  /// at most one per library.
  [[nodiscard]] virtual std::vector<Entry> find(std::string_view lowerName) const = 0;
  [[nodiscard]] virtual bool isLibrary(std::string_view lowerName) const = 0;
  /// Every name it declares, for "did you mean" (lower case).
  [[nodiscard]] virtual std::vector<std::string_view> names() const = 0;
  /// All files of one library, for generating its headers and for documentation.
  [[nodiscard]] virtual std::vector<Entry> files(std::string_view library) const = 0;
};

struct Settings {
  bool checks = true; ///< run-time checks (index, division, null, subrange)
  std::vector<Define>
      defines; ///< names that `{IF defined (…)}` knows, besides those of stride.toml
};

/// Everything of one compilation; owns sources, identifiers, trees, symbols.
struct Program {
  SourceManager sources;
  Interner interner;
  Arena arena;
  Diagnostics diagnostics;
  Settings settings;
  std::vector<std::unique_ptr<Library>> libraries; ///< used libraries in order of first use
  Library *user = nullptr;        ///< the project; null while a library itself is compiled
  std::vector<ast::File *> files; ///< parsed user files
  // Storage of the symbols that own containers (the others live in the arena).
  std::deque<NamespaceSymbol> spaceStorage;
  std::deque<PouSymbol> pouStorage;
  std::deque<TypeSymbol> typeStorage;
  std::deque<GlobalsSymbol> globalsStorage;
};

/// Declares and checks `files` as the user's project, pulling in what they use of `index`.
/// Reports everything wrong to program.diagnostics; program is fit for codegen when no error was
/// reported.
void check(Program &program, const std::vector<ast::File *> &files, const LibraryIndex &index);

/// Declares and checks all of one library (for its headers and its compiled bodies).
void checkLibrary(Program &program, std::string_view library, const LibraryIndex &index);

} // namespace stc
