// All drivers for axes, as data: for the compiler and for the runtime.
#ifndef STRIDE_DRIVERS_REGISTRY_HPP
#define STRIDE_DRIVERS_REGISTRY_HPP

#include "drivers/can/schema.hpp"
#include "drivers/dummy/schema.hpp"
#include "drivers/sercos/schema.hpp"

#include <array>
#include <string_view>

/// Every driver by its folder, which is its namespace, too: it has a `kSchema` (schema.hpp),
/// `makeDriver` and `driveDataLayout` (axis_drivers.hpp). A new driver: a name here, and the
/// include of its schema above.
#define STRIDE_AXIS_DRIVERS(DRIVER) DRIVER(dummy) DRIVER(can) DRIVER(sercos)

namespace stride::drivers {

#define STRIDE_SCHEMA_OF(folder) &folder::kSchema,
inline constexpr std::array kSchemas = {STRIDE_AXIS_DRIVERS(STRIDE_SCHEMA_OF)};
#undef STRIDE_SCHEMA_OF

/// The driver with that name, or null.
constexpr const bus::DriverSchema *findSchema(std::string_view name) {
  for (const bus::DriverSchema *schema : kSchemas)
    if (schema->name == name)
      return schema;
  return nullptr;
}

} // namespace stride::drivers

#endif
