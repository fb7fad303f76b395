// The list of steps with which a node starts up.
#include "drivers/can/master/frames.hpp"
#include "drivers/can/master/start_up.hpp"

#include <algorithm>

namespace stride::can {
namespace {

// AXIS_REF.wCommunicationState meanwhile.
constexpr uint8_t kResetting = 0;
constexpr uint8_t kDeviceType = 10;
constexpr uint8_t kIdentityStep = 15;
constexpr uint8_t kStampStep = 20;
constexpr uint8_t kPdoSteps = 25;
constexpr uint8_t kParameterSteps = 45;
constexpr uint8_t kModeSteps = 60;
constexpr uint8_t kSupervisionSteps = 75;
constexpr uint8_t kStartStep = 85;
constexpr uint8_t kSyncSteps = 90;
constexpr uint8_t kPdoStep = 95;

SdoWrite optional(Object object, uint8_t size = 0, uint32_t value = 0) {
  return {object, size, value, true};
}

uint32_t milliseconds(double seconds) {
  constexpr uint32_t kMost = 65535;
  return std::clamp(static_cast<uint32_t>(seconds * 1000 + 0.5), 1U, kMost);
}

/// A time as mantissa and power of ten, as 60C2h has it.
struct Period {
  uint8_t mantissa = 1;
  int8_t exponent = -3;
  bool exact = true;
};
Period periodOf(double seconds) {
  constexpr uint32_t kMostMantissa = 255;
  auto mantissa = static_cast<uint32_t>(seconds * 1e6 + 0.5);
  int8_t exponent = -6;
  bool exact = true;
  while (mantissa > kMostMantissa || (mantissa != 0 && mantissa % 10 == 0)) {
    exact = exact && mantissa % 10 == 0;
    mantissa = (mantissa + 5) / 10;
    ++exponent;
  }
  return {static_cast<uint8_t>(mantissa), exponent, exact};
}

class List {
public:
  /// `object`: of the first axis.
  void add(StartOp op, uint8_t progress, SdoWrite object = {}) {
    object.object = ofAxis(object.object, axis_);
    addAsIs(op, progress, object);
  }
  void addAsIs(StartOp op, uint8_t progress, const SdoWrite &object) {
    steps_.push_back({op, progress, object, device_});
  }
  /// What is added now is of that logical device.
  void of(size_t device, uint8_t axis) {
    device_ = static_cast<uint8_t>(device);
    axis_ = axis;
  }
  /// Writes whose progress goes from one number to the next.
  void addWrites(std::span<const SdoWrite> writes, uint8_t from, uint8_t to) {
    for (size_t i = 0; i < writes.size(); ++i) {
      const auto progress =
          static_cast<uint8_t>(from + i * static_cast<size_t>(to - from) / writes.size());
      if (writes[i].keepNoRemote)
        addAsIs(StartOp::NoRemote, progress, optional(writes[i].object));
      addAsIs(StartOp::Write, progress, writes[i]);
    }
  }
  std::vector<StartStep> take() { return std::move(steps_); }

private:
  std::vector<StartStep> steps_;
  uint8_t device_ = 0;
  uint8_t axis_ = 0;
};

/// A part of the whole from `from` to `to`: the n-th of so many.
uint8_t share(uint8_t from, uint8_t to, size_t n, size_t count) {
  return static_cast<uint8_t>(from + n * static_cast<size_t>(to - from) / count);
}

/// Of one of its logical devices, which is a drive.
void addDriveChecks(List &list, const DeviceConfig &config) {
  list.add(StartOp::SupportedModes, kIdentityStep, optional(object::kSupportedModes));
  constexpr uint8_t kTorque = cyclic::kTorque;
  if (((config.plan.sent | config.plan.received) & kTorque) != 0 && config.drive.torqueRated == 0)
    list.add(StartOp::RatedTorque, kIdentityStep, optional(object::kRatedTorque));
  if ((config.plan.received & cyclic::kCurrent) != 0)
    list.add(StartOp::RatedCurrent, kIdentityStep, optional(object::kRatedCurrent));
  if (((config.plan.sent | config.plan.received) & cyclic::kPosition) != 0) {
    list.add(StartOp::RangeLow, kIdentityStep, optional({object::kRangeLimit.index, 1}));
    list.add(StartOp::RangeHigh, kIdentityStep, optional({object::kRangeLimit.index, 2}));
  }
}

void addChecks(List &list, const NodeConfig &config) {
  const bool drive = config.kind == NodeConfig::Kind::Drive;
  list.add(StartOp::DeviceType, kDeviceType, {object::kDeviceType});
  for (size_t i = 0; drive && i < config.devices(); ++i) {
    list.of(i, config.device(i).plan.axis);
    list.add(StartOp::AxisType, kDeviceType, optional(object::kAxisType));
  }
  list.of(0, config.plan.axis);
  for (size_t i = 0; i < NodeConfig::kIdentity; ++i)
    if (config.identity[i] != 0)
      list.add(StartOp::Identity, kIdentityStep,
               {{object::kIdentity, static_cast<uint8_t>(i + 1)}, 4, config.identity[i]});
  if (config.kind == NodeConfig::Kind::Encoder)
    list.add(StartOp::EncoderRange, kIdentityStep, optional(object::kEncoderRange));
  for (size_t i = 0; drive && i < config.devices(); ++i) {
    list.of(i, config.device(i).plan.axis);
    addDriveChecks(list, config.device(i));
  }
}

void addConfiguration(List &list, const NodeConfig &config) {
  std::vector<SdoWrite> all;
  const size_t count = config.devices();
  for (size_t i = 0; i < count; ++i) {
    const std::vector<SdoWrite> pdos = pdoWrites(config.device(i).plan);
    all.insert(all.end(), pdos.begin(), pdos.end());
  }
  for (size_t i = 0; i < count; ++i)
    all.insert(all.end(), config.device(i).parameters.begin(), config.device(i).parameters.end());
  const ConfigurationStamp stamp = stampOf(all);
  const Object date = {object::kConfigurationDate, 1};
  const Object time = {object::kConfigurationDate, 2};
  list.of(0, config.plan.axis);
  list.add(StartOp::StampDate, kStampStep, optional(date, 4, stamp.date));
  list.add(StartOp::StampTime, kStampStep, optional(time, 4, stamp.time));
  for (size_t i = 0; i < count; ++i) {
    list.of(i, config.device(i).plan.axis);
    list.addWrites(pdoWrites(config.device(i).plan), share(kPdoSteps, kParameterSteps, i, count),
                   share(kPdoSteps, kParameterSteps, i + 1, count));
    list.add(StartOp::CheckPdos, share(kPdoSteps, kParameterSteps, i + 1, count));
  }
  for (size_t i = 0; i < count; ++i) {
    list.of(i, config.device(i).plan.axis);
    list.addWrites(config.device(i).parameters, share(kParameterSteps, kModeSteps - 1, i, count),
                   share(kParameterSteps, kModeSteps - 1, i + 1, count));
  }
  list.of(0, config.plan.axis);
  list.add(StartOp::Write, kModeSteps - 1, optional(date, 4, stamp.date));
  list.add(StartOp::Write, kModeSteps - 1, optional(time, 4, stamp.time));
}

void addModes(List &list, const DeviceConfig &config, double cycle) {
  if (config.drive.homesItself)
    list.add(StartOp::HomeOffset, kModeSteps, optional(object::kHomeOffset));
  const Period period = periodOf(cycle);
  constexpr uint16_t kPeriod = object::kInterpolationPeriod;
  list.add(StartOp::Write, kModeSteps, optional({kPeriod, 1}, 1, period.mantissa));
  list.add(StartOp::Write, kModeSteps,
           optional({kPeriod, 2}, 1, static_cast<uint8_t>(period.exponent)));
  // Velocities go ahead of positions (60B1h), and are the whole velocity in velocity mode.
  if (config.plan.carries(Signal::VelocityOffset))
    list.add(StartOp::Write, kModeSteps, optional(object::kTargetVelocity, 4, 0));
  list.add(StartOp::WriteMode, kModeSteps, {object::kMode, 1});
  list.add(StartOp::ReadMode, kModeSteps, {object::kModeDisplay});
}

void addSupervision(List &list, const NodeConfig &config) {
  const uint32_t consumed = milliseconds(1.5 * config.heartbeat);
  list.add(
      StartOp::WriteConsumer, kSupervisionSteps,
      optional({object::kConsumerHeartbeat, 1}, 4, uint32_t{config.masterNode} << 16U | consumed));
  if (config.guard > 0) {
    list.add(StartOp::Write, kSupervisionSteps,
             {{object::kGuardTime, 0}, 2, milliseconds(config.guard)});
    list.add(StartOp::Write, kSupervisionSteps, {{object::kLifeTimeFactor, 0}, 1, 3});
  } else {
    list.add(StartOp::Write, kSupervisionSteps,
             optional({object::kProducerHeartbeat, 0}, 2, milliseconds(config.heartbeat)));
  }
  list.add(StartOp::Supervise, kSupervisionSteps);
}

void addSync(List &list, const NodeConfig &config) {
  constexpr uint32_t kProduces = 0x40000000;
  const auto period = static_cast<uint32_t>(config.cycle * 1e6 + 0.5);
  list.add(StartOp::Write, kSyncSteps, {{object::kSyncPeriod, 0}, 4, period});
  list.add(StartOp::Write, kSyncSteps, {{object::kSyncId, 0}, 4, kProduces | kSyncCobId});
}

} // namespace

bool isExactPeriod(double seconds) { return periodOf(seconds).exact; }

std::vector<StartStep> startSteps(const NodeConfig &config) {
  List list;
  const bool drive = config.kind == NodeConfig::Kind::Drive;
  const bool served = config.kind != NodeConfig::Kind::SyncDevice;
  if (config.lss.wanted)
    list.add(StartOp::Lss, kResetting);
  list.add(StartOp::Reset, kResetting);
  if (config.reset != NodeConfig::Reset::None)
    list.add(StartOp::BootUp, kResetting);
  if (served) {
    addChecks(list, config);
    addConfiguration(list, config);
    for (size_t i = 0; drive && i < config.devices(); ++i) {
      list.of(i, config.device(i).plan.axis);
      addModes(list, config.device(i), config.cycle);
    }
    addSupervision(list, config);
  }
  list.add(StartOp::Start, kStartStep);
  if (served)
    list.add(StartOp::Operational, kStartStep);
  if (config.producesSync)
    addSync(list, config);
  if (served)
    list.add(StartOp::FirstPdo, kPdoStep);
  return list.take();
}

} // namespace stride::can
