#ifndef STRIDE_COMPILER_PROJECT_LIBRARY_INDEX_HPP
#define STRIDE_COMPILER_PROJECT_LIBRARY_INDEX_HPP
// The standard library inside the program `stride`: its texts, and an index of the names they
// declare. Both are made when Stride is built (stdlib/CMakeLists.txt), so that nothing is parsed
// that a project does not use.

#include "compiler/semantics/program.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace stc {

/// One file of the standard library.
struct EmbeddedFile {
  std::string_view library;  ///< `SM_PLCopen`
  std::string_view fileName; ///< `<stdlib>/SM_PLCopen/MC_Power.st`
  std::string_view text;
};

/// A name that a file declares.
struct EmbeddedName {
  std::string_view lower; ///< lower-case spelling
  std::string_view text;  ///< as it is declared
  uint16_t file;          ///< index into the files
  LibraryIndex::Kind kind;
};

/// The tables as the generator writes them: files grouped by library, names sorted by (lower, kind,
/// file).
struct EmbeddedTables {
  std::span<const EmbeddedFile> files;
  std::span<const EmbeddedName> names;
};

/// LibraryIndex over such tables, which must outlive it.
class EmbeddedLibraryIndex final : public LibraryIndex {
public:
  explicit EmbeddedLibraryIndex(const EmbeddedTables &tables) : tables_(tables) {}

  [[nodiscard]] std::vector<Entry> find(std::string_view lowerName) const override;
  [[nodiscard]] bool isLibrary(std::string_view lowerName) const override;
  [[nodiscard]] bool isReserved(std::string_view lowerName) const override;
  [[nodiscard]] bool answersTo(std::string_view library, std::string_view lowerName) const override;
  [[nodiscard]] std::vector<Name> names() const override;
  [[nodiscard]] std::vector<Entry> files(std::string_view library) const override;
  /// Names of all libraries, in the order of the tables.
  [[nodiscard]] std::vector<std::string_view> libraries() const override;

private:
  EmbeddedTables tables_;
};

/// The standard library of this program. Defined in a generated file.
[[nodiscard]] EmbeddedTables standardLibrary();

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_LIBRARY_INDEX_HPP
