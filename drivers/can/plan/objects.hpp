// Objects of the dictionary of a CANopen drive that the master knows by name. [CiA 301, CiA 402]
#ifndef STRIDE_DRIVERS_CAN_PLAN_OBJECTS_HPP
#define STRIDE_DRIVERS_CAN_PLAN_OBJECTS_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace stride::can {

/// Where a value is in the dictionary.
struct Object {
  uint16_t index = 0;
  uint8_t sub = 0;
  friend constexpr bool operator==(const Object &, const Object &) = default;
};

namespace object {

inline constexpr Object kDeviceType = {0x1000, 0};
inline constexpr Object kErrorRegister = {0x1001, 0};
inline constexpr uint16_t kErrorField = 0x1003; ///< How many, and from subindex 1 the newest first.
inline constexpr uint16_t kSyncId = 0x1005;
inline constexpr uint16_t kSyncPeriod = 0x1006;
inline constexpr uint16_t kGuardTime = 0x100C;
inline constexpr uint16_t kLifeTimeFactor = 0x100D;
inline constexpr uint16_t kConsumerHeartbeat = 0x1016;
inline constexpr uint16_t kProducerHeartbeat = 0x1017;
inline constexpr uint16_t kIdentity = 0x1018;
inline constexpr uint16_t kConfigurationDate = 0x1020;
inline constexpr uint16_t kRpdoCommunication = 0x1400;
inline constexpr uint16_t kRpdoMapping = 0x1600;
inline constexpr uint16_t kTpdoCommunication = 0x1800;
inline constexpr uint16_t kTpdoMapping = 0x1A00;
inline constexpr Object kErrorCode = {0x603F, 0};
inline constexpr Object kMode = {0x6060, 0};
inline constexpr Object kModeDisplay = {0x6061, 0};
inline constexpr Object kTargetPosition = {0x607A, 0};
inline constexpr Object kRangeLimit = {0x607B, 0};
inline constexpr Object kHomeOffset = {0x607C, 0};
inline constexpr Object kRatedCurrent = {0x6075, 0};
inline constexpr Object kRatedTorque = {0x6076, 0};
inline constexpr Object kInterpolatedPosition = {0x60C1, 1};
inline constexpr uint16_t kInterpolationPeriod = 0x60C2;
inline constexpr uint16_t kProbeValues = 0x60BA; ///< Four objects from here.
inline constexpr Object kTargetVelocity = {0x60FF, 0};
inline constexpr Object kSupportedModes = {0x6502, 0};
inline constexpr Object kAxisType = {0x67FF, 0}; ///< As 1000h, of a logical device.
inline constexpr Object kEncoderRange = {0x6002, 0};
// Of I/O devices: arrays from subindex 1.
inline constexpr uint16_t kInputs = 0x6000;
inline constexpr uint16_t kOutputs = 0x6200;
inline constexpr uint16_t kOutputErrorMode = 0x6206;
inline constexpr uint16_t kOutputErrorValue = 0x6207;
inline constexpr uint16_t kAnalogInputs = 0x6401;
inline constexpr uint16_t kAnalogOutputs = 0x6411;
inline constexpr uint16_t kAnalogEvents = 0x6423;
inline constexpr uint16_t kAnalogErrorMode = 0x6443;
inline constexpr uint16_t kAnalogErrorValue = 0x6444;

} // namespace object

/// What a drive is told and tells in PDOs.
enum class Signal : uint8_t {
  Controlword,
  Mode,
  TargetPosition,
  VelocityOffset,
  TargetVelocity,
  TargetTorque,
  ProbeFunction,
  Statusword,
  ModeDisplay,
  Position,
  Velocity,
  Torque,
  Current,
  FollowingError,
  ErrorCode,
  Inputs,
  ProbeStatus,
  Probe1Rising, ///< The four latched positions follow one another.
  Probe1Falling,
  Probe2Rising,
  Probe2Falling,
  SecondPosition,  ///< Of a second encoder of the drive.
  EncoderPosition, ///< Of an encoder. [CiA 406]
  Other,           ///< It means nothing to the master.
};
inline constexpr size_t kSignals = static_cast<size_t>(Signal::Other) + 1;

/// "target position"; empty for Other.
std::string_view nameOf(Signal signal);

/// The object that carries a signal.
struct SignalObject {
  Signal signal;
  Object object;
  uint8_t bits;
  bool isSigned;
};

