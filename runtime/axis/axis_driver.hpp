// The interface between axis groups and the drivers of their buses.
#ifndef STRIDE_RUNTIME_AXIS_AXIS_DRIVER_HPP
#define STRIDE_RUNTIME_AXIS_AXIS_DRIVER_HPP

#include <cstddef>
#include <cstdint>
#include <string>

namespace stride::axis {

/// What a drive reports in every cycle. Lengths in increments.
struct DriveStatus {
  uint32_t position = 0;      ///< Position counter; wraps at 2^32. [inc]
  double velocity = 0;        ///< [inc/s]
  double torque = 0;          ///< In the bus's unit.
  bool communication = false; ///< The drive answers.
  bool regulatorOn = false;   ///< The power stage is really on.
  bool driveStarted = false;  ///< The brake is really released.
  bool error = false;         ///< The drive reports an error.
  uint16_t errorId = 0;       ///< The drive's own number.
  uint8_t controllerMode = 3; ///< 1 torque, 2 velocity, 3 position, 4 current.
};

/// What a drive is told in every cycle. Lengths in increments.
struct DriveCommand {
  uint32_t position = 0;      ///< Set position; wraps at 2^32. [inc]
  double velocity = 0;        ///< [inc/s]
  double acceleration = 0;    ///< [inc/s^2]
  double torque = 0;          ///< In the bus's unit.
  bool regulatorOn = false;   ///< Switch the power stage on.
  bool driveStart = false;    ///< Release the brake.
  bool errorAckn = false;     ///< Acknowledge the error.
  uint8_t controllerMode = 3; ///< As in DriveStatus.
};

/// How far a drive's start-up is.
enum class StartUp : uint8_t { Busy, Started, Failed };

/// One bus with its drives, numbered from 0 as configured: the manual's <Bus>DriveExecute_Start,
/// <Bus>DriveInit and <Bus>DriveExecute_End. All calls come from the task of the axis group.
class AxisDriver {
public:
  AxisDriver() = default;
  AxisDriver(const AxisDriver &) = delete;
  AxisDriver &operator=(const AxisDriver &) = delete;
  virtual ~AxisDriver() = default;

  /// First in the task's cycle: takes over what the bus has received.
  virtual void executeStart() = 0;

  /// Last in the task's cycle: sends the commands.
  virtual void executeEnd() = 0;

  /// One step of a drive's start-up, called in every cycle until it is Started or Failed.
  /// `progress` (0..99) becomes AXIS_REF.wCommunicationState. Failed: `message` says why.
  virtual StartUp init(std::size_t drive, uint16_t &progress, std::string &message) = 0;

  /// The state taken over by the last executeStart.
  [[nodiscard]] virtual DriveStatus status(std::size_t drive) const = 0;

  /// Stores what the next executeEnd sends.
  virtual void command(std::size_t drive, const DriveCommand &command) = 0;
};

} // namespace stride::axis

#endif
