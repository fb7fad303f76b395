#include "drivers/can/simulated_network.hpp"

#include "drivers/can/can_setup.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace stride::can {
namespace {

/// Frames that the queue of the interface holds, as docs/can.md says to set it.
constexpr size_t kSendQueue = 128;

simulation::BusSetup busSetup(const bus::GroupSetup &setup, const CanSetup &can) {
  simulation::BusSetup result;
  result.bitRate = can.bitRate * 1000;
  result.cycleNs = static_cast<int64_t>(setup.cycleSeconds * 1e9 + 0.5);
  result.sendQueue = kSendQueue;
  return result;
}

/// Below them are the objects that every node has, or has not.
constexpr uint16_t kDeviceObjects = 0x2000;

simulation::DataType typeOf(uint32_t bits) {
  using Type = simulation::DataType;
  constexpr std::array kByBytes = {Type::Unsigned32, // whatever it is
                                   Type::Unsigned8,  Type::Unsigned16, Type::Unsigned24,
                                   Type::Unsigned32, Type::Unsigned40, Type::Unsigned48,
                                   Type::Unsigned56, Type::Unsigned64};
  return kByBytes[std::min<size_t>(bits / 8, kByBytes.size() - 1)];
}

/// Objects of its maker that it is given at start-up, or has in its own PDOs.
std::vector<simulation::ObjectRow> moreObjects(const DriveSettings &settings, uint8_t axis = 0) {
  std::vector<simulation::ObjectRow> rows;
  const auto add = [&](Object object, uint32_t bits) {
    object = ofAxis(object, axis);
    if (object.index >= kDeviceObjects)
      rows.push_back({.index = object.index,
                      .sub = object.sub,
                      .type = typeOf(bits),
                      .mapping = simulation::kInBoth});
  };
  for (const SdoWrite &write : settings.startup)
    if (write.bytes.empty() || write.bytes.size() == sizeof(uint64_t))
      add(write.object, static_cast<uint32_t>(8U * write.length()));
    else if (write.object.index >= kDeviceObjects)
      rows.push_back({.index = write.object.index,
                      .sub = write.object.sub,
                      .type = simulation::DataType::VisibleString,
                      .room = write.bytes.size()});
  for (const std::vector<Pdo> *pdos : {&settings.rpdos, &settings.tpdos})
    for (const Pdo &pdo : *pdos)
      for (const PdoEntry &entry : pdo.mapped())
        add(entry.object, entry.bits);
  return rows;
}

double stepsPerUnit(const bus::SetupParameters &encoder) {
  return encoder.number("dwRatioTechUnitsDenom") / encoder.number("iRatioTechUnitsNum");
}

/// A node that is to get its number by LSS has none.
uint8_t idOf(const bus::SetupParameters &given, uint32_t number) {
  return given.number("lss") != 0 ? simulation::kUnconfigured : static_cast<uint8_t>(number);
}

/// A drive that is what stride.toml expects.
simulation::Drive402Setup driveSetup(const bus::GroupSetup &setup, const GroupPlan &plan,
                                     const CanSetup &can, size_t index) {
  const bus::DriveSetup &drive = setup.drives[index];
  const bus::SetupParameters &given = drive.parameters;
  const auto number = [&](const char *name) { return static_cast<uint32_t>(given.number(name)); };
  simulation::Drive402Setup result;
  result.node.id = idOf(given, drive.id);
  result.node.vendor = number("identity.vendor");
  result.node.product = number("identity.product");
  result.node.revision = number("identity.revision");
  result.node.serial = number("identity.serial");
  result.drive = dummy::driveParameters(given);
  if (given.number("torque_rated") > 0)
    result.ratedTorque = given.number("torque_rated");
  result.velocityScale = given.number("velocity_scale");
  for (size_t i = 0; i < plan.encoders.size(); ++i)
    if (plan.encoders[i].drive == index)
      result.secondEncoder =
          result.drive.unitsPerIncrement * stepsPerUnit(setup.encoders[i].parameters);
  result.axis = axisOfDrive(drive);
  DriveSettings settings = driveSettings(static_cast<uint8_t>(drive.id), given, result.axis);
  const CanSetup::DrivePlace &place = can.drives[index];
  settings.startup = can.master.nodes[place.node].device(place.device).parameters; // with a file's
  result.more = moreObjects(settings, result.axis);
  return result;
}

/// Further axes of the device that a drive is the first one of.
void addAxes(const bus::GroupSetup &setup, const GroupPlan &plan, const CanSetup &can, size_t first,
             simulation::Drive402Setup &device) {
  for (size_t i = first + 1; i < setup.drives.size(); ++i)
    if (can.faults[i].empty() && can.drives[i].node == can.drives[first].node)
      device.further.push_back(driveSetup(setup, plan, can, i));
}

} // namespace

