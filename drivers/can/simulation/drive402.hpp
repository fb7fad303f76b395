// A simulated drive on CAN: a CANopen node with the profile of drives, on the mechanics of the
// driver "Dummy". [CiA 402]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_DRIVE402_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_DRIVE402_HPP

#include "drivers/can/simulation/canopen_node.hpp"
#include "drivers/can/simulation/drive_objects.hpp"
#include "drivers/can/simulation/power_state.hpp"
#include "drivers/dummy/drive_parameters.hpp"
#include "drivers/dummy/reference_run.hpp"

#include "st/DummyDrive/DUMMY_DRIVE_SIM.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace stride::can::simulation {

/// What programs see of the simulation and disturb it with.
using DriveSim = ::st::DummyDrive::DUMMY_DRIVE_SIM;

struct Drive402Setup {
  NodeSetup node{}; ///< Of the first axis.
  dummy::DriveParameters drive{};
  double ratedTorque = 1;   ///< 6076h. [Nm]
  double velocityScale = 1; ///< Increments per second that a unit of velocity of the drive is.
  double secondEncoder = 1; ///< 60E4h:1: its increments for one of the drive's.
  /// Objects that it has besides: those of the profile go before them.
  std::vector<ObjectRow> more{};
  uint8_t axis = 0; ///< Of the device.
  /// More axes of the same device. [CiA 301, logical devices]
  std::vector<Drive402Setup> further{};
};

class SimulatedDrive402;

/// Its controllers run with SYNC, or by themselves every 60C2h when none comes: a cycle of them is
/// over when SYNC comes about that time after the last one. What is valid since a SYNC has been
/// reached at the next one, with ideal mechanics to the increment.
class DriveAxis {
public:
  /// The rows of `setup` must be in the dictionary of `node`, whose axis it is.
  DriveAxis(const Drive402Setup &setup, SimulatedDrive402 &node);

  /// Where the structure that it shares with programs is now; null: there is none.
  void bind(DriveSim *sim) { sim_ = sim; }

  /// An error of the drive: it stops as 605Eh says, and is in fault then.
  void raiseError(uint16_t code) noexcept;
  /// An edge at a touch probe input: probe 1 rising, falling, probe 2 rising, falling.
  void probe(size_t input) noexcept;
  /// An axis without power is turned by hand. [inc]
  void place(int64_t position) noexcept;

  [[nodiscard]] PowerState power() const { return power_; }
  [[nodiscard]] const dummy::Mechanics &mechanics() const { return mechanics_; }
  /// The position counter, as the bus has it. [inc]
  [[nodiscard]] int32_t position() const;
  [[nodiscard]] int8_t mode() const { return mode_; }

  [[nodiscard]] uint8_t number() const { return static_cast<uint8_t>(shift_ / kAxisObjects); }
  /// The code of its error; 0: it has none.
  [[nodiscard]] uint16_t fault() const { return fault_; }

  // What a program does to it (DriveSim).
  [[nodiscard]] bool isWatched() const { return sim_ != nullptr; }
  [[nodiscard]] bool isUnplugged() const {
    return sim_ != nullptr && sim_->bLoseCommunication != 0;
  }
  [[nodiscard]] bool isDeaf() const { return sim_ != nullptr && sim_->bHoldParameters != 0; }
  [[nodiscard]] bool isElsewhere() const;

  // Hooks of its node, as CanopenNode has them.
  void reset() noexcept;
  void entered(NmtState state) noexcept;
  [[nodiscard]] Abort check(const Entry &entry, uint64_t value) const noexcept;
  void written(Entry &entry) noexcept;
  void sync() noexcept;
  void synchronized() noexcept;
  void connectionLost() noexcept;
  void time() noexcept;
  [[nodiscard]] int64_t nextNs() const noexcept;

private:
  // drive402.cpp: the power state machine.
  void control(uint16_t before, uint16_t word) noexcept;
  void change(PowerState state) noexcept;
  void leaveOperation(PowerState target) noexcept;
  void finishSwitching() noexcept;
  void finishStop() noexcept;
  void brakeTo(PowerState target, const Entry &ramp) noexcept;
  void abortConnection(bool always) noexcept;
  [[nodiscard]] bool powered() const;
  [[nodiscard]] bool regulates() const;
  [[nodiscard]] bool positions() const;

  // drive_motion.cpp: one cycle of the controllers.
  void move(int64_t timeNs) noexcept;
  void latch() noexcept;
  [[nodiscard]] dummy::Demand demandFor(double seconds) noexcept;
  [[nodiscard]] dummy::Demand followPosition(double seconds) noexcept;
  [[nodiscard]] dummy::Demand followVelocity(double seconds) noexcept;
  [[nodiscard]] dummy::Demand hold() const;
  [[nodiscard]] dummy::Demand stop(double seconds) noexcept;
  [[nodiscard]] dummy::Demand home() noexcept;
  [[nodiscard]] double torqueFor(double seconds) noexcept;
  [[nodiscard]] int64_t periodNs() const noexcept;
  [[nodiscard]] int64_t targetPosition() noexcept;
  void regulate(double seconds) noexcept;
  void changeMode() noexcept;
  void startHoming() noexcept;
  [[nodiscard]] bool onReferenceSwitch() const;
  void lookForHome(double before, double after) noexcept;

