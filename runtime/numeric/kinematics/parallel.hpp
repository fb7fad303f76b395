// Parallel kinematics: motors that stand still hold a plate or a point by rods. Free of the C++
// standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_PARALLEL_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_PARALLEL_HPP

#include "runtime/numeric/kinematics/model.hpp"

namespace stride::kinematics {

/// The point that is as far from three others as `length` says, on the side to which the z axis
/// points less. [u]
template <class Scalar>
Outcome hangFromThree(const Vector<Scalar> (&centre)[3], double length, Vector<Scalar> &point) {
  const Vector<Scalar> first = centre[1] - centre[0];
  const Vector<Scalar> second = centre[2] - centre[0];
  const Vector<Scalar> normal = first.cross(second);
  const Scalar area = normal.dot(normal);
  if (!(valueOf(area) > 0))
    return Outcome::WrongMeasures;
  // The circumcentre in the plane of the three, then down its axis.
  const Vector<Scalar> toMiddle =
      (normal.cross(first) * second.dot(second) + second.cross(normal) * first.dot(first)) /
      (Scalar(2.0) * area);
  const Scalar rest = Scalar(length * length) - toMiddle.dot(toMiddle);
  if (isNegative(rest))
    return Outcome::Unreachable;
  const Scalar down = rootOf(rest / area);
  point = centre[0] + toMiddle + normal * (valueOf(normal(2)) > 0 ? -down : down);
  return Outcome::Done;
}

/// Whether a point hangs from three others on the side on which hangFromThree has it: on the other
/// one it is that of rods that have been put together otherwise. [u]
inline bool hangs(const Vector<double> (&centre)[3], double length, const Vector<double> &point) {
  constexpr double kRounding = 1e-9;
  const Vector<double> normal = (centre[1] - centre[0]).cross(centre[2] - centre[0]);
  const double side = normal(2) > 0 ? 1.0 : -1.0;
  return side * normal.dot(point - centre[0]) <= kRounding * length * normal.norm();
}

/// Directions of three columns or motors around a middle, a third of a turn apart.
template <class Scalar> Vector<Scalar> thirdOfRing(double firstAngle, int index) {
  const TurnOf<double> turn = turnBy(firstAngle + 2 * kPi / 3 * index);
  return {Scalar(turn.c), Scalar(turn.s), Scalar(0.0)};
}

/// Three slides on rails, which lean outwards or inwards, hold a plate by pairs of parallel rods,
/// so that it keeps its turn. A slide moves down by its positive way. Sources: SoftMotion V2.3
/// manual, section 8.2.6 (rails upright); SoftMotion 3, Kin_Tripod_Linear.
struct TripodLinear {
  static constexpr int kJoints = 3;
  static constexpr unsigned kTurning = 0;
  static constexpr Task kTask = Task::Place;
  static constexpr bool kFlangeKeepsTurn = true;

  double outerRadius; ///< circle about the origin on which the rails meet z = 0 [u]
  double innerRadius; ///< circle of the plate on which the rods end [u]
  double rod;         ///< length of the rods [u]
  double lean;        ///< of the rails against upright, at most a quarter turn; positive: they come
                      ///< inwards on the way down [rad]
  double firstAngle;  ///< where the first rail is, from x towards y [rad]

  double reach() const noexcept { return rod; }
  Posture postureOf(const double *) const noexcept { return {}; }

  bool areGood() const noexcept { return rod > 0 && exact::fabs(lean) <= kPi / 2; }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    if (!areGood())
      return Outcome::WrongMeasures;
    Vector<Scalar> centre[3];
    setSlides(joints, centre);
    pose.turn = Matrix<Scalar>::Identity();
    return hangFromThree(centre, rod, pose.place);
  }

