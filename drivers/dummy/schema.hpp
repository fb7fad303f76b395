// Interface type "Dummy": see docs/dummy-drive.md.
#ifndef STRIDE_DRIVERS_DUMMY_SCHEMA_HPP
#define STRIDE_DRIVERS_DUMMY_SCHEMA_HPP

#include "runtime/bus/driver_schema.hpp"

namespace stride::dummy {

inline constexpr bus::DriverSchema kSchema = {"Dummy", "Dummy (simulated drives)",
                                              "DummyDrive.DUMMY_DRIVE_SIM", true};

} // namespace stride::dummy

#endif
