// All kinds of I/O devices, to be made.
#ifndef STRIDE_DRIVERS_IO_IO_DRIVERS_HPP
#define STRIDE_DRIVERS_IO_IO_DRIVERS_HPP

#include "runtime/io/io_driver.hpp"
#include "runtime/io/io_schema.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace stride::drivers {

/// A kind of I/O device of this runtime.
struct IoDriverEntry {
  const io::IoSchema *schema;
  /// Throws app::Error for a device that cannot be opened.
  std::unique_ptr<io::IoDriver> (*make)(const io::IoSettings &settings);
};

/// The kind with that name, or null.
const IoDriverEntry *findIoDriver(std::string_view name);

/// "it has 'Simulated' and 'SharedMemory'", for messages.
std::string knownIoDrivers();

} // namespace stride::drivers

#endif