  // drive_signals.cpp: what goes in and out besides.
  void disturb() noexcept;
  void publish() noexcept;
  void updateObjects() noexcept;
  void updateSwitches() noexcept;
  void watchFollowingError() noexcept;
  [[nodiscard]] uint16_t modeBits() const noexcept;
  void passMarks(double before, double after) noexcept;
  void configureProbes(uint64_t before) noexcept;
  void capture(size_t input, bool index, double increments) noexcept;
  [[nodiscard]] double exactPosition() const;
  [[nodiscard]] double lag() const;
  [[nodiscard]] double rampOf(const Entry &entry) const;
  [[nodiscard]] uint32_t counter(int64_t increments) const;

  enum class HomingState : uint8_t { Idle, Running, Found, Attained, Failed };

  SimulatedDrive402 &node_;
  uint16_t shift_; ///< From the objects of the first axis to its own.
  dummy::DriveParameters parameters_;
  dummy::DriveParameters homingParameters_;
  double ratedTorque_;
  double velocityScale_;
  double secondEncoder_;
  DriveObjects o_;
  dummy::Mechanics mechanics_;
  dummy::ReferenceRun run_;
  DriveSim *sim_ = nullptr;

  PowerState power_ = PowerState::NotReady;
  PowerState switching_ = PowerState::NotReady; ///< Where it is on its way to; NotReady: nowhere.
  int64_t switchedNs_ = 0;                      ///< It is there then.
  PowerState afterStop_ = PowerState::NotReady; ///< Where it goes after it has come to rest.
  bool stopping_ = false;                       ///< It brakes by itself, or holds after that.
  double deceleration_ = 0;                     ///< Meanwhile. [inc/s²]
  uint16_t fault_ = 0;
  bool persistent_ = false;
  uint16_t control_ = 0;
  uint16_t probes_ = 0; ///< 60B8h, as it was last.
  int8_t mode_ = 0;

  int64_t cycleNs_ = 0; ///< The present cycle of the controllers began then.
  bool freely_ = true;  ///< It was not SYNC that began it.
  double cycle_ = 0;    ///< For which the mechanics are configured. [s]
  int64_t origin_ = 0;  ///< Position counter minus position of the mechanics. [inc]

  // Set values of the present cycle; lengths as the mechanics have them.
  int64_t target_ = 0;
  int64_t from_ = 0;     ///< Where interpolation has begun …
  int64_t passedNs_ = 0; ///< … and how long ago.
  double velocity_ = 0;  ///< [inc/s]
  double torque_ = 0;    ///< [Nm]
  bool targetLimited_ = false;
  // Where they are.
  int64_t demanded_ = 0;
  double demandRest_ = 0;
  double velocityDemanded_ = 0;
  double torqueDemanded_ = 0;

  HomingState homing_ = HomingState::Idle;
  double lagSeconds_ = 0; ///< That the following error is too large.
  bool following_ = false;

  bool limitPositive_ = false;
  bool limitNegative_ = false;
  bool homeSwitch_ = false;
  bool index_ = false;
  double indexMark_ = 0;
};

/// A node that is one drive or several.
class SimulatedDrive402 final : public CanopenNode {
public:
  explicit SimulatedDrive402(const Drive402Setup &setup);

  /// In the order of the setup.
  [[nodiscard]] DriveAxis &axis(size_t place) { return axes_[place]; }
  [[nodiscard]] const DriveAxis &axis(size_t place) const { return axes_[place]; }

  // Of the first axis.
  void bind(DriveSim *sim) { axes_[0].bind(sim); }
  void raiseError(uint16_t code) noexcept { axes_[0].raiseError(code); }
  void probe(size_t input) noexcept { axes_[0].probe(input); }
  void place(int64_t position) noexcept { axes_[0].place(position); }
  [[nodiscard]] PowerState power() const { return axes_[0].power(); }
  [[nodiscard]] const dummy::Mechanics &mechanics() const { return axes_[0].mechanics(); }
  [[nodiscard]] int32_t position() const { return axes_[0].position(); }
  [[nodiscard]] int8_t mode() const { return axes_[0].mode(); }

  // Errors of an axis.
  void raise(uint16_t code, uint8_t registerBits) noexcept;
  void settle(uint16_t code) noexcept;

private:
  void onReset() noexcept override;
  void onState(NmtState state) noexcept override;
  Abort onWrite(const Entry &entry, uint64_t value) noexcept override;
  void onWritten(Entry &entry) noexcept override;
  void onSync() noexcept override;
  void onSynchronized() noexcept override;
  void onConnectionLost() noexcept override;
  void onTime() noexcept override;
  [[nodiscard]] int64_t nextDeviceNs() const noexcept override;

  void disturb() noexcept;

  std::vector<DriveAxis> axes_;
};

} // namespace stride::can::simulation

#endif
