// Interface type "Dummy": see docs/dummy-drive.md.
#ifndef STRIDE_DRIVERS_DUMMY_SCHEMA_HPP
#define STRIDE_DRIVERS_DUMMY_SCHEMA_HPP

#include "drivers/dummy/physics_schema.hpp"
#include "runtime/bus/driver_schema.hpp"

#include <array>

namespace stride::dummy {

// Faults of a simulated SYNC, for groups whose task waits for it.
inline constexpr std::array kGroupSimulation = {
    common::duration("sync_offset")
        .defaultsTo(0)
        .says("how long after the beginning of a cycle (`dwCycle`) SYNC comes"),
    common::whole("sync_lost", 2, 1000000, "SYNCs")
        .says("of this many the last one does not come; default: all come"),
};
inline constexpr std::array kAxisGroupTables = {
    common::ParameterTable{"simulation", "the simulation of a bus", kGroupSimulation}};

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
    .axisGroupTables = kAxisGroupTables,
    .driveTables = kDriveTables,
    .encoderTables = kEncoderTables,
};

} // namespace stride::dummy

#endif
