// Objects of a path the other way round. Free of the C++ standard library: linked into every
// application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_OBJECT_REVERSE_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_OBJECT_REVERSE_HPP

#include "runtime/numeric/cnc/path_object.hpp"

namespace stride::cnc {

/// The same piece of the path from its end to its start: same places, same velocity, accelerations,
/// source; switch points are where they were. `velocityEnd` is what the path has at its start.
PathObject reversed(const PathObject &object, double velocityEnd) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_OBJECT_REVERSE_HPP
