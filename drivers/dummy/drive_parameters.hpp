// The parameters of a simulated drive, from the PLC configuration.
#ifndef STRIDE_DRIVERS_DUMMY_DRIVE_PARAMETERS_HPP
#define STRIDE_DRIVERS_DUMMY_DRIVE_PARAMETERS_HPP

#include "drivers/dummy/mechanics.hpp"
#include "runtime/bus/axis_driver.hpp"
#include "runtime/bus/group_setup.hpp"

#include <cstdint>

namespace stride::dummy {

/// Marks along an axis that are noticed when it passes them.
struct Marks {
  bool any = false;
  double position = 0; ///< Of one of them. [inc]
  double distance = 0; ///< From one to the next; 0: there is only one. [inc]

  /// Whether the axis passes one on its way from `from` to `to`; the first of them.
  bool passed(double from, double to, double &mark) const;
};

/// A switch that is actuated between two positions.
struct SwitchRange {
  bool any = false;
  double from = 0; ///< [inc]
  double to = 0;   ///< [inc]

  /// `period` [inc] of a rotary axis, else 0.
  [[nodiscard]] bool actuated(double position, double period) const;
};

/// The drive's reference run.
struct HomingParameters {
  bool positive = false;   ///< Direction in which the switch is looked for.
  double fast = 0;         ///< Velocity on the way to the switch. [inc/s]
  double slow = 0;         ///< Velocity off the switch. [inc/s]
  double acceleration = 0; ///< Also for braking. [inc/s^2]
};

/// All about one drive.
struct DriveParameters {
  MechanicsParameters mechanics;
  double unitsPerIncrement = 1;
  double period = 0; ///< Of a rotary axis, else 0. [inc]
  int64_t startPosition = 0;
  uint32_t startUpCycles = 0;
  uint32_t switchCycles = 0;
  uint32_t deadTime = 0;        ///< Cycles by which set values come later.
  uint32_t parameterCycles = 0; ///< That the answer to a question for a parameter takes.
  bool hasLimitPositive = false;
  bool hasLimitNegative = false;
  double limitPositive = 0; ///< [inc]
  double limitNegative = 0; ///< [inc]
  SwitchRange home;
  HomingParameters homing;
  Marks index;
  Marks probe;
  uint8_t probeInputs = 0;                                   ///< Bit n: there is input n.
  double quickStop = 0;                                      ///< 0: it has none. [inc/s^2]
  uint8_t modes = 1U << kPositionMode | 1U << kVelocityMode; ///< Bit n: controller mode n.
  uint8_t received = 0x0F;                                   ///< bus::CyclicData.
  // Of its parameter list only: what is no number. As a CANopen drive has it.
  uint32_t deviceType = 0x00020192; ///< 1000h: servo drive, profile 402.
  uint32_t userBits = 0;
  bus::ByteString deviceName{std::string_view("Stride Dummy")}; ///< 1008h.
  bus::ByteString userText;
};

/// Longest userText. [bytes]
inline constexpr size_t kUserText = 32;

/// Reads them.
DriveParameters driveParameters(const bus::SetupParameters &parameters);

} // namespace stride::dummy

#endif
