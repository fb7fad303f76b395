// Interface type "Sercos": drives on an optical Sercos ring (I, II). See docs/sercos.md.
#ifndef STRIDE_DRIVERS_SERCOS_SCHEMA_HPP
#define STRIDE_DRIVERS_SERCOS_SCHEMA_HPP

#include "drivers/dummy/physics_schema.hpp"
#include "runtime/bus/driver_schema.hpp"

#include <array>
#include <cstdint>

namespace stride::sercos {

// device_type
inline constexpr int64_t kDrive = 0;
inline constexpr int64_t kIoDevice = 1;
// homing
inline constexpr int64_t kHomesItself = 0;
inline constexpr int64_t kHomedByController = 1;

namespace rows {

using common::choice;
using common::Choice;
using common::duration;
using common::positive;
using common::text;
using common::whole;

inline constexpr std::array<Choice, 2> kDevices = {{{"drive", kDrive}, {"io", kIoDevice}}};
inline constexpr std::array<Choice, 2> kHomings = {
    {{"drive", kHomesItself}, {"controller", kHomedByController}}};
/// PackProfile.
inline constexpr std::array<Choice, 4> kProfiles = {
    {{"none", 0}, {"BasicA", 1}, {"BasicB", 2}, {"Extended", 3}}};

/// A list of texts.
constexpr common::Parameter list(std::string_view name) {
  return {name, common::ParameterType::NameList};
}

inline constexpr std::array kDrive = {
    choice("device_type", kDevices)
        .defaultsTo(sercos::kDrive)
        .says("an I/O device gets neither scaling nor modes from the driver, and only what "
              "`additional` and `additional_sent` name is exchanged with it"),
    list("locked").says("IDNs that the driver does not write: `[\"S-0-0076\"]`"),
    list("additional")
        .says("what else comes from the drive in each cycle, IDN and bytes: "
              "`[\"S-0-0189:4\"]`"),
    list("additional_sent").says("what else goes to the drive in each cycle"),
    choice("packprofile", kProfiles)
        .defaultsTo(0)
        .says("the PackProfile that the drive must meet: checked in stride.toml, and again in the "
              "drive after its start-up"),
    text("parameters")
        .says("a file of `SMC_WriteDriveParamsToFile`, text or XML, in the folder for files: its "
              "values are written when the drive starts"),
    choice("homing", kHomings)
        .defaultsTo(kHomesItself)
        .says("who makes the reference run of `MC_Home`: the drive by its command S-0-0148, or "
              "nobody, as `SMC_Homing` does it"),
    whole("probe_inputs", 0, 15)
        .defaultsTo(0)
        .says("probes of the drive: 1 + 2 for both edges of the first, 4 + 8 of the second"),
    positive("torque_rated", "Nm")
        .defaultsTo(100)
        .says("what 100 % of the drive's torques are; with 100 torques are in percent"),
    whole("service_timeout", 1, 100000, "cycles")
        .defaultsTo(10)
        .says("for a step of the service channel"),
    duration("command_timeout")
        .defaultsTo(5)
        .says("for a procedure command of the start-up, S-0-0127 or S-0-0128"),
    duration("power_timeout")
        .defaultsTo(2)
        .says("for the drive to get or lose torque; after it the drive has error 65535"),
    duration("mode_timeout").defaultsTo(0.5).says("for a change of the operation mode"),
};

inline constexpr std::array kEncoder = {
    common::Parameter{"second_of", common::ParameterType::DriveName}.says(
        "it is the second encoder of this drive (S-0-0053), which the drive tells in each cycle; "
        "`wEncoderId` is without meaning"),
};

inline constexpr std::array kIdn = {
    list("phase2").says("written in phase 2, in this order: `[\"S-0-0138 := 5000\"]`"),
    list("phase3").says("written in phase 3"),
    list("phase4").says("written at the start of phase 4"),
};

inline constexpr std::array kDriveTables = {
    common::ParameterTable{"idn", "the init data of a drive", kIdn},
    common::ParameterTable{"physics", "the physics of a simulated drive", dummy::physics::kDrive}};

} // namespace rows

/// See drivers/sercos/plan/group_plan.hpp.
void checkGroup(const bus::GroupSetup &setup, bus::GroupFindings &findings);

bus::GroupPlanText describeGroup(const bus::GroupSetup &setup);

inline constexpr bus::DriverSchema kSchema = {
    .name = "Sercos",
    .interfaceType = "Sercos (3S-SercosBase)",
    .driveData = {.type = "SercosDrive.SERCOS_DRIVE_SIM",
                  .table = "physics",
                  .suffix = "_Sim",
                  .what = "simulation of drive"},
    .groupData = {.type = "SercosDrive.SERCOS_RING_SIM",
                  .suffix = "_Sim",
                  .what = "simulation of axis group"},
    .givesSync = true,
    .drive = rows::kDrive,
    .encoder = rows::kEncoder,
    .driveTables = rows::kDriveTables,
    .check = checkGroup,
    .plan = describeGroup,
};

} // namespace stride::sercos

#endif
