// What compiler and runtime know of a driver before there is one. Data only: it needs no library.
#ifndef STRIDE_RUNTIME_BUS_DRIVER_SCHEMA_HPP
#define STRIDE_RUNTIME_BUS_DRIVER_SCHEMA_HPP

#include <string_view>

namespace stride::bus {

struct DriverSchema {
  std::string_view name;          ///< The first word of InterfaceType.
  std::string_view interfaceType; ///< An InterfaceType of it, for messages.
  /// The ST type, with its library, of a variable that driver and program share for each drive that
  /// asks for one (AXIS_REF.pMS leads there); empty: there is none.
  std::string_view driveData;
  bool givesSync; ///< The bus has a SYNC every dwCycle of its own, so that bSync needs no other
                  ///< task.
};

} // namespace stride::bus

#endif
