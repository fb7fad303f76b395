// `--print`: values at the end of a run.
#ifndef STRIDE_RUNTIME_HOST_PRINT_VALUES_HPP
#define STRIDE_RUNTIME_HOST_PRINT_VALUES_HPP

#include "runtime/app/symbols.hpp"
#include "runtime/host/output.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stride::host {

/// A line per elementary value below the names: `Ipo.p = 50.0`. Throws app::Error for an unknown
/// name.
std::string printedValues(const app::SymbolTable &symbols, const std::vector<std::string> &names,
                          std::byte *state);

/// Writes it to standard output: 0, or the errno of what is missing there (ETIMEDOUT: nobody reads
/// it, with Output::Wait::Never).
int print(std::string_view text, Output::Wait wait);

} // namespace stride::host

#endif
