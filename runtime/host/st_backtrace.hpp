// Where in the ST an exception came from.
#ifndef STRIDE_RUNTIME_HOST_ST_BACKTRACE_HPP
#define STRIDE_RUNTIME_HOST_ST_BACKTRACE_HPP

#include "runtime/task/fault.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace stride::host {

/// One call in a call path.
struct StCall {
  std::string pou;  ///< `Main`, `Divider.Go`, `Tank.Level (GET)`.
  std::string file; ///< As the compiler was given it.
  int line = 0;     ///< Of the statement that was being executed.

  bool operator==(const StCall &) const = default;
};

/// The part of a call path that is ST, innermost first, with inlined calls, by the line tables of
/// the application; without a name where calls were left out. Empty when it has no tables.
std::vector<StCall> resolveCalls(std::span<const uintptr_t> calls);

/// `st::user::Divider::Go(stride::Ctx&, int)` becomes `Divider.Go`.
std::string pouName(const std::string &demangled);

/// task::describe, and where there are several calls a line for each:
///   in Divider.Go at Main.st:5
///   called by Main at Main.st:17
std::string describeWithCalls(const task::Fault &fault);

} // namespace stride::host

#endif
