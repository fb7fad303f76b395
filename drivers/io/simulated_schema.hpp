// `device = "Simulated"`: an I/O device without hardware.
#ifndef STRIDE_DRIVERS_IO_SIMULATED_SCHEMA_HPP
#define STRIDE_DRIVERS_IO_SIMULATED_SCHEMA_HPP

#include "runtime/io/io_schema.hpp"

#include <array>

namespace stride::io::simulated {

inline constexpr std::array kParameters = {
    common::flag("loop_back").defaultsTo(0).says("its inputs are its outputs"),
    common::whole("delay", 0, 1000, "cycles")
        .defaultsTo(0)
        .onlyWith("loop_back", 1)
        .says("with `loop_back`: the inputs follow this many cycles of the writing task later"),
};

inline constexpr IoSchema kSchema = {
    .name = "Simulated", .external = false, .parameters = kParameters};

} // namespace stride::io::simulated

#endif
