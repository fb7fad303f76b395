#include "drivers/axis_drivers.hpp"

#include "drivers/registry.hpp"

#include <array>
#include <cstddef>

// What every driver of the registry implements in its folder.
#define STRIDE_DECLARE_DRIVER(folder)                                                              \
  namespace stride::folder {                                                                       \
  uint64_t driveDataLayout();                                                                      \
  std::unique_ptr<bus::AxisDriver> makeDriver(const bus::GroupSetup &setup);                       \
  }
STRIDE_AXIS_DRIVERS(STRIDE_DECLARE_DRIVER)
#undef STRIDE_DECLARE_DRIVER

namespace stride::drivers {

namespace {

#define STRIDE_DRIVER_ENTRY(folder)                                                                \
  DriverEntry{&folder::kSchema, folder::driveDataLayout, folder::makeDriver},
constexpr std::array kDrivers = {STRIDE_AXIS_DRIVERS(STRIDE_DRIVER_ENTRY)};
#undef STRIDE_DRIVER_ENTRY

} // namespace

const DriverEntry *findDriver(std::string_view name) {
  for (const DriverEntry &driver : kDrivers)
    if (driver.schema->name == name)
      return &driver;
  return nullptr;
}

std::string knownDrivers() {
  std::string text = "it has ";
  for (size_t i = 0; i < kDrivers.size(); ++i) {
    text += i == 0 ? "'" : ", '";
    text.append(kDrivers[i].schema->interfaceType).append("'");
  }
  return text;
}

} // namespace stride::drivers
