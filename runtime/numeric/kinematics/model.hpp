// What every kinematics says of itself. A model is a plain structure of its measures with
//
//   static constexpr int kJoints;            // of them, joint 0 first
//   static constexpr unsigned kTurning;      // bit i: joint i turns [rad]; else it shifts [u]
//   static constexpr Task kTask;             // which coordinates of a pose its joints answer for
//   double reach() const;                    // a length to measure errors by [u]
//   Posture postureOf(const double *joints) const;
//   template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const;
//   template <class Scalar>
//   Outcome inverse(const Frame<Scalar> &pose, Posture, const double *reference, Scalar *joints)
//   const;
//
// for numbers and for jets. `inverse` says joints within half a turn of `reference`, which also
// decides what nothing else does (singular poses). Free of the C++ standard library: linked into
// every application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_MODEL_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_MODEL_HPP

#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/kinematics/frame.hpp"

namespace stride::kinematics {

inline constexpr int kMostJoints = 6;
inline constexpr double kPi = 3.141592653589793;

/// Which coordinates of a pose a kinematics can choose; the others follow, and are not looked at by
/// `inverse`.
enum class Task : uint8_t {
  Plane,          ///< x, y
  Place,          ///< x, y, z
  PlaneTurn,      ///< x, y and the turn about z
  PlaceTurn,      ///< x, y, z and the turn about z
  PlaceDirection, ///< x, y, z and where the tool's z axis points
  Full            ///< all six
};

/// Which of the ways to take a pose; each model says what its bits mean.
struct Posture {
  /// Arm: the shoulder looks away from the tool.
  bool backwards;
  /// Elbow: see the model.
  bool elbow;
  /// Hand: the wrist's middle joint is positive.
  bool hand;

  friend bool operator==(const Posture &, const Posture &) noexcept = default;
};

enum class Outcome : uint8_t {
  Done,
  Unreachable,   ///< no joints bring the tool there
  WrongMeasures, ///< a length of the model is not positive, NaN …
  OutOfLimits,   ///< joints do, but not within their limits
  WrongCoupling, ///< arm and hand have no way back from a pose
  WrongTool,     ///< nothing says where the tool's point is before the arm's turn is known
  WrongLimits,   ///< a joint's lower limit is above its upper one, NaN
  NotSet         ///< there is no kinematics
};

/// `angle` plus the whole turns that bring it nearest to `reference`. [rad]
template <class Scalar> Scalar nearTo(double reference, const Scalar &angle) noexcept {
  const double turns = (reference - valueOf(angle)) / (2 * kPi) + 0.5;
  if (turns >= 0 && turns < 1) // as a rule
    return angle + Scalar(0.0);
  return angle + Scalar(2 * kPi * exact::floor(turns));
}

template <class Scalar> bool isNegative(const Scalar &number) noexcept {
  return !(valueOf(number) >= 0);
}

/// Whether a point is the origin, but for the rounding of numbers of a size: nothing decides the
/// angle that leads to it.
template <class Scalar> bool isOrigin(const Scalar &x, const Scalar &y, double size) noexcept {
  const double most = 1e-12 * size;
  return valueOf(x) * valueOf(x) + valueOf(y) * valueOf(y) <= most * most;
}

template <class Scalar> Scalar square(const Scalar &number) noexcept { return number * number; }

/// The turn about z that is nearest to an orientation (least squares of all elements). [rad]
template <class Scalar> Scalar turnAboutZ(const Matrix<Scalar> &turn) noexcept {
  return angleOf(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
}

/// Whether a model says by its own `heading(joints)` how far its flange has turned about z [rad],
/// which is all that it turns.
template <class Model, class Scalar>
inline constexpr bool kHasHeading = requires(const Model &model, const Scalar *joints) {
  model.heading(joints);
};

/// An orientation as the arm's flange sees it: by the model's own `seenFromFlange(joints, turn)` if
/// it has one.
template <class Model, class Scalar>
Matrix<Scalar> seenFromFlange(const Model &model, const Scalar *joints,
                              const Matrix<Scalar> &turn) {
  if constexpr (requires { model.seenFromFlange(joints, turn); }) {
    return model.seenFromFlange(joints, turn);
  } else {
    Frame<Scalar> flange;
    (void)model.forward(joints, flange);
    return transposedTimes(flange.turn, turn);
  }
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_MODEL_HPP
