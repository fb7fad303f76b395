#include "runtime/host/print_values.hpp"

#include "runtime/app/value_text.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace stride::host {

void printValues(const app::SymbolTable &symbols, const std::vector<std::string> &names,
                 std::byte *state) {
  for (const std::string &name : names) {
    for (const app::Symbol &leaf : symbols.leaves(symbols.resolve(name))) {
      std::byte bit{};
      const void *value = leaf.read(state, bit);
      fmt::print("{} = {}\n", leaf.path(),
                 value != nullptr ? app::formatLiteral(symbols.app(), symbols.type(leaf), value)
                                  : std::string("NULL"));
    }
  }
  std::fflush(stdout);
}

} // namespace stride::host
