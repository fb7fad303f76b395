// I/O with another process through shared memory (runtime/io/stride_io.h).
#ifndef STRIDE_DRIVERS_IO_SHARED_MEMORY_IO_HPP
#define STRIDE_DRIVERS_IO_SHARED_MEMORY_IO_HPP

#include "drivers/io/shared_memory_schema.hpp"
#include "runtime/io/io_driver.hpp"

namespace stride::io::shared_memory {

/// Opens the segment, or creates it. Throws app::Error when that is not possible. The segment is
/// left behind at the end, so that either side may be started again.
std::unique_ptr<IoDriver> makeDriver(const IoSettings &settings);

} // namespace stride::io::shared_memory

#endif