  /// Where the rods begin, moved inwards by the plate's circle. [u]
  template <class Scalar> void setSlides(const Scalar *joints, Vector<Scalar> (&centre)[3]) const {
    const TurnOf<double> rail = turnBy(lean);
    for (int i = 0; i < 3; ++i) {
      centre[i] = thirdOfRing<Scalar>(firstAngle, i) *
                  (Scalar(outerRadius - innerRadius) - joints[i] * Scalar(rail.s));
      centre[i](2) = -joints[i] * Scalar(rail.c);
    }
  }

  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture, const double *, Scalar *joints) const {
    if (!areGood())
      return Outcome::WrongMeasures;
    const TurnOf<double> rail = turnBy(lean);
    for (int i = 0; i < 3; ++i) {
      const Vector<Scalar> ring = thirdOfRing<Scalar>(firstAngle, i);
      const Vector<Scalar> along =
          ring * Scalar(-rail.s) + Vector<Scalar>(Scalar(0.0), Scalar(0.0), Scalar(-rail.c));
      const Vector<Scalar> way = pose.place - ring * Scalar(outerRadius - innerRadius);
      const Scalar middle = way.dot(along);
      const Vector<Scalar> aside = way - along * middle;
      const Scalar rest = Scalar(rod * rod) - aside.dot(aside);
      if (isNegative(rest))
        return Outcome::Unreachable;
      joints[i] = middle - rootOf(rest); // the slide is above the plate
    }
    Vector<double> centre[3];
    double way[3];
    for (int i = 0; i < 3; ++i)
      way[i] = valueOf(joints[i]);
    setSlides(way, centre);
    const Vector<double> point(valueOf(pose.place(0)), valueOf(pose.place(1)),
                               valueOf(pose.place(2)));
    return hangs(centre, rod, point) ? Outcome::Done : Outcome::Unreachable;
  }
};

/// The joint of an arm whose end is as far as `rod` from a point that is `out` and `down` from its
/// axis, and off its plane by the root of `aside`: the outer of both elbows. False: nothing does.
/// [u], [rad]
template <class Scalar>
bool swing(double arm, double rod, const Scalar &out, const Scalar &down, const Scalar &aside,
           double reference, Scalar &joint) {
  // out cos + down sin = (out^2 + down^2 + aside + arm^2 - rod^2) / (2 arm)
  const Scalar flat = square(out) + square(down);
  const Scalar wanted = (flat + aside + Scalar(arm * arm - rod * rod)) / Scalar(2 * arm);
  const Scalar rest = flat - square(wanted);
  if (isNegative(rest) || !(valueOf(flat) > 0))
    return false;
  const Scalar root = rootOf(rest);
  joint = nearTo(reference, angleOf(down * wanted - out * root, out * wanted + down * root));
  return true;
}

/// Three arms that motors swing, and pairs of parallel rods from their ends to a plate, which keeps
/// its turn (a delta). At zero the arms are level, and the plate's middle is the origin; positive
/// joints swing the arms down. Source: SoftMotion 3, Kin_Tripod_Rotary.
struct TripodRotary {
  static constexpr int kJoints = 3;
  static constexpr unsigned kTurning = 7;
  static constexpr Task kTask = Task::Place;
  static constexpr bool kFlangeKeepsTurn = true;

  double upperArm;    ///< [u]
  double rod;         ///< [u]
  double motorRadius; ///< circle of the arms' axes [u]
  double plateRadius; ///< circle of the plate on which the rods end [u]
  double firstAngle;  ///< where the first motor is, from x towards y [rad]

  double reach() const noexcept { return upperArm + rod; }
  Posture postureOf(const double *) const noexcept { return {}; }

  /// How far the motors are above the origin; NaN where the rods are too short for level arms. [u]
  double motorHeight() const noexcept {
    const double out = motorRadius + upperArm - plateRadius;
    return ::stride::sqrt(rod * rod - out * out);
  }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    const double height = motorHeight();
    if (!(upperArm > 0 && rod > 0 && height >= 0))
      return Outcome::WrongMeasures;
    Vector<Scalar> centre[3];
    setElbows(height, joints, centre);
    pose.turn = Matrix<Scalar>::Identity();
    return hangFromThree(centre, rod, pose.place);
  }

  /// Where the rods begin, moved inwards by the plate's circle. [u]
  template <class Scalar>
  void setElbows(double height, const Scalar *joints, Vector<Scalar> (&centre)[3]) const {
    for (int i = 0; i < 3; ++i) {
      const TurnOf<Scalar> arm = turnBy(joints[i]);
      centre[i] = thirdOfRing<Scalar>(firstAngle, i) *
                  (Scalar(motorRadius - plateRadius) + Scalar(upperArm) * arm.c);
      centre[i](2) = Scalar(height) - Scalar(upperArm) * arm.s;
    }
  }

  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture, const double *reference,
                  Scalar *joints) const {
    const double height = motorHeight();
    if (!(upperArm > 0 && rod > 0 && height >= 0))
      return Outcome::WrongMeasures;
    for (int i = 0; i < 3; ++i) {
      const Vector<Scalar> ring = thirdOfRing<Scalar>(firstAngle, i);
      const Scalar out = pose.place.dot(ring) - Scalar(motorRadius - plateRadius);
      const Scalar down = Scalar(height) - pose.place(2);
      const Scalar aside = square(pose.place(0) * ring(1) - pose.place(1) * ring(0));
      if (!swing(upperArm, rod, out, down, aside, reference[i], joints[i]))
        return Outcome::Unreachable;
    }
    Vector<double> centre[3];
    double angle[3];
    for (int i = 0; i < 3; ++i)
      angle[i] = valueOf(joints[i]);
    setElbows(height, angle, centre);
    const Vector<double> point(valueOf(pose.place(0)), valueOf(pose.place(1)),
                               valueOf(pose.place(2)));
    return hangs(centre, rod, point) ? Outcome::Done : Outcome::Unreachable;
  }
};

