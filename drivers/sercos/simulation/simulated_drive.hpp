// A simulated drive on a Sercos ring, on the mechanics of the driver "Dummy". [IEC 61491]
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATION_SIMULATED_DRIVE_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATION_SIMULATED_DRIVE_HPP

#include "drivers/dummy/reference_run.hpp"
#include "drivers/sercos/simulation/drive_scaling.hpp"
#include "drivers/sercos/simulation/drive_setup.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace stride::sercos::simulation {

/// Its controllers run with the MST: what the MDT of a cycle has brought is valid from the next MST
/// on, and reached at the one after that, with ideal mechanics to the increment. Feedback is that
/// of the MST. With S-0-0001 of several S-0-0002 a position is reached in as many cycles, counted
/// from where the bit IPOSYNC turns. Without an MDT the position goes on as in the cycle before.
class SimulatedDrive final : public Device {
public:
  explicit SimulatedDrive(const DriveSetup &setup);

  /// Where the structure that it shares with programs is now; null: there is none.
  void bind(DriveSim *sim) { sim_ = sim; }

  /// An error of the drive with a number for S-0-0129: it stops, and is without torque then.
  void fail(uint16_t number) noexcept;
  /// An edge at a probe input: probe 1 positive, negative, probe 2 positive, negative.
  void probe(size_t input) noexcept;
  /// An axis without torque is turned by hand. [inc]
  void place(int64_t position) noexcept;
  /// Main power comes and goes; at first it is there.
  void setMainPower(bool on) noexcept { mainPower_ = on; }

  enum class Power : uint8_t { Off, SwitchingOn, On, Stopping };
  [[nodiscard]] Power power() const { return power_; }
  [[nodiscard]] bool hasTorque() const { return power_ == Power::On || power_ == Power::Stopping; }
  [[nodiscard]] const dummy::Mechanics &mechanics() const { return mechanics_; }
  /// Which of S-0-0032 … S-0-0035 is active.
  [[nodiscard]] uint8_t mode() const { return mode_; }

private:
  void onPhase(Phase before) noexcept override;
  void onCycle(int64_t periodNs) noexcept override;
  [[nodiscard]] uint16_t deviceStatus() const noexcept override;
  void checkPhase4(IdnEntry &invalid) noexcept override;
  uint16_t checkData(const IdnEntry &entry, int64_t value) noexcept override;
  void onData(const IdnEntry &entry) noexcept override;
  uint16_t onCommand(Idn idn) noexcept override;
  void onCommandEnd(Idn idn) noexcept override;
  void onError() noexcept override;
  [[nodiscard]] bool canReset() const noexcept override { return !persistent_; }
  void onReset() noexcept override;

  // simulated_drive.cpp: power and modes.
  void control() noexcept;
  void switchOn() noexcept;
  void switchOff() noexcept;
  void stop() noexcept;
  void changeMode() noexcept;
  [[nodiscard]] bool supports(int64_t operationMode) const;
  [[nodiscard]] OperationMode operation() const;
  [[nodiscard]] bool positions() const;
  [[nodiscard]] bool mayFollow() const;

  // drive_motion.cpp: what moves.
  void move(double seconds) noexcept;
  void regulate(double seconds) noexcept;
  [[nodiscard]] dummy::Demand demandFor(double seconds) noexcept;
  [[nodiscard]] dummy::Demand followPosition(double seconds) noexcept;
  [[nodiscard]] dummy::Demand followVelocity() noexcept;
  [[nodiscard]] dummy::Demand brake(double seconds) noexcept;
  [[nodiscard]] dummy::Demand hold() const;
  [[nodiscard]] dummy::Demand home() noexcept;
  void latch() noexcept;
  void rest() noexcept;
  uint16_t startHoming() noexcept;
  void lookForHome(double before, double now) noexcept;
  void setReference(double increments) noexcept;

  // drive_signals.cpp: what goes in and out besides.
  void disturb() noexcept;
  void publish() noexcept;
  void updateData() noexcept;
  void updateClasses() noexcept;
  void updateSwitches() noexcept;
  void watchPosition() noexcept;
  void passMarks(double before, double now) noexcept;
  void capture(size_t input, double increments) noexcept;
  void clearProbe(size_t probe) noexcept;
  [[nodiscard]] double exactPosition() const;
  [[nodiscard]] double lag() const;
  [[nodiscard]] int64_t ringPosition(double increments) const;

  enum class Homing : uint8_t { Idle, Running, Found };

  dummy::DriveParameters parameters_;
  dummy::DriveParameters homingParameters_;
  double ratedTorque_;
  DriveScaling scaling_;
  dummy::Mechanics mechanics_;
  dummy::ReferenceRun run_;
  DriveSim *sim_ = nullptr;

  Power power_ = Power::Off;
  bool mainPower_ = true;
  bool armed_ = false;        ///< The master has let go of "on" since the drive could be.
  bool persistent_ = false;   ///< S-0-0099 does not help.
  uint32_t switchCycles_ = 0; ///< Until it is on.
  bool follows_ = false;      ///< In this cycle it does what the command values say.
  uint8_t mode_ = 0;
  uint16_t failed_ = 0;  ///< Number of fail(), until S-0-0099.
  double cycle_;         ///< For which the mechanics are configured. [s]
  double torqueLimit_;   ///< With which they are. [Nm]
  bool lagless_ = false; ///< With all of the velocity fed forward.

  // Set values; lengths as the mechanics have them.
  int64_t origin_ = 0;     ///< Position on the ring minus that of the mechanics. [ring units]
  int64_t commanded_ = 0;  ///< Over any number of turns. [ring units]
  int64_t target_ = 0;     ///< [inc]
  int64_t cyclesLeft_ = 0; ///< Until the target is to be reached.
  int64_t way_ = 0;        ///< Of the last cycle. [inc]
  bool ipoSync_ = false;
  double velocity_ = 0;         ///< [inc/s]
  double torque_ = 0;           ///< [Nm]
  int64_t demanded_ = 0;        ///< Where the set position is. [inc]
  double demandRest_ = 0;       ///< What is left of it below one increment.
  double velocityDemanded_ = 0; ///< [inc/s]

  Homing homing_ = Homing::Idle;
  bool needsMark_ = false;   ///< The reference is an index pulse …
  bool needsSwitch_ = false; ///< … after the home switch, or that alone.
  bool probing_ = false;

  bool limitPositive_ = false;
  bool limitNegative_ = false;
  bool homeSwitch_ = false;
  bool index_ = false;
  double indexMark_ = 0;
};

} // namespace stride::sercos::simulation

#endif
