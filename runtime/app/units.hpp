// Units of variables, as the PLC configuration gives them.
#ifndef STRIDE_RUNTIME_APP_UNITS_HPP
#define STRIDE_RUNTIME_APP_UNITS_HPP

#include "runtime/app/abi.h"

#include <string>
#include <string_view>

namespace stride::app {

/// The unit of a member of a drive or an axis with a `unit` in stride.toml (`mm/s` of
/// `Drive.fSetVelocity`); empty: it is not known.
[[nodiscard]] std::string unitOf(const StrideAppV1 &app, std::string_view path);

} // namespace stride::app

#endif