/// Two arms that motors swing in one plane, and a rod from the end of each to the tool's point. The
/// motors are on the x axis, the same way from the origin; the first one at negative x. Joints are
/// angles from level outwards, positive downwards (negative y).
struct BipodRotary {
  static constexpr int kJoints = 2;
  static constexpr unsigned kTurning = 3;
  static constexpr Task kTask = Task::Plane;
  static constexpr bool kFlangeKeepsTurn = true;

  double motorDistance; ///< between the motors [u]
  double upperArm;      ///< [u]
  double rod;           ///< [u]
  double plateDistance; ///< between the ends of the rods at the tool [u]

  double reach() const noexcept { return upperArm + rod; }
  Posture postureOf(const double *) const noexcept { return {}; }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    if (!(upperArm > 0 && rod > 0))
      return Outcome::WrongMeasures;
    Scalar x[2];
    Scalar y[2];
    setElbows(joints, x, y);
    const Scalar half(0.5);
    const Scalar acrossX = (x[1] - x[0]) * half;
    const Scalar acrossY = (y[1] - y[0]) * half;
    const Scalar flat = square(acrossX) + square(acrossY);
    const Scalar rest = Scalar(rod * rod) - flat;
    if (isNegative(rest) || !(valueOf(flat) > 0))
      return Outcome::Unreachable;
    const Scalar down = rootOf(rest / flat);
    pose = unturned(Vector<Scalar>((x[0] + x[1]) * half + acrossY * down,
                                   (y[0] + y[1]) * half - acrossX * down, Scalar(0.0)));
    return Outcome::Done;
  }

  /// Where the rods begin, moved inwards by half of plateDistance. [u]
  template <class Scalar>
  void setElbows(const Scalar *joints, Scalar (&x)[2], Scalar (&y)[2]) const {
    for (int i = 0; i < 2; ++i) {
      const TurnOf<Scalar> arm = turnBy(joints[i]);
      const Scalar out = Scalar((motorDistance - plateDistance) / 2) + Scalar(upperArm) * arm.c;
      x[i] = i == 0 ? -out : out;
      y[i] = -Scalar(upperArm) * arm.s;
    }
  }

  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture, const double *reference,
                  Scalar *joints) const {
    if (!(upperArm > 0 && rod > 0))
      return Outcome::WrongMeasures;
    for (int i = 0; i < 2; ++i) {
      const Scalar side(i == 0 ? -1.0 : 1.0);
      const Scalar out = side * pose.place(0) - Scalar((motorDistance - plateDistance) / 2);
      const Scalar down = -pose.place(1);
      if (!swing(upperArm, rod, out, down, Scalar(0.0), reference[i], joints[i]))
        return Outcome::Unreachable;
    }
    return hangs(joints, pose) ? Outcome::Done : Outcome::Unreachable;
  }

  /// Whether the tool is on the side of both elbows on which `forward` has it.
  template <class Scalar> bool hangs(const Scalar *joints, const Frame<Scalar> &pose) const {
    constexpr double kRounding = 1e-9;
    const double angle[2] = {valueOf(joints[0]), valueOf(joints[1])};
    double x[2];
    double y[2];
    setElbows(angle, x, y);
    const double acrossX = x[1] - x[0];
    const double acrossY = y[1] - y[0];
    const double side =
        acrossX * (valueOf(pose.place(1)) - y[0]) - acrossY * (valueOf(pose.place(0)) - x[0]);
    return side <= kRounding * rod * ::stride::sqrt(acrossX * acrossX + acrossY * acrossY);
  }
};

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_PARALLEL_HPP