namespace {

std::unique_ptr<simulation::SimulatedEncoder406> makeEncoder(const bus::GroupSetup &setup,
                                                             const bus::EncoderSetup &encoder,
                                                             const SimulatedNodes &nodes) {
  const bus::SetupParameters &given = encoder.parameters;
  const auto number = [&](const char *name) { return static_cast<uint32_t>(given.number(name)); };
  simulation::Encoder406Setup result;
  result.node.id = idOf(given, encoder.id);
  result.node.name = "Stride simulated encoder";
  result.node.vendor = number("identity.vendor");
  result.node.product = number("identity.product");
  result.node.revision = number("identity.revision");
  result.node.serial = number("identity.serial");
  constexpr uint32_t kTurns = 32768; // of 2^17 steps: all 32 bits
  const uint32_t modulo = number("dwEncoderModulo");
  result.perTurn = modulo != 0 ? modulo : uint32_t{1} << 17U;
  result.turns = modulo != 0 ? 1 : kTurns;
  result.more = moreObjects(driveSettings(static_cast<uint8_t>(encoder.id), given));
  const double steps = stepsPerUnit(given);
  result.velocity = given.number("physics.own_velocity") * steps;
  const size_t drive = driveNamed(setup, given.text("physics.follows"));
  const bool follows = drive < setup.drives.size() && nodes.axes[drive] != nullptr;
  if (follows)
    result.stepsPerIncrement =
        dummy::driveParameters(setup.drives[drive].parameters).unitsPerIncrement * steps;
  auto node = std::make_unique<simulation::SimulatedEncoder406>(result);
  if (follows)
    node->follow(nodes.axes[drive]);
  return node;
}

std::unique_ptr<simulation::SimulatedIo401> makeIo(const bus::IoSetup &io, const IoPlan &plan) {
  const auto number = [&](const char *name) {
    return static_cast<uint32_t>(io.parameters.number(name));
  };
  simulation::Io401Setup result;
  result.node.id = idOf(io.parameters, number("node"));
  result.node.name = "Stride simulated I/O device";
  result.node.vendor = number("identity.vendor");
  result.node.product = number("identity.product");
  result.node.revision = number("identity.revision");
  result.node.serial = number("identity.serial");
  result.inputBytes = static_cast<uint8_t>(plan.inputs.digital);
  result.outputBytes = static_cast<uint8_t>(plan.outputs.digital);
  result.analogInputs = static_cast<uint8_t>(plan.inputs.analog);
  result.analogOutputs = static_cast<uint8_t>(plan.outputs.analog);
  result.wired = io.parameters.flag("wired");
  DriveSettings settings;
  settings.startup = plan.startup;
  result.more = moreObjects(settings);
  return std::make_unique<simulation::SimulatedIo401>(result);
}

} // namespace

