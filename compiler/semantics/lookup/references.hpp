#ifndef STRIDE_COMPILER_SEMANTICS_LOOKUP_REFERENCES_HPP
#define STRIDE_COMPILER_SEMANTICS_LOOKUP_REFERENCES_HPP
// Who uses a symbol: an index over a checked program.

#include "compiler/semantics/program.hpp"

#include <span>
#include <utility>
#include <vector>

namespace stc {

/// Where the names of variables, POUs, members, types, enumerators and lists stand, in declarations
/// and bodies of the project and of what it uses of libraries, and in the paths of VAR_CONFIG and
/// VAR_ACCESS (entries with errors apart). The declaration itself is no use. Made by one walk over
/// the program.
class References {
public:
  /// The program must have been checked; names that are unknown have no symbol. It must outlive
  /// the index.
  explicit References(const Program &program);

  /// One place where a symbol is named.
  struct Use {
    const Symbol *symbol = nullptr;
    Span span; ///< of the name
  };
  /// All uses of the symbol, in the order of files and text.
  [[nodiscard]] std::span<const Use> of(const Symbol *symbol) const;
  /// What the name at that place stands for; null: there is no name.
  [[nodiscard]] const Symbol *at(FileId file, uint32_t offset) const;
  [[nodiscard]] size_t size() const { return bySymbol_.size(); }

private:
  std::vector<Use> bySymbol_; ///< sorted by symbol, file, place
  std::vector<Use> byPlace_;  ///< sorted by file, place
};

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_LOOKUP_REFERENCES_HPP
