// An I/O device without hardware.
#ifndef STRIDE_DRIVERS_IO_SIMULATED_IO_HPP
#define STRIDE_DRIVERS_IO_SIMULATED_IO_HPP

#include "drivers/io/simulated_schema.hpp"
#include "runtime/io/io_driver.hpp"

namespace stride::io::simulated {

/// Its inputs are those that --set and the program write in the image, or (loop back) the outputs
/// as they were some cycles of the writing task before.
std::unique_ptr<IoDriver> makeDriver(const IoSettings &settings);

} // namespace stride::io::simulated

#endif
