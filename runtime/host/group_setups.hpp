// What the drivers of an application are told.
#ifndef STRIDE_RUNTIME_HOST_GROUP_SETUPS_HPP
#define STRIDE_RUNTIME_HOST_GROUP_SETUPS_HPP

#include "runtime/app/abi.h"
#include "runtime/bus/group_setup.hpp"

namespace stride::host {

/// The configuration of an axis group as its driver gets it. `schema` is that driver's, and must
/// live as long as the result.
bus::GroupSetup groupSetup(const StrideAppV1 &app, const AxisGroupDesc &group,
                           const bus::DriverSchema &schema);

} // namespace stride::host

#endif
