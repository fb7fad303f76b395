// `--print`: values at the end of a run.
#ifndef STRIDE_RUNTIME_HOST_PRINT_VALUES_HPP
#define STRIDE_RUNTIME_HOST_PRINT_VALUES_HPP

#include "runtime/app/symbols.hpp"

#include <string>
#include <vector>

namespace stride::host {

/// A line per elementary value below the names, on standard output: `Ipo.p = 50.0`. Throws
/// app::Error for an unknown name.
void printValues(const app::SymbolTable &symbols, const std::vector<std::string> &names,
                 std::byte *state);

} // namespace stride::host

#endif
