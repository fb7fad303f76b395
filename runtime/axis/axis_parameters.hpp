// Parameters of AXIS_REF by number.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_AXIS_PARAMETERS_HPP
#define STRIDE_RUNTIME_AXIS_AXIS_PARAMETERS_HPP

#include "runtime/axis/axis_parameter.hpp"
#include "runtime/axis/axis_ref.hpp"

namespace stride::axis {

/// The parameter with a number, its own or PLCopen's; null if there is none.
[[nodiscard]] const AxisParameter *findParameter(int32_t number) noexcept;

/// Its value; a BOOL is 0 or 1.
[[nodiscard]] double readParameter(const AxisRef &axis, const AxisParameter &parameter) noexcept;

/// Gives it a value, rounded if it is a whole number. False: it is not to be written, or the value
/// is none that its type has.
bool writeParameter(AxisRef &axis, const AxisParameter &parameter, double value) noexcept;

} // namespace stride::axis

#endif
