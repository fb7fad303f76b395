// A Sercos drive behind the driver interface of axes: what its words and values mean.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_DRIVE_AXIS_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_DRIVE_AXIS_HPP

#include "drivers/sercos/master/drive_config.hpp"
#include "drivers/sercos/master/homing_run.hpp"
#include "drivers/sercos/master/power.hpp"
#include "drivers/sercos/master/probes.hpp"
#include "drivers/sercos/master/scaling.hpp"
#include "runtime/bus/axis_driver.hpp"

#include <cstdint>
#include <span>

namespace stride::sercos {

/// Numbers of errors that the master finds itself, in DriveStatus::errorId; others are S-0-0011.
namespace own_error {
inline constexpr uint16_t kPower = 0xFFFF; ///< The drive does not get or lose torque as it shall.
} // namespace own_error

class DriveAxis {
public:
  explicit DriveAxis(DriveConfig config);

  /// The drive is in operation; `telegram` is its AT. `missing`: StartUp::missingModes.
  void begin(const ScalingFacts &facts, uint8_t missing, std::span<const uint8_t> telegram);
  /// It is not any more: where it stood is still known.
  void end();

  /// First in a cycle: takes the AT over.
  void read(std::span<const uint8_t> telegram);
  /// Last in a cycle: its record of the MDT, without the service channel. `record` has the length
  /// that the plan says.
  void write(std::span<uint8_t> record);

  void command(const bus::DriveCommand &command) { command_ = command; }
  /// Without `communication`.
  [[nodiscard]] const bus::DriveStatus &status() const { return status_; }
  /// S-0-0135, of its last telegram.
  [[nodiscard]] uint16_t statusWord() const { return statusWord_; }
  /// What its second encoder shows (S-0-0053), as a counter of 32 bits; 0: it has none. [inc]
  [[nodiscard]] uint32_t secondPosition() const { return seconds_.counter(); }
  /// Bit n stands for mode n.
  [[nodiscard]] uint8_t controllerModes() const;
  /// It is switched off, whatever the command says: it stops as well as it can.
  void shutDown() { shutDown_ = true; }
  /// It stands still, or has no torque.
  [[nodiscard]] bool atRest() const;
  /// Set values move it, or it is on its way to rest from a reference run.
  [[nodiscard]] bool commandedToMove() const {
    return (follows() && targetMoves_) || (homing_.active() && !command_.homing && !atRest());
  }

  /// What is to be asked by the service channel.
  [[nodiscard]] ServiceWish wish() const;
  void answered(const ServiceWish &wish, const ServiceAnswer &answer);

private:
  /// The procedure command S-0-0099.
  enum class Reset : uint8_t { None, Start, Running, Ending };

  void resetAnswered(const ServiceAnswer &answer);
  void readMode();
  void readActual(std::span<const uint8_t> telegram);
  void readErrors();
  void readProbes();
  void readHoming();
  void chooseMode();
  void writeTargets(std::span<uint8_t> record);
  [[nodiscard]] uint32_t targetPosition(bool regulated) const;
  [[nodiscard]] double targetVelocity() const;
  [[nodiscard]] double targetTorque(uint8_t regulated) const;
  [[nodiscard]] PowerTarget powerTarget() const;
  [[nodiscard]] bool follows() const;

  DriveConfig config_;
  ModeList modes_;
  bus::DriveCommand command_;
  bus::DriveStatus status_;
  PowerControl power_;
  HomingRun homing_;
  Probes probes_;
  PositionCounter positions_;
  PositionCounter seconds_; ///< Of S-0-0053.
  double velocityUnit_ = 1; ///< [inc/s]
  double torqueUnit_ = 1;   ///< [Nm]
  uint32_t before_ = 0;     ///< Position of the cycle before. [inc]
  uint32_t lastTarget_ = 0; ///< Set position of the cycle before. [inc]
  uint32_t resting_ = 0;    ///< Cycles without motion.
  uint32_t modeWaited_ = 0; ///< For the mode that is wanted. [cycles]
  uint32_t unexpected_ = 0; ///< A mode is shown that nobody wants. [cycles]
  uint16_t statusWord_ = 0;
  uint16_t class1_ = 0;    ///< S-0-0011, of the present error.
  uint8_t wantedMode_ = 0; ///< Its place in modes_.
  uint8_t refused_ = 0;    ///< The controller mode that the drive has not taken.
  Reset reset_ = Reset::None;
  bool askedClass1_ = false;
  bool askedManufacturer_ = false;
  bool askedText_ = false;
  bool ipoSync_ = false;
  bool shutDown_ = false;
  bool targetMoves_ = false;
};

} // namespace stride::sercos

#endif
