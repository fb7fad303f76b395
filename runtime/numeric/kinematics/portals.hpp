// Portals: axes at right angles, or belts that move the same carriage. Free of the C++ standard
// library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_PORTALS_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_PORTALS_HPP

#include "runtime/numeric/kinematics/model.hpp"

namespace stride::kinematics {

/// X and Y.
struct Gantry2 {
  static constexpr int kJoints = 2;
  static constexpr unsigned kTurning = 0;
  static constexpr Task kTask = Task::Plane;
  static constexpr bool kFlangeKeepsTurn = true;

  double reach() const noexcept { return 1.0; }
  Posture postureOf(const double *) const noexcept { return {}; }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    pose = unturned(Vector<Scalar>(joints[0], joints[1], Scalar(0.0)));
    return Outcome::Done;
  }
  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture, const double *, Scalar *joints) const {
    joints[0] = pose.place(0);
    joints[1] = pose.place(1);
    return Outcome::Done;
  }
};

/// X, Y and Z.
struct Gantry3 {
  static constexpr int kJoints = 3;
  static constexpr unsigned kTurning = 0;
  static constexpr Task kTask = Task::Place;
  static constexpr bool kFlangeKeepsTurn = true;

  double reach() const noexcept { return 1.0; }
  Posture postureOf(const double *) const noexcept { return {}; }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    pose = unturned(Vector<Scalar>(joints[0], joints[1], joints[2]));
    return Outcome::Done;
  }
  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture, const double *, Scalar *joints) const {
    for (int axis = 0; axis < 3; ++axis)
      joints[axis] = pose.place(axis);
    return Outcome::Done;
  }
};

/// Two motors that stand still and move a carriage by one belt: x and y are half the sum or half
/// the difference of their ways. Sources: SoftMotion V2.3 manual, section 8.2.3; SoftMotion 3,
/// Kin_HGantry2, Kin_TGantry2, which do not say whether half or all of the difference counts.
struct BeltPortal {
  static constexpr int kJoints = 2;
  static constexpr unsigned kTurning = 0;
  static constexpr Task kTask = Task::Plane;
  static constexpr bool kFlangeKeepsTurn = true;

  /// How x and y go with the first motor: 1 or -1. With the second one x goes by `xSecond`, y by
  /// `ySecond`.
  double xFirst, yFirst, xSecond, ySecond;

  double reach() const noexcept { return 1.0; }
  Posture postureOf(const double *) const noexcept { return {}; }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    const Scalar half(0.5);
    const Scalar x = half * (Scalar(xFirst) * joints[0] + Scalar(xSecond) * joints[1]);
    const Scalar y = half * (Scalar(yFirst) * joints[0] + Scalar(ySecond) * joints[1]);
    pose = unturned(Vector<Scalar>(x, y, Scalar(0.0)));
    return Outcome::Done;
  }
  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture, const double *, Scalar *joints) const {
    // The columns are orthogonal: the transposed matrix is the inverse.
    joints[0] = Scalar(xFirst) * pose.place(0) + Scalar(yFirst) * pose.place(1);
    joints[1] = Scalar(xSecond) * pose.place(0) + Scalar(ySecond) * pose.place(1);
    return Outcome::Done;
  }
};

/// Belt in the shape of an H: forward and backward by the same way goes to +x, both backward to +y.
inline constexpr BeltPortal kHGantry2{1, -1, -1, -1};
/// Belt in the shape of a T: both forward goes to +x, the first backward and the second forward to
/// +y.
inline constexpr BeltPortal kTGantry2{1, -1, 1, 1};

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_PORTALS_HPP
