// Interface type "CAN": CiA 402 drives on CANopen.
#ifndef STRIDE_DRIVERS_CAN_SCHEMA_HPP
#define STRIDE_DRIVERS_CAN_SCHEMA_HPP

#include "drivers/dummy/physics_schema.hpp"
#include "runtime/bus/driver_schema.hpp"

#include <array>
#include <cstdint>

namespace stride::can {

// power_off
inline constexpr int64_t kDisableVoltage = 0;
inline constexpr int64_t kShutdown = 1;
// reset
inline constexpr int64_t kResetCommunication = 0;
inline constexpr int64_t kResetNode = 1;
inline constexpr int64_t kResetNone = 2;
// when
inline constexpr int64_t kAtSync = 0;
inline constexpr int64_t kByEvent = 1;
// lss
inline constexpr int64_t kLssNone = 0;
inline constexpr int64_t kLssSet = 1;
inline constexpr int64_t kLssStore = 2;
// homing
inline constexpr int64_t kHomesItself = 0;
inline constexpr int64_t kHomedByController = 1;

namespace rows {

using common::Choice;
using common::choice;
using common::duration;
using common::flag;
using common::ParameterValues;
using common::positive;
using common::text;
using common::whole;

inline constexpr std::array<Choice, 2> kPowerOffs = {
    {{"disable_voltage", kDisableVoltage}, {"shutdown", kShutdown}}};
inline constexpr std::array<Choice, 3> kResets = {
    {{"communication", kResetCommunication}, {"node", kResetNode}, {"none", kResetNone}}};
inline constexpr std::array<Choice, 3> kLss = {
    {{"none", kLssNone}, {"set", kLssSet}, {"store", kLssStore}}};
inline constexpr std::array<Choice, 2> kHomings = {
    {{"drive", kHomesItself}, {"controller", kHomedByController}}};

// Whether a PDO is sent at every SYNC or when something changes.
inline constexpr std::array<Choice, 2> kWhens = {{{"sync", kAtSync}, {"event", kByEvent}}};

/// A list of texts.
constexpr common::Parameter list(std::string_view name) {
  return {name, common::ParameterType::NameList};
}

constexpr double limitsAreUsed(const ParameterValues &values) {
  return values.number("bHWLimitEnable");
}

inline constexpr std::array kBus = {
    text("interface")
        .says("the CAN interface of the system; default: `can` and the `ControllerNo` of the axis "
              "group, `can0`"),
    whole("node_id", 1, 127)
        .defaultsTo(126)
        .says("the master's own node id, which only its heartbeat has"),
    duration("heartbeat")
        .defaultsTo(0.1)
        .says("period of the heartbeats of master and drives; whoever misses 1.5 of them knows "
              "that the other one is gone"),
    duration("sdo_timeout").defaultsTo(0.5).says("for each answer to an SDO"),
    duration("lss_wait")
        .defaultsTo(2)
        .says("a node with `lss` that does not answer is looked for again for so long, as it may "
              "still be booting; `T#1ms`: it is looked for once"),
    duration("time_stamp")
        .says("the master sends the time of day (object 100h, TIME_OF_DAY) so often; default: "
              "never"),
    duration("read_wait")
        .says("after SYNC a cycle waits so long at most for what the drives say at it: actual "
              "values are "
              "known one cycle earlier then; on a real bus only; default: no cycle waits"),
};

inline constexpr std::array kDrive = {
    whole("axis", 0, 7)
        .defaultsTo(0)
        .says("which axis of its device it is: one node may be several drives (logical devices of "
              "CiA 301), each with objects 800h and PDOs 64 after those of the one before"),
    choice("reset", kResets)
        .defaultsTo(kResetCommunication)
        .says("what the drive is told by NMT when its start-up begins"),
    duration("guard").says(
        "node guarding with this period instead of a heartbeat, for drives without 1017h"),
    choice("lss", kLss)
        .defaultsTo(kLssNone)
        .says("before its start-up the node is found by its `identity`, which must be whole, and "
              "given its node id (LSS, CiA 305): each time, or for good together with the bit "
              "rate"),
    choice("power_off", kPowerOffs)
        .defaultsTo(kDisableVoltage)
        .says("controlword of a drive that is off: 0000h, or 0006h, with which it stays ready"),
    duration("power_timeout")
        .defaultsTo(2)
        .says("for a transition of the drive's state machine; after it the drive has error 1"),
    duration("brake_release")
        .defaultsTo(0)
        .says("after operation is enabled, until set values are followed"),
    duration("mode_timeout").defaultsTo(0.5).says("for a change of the mode of operation"),
    flag("mode_pdo")
        .defaultsTo(0)
        .says("6060h and 6061h are in PDOs also where they take room in every cycle; else by SDO "
              "there"),
    flag("event_pdos")
        .defaultsTo(1)
        .says("controlword, statusword and inputs may have PDOs of their own, which are sent when "
              "something changes"),
    choice("homing", kHomings)
        .defaultsTo(kHomesItself)
        .says("who makes the reference run of `MC_Home`: the drive in its homing mode, or nobody, "
              "as `SMC_Homing` does it"),
    flag("inputs")
        .defaultsTo(limitsAreUsed, "`bHWLimitEnable`")
        .says("limit switches and home switch come from 60FDh"),
    whole("inputs_inverted", 0, 7)
        .defaultsTo(0)
        .says("that are actuated when 60FDh shows 0: 1 negative limit, 2 positive limit, 4 home "
              "switch, or their sum"),
    whole("probe_inputs", 0, 15)
        .defaultsTo(0)
        .says("touch probes of the drive: 1 + 2 for both edges of the first, 4 + 8 of the second"),
    positive("torque_rated", "Nm")
        .says("what 100 % of 6071h and 6077h are; default: what the drive says in 6076h"),
    positive("velocity_scale", "increments/s")
        .defaultsTo(1)
        .says("one unit of the drive's velocities (606Ch, 60FFh, 60B1h)"),
    list("startup").says(
        "objects that are written when the drive starts, after its PDOs, in this order: "
        "`[\"6098h := 35\", \"2031h:2 := UINT#500\", \"2033h := 'Axis 1'\"]`; the type may be left "
        "out where CiA 402 fixes it"),
    text("parameters")
        .says("a file in the folder for files, written by SMC_WriteDriveParamsToFile as text or "
              "XML: its parameters are written when the drive starts, after `startup`"),
    whole("pdo_timeout", 1, 1000, "cycles")
        .defaultsTo(3)
        .says("without a synchronous PDO until the drive counts as silent"),
};

inline constexpr std::array kIdentity = {
    whole("vendor", 0, common::kLargestDword).defaultsTo(0).says("1018h:1, 0: any"),
    whole("product", 0, common::kLargestDword).defaultsTo(0).says("1018h:2"),
    whole("revision", 0, common::kLargestDword).defaultsTo(0).says("1018h:3"),
    whole("serial", 0, common::kLargestDword).defaultsTo(0).says("1018h:4"),
};

// An encoder is served as a drive is, as far as it goes.
inline constexpr std::array kEncoder = {
    common::Parameter{"second_of", common::ParameterType::DriveName}.says(
        "it is the second encoder of this drive (60E4h:1), in the drive's PDOs, and no node of its "
        "own: `wEncoderId` is without meaning"),
    kDrive[1].onlyWithout("second_of"),
    kDrive[2].onlyWithout("second_of"),
    kDrive[3].onlyWithout("second_of"),
    whole("pdo_timeout", 1, 1000, "cycles")
        .defaultsTo(3)
        .onlyWithout("second_of")
        .says("without its PDO until the encoder counts as silent"),
    list("startup")
        .onlyWithout("second_of")
        .says("objects that are written when the encoder starts, after its PDOs, as of a drive: "
              "`[\"6000h := UINT#4\", \"6001h := UDINT#4096\"]`"),
};

inline constexpr std::array kRpdo = {
    list("map").needed().says("what it has in it: `[\"6040h\", \"607Ah\", \"2031h:2:16\"]`; the "
                              "bits after the subindex may be left out where CiA 402 fixes them"),
    choice("when", kWhens)
        .defaultsTo(kAtSync)
        .says("whether it is sent in every cycle, or when something in it changes"),
};

inline constexpr std::array kTpdo = {
    kRpdo[0],
    kRpdo[1],
    duration("inhibit")
        .defaultsTo(0)
        .onlyWith("when", kByEvent)
        .says("shortest time between two of them, in steps of 100 µs"),
    duration("event")
        .defaultsTo(0.1)
        .onlyWith("when", kByEvent)
        .says("it is sent at least so often"),
};

inline constexpr std::array kDriveTables = {
    common::ParameterTable{"identity", "the identity of a drive", kIdentity},
    common::ParameterTable{"rpdo1", "an RPDO of a drive", kRpdo},
    common::ParameterTable{"rpdo2", "an RPDO of a drive", kRpdo},
    common::ParameterTable{"rpdo3", "an RPDO of a drive", kRpdo},
    common::ParameterTable{"rpdo4", "an RPDO of a drive", kRpdo},
    common::ParameterTable{"tpdo1", "a TPDO of a drive", kTpdo},
    common::ParameterTable{"tpdo2", "a TPDO of a drive", kTpdo},
    common::ParameterTable{"tpdo3", "a TPDO of a drive", kTpdo},
    common::ParameterTable{"tpdo4", "a TPDO of a drive", kTpdo},
    common::ParameterTable{"physics", "the physics of a simulated drive", dummy::physics::kDrive}};

inline constexpr std::array kEncoderTables = {
    common::ParameterTable{"identity", "the identity of an encoder", kIdentity},
    common::ParameterTable{"tpdo1", "a TPDO of an encoder", kTpdo},
    common::ParameterTable{"tpdo2", "a TPDO of an encoder", kTpdo},
    common::ParameterTable{"tpdo3", "a TPDO of an encoder", kTpdo},
    common::ParameterTable{"tpdo4", "a TPDO of an encoder", kTpdo},
    common::ParameterTable{"physics", "the physics of a simulated encoder",
                           dummy::physics::kEncoder}};

} // namespace rows

/// See drivers/can/plan/group_plan.hpp.
void checkGroup(const bus::GroupSetup &setup, bus::GroupFindings &findings);

bus::GroupPlanText describeGroup(const bus::GroupSetup &setup);

inline constexpr bus::DriverSchema kSchema = {
    .name = "CAN",
    .interfaceType = "CAN (SocketCAN)",
    .driveData = {.type = "DummyDrive.DUMMY_DRIVE_SIM",
                  .table = "physics",
                  .suffix = "_Sim",
                  .what = "simulation of drive"},
    .groupData = {.type = "SM_CAN.SMC_CAN_COUNTERS",
                  .suffix = "_Can",
                  .what = "counters of axis group"},
    .givesSync = true,
    .records = true,
    .bus = rows::kBus,
    .drive = rows::kDrive,
    .encoder = rows::kEncoder,
    .driveTables = rows::kDriveTables,
    .encoderTables = rows::kEncoderTables,
    .check = checkGroup,
    .plan = describeGroup,
};

} // namespace stride::can

#endif
