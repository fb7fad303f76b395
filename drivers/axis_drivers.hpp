// All drivers for axes, to be made.
#ifndef STRIDE_DRIVERS_AXIS_DRIVERS_HPP
#define STRIDE_DRIVERS_AXIS_DRIVERS_HPP

#include "runtime/bus/axis_driver.hpp"
#include "runtime/bus/driver_schema.hpp"
#include "runtime/bus/group_setup.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace stride::drivers {

/// A driver of this runtime.
struct DriverEntry {
  const bus::DriverSchema *schema;
  /// The layout hash of the type in schema->driveData, as this runtime knows it; 0: it has none.
  uint64_t (*driveDataLayout)();
  std::unique_ptr<bus::AxisDriver> (*make)(const bus::GroupSetup &setup);
};

/// The driver with that name, or null.
const DriverEntry *findDriver(std::string_view name);

/// "it has 'Dummy (simulated drives)'", for messages.
std::string knownDrivers();

} // namespace stride::drivers

#endif