SimulatedNodes simulatedNodes(const bus::GroupSetup &setup) {
  const CanSetup can = canSetup(setup);
  const GroupPlan plan = planGroup(setup);
  SimulatedNodes nodes;
  nodes.drives.resize(setup.drives.size());
  nodes.axes.resize(setup.drives.size());
  std::vector<simulation::SimulatedDrive402 *> devices(can.driveNodes);
  for (size_t i = 0; i < setup.drives.size(); ++i) {
    const CanSetup::DrivePlace &place = can.drives[i];
    if (!can.faults[i].empty())
      continue;
    if (place.device == 0) {
      simulation::Drive402Setup drive = driveSetup(setup, plan, can, i);
      addAxes(setup, plan, can, i, drive);
      nodes.drives[i] = std::make_unique<simulation::SimulatedDrive402>(drive);
      devices[place.node] = nodes.drives[i].get();
    }
    nodes.axes[i] = &devices[place.node]->axis(place.device);
  }
  for (size_t i = 0; i < setup.encoders.size(); ++i)
    if (plan.encoders[i].fault.empty() && plan.encoders[i].drive == EncoderPlan::kNode)
      nodes.encoders.push_back(makeEncoder(setup, setup.encoders[i], nodes));
  for (size_t i = 0; i < setup.ios.size(); ++i)
    nodes.ios.push_back(plan.ios[i].fault.empty() ? makeIo(setup.ios[i], plan.ios[i]) : nullptr);
  if (can.hasSyncDevice) {
    simulation::NodeSetup node;
    node.id = kSyncDevice;
    node.name = "Stride simulated SYNC device";
    nodes.syncDevice = std::make_unique<simulation::CanopenNode>(node, simulation::DeviceRows{});
  }
  return nodes;
}

SimulatedNetwork::SimulatedNetwork(const bus::GroupSetup &setup)
    : bus_(busSetup(setup, canSetup(setup))), port_(bus_.port(bus_.addPort())),
      nodes_(simulatedNodes(setup)) {
  for (const auto &drive : nodes_.drives)
    if (drive != nullptr)
      bus_.attach(*drive);
  for (const auto &encoder : nodes_.encoders)
    bus_.attach(*encoder);
  for (const auto &io : nodes_.ios)
    if (io != nullptr)
      bus_.attach(*io);
  if (nodes_.syncDevice != nullptr)
    bus_.attach(*nodes_.syncDevice);
  addWorlds(setup);
}

void SimulatedNetwork::addWorlds(const bus::GroupSetup &setup) {
  for (size_t i = 0; i < nodes_.ios.size(); ++i) {
    const std::shared_ptr<common::IoExchange> &exchange = setup.ios[i].exchange;
    if (nodes_.ios[i] == nullptr || exchange == nullptr)
      continue;
    exchange->simulated.store(true, std::memory_order_relaxed);
    worlds_.push_back({nodes_.ios[i].get(), exchange, planIo(setup.ios[i]).inputs,
                       setup.ios[i].parameters.flag("wired")});
  }
}

/// What has come to the nodes from their world since the last cycle is there now.
void SimulatedNetwork::beginCycle() noexcept {
  for (const IoWorld &world : worlds_) {
    world.node->setSilent(world.exchange->pulled.load(std::memory_order_relaxed));
    if (world.wired)
      continue;
    std::array<uint8_t, IoSide::kMostDigital + 2 * IoSide::kMostAnalog> bytes{};
    const std::span<uint8_t> analog = std::span(bytes).subspan(IoSide::kMostDigital);
    world.exchange->terminals.read(0, std::span(bytes).first(world.inputs.digital));
    world.exchange->terminals.read(world.inputs.analogAt(),
                                   analog.first(size_t{2} * world.inputs.analog));
    for (uint32_t i = 0; i < world.inputs.digital; ++i)
      world.node->setInput(i, bytes[i]);
    for (size_t i = 0; i < world.inputs.analog; ++i)
      world.node->setAnalogInput(
          i, static_cast<int16_t>(analog[2 * i] | static_cast<uint16_t>(analog[2 * i + 1] << 8U)));
  }
  port_.beginCycle();
}

void SimulatedNetwork::bindData(size_t drive, void *data) {
  if (nodes_.axes[drive] != nullptr)
    nodes_.axes[drive]->bind(static_cast<simulation::DriveSim *>(data));
}

} // namespace stride::can
