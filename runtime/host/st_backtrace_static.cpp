// In static executables: without the library that reads line tables, and without the call path. The
// place of the exception itself is known without them.
#include "runtime/host/st_backtrace.hpp"

namespace stride::host {

std::string describeWithCalls(const task::Fault &fault) { return task::describe(fault); }

} // namespace stride::host
