// All kinds of I/O devices, as data: for the compiler and for the runtime.
#ifndef STRIDE_DRIVERS_IO_REGISTRY_HPP
#define STRIDE_DRIVERS_IO_REGISTRY_HPP

#include "drivers/can/io_schema.hpp"
#include "drivers/io/shared_memory_schema.hpp"
#include "drivers/io/simulated_schema.hpp"

#include <array>
#include <string_view>

/// Every kind by its namespace in stride::io: it has a `kSchema` (…_schema.hpp) and `makeDriver`
/// (io_drivers.hpp). A new one: a name here, and the include of its schema above.
#define STRIDE_IO_DRIVERS(DRIVER)                                                                  \
  DRIVER(simulated)                                                                                \
  DRIVER(shared_memory)                                                                            \
  DRIVER(can)

namespace stride::drivers {

#define STRIDE_SCHEMA_OF(space) &io::space::kSchema,
inline constexpr std::array kIoSchemas = {STRIDE_IO_DRIVERS(STRIDE_SCHEMA_OF)};
#undef STRIDE_SCHEMA_OF

/// The kind with that name, or null.
constexpr const io::IoSchema *findIoSchema(std::string_view name) {
  for (const io::IoSchema *schema : kIoSchemas)
    if (schema->name == name)
      return schema;
  return nullptr;
}

} // namespace stride::drivers

#endif
