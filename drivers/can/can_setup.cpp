#include "drivers/can/can_setup.hpp"

#include "drivers/can/master/frames.hpp"
#include "drivers/can/plan/parameter_file.hpp"
#include "drivers/can/schema.hpp"
#include "runtime/common/folder_file.hpp"

#include <algorithm>
#include <optional>

namespace stride::can {
namespace {

constexpr double kHomingPatience = 2; // s
constexpr double kFaultResetTime = 1; // s

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

/// What all kinds of nodes have.
NodeConfig busConfig(const bus::GroupSetup &setup, const bus::SetupParameters &given) {
  NodeConfig node;
  node.cycle = setup.cycleSeconds;
  node.reset = static_cast<NodeConfig::Reset>(given.number("reset"));
  node.identity = {static_cast<uint32_t>(given.number("identity.vendor")),
                   static_cast<uint32_t>(given.number("identity.product")),
                   static_cast<uint32_t>(given.number("identity.revision")),
                   static_cast<uint32_t>(given.number("identity.serial"))};
  node.sdoTimeout = setup.busParameters.number("sdo_timeout");
  node.heartbeat = setup.busParameters.number("heartbeat");
  node.masterNode = static_cast<uint8_t>(setup.busParameters.number("node_id"));
  node.guard = given.number("guard");
  const auto lss = static_cast<int64_t>(given.number("lss"));
  node.lss.wanted = lss != kLssNone;
  node.lss.store = lss == kLssStore;
  node.lss.wait = setup.busParameters.number("lss_wait");
  node.lss.bitRate = lss::bitRateIndex(bitRateOf(setup));
  node.pdoTimeout = static_cast<uint32_t>(given.number("pdo_timeout"));
  return node;
}

NodeConfig nodeConfig(const bus::GroupSetup &setup, const bus::SetupParameters &given,
                      const DrivePlan &plan, const DriveSettings &settings) {
  NodeConfig node = busConfig(setup, given);
  node.plan = plan;
  node.parameters = settings.startup;
  node.drive = driveConfig(given, setup.cycleSeconds);
  return node;
}

NodeConfig encoderConfig(const bus::GroupSetup &setup, const bus::SetupParameters &given,
                         const EncoderPlan &plan) {
  NodeConfig node = busConfig(setup, given);
  node.kind = NodeConfig::Kind::Encoder;
  node.plan = plan.plan;
  node.parameters = plan.startup;
  node.encoderModulo = static_cast<uint32_t>(given.number("dwEncoderModulo"));
  return node;
}

/// Nodes after those of the drives, as far as encoders are nodes.
void addEncoders(const bus::GroupSetup &setup, const GroupPlan &plan, CanSetup &result) {
  for (size_t i = 0; i < setup.encoders.size(); ++i) {
    const EncoderPlan &encoder = plan.encoders[i];
    CanSetup::EncoderSource &source = result.encoders.emplace_back();
    source.fault = encoder.fault;
    if (!encoder.fault.empty())
      continue;
    if (encoder.drive != EncoderPlan::kNode) {
      source.node = result.drives[encoder.drive].node;
      source.device = result.drives[encoder.drive].device;
      source.signal = Signal::SecondPosition;
      continue;
    }
    source.node = result.master.nodes.size();
    source.signal = Signal::EncoderPosition;
    result.master.nodes.push_back(encoderConfig(setup, setup.encoders[i].parameters, encoder));
  }
}

void addIos(const bus::GroupSetup &setup, const GroupPlan &plan, CanSetup &result) {
  for (size_t i = 0; i < setup.ios.size(); ++i) {
    const IoPlan &io = plan.ios[i];
    if (!io.fault.empty())
      continue;
    NodeConfig node = busConfig(setup, setup.ios[i].parameters);
    node.kind = NodeConfig::Kind::Io;
    node.plan = io.plan;
    node.parameters = io.startup;
    node.io = {setup.ios[i].exchange, io.rpdoAt, io.tpdoAt};
    result.master.nodes.push_back(std::move(node));
  }
}

/// A value that is given twice is the last one, in the length that is known.
void addOrReplace(std::vector<SdoWrite> &writes, SdoWrite write) {
  const auto same = std::find_if(writes.begin(), writes.end(),
                                 [&](const SdoWrite &one) { return one.object == write.object; });
  if (same == writes.end()) {
    writes.push_back(write);
    return;
  }
  if (!same->bytes.empty()) { // a parameter has 32 bits: the drive is asked, and it will not fit
    *same = write;
    return;
  }
  const uint32_t above =
      same->size < sizeof(uint32_t) ? write.value >> (8U * same->size - 1U) : uint32_t{0};
  const bool fits = above >> 1U == 0 || above == UINT32_MAX >> (8U * same->size - 1U);
  write.size = fits ? same->size : uint8_t{0}; // the drive is asked, and it will not fit
  *same = write;
}

/// Parameters of a file, after those of `startup`. Without the file, which the program may have
/// still to write, the drive keeps its own.
void addFileParameters(const bus::GroupSetup &setup, CanSetup &result) {
  for (size_t i = 0; setup.files && i < setup.drives.size(); ++i) {
    const std::string name = setup.drives[i].parameters.text("parameters");
    if (name.empty() || !result.faults[i].empty())
      continue;
    const std::optional<std::string> text = common::textOfFile(*setup.files, name);
    if (!text) {
      result.notes.push_back("drive '" + setup.drives[i].name + "': there is no file '" + name +
                             "' with its parameters: it keeps those that it has");
      continue;
    }
    const ParameterFile file = readParameterFile(*text, axisOfDrive(setup.drives[i]));
    const CanSetup::DrivePlace &place = result.drives[i];
    NodeConfig &node = result.master.nodes[place.node];
    DeviceConfig &device = place.device == 0 ? node : node.further[place.device - 1];
    for (const SdoWrite &write : file.writes)
      addOrReplace(device.parameters, write);
    if (!file.error.empty())
      result.faults[i] = "the file '" + name + "' with its parameters, " + file.error;
  }
}

/// A place in the list of nodes that nobody answers at.
NodeConfig nobody(const NodeConfig &like) {
  NodeConfig node = like;
  node.plan = {};
  node.lss = {};
  return node;
}

/// A node for each, or for those that are axes of one device.
void addDrives(const bus::GroupSetup &setup, const GroupPlan &plan, CanSetup &result) {
  std::vector<NodeConfig> &nodes = result.master.nodes;
  for (size_t i = 0; i < setup.drives.size(); ++i) {
    const bool works = result.faults[i].empty();
    const size_t first = deviceOf(setup, i);
    const bus::SetupParameters &own = setup.drives[i].parameters;
    NodeConfig node =
        nodeConfig(setup, setup.drives[first].parameters, plan.drives[i].plan, plan.settings[i]);
    node.drive = driveConfig(own, setup.cycleSeconds);
    if (!works)
      node = nobody(node);
    node.producesSync = plan.sync == SyncProducer::FirstDrive && i == 0;
    const auto same = std::find_if(nodes.begin(), nodes.end(), [&](const NodeConfig &one) {
      return works && one.plan.node == node.plan.node;
    });
    result.drives.push_back({static_cast<size_t>(same - nodes.begin()), 0});
    if (same == nodes.end()) {
      nodes.push_back(std::move(node));
      continue;
    }
    result.drives.back().device = same->devices();
    same->further.push_back(node);
  }
  result.driveNodes = nodes.size();
}

} // namespace

CanSetup canSetup(const bus::GroupSetup &setup) {
  CanSetup result;
  MasterConfig &master = result.master;
  const GroupPlan plan = planGroup(setup);
  result.hasSyncDevice = plan.sync == SyncProducer::Device;
  result.faults = plan.faults;
  addDrives(setup, plan, result);
  addFileParameters(setup, result);
  addEncoders(setup, plan, result);
  addIos(setup, plan, result);
  result.hasIos = !setup.ios.empty();
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
  // A simulated bus has the time of a cycle between two of them, and nothing to wait for.
  if (setup.kind == bus::BusKind::Real)
    master.readWaitNs = static_cast<int64_t>(setup.busParameters.number("read_wait") * 1e9 + 0.5);
  master.heartbeat = setup.busParameters.number("heartbeat");
  master.timeStamp = setup.busParameters.number("time_stamp");
  master.node = static_cast<uint8_t>(setup.busParameters.number("node_id"));
  master.givesSync = plan.sync == SyncProducer::Master;
  result.bitRate = plan.bitRate;
  result.load = plan.load;
  master.sdoPerCycle = result.load.sdoPerCycle;
  master.bitsPerCycle = uint64_t{plan.bitRate} * plan.cycle / 1000;
  result.interface = setup.busParameters.text("interface");
  if (result.interface.empty())
    result.interface =
        "can" + std::to_string(static_cast<int>(setup.parameters.number("ControllerNo")));
  return result;
}

} // namespace stride::can
