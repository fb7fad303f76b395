#include "drivers/can/can_setup.hpp"

#include "drivers/can/master/frames.hpp"
#include "drivers/can/schema.hpp"

#include <algorithm>

namespace stride::can {
namespace {

constexpr double kHomingPatience = 2; // s
constexpr double kFaultResetTime = 1; // s
constexpr uint32_t kUsualBitRate = 1000;

// SyncProducer
constexpr int kFirstDrive = 1;
constexpr int kDevice = 2;

DriveConfig driveConfig(const bus::SetupParameters &given, double cycle) {
  DriveConfig drive;
  drive.cycle = cycle;
  const auto cycles = [&](const char *name) { return cyclesOf(given.number(name), cycle); };
  drive.power.off = given.number("power_off") == static_cast<double>(kShutdown)
                        ? PowerOff::Shutdown
                        : PowerOff::DisableVoltage;
  drive.power.timeout = cycles("power_timeout");
  drive.power.resetTime = cyclesOf(kFaultResetTime, cycle);
  drive.brakeRelease = given.number("brake_release") > 0 ? cycles("brake_release") : 0;
  drive.modeTimeout = cycles("mode_timeout");
  drive.homingTimeout = cyclesOf(kHomingPatience, cycle);
  drive.homesItself = given.number("homing") == static_cast<double>(kHomesItself);
  drive.inputsInverted = static_cast<uint8_t>(given.number("inputs_inverted"));
  drive.probeInputs = static_cast<uint8_t>(given.number("probe_inputs"));
  drive.torqueRated = given.number("torque_rated");
  drive.velocityScale = given.number("velocity_scale");
  return drive;
}

NodeConfig nodeConfig(const bus::GroupSetup &setup, const bus::SetupParameters &given,
                      const DrivePlan &plan) {
  NodeConfig node;
  node.plan = plan;
  node.cycle = setup.cycleSeconds;
  node.drive = driveConfig(given, setup.cycleSeconds);
  node.reset = static_cast<NodeConfig::Reset>(given.number("reset"));
  node.identity = {static_cast<uint32_t>(given.number("identity.vendor")),
                   static_cast<uint32_t>(given.number("identity.product")),
                   static_cast<uint32_t>(given.number("identity.revision")),
                   static_cast<uint32_t>(given.number("identity.serial"))};
  node.sdoTimeout = setup.busParameters.number("sdo_timeout");
  node.heartbeat = setup.busParameters.number("heartbeat");
  node.masterNode = static_cast<uint8_t>(setup.busParameters.number("node_id"));
  node.guard = given.number("guard");
  node.pdoTimeout = static_cast<uint32_t>(given.number("pdo_timeout"));
  return node;
}

/// Why a drive cannot be started at all.
std::string faultOf(const PlanResult &plan, uint32_t id, const bus::GroupSetup &setup,
                    bool hasSyncDevice) {
  if (id == 0 || id > kLastNode)
    return "wDriveId is its node id: 1 to 127";
  const auto own = static_cast<uint32_t>(setup.busParameters.number("node_id"));
  if (id == own)
    return "its node id is the master's own (node_id)";
  if (hasSyncDevice && id == kSyncDevice)
    return "its node id is that of the SYNC device";
  if (std::count_if(setup.drives.begin(), setup.drives.end(),
                    [id](const bus::DriveSetup &drive) { return drive.id == id; }) > 1)
    return "another drive has the same wDriveId";
  for (const PlanNote note : plan.notes)
    if (isError(note))
      return std::string(describe(note));
  return {};
}

/// A place in the list of nodes that nobody answers at.
NodeConfig nobody(const NodeConfig &like) {
  NodeConfig node = like;
  node.plan = {};
  return node;
}

} // namespace

DriveWish driveWish(uint32_t node, const bus::SetupParameters &given) {
  DriveWish wish;
  wish.node = node <= kLastNode ? static_cast<uint8_t>(node) : uint8_t{0};
  wish.controlType = static_cast<uint8_t>(given.number("wControlType"));
  for (size_t i = 0; i < wish.send.size(); ++i) {
    const std::string place = std::to_string(i + 1);
    wish.send[i] = static_cast<uint16_t>(given.number("wCyclicDataS" + place));
    wish.receive[i] = static_cast<uint16_t>(given.number("wCyclicDataR" + place));
  }
  wish.modeInPdo = given.flag("mode_pdo");
  wish.eventPdos = given.flag("event_pdos");
  wish.inputs = given.flag("inputs");
  wish.probeInputs = static_cast<uint8_t>(given.number("probe_inputs"));
  return wish;
}

CanSetup canSetup(const bus::GroupSetup &setup) {
  CanSetup result;
  MasterConfig &master = result.master;
  const auto producer = static_cast<int>(setup.parameters.number("SyncProducer"));
  result.hasSyncDevice = producer == kDevice;
  std::vector<DrivePlan> plans;
  for (const bus::DriveSetup &drive : setup.drives) {
    const PlanResult plan = planDrive(driveWish(drive.id, drive.parameters));
    NodeConfig node = nodeConfig(setup, drive.parameters, plan.plan);
    result.faults.push_back(faultOf(plan, drive.id, setup, result.hasSyncDevice));
    if (!result.faults.back().empty())
      node = nobody(node);
    node.producesSync = producer == kFirstDrive && master.nodes.empty();
    plans.push_back(node.plan);
    master.nodes.push_back(std::move(node));
  }
  if (result.hasSyncDevice) {
    NodeConfig device;
    device.kind = NodeConfig::Kind::SyncDevice;
    device.plan.node = kSyncDevice;
    device.cycle = setup.cycleSeconds;
    device.sdoTimeout = setup.busParameters.number("sdo_timeout");
    device.producesSync = true;
    master.nodes.push_back(device);
  }
  master.cycle = setup.cycleSeconds;
  master.heartbeat = setup.busParameters.number("heartbeat");
  master.node = static_cast<uint8_t>(setup.busParameters.number("node_id"));
  master.givesSync = producer != kFirstDrive && producer != kDevice;
  const auto rate = static_cast<uint32_t>(setup.parameters.number("BaudRate"));
  result.bitRate = rate == 0 ? kUsualBitRate : rate;
  const double cycleUs = std::clamp(setup.cycleSeconds * 1e6 + 0.5, 1.0, 4e9);
  result.load = busLoad(plans, result.bitRate, static_cast<uint32_t>(cycleUs));
  master.sdoPerCycle = result.load.sdoPerCycle;
  result.interface = setup.busParameters.text("interface");
  if (result.interface.empty())
    result.interface =
        "can" + std::to_string(static_cast<int>(setup.parameters.number("ControllerNo")));
  return result;
}

} // namespace stride::can
