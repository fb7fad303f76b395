// How a simulated drive looks for its reference by itself.
#ifndef STRIDE_DRIVERS_DUMMY_REFERENCE_RUN_HPP
#define STRIDE_DRIVERS_DUMMY_REFERENCE_RUN_HPP

#include "drivers/dummy/drive_parameters.hpp"
#include "runtime/bus/axis_driver.hpp"

#include <cstdint>

namespace stride::dummy {

/// Fast towards the home switch, and slowly back off it; the reference is where the switch opens.
/// Starts on the switch: only the latter. Velocities change with a limited acceleration.
class ReferenceRun {
public:
  /// Begins at rest at a position, on the home switch or not.
  void begin(const DriveParameters &parameters, int64_t position, bool onSwitch);

  /// There is none.
  void clear() { state_ = bus::Homing::None; }

  /// The drive gives up and brakes.
  void fail() { state_ = bus::Homing::Failed; }

  /// Set values for the next cycle.
  [[nodiscard]] Demand next();

  /// After a cycle in which the mechanics went from `before` to `after`: what the switches say now.
  void look(double before, double after, bool onSwitch, bool limitPositive, bool limitNegative);

  [[nodiscard]] bus::Homing state() const { return state_; }

  /// Found: where. [inc]
  [[nodiscard]] double reference() const { return reference_; }

private:
  [[nodiscard]] double wantedVelocity() const;
  [[nodiscard]] double edge(double before, double after) const;

  HomingParameters p_;
  SwitchRange home_;
  double period_ = 0;
  double cycle_ = 0;
  bus::Homing state_ = bus::Homing::None;
  bool leaving_ = false; ///< The switch has been found: slowly off it.
  bool onSwitch_ = false;
  int64_t whole_ = 0; ///< Last set position …
  double rest_ = 0;   ///< … and what is left below one increment.
  double velocity_ = 0;
  double way_ = 0; ///< That has been looked for the switch. [inc]
  double reference_ = 0;
};

} // namespace stride::dummy

#endif
