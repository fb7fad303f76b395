// A CiA 402 drive behind the driver interface of axes. It knows objects and their values, and
// nothing of frames or SYNC.
#ifndef STRIDE_DRIVERS_CAN_MASTER_DRIVE402_HPP
#define STRIDE_DRIVERS_CAN_MASTER_DRIVE402_HPP

#include "drivers/can/master/homing_run.hpp"
#include "drivers/can/master/modes.hpp"
#include "drivers/can/master/power.hpp"
#include "drivers/can/master/signals.hpp"
#include "drivers/can/master/touch_probe.hpp"
#include "drivers/can/plan/pdo_plan.hpp"
#include "runtime/bus/axis_driver.hpp"

#include <array>
#include <cstdint>

namespace stride::can {

/// Numbers of errors that the master finds itself, in DriveStatus::errorId; those of 603Fh are
/// greater.
namespace own_error {
inline constexpr uint16_t kPower = 1; ///< The drive stays in a state that it should leave.
} // namespace own_error

struct DriveConfig {
  double cycle = 0.001; ///< [s]
  PowerParameters power;
  uint32_t brakeRelease =
      0; ///< After operation is enabled, until set values are followed. [cycles]
  uint32_t modeTimeout = 500;    ///< [cycles]
  uint32_t homingTimeout = 2000; ///< Until a reference run begins to move. [cycles]
  bool homesItself = true;       ///< The drive has reference runs of its own.
  uint8_t inputsInverted = 0;    ///< Of 60FDh: bit 0 negative limit, 1 positive limit, 2 home.
  uint8_t probeInputs = 0;       ///< Bit n: input n of DriveStatus.
  double torqueRated = 0;        ///< 0: what the drive says (6076h). [Nm]
  double velocityScale = 1;      ///< [inc/s] for one unit of 60FFh and 606Ch.
};

/// What a start-up has found out.
struct DriveFacts {
  uint32_t supportedModes = kUsualModes; ///< 6502h.
  uint32_t ratedTorque = 0;              ///< 6076h; 0: unknown. [mNm]
  uint32_t ratedCurrent = 0;             ///< 6075h; 0: unknown. [mA]
  uint32_t homeOffset = 0;               ///< 607Ch. [inc]
  int8_t mode = mode::kNone;             ///< In which the drive has started.
};

/// Whether 606Ch means what the configuration says: compared with the way of 6064h.
class VelocityCheck {
public:
  /// One cycle in operation. TRUE once: they do not fit together.
  bool step(double way, double velocityWay);
  void clear() { *this = VelocityCheck(); }

private:
  double way_ = 0;
  double velocityWay_ = 0;
  uint32_t cycles_ = 0; ///< In motion.
};

class Drive402 {
public:
  Drive402(const DriveConfig &config, const DrivePlan &plan);

  /// The drive has started up; its actual values are in `signals`.
  void begin(const DriveFacts &facts, const Signals &signals);
  /// It is left alone.
  void end();

  /// First in a cycle: takes the actual values over. `told`: the error that the
  /// node has told or has in its list, for a fault without 603Fh.
  void read(const Signals &signals, uint16_t told);
  /// Last in a cycle: makes set values of the command.
  void write(Signals &signals);

  /// Whether it can be reached: if not, it stays off until an error is acknowledged after that.
  void reach(bool reachable) { power_.reach(reachable); }

  void command(const bus::DriveCommand &command) { command_ = command; }
  /// Without `communication`.
  [[nodiscard]] const bus::DriveStatus &status() const { return status_; }
  [[nodiscard]] uint8_t controllerModes() const { return controllerModes_; }
  [[nodiscard]] PowerState powerState() const { return power_.state(); }
  /// It shows a fault (bit 3 of its statusword).
  [[nodiscard]] bool fault() const { return power_.fault(); }
  /// 603Fh of the present fault; 0: none, or not known.
  [[nodiscard]] uint16_t errorCode() const { return errorCode_; }
  /// It does not go into the state that it shall have.
  [[nodiscard]] bool stuck() const { return power_.stuck(); }
  /// True once: velocity and way do not fit together (velocity_scale).
  [[nodiscard]] bool velocityDoubtful();

  /// It brakes by itself, as 605Ah says, and stays so.
  void quickStop() { quickStop_ = true; }
  /// It is switched off, whatever the command says.
  void shutDown() { shutDown_ = true; }
  /// It stands still, or is off.
  [[nodiscard]] bool atRest() const;
  /// In regulation, with set values that move; or on its way to rest from a reference run.
  [[nodiscard]] bool commandedToMove() const;

  /// What is to be asked by SDO.
  [[nodiscard]] ObjectWish wish() const;
  void answered(const ObjectWish &wish, const ObjectAnswer &answer);

private:
  static constexpr size_t kProbes = 2;

  void readActual(const Signals &signals);
  void readInputs(const Signals &signals);
  void readProbes(const Signals &signals);
  void readErrors(uint16_t told);
  void stepHoming();
  void chooseMode();
  void writeTargets(Signals &signals);
  [[nodiscard]] uint32_t targetPosition(bool regulated) const;
  [[nodiscard]] int32_t targetVelocity(uint8_t regulated, const Signals &signals) const;
  [[nodiscard]] int32_t targetTorque(uint8_t regulated, const Signals &signals) const;
  [[nodiscard]] PowerTarget powerTarget() const;
  [[nodiscard]] bool follows() const;
  [[nodiscard]] int32_t driveVelocity(double velocity) const;
  [[nodiscard]] int32_t driveTorque(double torque) const;
  [[nodiscard]] double ratedTorque() const;
  [[nodiscard]] ObjectWish probeWish() const;

  DriveConfig config_;
  DrivePlan plan_;
  DriveFacts facts_;
  bus::DriveCommand command_;
  bus::DriveStatus status_;
  PowerControl power_;
  ModeControl modes_;
  HomingRun homing_;
  std::array<TouchProbe, kProbes> probes_;
  VelocityCheck check_;
  uint32_t before_ = 0;     ///< Position of the cycle before. [inc]
  uint32_t lastTarget_ = 0; ///< Set position of the cycle before. [inc]
  uint32_t released_ = 0;   ///< Cycles since operation is enabled.
  uint32_t resting_ = 0;    ///< Cycles without motion.
  uint16_t statusword_ = 0;
  uint16_t errorCode_ = 0; ///< 603Fh, of the present fault.
  uint8_t controllerModes_ = 0;
  uint8_t refused_ = 0;      ///< The controller mode that the drive has not taken.
  bool askedOffset_ = false; ///< 607Ch has been read for this reference run.
  bool askedError_ = false;  ///< 603Fh has been read for this fault.
  bool quickStop_ = false;
  bool shutDown_ = false;
  bool targetMoves_ = false;
  bool doubtful_ = false;
};

} // namespace stride::can

#endif
