// Arms whose joints turn about upright axes: polar arm, Scaras with two and three arms, each with a
// lifting axis too. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_PLANAR_ARMS_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_PLANAR_ARMS_HPP

#include "runtime/numeric/kinematics/model.hpp"

namespace stride::kinematics {

/// The two angles of an arm of two links in a plane: of the first link against x, of the second one
/// against the first. The elbow's angle is positive where `positive`. Where the plane's origin is
/// reached, nothing decides the first angle: it keeps `reference`. A second link whose length is a
/// Scalar may change its length while the arm moves. [u], [rad]
template <class Link, class Scalar>
Outcome bendArm(double first, const Link &second, const Scalar &x, const Scalar &y, bool positive,
                double reference, Scalar (&angle)[2]) {
  const Link sum = Link(first) + second;
  if (!(first > 0 && valueOf(second) > 0 && exact::isfinite(valueOf(sum))))
    return Outcome::WrongMeasures;
  const Link difference = first >= valueOf(second) ? Link(first) - second : second - Link(first);
  // Twice the area of the triangle of base, elbow and tool by Heron's formula: exact near a
  // stretched arm, too.
  const Scalar distance = rootOf(x * x + y * y);
  const Scalar longer = Scalar(sum) - distance;
  const Scalar shorter = distance - Scalar(difference);
  if (isNegative(longer) || isNegative(shorter))
    return Outcome::Unreachable;
  const Scalar height =
      rootOf(longer * (Scalar(sum) + distance) * shorter * (distance + Scalar(difference)));
  const Scalar s = positive ? height : -height;
  const Scalar c = x * x + y * y - Scalar(Link(first * first) + second * second);
  angle[1] = angleOf(s, c);
  if (isOrigin(x, y, valueOf(sum))) {
    angle[0] = Scalar(reference);
    return Outcome::Done;
  }
  const TurnOf<Scalar> bend = turnTowards(s, c, angle[1]);
  const Scalar along = Scalar(first) + second * bend.c;
  const Scalar aside = second * bend.s;
  angle[0] = angleOf(y * along - x * aside, x * along + y * aside);
  return Outcome::Done;
}

/// A turning axis and a slide: where `a1` is 0 the tool is on the turning axis. Source: SoftMotion
/// 3, Kin_Polar.
struct Polar {
  static constexpr int kJoints = 2;
  static constexpr unsigned kTurning = 1;
  static constexpr Task kTask = Task::Plane;
  static constexpr bool kFlangeKeepsTurn = false;

  double reach() const noexcept { return 1.0; }
  Posture postureOf(const double *) const noexcept { return {}; }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    pose.turn = aboutZ(joints[0]);
    pose.place = pose.turn.col(0) * joints[1];
    return Outcome::Done;
  }
  template <class Scalar> Scalar heading(const Scalar *joints) const { return joints[0]; }
  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture, const double *reference,
                  Scalar *joints) const {
    const Scalar &x = pose.place(0);
    const Scalar &y = pose.place(1);
    const bool centre = valueOf(x) == 0 && valueOf(y) == 0;
    joints[0] = centre ? Scalar(reference[0]) : nearTo(reference[0], angleOf(y, x));
    joints[1] = rootOf(x * x + y * y);
    return Outcome::Done;
  }
};

/// Two arms. Posture: `elbow` where the second arm turns to the left of the first (angle of joint 1
/// positive). Sources: SoftMotion V2.3 manual, section 8.2.4; SoftMotion 3, Kin_Scara2_Z.
struct Scara2 {
  static constexpr int kJoints = 2;
  static constexpr unsigned kTurning = 3;
  static constexpr Task kTask = Task::Plane;
  static constexpr bool kFlangeKeepsTurn = false;

  double firstArm, secondArm; ///< [u]

  double reach() const noexcept { return firstArm + secondArm; }
  Posture postureOf(const double *joints) const noexcept {
    return {.backwards = false, .elbow = ::stride::sin(joints[1]) >= 0, .hand = false};
  }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    const Matrix<Scalar> first = aboutZ(joints[0]);
    pose.turn = first * aboutZ(joints[1]);
    pose.place = first.col(0) * Scalar(firstArm) + pose.turn.col(0) * Scalar(secondArm);
    return firstArm > 0 && secondArm > 0 ? Outcome::Done : Outcome::WrongMeasures;
  }
  template <class Scalar> Scalar heading(const Scalar *joints) const {
    return joints[0] + joints[1];
  }
  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture posture, const double *reference,
                  Scalar *joints) const {
    Scalar angle[2];
    const Outcome outcome = bendArm(firstArm, secondArm, pose.place(0), pose.place(1),
                                    posture.elbow, reference[0], angle);
    if (outcome != Outcome::Done)
      return outcome;
    for (int i = 0; i < 2; ++i)
      joints[i] = nearTo(reference[i], angle[i]);
    return Outcome::Done;
  }
};

/// A kinematics of the plane on a lifting axis, its last joint. Sources: SoftMotion 3,
/// Kin_Scara2_Z, Kin_Polar_Z.
template <class Flat> struct Lifted {
  static constexpr int kJoints = Flat::kJoints + 1;
  static constexpr unsigned kTurning = Flat::kTurning;
  static constexpr Task kTask = Flat::kTask == Task::PlaneTurn ? Task::PlaceTurn : Task::Place;
  static constexpr bool kFlangeKeepsTurn = Flat::kFlangeKeepsTurn;

  Flat flat;

  double reach() const noexcept { return flat.reach(); }
  Posture postureOf(const double *joints) const noexcept { return flat.postureOf(joints); }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    const Outcome outcome = flat.forward(joints, pose);
    pose.place(2) += joints[Flat::kJoints];
    return outcome;
  }
  template <class Scalar> Scalar heading(const Scalar *joints) const requires requires {
    flat.heading(joints);
  }
  { return flat.heading(joints); }
  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture posture, const double *reference,
                  Scalar *joints) const {
    joints[Flat::kJoints] = pose.place(2);
    return flat.inverse(pose, posture, reference, joints);
  }
};

/// Three arms; the third one points where the pose's x axis does. Sources: SoftMotion V2.3 manual,
/// section 8.2.5; SoftMotion 3, Kin_Scara3_Z.
struct Scara3 {
  static constexpr int kJoints = 3;
  static constexpr unsigned kTurning = 7;
  static constexpr Task kTask = Task::PlaneTurn;
  static constexpr bool kFlangeKeepsTurn = false;

  Scara2 arms;
  double thirdArm; ///< [u], may be 0

  double reach() const noexcept { return arms.reach() + exact::fabs(thirdArm); }
  Posture postureOf(const double *joints) const noexcept { return arms.postureOf(joints); }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    const Outcome outcome = arms.forward(joints, pose);
    pose.turn = pose.turn * aboutZ(joints[2]);
    pose.place += pose.turn.col(0) * Scalar(thirdArm);
    return outcome;
  }
  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture posture, const double *reference,
                  Scalar *joints) const {
    const Scalar heading = turnAboutZ(pose.turn);
    Frame<Scalar> wrist = pose;
    wrist.place -= aboutZ(heading).col(0) * Scalar(thirdArm);
    const Outcome outcome = arms.inverse(wrist, posture, reference, joints);
    if (outcome == Outcome::Done)
      joints[2] = nearTo(reference[2], heading - joints[0] - joints[1]);
    return outcome;
  }
};

using Scara2Z = Lifted<Scara2>;
using Scara3Z = Lifted<Scara3>;
using PolarZ = Lifted<Polar>;

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_PLANAR_ARMS_HPP
