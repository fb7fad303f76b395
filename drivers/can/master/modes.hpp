// Modes of operation of a drive and the change between them. [CiA 402-2, 6060h, 6061h, 6502h]
#ifndef STRIDE_DRIVERS_CAN_MASTER_MODES_HPP
#define STRIDE_DRIVERS_CAN_MASTER_MODES_HPP

#include "drivers/can/master/object_wish.hpp"

#include <cstdint>

namespace stride::can {

/// Values of 6060h.
namespace mode {
inline constexpr int8_t kNone = 0;
inline constexpr int8_t kProfileVelocity = 3;
inline constexpr int8_t kProfileTorque = 4;
inline constexpr int8_t kHoming = 6;
inline constexpr int8_t kInterpolatedPosition = 7;
inline constexpr int8_t kCyclicPosition = 8;
inline constexpr int8_t kCyclicVelocity = 9;
inline constexpr int8_t kCyclicTorque = 10;
} // namespace mode

/// Modes of a drive that does not say which it has (6502h): the cyclic ones, and homing.
inline constexpr uint32_t kUsualModes = 0x3A0;

/// Whether 6502h says that the drive has it.
bool isSupported(int8_t mode, uint32_t supported);

/// The mode for a controller mode (1 torque, 2 velocity, 3 position): cyclic, else profile or
/// interpolated; kNone: the drive has none for it.
int8_t modeFor(uint8_t controllerMode, uint32_t supported);

/// The controller mode that a mode is; 0: none.
uint8_t controllerModeOf(int8_t mode);

/// Brings the drive into a mode: in every cycle where 6060h and 6061h are in PDOs, else by SDO.
class ModeControl {
public:
  /// `timeout`: [cycles].
  ModeControl(bool inPdos, uint32_t timeout) : timeout_(timeout), inPdos_(inPdos) {}

  /// The drive has started in this mode.
  void begin(int8_t mode);
  /// The mode that the drive shows in its PDO.
  void seen(int8_t display);
  /// The mode that it shall have; once in each cycle.
  void want(int8_t mode);

  /// The mode that it has.
  [[nodiscard]] int8_t current() const { return current_; }
  /// What 6060h is.
  [[nodiscard]] int8_t wanted() const { return wanted_; }
  /// It has not taken the wanted mode in time.
  [[nodiscard]] bool late() const { return waited_ >= timeout_; }

  /// What is to be asked by SDO.
  [[nodiscard]] ObjectWish wish() const;
  void answered(const ObjectWish &wish, const ObjectAnswer &answer);

private:
  uint32_t timeout_;
  uint32_t waited_ = 0;
  bool inPdos_;
  int8_t current_ = mode::kNone;
  int8_t wanted_ = mode::kNone;
  int8_t written_ = mode::kNone;
};

} // namespace stride::can

#endif
