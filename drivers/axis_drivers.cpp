#include "drivers/axis_drivers.hpp"

#include "drivers/dummy/dummy_drive.hpp"
#include "drivers/registry.hpp"

#include <array>
#include <cstddef>

namespace stride::drivers {

namespace {

constexpr std::array kDrivers = {
    DriverEntry{dummy::kSchema, ::st::DummyDrive::DUMMY_DRIVE_SIM__layout__,
                dummy::makeDummyDriver},
};

constexpr bool sameNames() {
  for (std::size_t i = 0; i < kDrivers.size(); ++i)
    if (kDrivers[i].schema.name != kSchemas[i].name)
      return false;
  return kDrivers.size() == kSchemas.size();
}
static_assert(sameNames(), "a driver that the compiler knows is missing here, or the other way");

} // namespace

const DriverEntry *findDriver(std::string_view name) {
  for (const DriverEntry &driver : kDrivers)
    if (driver.schema.name == name)
      return &driver;
  return nullptr;
}

std::string knownDrivers() {
  std::string text = "it has ";
  for (std::size_t i = 0; i < kDrivers.size(); ++i) {
    text += i == 0 ? "'" : ", '";
    text.append(kDrivers[i].schema.interfaceType).append("'");
  }
  return text;
}

} // namespace stride::drivers
