// All drivers for axes, as data: for the compiler and for the runtime.
#ifndef STRIDE_DRIVERS_REGISTRY_HPP
#define STRIDE_DRIVERS_REGISTRY_HPP

#include "drivers/dummy/schema.hpp"

#include <array>
#include <string_view>

namespace stride::drivers {

/// A new driver: a line here, and one in axis_drivers.cpp.
inline constexpr std::array kSchemas = {dummy::kSchema};

/// The driver with that name, or null.
constexpr const bus::DriverSchema *findSchema(std::string_view name) {
  for (const bus::DriverSchema &schema : kSchemas)
    if (schema.name == name)
      return &schema;
  return nullptr;
}

} // namespace stride::drivers

#endif
