// `--print`: values at the end of a run.
#ifndef STRIDE_RUNTIME_HOST_PRINT_VALUES_HPP
#define STRIDE_RUNTIME_HOST_PRINT_VALUES_HPP

#include "runtime/app/symbols.hpp"

#include <vector>

namespace stride::host {

/// A line per elementary value below the symbols, on standard output: `Ipo.p = 50.0`.
void printValues(const app::SymbolTable &symbols, const std::vector<app::Symbol> &wanted,
                 std::byte *state);

} // namespace stride::host

#endif
