// Interface type "Dummy": see docs/dummy-drive.md.
#ifndef STRIDE_DRIVERS_DUMMY_SCHEMA_HPP
#define STRIDE_DRIVERS_DUMMY_SCHEMA_HPP

#include "drivers/dummy/physics_schema.hpp"
#include "runtime/bus/driver_schema.hpp"

#include <array>

namespace stride::dummy {

inline constexpr std::array kDriveTables = {
    common::ParameterTable{"physics", "the physics of a drive", physics::kDrive}};
inline constexpr std::array kEncoderTables = {
    common::ParameterTable{"physics", "the physics of an encoder", physics::kEncoder}};

inline constexpr bus::DriverSchema kSchema = {
    .name = "Dummy",
    .interfaceType = "Dummy (simulated drives)",
    .driveData = {.type = "DummyDrive.DUMMY_DRIVE_SIM",
                  .table = "physics",
                  .suffix = "_Sim",
                  .what = "simulation of drive"},
    .givesSync = true,
    .driveTables = kDriveTables,
    .encoderTables = kEncoderTables,
};

} // namespace stride::dummy

#endif
