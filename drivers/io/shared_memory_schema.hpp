// `device = "SharedMemory"`: I/O with another process.
#ifndef STRIDE_DRIVERS_IO_SHARED_MEMORY_SCHEMA_HPP
#define STRIDE_DRIVERS_IO_SHARED_MEMORY_SCHEMA_HPP

#include "runtime/io/io_schema.hpp"

#include <array>

namespace stride::io::shared_memory {

inline constexpr std::array kParameters = {
    common::text("segment")
        .defaultsTo("/{project}-{name}")
        .says("name of the segment; `{project}` and `{name}` are those of the project and the "
              "device"),
    common::duration("timeout").says("the device counts as lost when the other side has written "
                                     "nothing for this long; default: never"),
};

inline constexpr IoSchema kSchema = {
    .name = "SharedMemory", .external = true, .parameters = kParameters};

} // namespace stride::io::shared_memory

#endif
