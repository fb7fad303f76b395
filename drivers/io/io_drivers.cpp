#include "drivers/io/io_drivers.hpp"

#include "drivers/io/registry.hpp"

#include <array>
#include <cstddef>

// What every kind of the registry implements.
#define STRIDE_DECLARE_DRIVER(space)                                                               \
  namespace stride::io::space {                                                                    \
  std::unique_ptr<IoDriver> makeDriver(const IoSettings &settings);                                \
  }
STRIDE_IO_DRIVERS(STRIDE_DECLARE_DRIVER)
#undef STRIDE_DECLARE_DRIVER

namespace stride::drivers {

namespace {

#define STRIDE_DRIVER_ENTRY(space) IoDriverEntry{&io::space::kSchema, io::space::makeDriver},
constexpr std::array kIoDrivers = {STRIDE_IO_DRIVERS(STRIDE_DRIVER_ENTRY)};
#undef STRIDE_DRIVER_ENTRY

} // namespace

const IoDriverEntry *findIoDriver(std::string_view name) {
  for (const IoDriverEntry &driver : kIoDrivers)
    if (driver.schema->name == name)
      return &driver;
  return nullptr;
}

std::string knownIoDrivers() {
  std::string text = "it has ";
  for (size_t i = 0; i < kIoDrivers.size(); ++i) {
    text += i == 0 ? "'" : i + 1 < kIoDrivers.size() ? ", '" : " and '";
    text.append(kIoDrivers[i].schema->name).append("'");
  }
  return text;
}

} // namespace stride::drivers
