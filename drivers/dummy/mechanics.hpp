// What moves behind a simulated drive. Deterministic to the bit; no allocation.
#ifndef STRIDE_DRIVERS_DUMMY_MECHANICS_HPP
#define STRIDE_DRIVERS_DUMMY_MECHANICS_HPP

#include "drivers/dummy/physics_schema.hpp"

#include <cstdint>

namespace stride::dummy {

/// Controller modes, numbered as in AXIS_REF.byControllerMode.
inline constexpr uint8_t kTorqueMode = 1;
inline constexpr uint8_t kVelocityMode = 2;
inline constexpr uint8_t kPositionMode = 3;
inline constexpr uint8_t kCurrentMode = 4;

/// Parameters of the models. Lengths in increments; torques in Nm (or forces in N).
struct MechanicsParameters {
  Model model = Model::Ideal;
  double cycle = 0.01;        ///< [s]
  double timeConstant = 0;    ///< Lag. [s]
  double inertia = 1;         ///< [Nm/(inc/s^2)]
  double viscousFriction = 0; ///< [Nm/(inc/s)]
  double coulombFriction = 0; ///< [Nm]
  double torqueLimit = 0;     ///< [Nm]
  double positionGain = 0;    ///< [1/s]
  double velocityGain = 0;    ///< [Nm/(inc/s)]
  double integralTime = 0;    ///< Of the velocity controller; 0: no integral part. [s]
  double velocityFeedforward =
      0;                 ///< Share of the set velocity that goes past the position controller.
  uint32_t substeps = 1; ///< Of the controllers, per cycle.
};

/// Set values for one cycle, over which positions and velocities change linearly.
struct Demand {
  int64_t from = 0;        ///< Position at its start. [inc]
  int64_t to = 0;          ///< Position at its end. [inc]
  double velocityFrom = 0; ///< For velocity mode: at its start … [inc/s]
  double velocity = 0;     ///< … and at its end. [inc/s]
  double torque = 0;       ///< For torque mode: all the time. [Nm]
  uint8_t mode = kPositionMode;
  bool homing = false; ///< The drive shall look for its reference instead.
};

/// One axis.
class Mechanics {
public:
  /// At rest at `position`.
  Mechanics(const MechanicsParameters &parameters, int64_t position);

  /// One cycle in regulation. `load`: torque from outside, positive in positive direction.
  void regulate(const Demand &demand, double load);

  /// One cycle without torque but with the brake open.
  void coast(double load);

  /// The brake is closed.
  void hold();

  /// Other parameters from now on. The model stays.
  void configure(const MechanicsParameters &parameters);

  /// Puts the axis somewhere, at rest.
  void place(int64_t position);

  /// What the encoder shows, over any number of turns.
  [[nodiscard]] int64_t position() const { return whole_; }
  /// How far the axis is beyond that, in [-0.5, 0.5). [inc]
  [[nodiscard]] double fraction() const { return rest_; }
  [[nodiscard]] double velocity() const { return velocity_; } ///< [inc/s]
  /// The motor's, at the end of the cycle. [Nm]
  [[nodiscard]] double torque() const { return torque_; }
  /// The torque was at its limit in the last cycle.
  [[nodiscard]] bool saturated() const { return saturated_; }

private:
  void regulateLag(const Demand &demand);
  void regulateSecondOrder(const Demand &demand, double load);
  void set(int64_t whole, double offset);
  [[nodiscard]] double limited(double torque);

  MechanicsParameters p_;
  double decay_ = 0; ///< Lag: what is left of a deviation after one cycle.
  int64_t whole_;
  double rest_ = 0;
  double velocity_ = 0;
  double torque_ = 0;
  double integral_ = 0; ///< Of the velocity controller. [Nm]
  bool saturated_ = false;
};

/// A body under a constant torque (motor and load together) for `time` [s]: exact, also where it
/// comes to rest or turns round on the way. `x` and `v` go on.
void moveBody(const MechanicsParameters &parameters, double torque, double time, double &x,
              double &v);

} // namespace stride::dummy

#endif