inline constexpr std::array<SignalObject, 23> kSignalObjects = {{
    {Signal::Controlword, {0x6040, 0}, 16, false},
    {Signal::Mode, {0x6060, 0}, 8, true},
    {Signal::TargetPosition, {0x607A, 0}, 32, true},
    {Signal::VelocityOffset, {0x60B1, 0}, 32, true},
    {Signal::TargetVelocity, {0x60FF, 0}, 32, true},
    {Signal::TargetTorque, {0x6071, 0}, 16, true},
    {Signal::ProbeFunction, {0x60B8, 0}, 16, false},
    {Signal::Statusword, {0x6041, 0}, 16, false},
    {Signal::ModeDisplay, {0x6061, 0}, 8, true},
    {Signal::Position, {0x6064, 0}, 32, true},
    {Signal::Velocity, {0x606C, 0}, 32, true},
    {Signal::Torque, {0x6077, 0}, 16, true},
    {Signal::Current, {0x6078, 0}, 16, true},
    {Signal::FollowingError, {0x60F4, 0}, 32, true},
    {Signal::ErrorCode, {0x603F, 0}, 16, false},
    {Signal::Inputs, {0x60FD, 0}, 32, false},
    {Signal::ProbeStatus, {0x60B9, 0}, 16, false},
    {Signal::Probe1Rising, {0x60BA, 0}, 32, true},
    {Signal::Probe1Falling, {0x60BB, 0}, 32, true},
    {Signal::Probe2Rising, {0x60BC, 0}, 32, true},
    {Signal::Probe2Falling, {0x60BD, 0}, 32, true},
    {Signal::SecondPosition, {0x60E4, 1}, 32, true},
    {Signal::EncoderPosition, {0x6004, 0}, 32, false},
}};

/// The row of a signal; `signal` is not Other.
constexpr const SignalObject &objectOf(Signal signal) {
  return kSignalObjects[static_cast<size_t>(signal)];
}

/// What an object means to the master. An interpolated position is a target position, too.
constexpr Signal signalOf(Object object) {
  if (object == object::kInterpolatedPosition)
    return Signal::TargetPosition;
  for (const SignalObject &row : kSignalObjects)
    if (row.object == object)
      return row.signal;
  return Signal::Other;
}

// A device may be several drives, its axes: they are logical devices, whose objects lie 800h and
// whose PDOs 64 apart. [CiA 301, object 67FFh; CiA 402-3]
inline constexpr uint8_t kMostAxes = 8;
inline constexpr uint16_t kProfileObjects = 0x6000; ///< Where those of the first axis begin …
inline constexpr uint16_t kAxisObjects = 0x0800;    ///< … and how many there are of each.
inline constexpr uint16_t kAxisPdos = 64;

/// The axis that an object of the device profiles belongs to; kMostAxes: it belongs to none.
constexpr uint8_t axisOf(Object object) {
  if (object.index < kProfileObjects)
    return kMostAxes;
  const auto axis = static_cast<uint8_t>((object.index - kProfileObjects) / kAxisObjects);
  return axis < kMostAxes ? axis : kMostAxes;
}

/// What of an axis is what `object` is of the first one.
constexpr Object ofAxis(Object object, uint8_t axis) {
  if (axisOf(object) == 0)
    object.index = static_cast<uint16_t>(object.index + kAxisObjects * axis);
  return object;
}

/// What of the first axis is what `object` is of that one; objects of others stay as they are.
constexpr Object inProfile(Object object, uint8_t axis) {
  if (axisOf(object) == axis)
    object.index = static_cast<uint16_t>(object.index - kAxisObjects * axis);
  return object;
}

/// Bytes of an object that CiA 402 fixes, and whether it has a sign; bytes 0: not known here.
struct ObjectForm {
  uint8_t bytes = 0;
  bool isSigned = false;
};
ObjectForm formOf(Object object);

// Identifiers. [CiA 301, predefined connection set]
inline constexpr uint16_t kNmtId = 0x000;
inline constexpr uint16_t kSyncCobId = 0x080;
inline constexpr uint16_t kTimeId = 0x100;
inline constexpr uint16_t kEmcyBase = 0x080;
inline constexpr uint16_t kTpdoBase = 0x180; ///< The next PDO 100h further.
inline constexpr uint16_t kRpdoBase = 0x200; ///< The same.
inline constexpr uint16_t kNextPdo = 0x100;
inline constexpr uint16_t kSdoAnswerBase = 0x580;
inline constexpr uint16_t kSdoRequestBase = 0x600;
inline constexpr uint16_t kHeartbeatBase = 0x700;
inline constexpr uint8_t kLastNode = 127;

/// Bit 31 of a PDO's COB-ID: it is not there; bit 30: nobody may ask for it.
inline constexpr uint32_t kPdoInvalid = 0x80000000;
inline constexpr uint32_t kPdoNoRemote = 0x40000000;

} // namespace stride::can

#endif
