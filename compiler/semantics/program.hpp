#ifndef STRIDE_COMPILER_SEMANTICS_PROGRAM_HPP
#define STRIDE_COMPILER_SEMANTICS_PROGRAM_HPP
// A checked program: what codegen works on.

#include "compiler/semantics/implicit_checks.hpp"
#include "compiler/semantics/sharing.hpp"
#include "compiler/semantics/symbols.hpp"
#include "compiler/source/arena.hpp"
#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"
#include "compiler/syntax/conditions.hpp"

#include <array>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace stc {

struct Library;

/// A library of the user's own under the name by which another one, or the project, calls it.
struct UsedLibrary {
  std::string name;
  const Library *library = nullptr;
};

/// A library or the user's project, with what of it has been used (a library) or declared (the
/// project).
struct Library {
  std::string name; ///< `SM_PLCopen`; of a library of one's own its namespace; the project: empty
  bool isUser = false;
  bool isOwn = false; ///< the project brings it ([[library]] of stride.toml)
  /// All of it is declared, and its code is made with the application: a library of one's own, or
  /// one of Stride's that has not been compiled with the parameters that the project sets.
  bool isBuilt = false;
  bool qualifiedOnly = false;    ///< of an own one: its names need the namespace before them
  unsigned pack = 0;             ///< of its structures without pack_mode; 0: natural alignment
  bool truncIsInt = false;       ///< as Settings::truncIsInt, for its own code
  std::vector<UsedLibrary> uses; ///< own libraries that it names itself
  std::vector<PouSymbol *> pous; ///< with resolved declarations and checked bodies
  std::vector<TypeSymbol *>
      types; ///< structures, enumerations, aliases; a type follows those it contains
  std::vector<GlobalsSymbol *> globals; ///< VAR_GLOBAL lists
};

/// A library of the user's own: parsed, not yet declared.
struct LibrarySource {
  /// How it is called by somebody who uses it, and its LibrarySource::name.
  struct Use {
    std::string name;
    std::string library;
  };
  std::string name; ///< unlike that of all others
  std::vector<ast::File *> files;
  std::vector<Use> uses; ///< own libraries that it names itself
  bool qualifiedOnly = false;
  unsigned pack = 0;
  bool truncIsInt = false;
  std::string about; ///< what its documentation begins with
};

/// What the project sets a constant of a library's parameter list to.
struct ParameterValue {
  std::string library;         ///< as Library::name
  std::string list;            ///< lower case; empty: the list does not matter
  std::string name;            ///< as the project spells it
  Span place;                  ///< of the name
  ast::Expr *value = nullptr;  ///< null: it is none
  ast::Expr *quoted = nullptr; ///< the same as a text, for a STRING; null: it stands without quotes
  bool isSet = false;          ///< the constant has been found
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
    /// Its names are seen with the library's name in front only (`SMCB.Line`): they are words that
    /// programs use for other things.
    bool qualifiedOnly = false;
    /// Made so that programs of other systems run. Others may have its names, and projects a
    /// library of its name.
    bool isForeign = false;
  };
  /// The files that declare `lowerName` (a POU, type, global variable, or enumerator), best first:
  /// at most one per library.
  [[nodiscard]] virtual std::vector<Entry> find(std::string_view lowerName) const = 0;
  [[nodiscard]] virtual bool isLibrary(std::string_view lowerName) const = 0;
  /// No library of a project may go by this name.
  [[nodiscard]] virtual bool isReserved(std::string_view lowerName) const {
    return isLibrary(lowerName);
  }
  /// Whether `library` goes by this name: its own, or the one that SoftMotion 3, CODESYS V3 or
  /// TwinCAT 3 gives to what it holds. Several libraries may go by one name.
  [[nodiscard]] virtual bool answersTo(std::string_view library,
                                       std::string_view lowerName) const = 0;
  enum class Kind : uint8_t { Function, Type, Variable, Enumerator }; ///< Type: blocks, too
  struct Name {
    std::string_view text; ///< as it is declared
    Kind kind = Kind::Type;
  };
  /// Every name it declares that is seen without a library's name, for "did you mean".
  [[nodiscard]] virtual std::vector<Name> names() const = 0;
  /// Names of all libraries.
  [[nodiscard]] virtual std::vector<std::string_view> libraries() const { return {}; }
  /// All files of one library, for generating its headers and for documentation.
  [[nodiscard]] virtual std::vector<Entry> files(std::string_view library) const = 0;
};

/// What the numbers of direct addresses count.
enum class Addressing : uint8_t {
  Units, ///< units of their size: `%MW3` is bytes 6 and 7; bits by byte: `%MX3.1`
  Bytes, ///< bytes: `%MW3` is bytes 3 and 4
  Words, ///< units of their size; bits by word: `%MX3.9` is bit 1 of byte 7
};

