// What stands below a path.
#ifndef STRIDE_RUNTIME_MONITOR_SYMBOL_LIST_HPP
#define STRIDE_RUNTIME_MONITOR_SYMBOL_LIST_HPP

#include "runtime/app/symbols.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stride::monitor {

/// A name below a path.
struct SymbolEntry {
  std::string name; ///< "count", "[3]"
  std::string path; ///< The whole path, to read it or to list what is below.
  std::string type; ///< ST name.
  Kind kind = Kind::None;
  uint32_t flags = 0;    ///< SymbolFlags.
  uint64_t children = 0; ///< How many entries are below it; 0: it is a value, or an address.
};

/// Some of the names below a path.
struct SymbolPage {
  uint64_t total = 0; ///< How many there are.
  std::vector<SymbolEntry> entries;
};

/// The names directly below a path (programs and global variables for an empty one) in the order
/// of declaration, from number `first` on, at most `most`. Hidden ones are left out. Throws
/// app::Error for unknown names.
SymbolPage listSymbols(const app::SymbolTable &symbols, std::string_view path, uint64_t first,
                       size_t most);

} // namespace stride::monitor

#endif
