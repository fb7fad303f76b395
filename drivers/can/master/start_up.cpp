#include "drivers/can/master/start_up.hpp"

#include "drivers/can/master/frames.hpp"
#include "drivers/can/master/texts.hpp"

#include <algorithm>

namespace stride::can {
namespace {

constexpr double kPatience = 2;             // s
constexpr uint8_t kAfterConfiguration = 60; // the progress of what comes then

/// How a step is made.
enum class Manner : uint8_t {
  Act,   ///< At once, or by waiting for something.
  Read,  ///< An object of the node.
  Write, ///< The same.
};
struct OpRow {
  StartOp op;
  Manner manner;
};
constexpr std::array<OpRow, 25> kOps = {{
    {StartOp::Lss, Manner::Act},
    {StartOp::Reset, Manner::Act},
    {StartOp::BootUp, Manner::Act},
    {StartOp::DeviceType, Manner::Read},
    {StartOp::AxisType, Manner::Read},
    {StartOp::Identity, Manner::Read},
    {StartOp::SupportedModes, Manner::Read},
    {StartOp::RatedTorque, Manner::Read},
    {StartOp::RatedCurrent, Manner::Read},
    {StartOp::HomeOffset, Manner::Read},
    {StartOp::RangeLow, Manner::Read},
    {StartOp::RangeHigh, Manner::Read},
    {StartOp::EncoderRange, Manner::Read},
    {StartOp::StampDate, Manner::Read},
    {StartOp::StampTime, Manner::Read},
    {StartOp::NoRemote, Manner::Read},
    {StartOp::Write, Manner::Write},
    {StartOp::CheckPdos, Manner::Act},
    {StartOp::WriteConsumer, Manner::Write},
    {StartOp::WriteMode, Manner::Write},
    {StartOp::ReadMode, Manner::Read},
    {StartOp::Supervise, Manner::Act},
    {StartOp::Start, Manner::Act},
    {StartOp::Operational, Manner::Act},
    {StartOp::FirstPdo, Manner::Act},
}};
constexpr bool opsAreInOrder() {
  for (size_t i = 0; i < kOps.size(); ++i)
    if (kOps[i].op != static_cast<StartOp>(i))
      return false;
  return true;
}
static_assert(opsAreInOrder());

Manner mannerOf(StartOp op) { return kOps[static_cast<size_t>(op)].manner; }

/// For each NodeConfig::Reset: PDOs cannot be configured in operation.
constexpr std::array<NmtCommand, 3> kResets = {NmtCommand::ResetCommunication,
                                               NmtCommand::ResetNode, NmtCommand::PreOperational};

/// What an output of an I/O device becomes without a master.
bool isErrorValue(Object object) {
  constexpr std::array kOfOutputs = {object::kOutputErrorMode, object::kOutputErrorValue,
                                     object::kAnalogErrorMode, object::kAnalogErrorValue};
  return std::find(kOfOutputs.begin(), kOfOutputs.end(), object.index) != kOfOutputs.end();
}

uint32_t numberOf(std::span<const uint8_t> bytes) {
  uint32_t value = 0;
  for (size_t i = 0; i < bytes.size(); ++i)
    value |= uint32_t{bytes[i]} << 8 * i;
  return value;
}

} // namespace

StartUp::StartUp(const NodeConfig &config)
    : steps_(startSteps(config)), patience_(cyclesOf(kPatience, config.cycle)),
      node_(config.plan.node) {
  unused_.reserve(2 * DrivePlan::kMostPdos * config.devices());
}

void StartUp::begin() {
  go(0);
  bootUps_ = 0;
  noRemote_ = 0;
  stampFits_ = adapted_ = several_ = false;
  unused_.clear();
  mismatch_ = {};
  lacksConsumer_ = false;
  lacksHeartbeat_ = false;
  lacksErrorValues_ = false;
}

void StartUp::go(size_t place) {
  place_ = place;
  waited_ = 0;
  asked_ = false;
  compares_ = inspects_ = false;
  measured_ = 0;
}

/// There is nothing to be done for this node: no cycle is lost with it.
bool StartUp::isIdle() const {
  switch (now().op) {
  case StartOp::AxisType:
    return !several_ && axisOf(now().object.object) == 0;
  case StartOp::CheckPdos:
    return !adapted_;
  case StartOp::Write: // whoever trusts that stamp would not look at its PDOs
    return now().object.object.index == object::kConfigurationDate &&
           (adapted_ || !unused_.empty());
  default:
    return false;
  }
}

uint8_t StartUp::progress() const {
  return place_ < steps_.size() ? steps_[place_].progress : steps_.back().progress;
}

bus::StartUp StartUp::step(const StartParts &parts, bus::Message &message) {
  if (place_ >= steps_.size())
    return bus::StartUp::Started;
  if (disturbed(parts, message))
    return bus::StartUp::Failed;
  ++waited_;
  Outcome outcome = Outcome::Busy;
  if (mannerOf(now().op) == Manner::Act)
    outcome = act(parts, message);
  else
    outcome = asked_ ? answered(parts, message) : ask(parts, message);
  if (outcome == Outcome::Failed)
    return bus::StartUp::Failed;
  if (outcome == Outcome::Next)
    go(place_ + 1);
  while (outcome == Outcome::Next && place_ < steps_.size() && isIdle())
    go(place_ + 1);
  return place_ >= steps_.size() ? bus::StartUp::Started : bus::StartUp::Busy;
}

/// Two nodes have one number, or the node has restarted meanwhile.
bool StartUp::disturbed(const StartParts &parts, bus::Message &message) {
  const uint32_t bootUps = parts.supervision.bootUps();
  if (bootUps > bootUps_) {
    if (bootUps > 1 && isReset()) { // LSS resets all devices that have one number by mistake
      message.set("node ", uint32_t{node_},
                  " has booted twice: duplicate node id, or it restarts by itself");
      return true;
    }
    bootUps_ = bootUps;
    const auto first = std::find_if(steps_.begin(), steps_.end(), [](const StartStep &step) {
      return step.op > StartOp::BootUp;
    });
    if (!awaitsBootUp()) { // it has come late, and knows nothing of what it has been told
      parts.sdo.clear();
      go(static_cast<size_t>(first - steps_.begin()));
    }
  }
  if (parts.sdo.unasked() == 0)
    return false;
  message.set("node ", uint32_t{node_}, " answers what nobody has asked: duplicate node id?");
  return true;
}

StartUp::Outcome StartUp::await(bool there, std::string_view text, bus::Message &message) {
  if (there)
    return Outcome::Next;
  if (waited_ < patience_)
    return Outcome::Busy;
  message.set("node ", uint32_t{node_}, text);
  return Outcome::Failed;
}

StartUp::Outcome StartUp::act(const StartParts &parts, bus::Message &message) {
  switch (now().op) {
  case StartOp::Lss:
    return awaitNumber(parts, message);
  case StartOp::Reset:
    return reset(parts);
  case StartOp::BootUp:
    return awaitBootUp(parts);
  case StartOp::Supervise:
    supervise(parts);
    return Outcome::Next;
  case StartOp::Start:
    parts.nmt = NmtCommand::Start;
    return Outcome::Next;
  case StartOp::CheckPdos:
    return checkPdos(parts, message);
  case StartOp::Operational:
    return await(parts.supervision.kind() == Supervision::Kind::None ||
                     parts.supervision.state() == nmt::kOperational,
                 " does not become operational", message);
  default: // FirstPdo
    return await(parts.pdosArrived, " sends no PDO", message);
  }
}

/// A node that begins anew by LSS is not reset before it has booted.
StartUp::Outcome StartUp::reset(const StartParts &parts) {
  if (parts.lssBusy)
    waited_ = 0; // the patience is for this node alone
  if (parts.lssBusy || (parts.boots && waited_ < patience_))
    return Outcome::Busy;
  bootUps_ = 0;
  parts.boots = false;
  parts.supervision.clear();
  parts.sdo.clear();
  // A reset of the whole node brings back the number that it has stored.
  const bool forgets = parts.config.lss.wanted && (!parts.config.lss.store || parts.lss.notStored);
  parts.nmt = kResets[static_cast<size_t>(parts.config.reset)];
  if (forgets && parts.nmt == NmtCommand::ResetNode)
    parts.nmt = NmtCommand::ResetCommunication;
  return Outcome::Next;
}

StartUp::Outcome StartUp::awaitNumber(const StartParts &parts, bus::Message &message) const {
  if (parts.lssBusy)
    return Outcome::Busy;
  switch (parts.lss.kind) {
  case LssOutcome::Kind::Refused:
    message.set("node ", uint32_t{node_}, ": the device refuses this number (LSS)");
    return Outcome::Failed;
  case LssOutcome::Kind::InUse:
    message.set("node ", uint32_t{node_}, ": the device has the number of node ",
                uint32_t{parts.lss.before}, ", which is in operation: ");
    message.append(parts.config.lss.store && !parts.lss.notStored
                       ? "switch it off and on"
                       : "give it another one (stride can lss), or stop that node first");
    return Outcome::Failed;
  default:
    return Outcome::Next;
  }
}

/// Without its message the node may have been there for long: it is asked.
StartUp::Outcome StartUp::awaitBootUp(const StartParts &parts) const {
  return parts.supervision.bootUps() > 0 || waited_ >= patience_ ? Outcome::Next : Outcome::Busy;
}

void StartUp::supervise(const StartParts &parts) const {
  const NodeConfig &config = parts.config;
  if (config.guard > 0)
    parts.supervision.begin(Supervision::Kind::Guarding, cyclesOf(config.guard, config.cycle));
  else if (!lacksHeartbeat_)
    parts.supervision.begin(Supervision::Kind::Heartbeat, cyclesOf(config.heartbeat, config.cycle));
}

uint32_t StartUp::valueOf(const SdoWrite &write, const StartParts &parts) const {
  constexpr uint32_t kTarget = 0x607A0020;
  constexpr uint32_t kInterpolated = 0x60C10120;
  LogicalDevice &device = parts.devices[now().device];
  const uint32_t axis = uint32_t{kAxisObjects} * device.plan().axis << 16U;
  const bool maps =
      write.object.index >= object::kRpdoMapping && write.object.index < object::kTpdoCommunication;
  if (maps && write.value == kTarget + axis && write.object.sub != 0 &&
      modeFor(kPositionControl, device.facts().supportedModes) == mode::kInterpolatedPosition)
    return kInterpolated + axis;
  return write.keepNoRemote ? write.value | noRemote_ : write.value;
}

/// The first of the modes that set values and drive allow.
bool StartUp::chooseMode(const StartParts &parts, bus::Message &message) {
  const DeviceConfig &config = parts.config.device(now().device);
  DriveFacts &facts = parts.devices[now().device].facts();
  const bool torque = config.drive.torqueRated > 0 || facts.ratedTorque > 0;
  for (const uint8_t one : {kPositionControl, kVelocityControl, kTorqueControl}) {
    const int8_t mode = modeFor(one, facts.supportedModes);
    if ((config.plan.controllerModes >> one & 1U) == 0 || mode == mode::kNone ||
        (one == kTorqueControl && !torque))
      continue;
    facts.mode = mode;
    return true;
  }
  message.set("node ", uint32_t{node_}, " has no mode of operation for its set values (",
              ObjectText(ofAxis(object::kSupportedModes, config.plan.axis)), " = ",
              HexText(facts.supportedModes, 8), ")");
  if (!torque && (config.plan.controllerModes >> kTorqueControl & 1U) != 0)
    message.append(", or torque_rated is missing");
  return false;
}

StartUp::Outcome StartUp::ask(const StartParts &parts, bus::Message &message) {
  if (inspects_) {
    asked_ = parts.sdo.upload(inspection_.wish(), bytes_);
    return Outcome::Busy;
  }
  const SdoWrite &object = now().object;
  const bool measures = object.length() == 0 && measured_ == 0; // before it is written
  if (mannerOf(now().op) == Manner::Read || compares_ || (now().op == StartOp::Write && measures)) {
    asked_ = parts.sdo.upload(object.object, bytes_);
    return Outcome::Busy;
  }
  if (!object.bytes.empty()) {
    asked_ = parts.sdo.download(object.object, object.bytes);
    return Outcome::Busy;
  }
  uint32_t value = valueOf(object, parts);
  if (now().op == StartOp::WriteMode) {
    if (!chooseMode(parts, message))
      return Outcome::Failed;
    value = static_cast<uint8_t>(parts.devices[now().device].facts().mode);
  }
  for (size_t i = 0; i < bytes_.size(); ++i)
    bytes_[i] = static_cast<uint8_t>(value >> 8 * i);
  const size_t size =
      std::clamp<size_t>(object.size != 0 ? object.size : measured_, 1, bytes_.size());
  asked_ = parts.sdo.download(object.object, std::span<const uint8_t>(bytes_).first(size));
  return Outcome::Busy;
}

StartUp::Outcome StartUp::answered(const StartParts &parts, bus::Message &message) {
  switch (parts.sdo.state()) {
  case SdoClient::State::Busy:
    return Outcome::Busy;
  case SdoClient::State::Failed:
    return refused(parts, message);
  default:
    break;
  }
  if (inspects_)
    return inspected(parts, message);
  if (now().op == StartOp::Write && now().object.length() == 0 && measured_ == 0)
    return measured(parts, message);
  if (mannerOf(now().op) == Manner::Write && !compares_)
    return Outcome::Next;
  const uint32_t value = numberOf(std::span<const uint8_t>(bytes_).first(parts.sdo.size()));
  return compares_ ? compared(value, parts, message) : taken(parts, value, message);
}

/// The node has told how long the object is: what is cut off of the value must be nothing, or its
/// sign.
StartUp::Outcome StartUp::measured(const StartParts &parts, bus::Message &message) {
  const size_t size = parts.sdo.size();
  const SdoWrite &write = now().object;
  const uint32_t above = size < sizeof(uint32_t) ? write.value >> (8 * size - 1) : 0;
  const bool sign = size < sizeof(uint32_t) && above == UINT32_MAX >> (8 * size - 1);
  if (size >= 1 && size <= sizeof(uint32_t) && (above >> 1U == 0 || sign)) {
    measured_ = static_cast<uint8_t>(size);
    asked_ = false;
    return Outcome::Busy;
  }
  message.set("node ", uint32_t{node_}, ", ", ObjectText(write.object), ": ", HexText(write.value),
              " does not fit into its ", static_cast<uint32_t>(size), " bytes");
  return Outcome::Failed;
}

StartUp::Outcome StartUp::refused(const StartParts &parts, bus::Message &message) {
  const uint32_t code = parts.sdo.abortCode();
  const SdoWrite &object = now().object;
  if (inspects_ && object.optional && !parts.sdo.timedOut())
    return inspected(parts, message);
  if (object.optional && !parts.sdo.timedOut() && isMissing(code)) {
    lacksConsumer_ = lacksConsumer_ || now().op == StartOp::WriteConsumer;
    lacksHeartbeat_ = lacksHeartbeat_ || object.object == Object{object::kProducerHeartbeat, 0};
    lacksErrorValues_ = lacksErrorValues_ || isErrorValue(object.object);
    noRemote_ = now().op == StartOp::NoRemote ? 0 : noRemote_;
    return Outcome::Next;
  }
  if (!inspects_ && isFixedPdo(parts.sdo))
    return fixedPdo(object);
  message.set("node ", uint32_t{node_});
  if (parts.sdo.timedOut() && now().op == StartOp::DeviceType) {
    message.append(" does not answer: is it on, with this number and bit rate?");
    if (parts.lss.kind == LssOutcome::Kind::NotFound)
      message.append(" No node with its identity answers by LSS, either");
    return Outcome::Failed;
  }
  message.append(", ");
  message.append(ObjectText(inspects_ ? inspection_.wish() : object.object));
  if (mannerOf(now().op) == Manner::Write && object.bytes.empty() && !inspects_) {
    message.append(" := ");
    message.append(HexText(valueOf(object, parts)));
  }
  message.append(": ");
  message.append(abortRow(code).text);
  message.append(" (abort code ");
  message.append(HexText(code, 8));
  message.append(")");
  return Outcome::Failed;
}

StartUp::Outcome StartUp::awaitMode(const StartParts &parts, uint32_t value,
                                    bus::Message &message) {
  const int8_t mode = parts.devices[now().device].facts().mode;
  if (static_cast<int8_t>(value) == mode)
    return Outcome::Next;
  asked_ = false; // once more
  if (waited_ < patience_)
    return Outcome::Busy;
  message.set("node ", uint32_t{node_}, " does not take mode of operation ",
              static_cast<uint32_t>(mode), ": it shows ", HexText(value, 2));
  return Outcome::Failed;
}

/// The configuration is there already.
void StartUp::skipConfiguration() {
  const auto next =
      std::find_if(steps_.begin() + static_cast<ptrdiff_t>(place_), steps_.end(),
                   [](const StartStep &step) { return step.progress >= kAfterConfiguration; });
  go(static_cast<size_t>(next - steps_.begin()));
}

StartUp::Outcome StartUp::taken(const StartParts &parts, uint32_t value, bus::Message &message) {
  DriveFacts &facts = parts.devices[now().device].facts();
  switch (now().op) {
  case StartOp::DeviceType:
    return checkType(parts.config, value, message);
  case StartOp::AxisType:
    return checkAxisType(value, message);
  case StartOp::Identity:
    return checkIdentity(value, message);
  case StartOp::SupportedModes:
    facts.supportedModes = value;
    break;
  case StartOp::RatedTorque:
    facts.ratedTorque = value;
    break;
  case StartOp::RatedCurrent:
    facts.ratedCurrent = value;
    break;
  case StartOp::HomeOffset:
    facts.homeOffset = value;
    break;
  case StartOp::RangeLow:
    rangeLow_ = value;
    break;
  case StartOp::RangeHigh:
    return checkRange(value, message);
  case StartOp::EncoderRange:
    return checkEncoder(parts.config, value, message);
  case StartOp::StampDate:
    stampFits_ = value == now().object.value;
    break;
  case StartOp::StampTime:
    if (!stampFits_ || value != now().object.value)
      break;
    skipConfiguration();
    return Outcome::Busy;
  case StartOp::NoRemote:
    noRemote_ = value & kPdoNoRemote;
    break;
  case StartOp::ReadMode:
    return awaitMode(parts, value, message);
  default:
    break;
  }
  return Outcome::Next;
}

} // namespace stride::can