/// From an object to something inside of it.
struct PathStep {
  const VarSymbol *member = nullptr; ///< null: an element
  uint64_t element = 0;              ///< counted from 0
};

/// A variable of the application's state.
struct StatePath {
  const Symbol *root = nullptr; ///< a program or a global variable
  std::vector<PathStep> steps;
};
/// `Main.fbs[3].in`
[[nodiscard]] std::string pathText(const StatePath &path);

/// What VAR_CONFIG says of one variable of one instance.
struct SlotPlace {
  StatePath path;
  const VarSymbol *variable = nullptr; ///< declared `AT %I*`; null: only an initial value is given
  Location at;
  const ast::VarDecl *decl = nullptr; ///< the entry; null: the place has been chosen
  bool placed = false;
};

/// An entry of VAR_ACCESS.
struct AccessPath {
  const ast::VarDecl *decl = nullptr;
  StatePath path; ///< without root: a direct address
  const Type *type = nullptr;
  const Location *location = nullptr; ///< of a variable in the process image
};

/// A module whose registers have addresses by rack and slot, `%IW1.4.3.2`.
struct RegisterModule {
  uint32_t rack = 0;
  uint32_t slot = 0;
};

struct Settings {
  uint64_t poolSize = 65536; ///< bytes for the objects of __NEW, a multiple of 16
  bool checks = true;        ///< run-time checks (index, division, null, subrange)
  Levels levels;             ///< severities given on the command line; they go before stride.toml's
  Addressing addressing = Addressing::Units;
  std::array<uint32_t, 3> imageBytes{}; ///< by Area; 0: as large as the program needs
  std::vector<RegisterModule> modules;  ///< TSX CSY 85, by [[csy]]
  unsigned pack = 0;        ///< of the project's structures without pack_mode; 0: natural alignment
  bool softMotion3 = false; ///< defaults that differ by generation are SoftMotion 3's
  bool truncIsInt = false;  ///< TRUNC gives an INT, as in CoDeSys V2.3, instead of a DINT
  unsigned jobs = 0;        ///< threads at once; 0: defaultJobs()
  std::vector<Define>
      defines; ///< names that `{IF defined (…)}` knows, besides those of stride.toml
};

/// The process image: bytes per area, by Area.
struct Image {
  std::array<uint32_t, 3> bytes{};
  std::array<const Type *, 3> types{}; ///< ARRAY [0..n-1] OF BYTE; null where an area is empty
};

/// Everything of one compilation; owns sources, identifiers, trees, symbols.
struct Program {
  Sources sources;
  Interner interner;
  Arena arena;
  Diagnostics diagnostics;
  Settings settings;
  Image image;
  std::vector<SlotPlace> slotPlaces;
  std::vector<AccessPath> accessPaths;
  std::vector<std::unique_ptr<Library>> libraries; ///< used libraries in order of first use
  Library *user = nullptr;        ///< the project; null while a library itself is compiled
  std::vector<ast::File *> files; ///< parsed user files
  /// Libraries of the user's own; each follows those that it uses.
  std::vector<LibrarySource> librarySources;
  std::vector<LibrarySource::Use> uses; ///< those that the project itself names
  std::string ownNamespace;             ///< of a project that is a library; else empty
  std::vector<ParameterValue> parameters;
  /// Types whose size the program asks for (SIZEOF), with what the checker has computed.
  std::vector<std::pair<const Type *, uint64_t>> measured;
  /// Types that the program creates objects of (__NEW), in the order of first use.
  std::vector<const Type *> created;
  ImplicitChecks implicitChecks{}; ///< the project's own run-time checks
  bool usesPool = false;           ///< __NEW or __DELETE is used
  Sharing sharing;                 ///< findSharing(): what several tasks use
  // Storage of the symbols that own containers (the others live in the arena).
  std::deque<NamespaceSymbol> spaceStorage;
  std::deque<PouSymbol> pouStorage;
  std::deque<TypeSymbol> typeStorage;
  std::deque<GlobalsSymbol> globalsStorage;
};

/// Bytes of the text of the project's own files: whether threads are worth it.
[[nodiscard]] size_t textBytes(const Program &program);

/// Declares and checks `files` as the user's project, pulling in what they use of `index`.
/// Reports everything wrong to program.diagnostics; program is fit for codegen when no error was
/// reported.
void check(Program &program, const std::vector<ast::File *> &files, const LibraryIndex &index);

class Lookup;
/// The same with a table of names (lookup/lookup.hpp) that can be asked afterwards.
void check(Program &program, Lookup &names, const std::vector<ast::File *> &files);

/// Declares and checks all of one library (for its headers and its compiled bodies).
void checkLibrary(Program &program, std::string_view library, const LibraryIndex &index);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_PROGRAM_HPP
