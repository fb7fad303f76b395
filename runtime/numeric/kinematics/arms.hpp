// Articulated arms: the three axes that carry a wrist, wrists, the arm of six axes with a spherical
// wrist, the arm of six axes with an offset wrist, and the palletiser. Free of the C++ standard
// library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_ARMS_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_ARMS_HPP

#include "runtime/numeric/kinematics/planar_arms.hpp"

namespace stride::kinematics {

/// A step of a chain after Denavit and Hartenberg: turn about z, shift along z, shift along x, turn
/// about x by a quarter turn times `quarter` (1, 0 or -1). [rad], [u]
template <class Scalar>
Frame<Scalar> chainStep(const Scalar &turn, double alongZ, double alongX, int quarter) {
  const Matrix<Scalar> z = aboutZ(turn);
  Frame<Scalar> step;
  step.place = z.col(0) * Scalar(alongX);
  step.place(2) += Scalar(alongZ);
  step.turn = z;
  if (quarter != 0) {
    step.turn.col(1) = z.col(2) * Scalar(quarter);
    step.turn.col(2) = z.col(1) * Scalar(-quarter);
  }
  return step;
}

/// Turns a frame's axes on by such a step, without the products with zeros.
template <class Scalar> void addTurn(Matrix<Scalar> &turn, const TurnOf<Scalar> &t, int quarter) {
  for (int row = 0; row < 3; ++row) {
    Scalar &first = turn(row, 0);
    Scalar &second = turn(row, 1);
    Scalar &third = turn(row, 2);
    const Scalar turned = withoutMinus0(first * t.c + second * t.s);
    const Scalar across = withoutMinus0(second * t.c - first * t.s);
    first = turned;
    second = quarter == 0 ? across : withoutMinus0(third * quarter);
    third = quarter == 0 ? third : withoutMinus0(across * -quarter);
  }
}

/// `pose` * chainStep(...), likewise.
template <class Scalar>
void addStep(Frame<Scalar> &pose, const Scalar &turn, double alongZ, double alongX, int quarter) {
  const TurnOf<Scalar> t = turnBy(turn);
  const Scalar x = t.c * alongX;
  const Scalar y = t.s * alongX;
  for (int row = 0; row < 3 && (alongX != 0 || alongZ != 0); ++row)
    pose.place(row) +=
        withoutMinus0(pose.turn(row, 0) * x + (pose.turn(row, 1) * y + pose.turn(row, 2) * alongZ));
  addTurn(pose.turn, t, quarter);
}

/// Three turning axes that carry a wrist's centre: the first one upright, the others parallel to
/// each other. At zero the upper arm stands upright and the forearm points to +x. Posture:
/// `backwards` where the arm reaches over its own head, `elbow` where the elbow is below the line
/// from shoulder to wrist. Source: SoftMotion 3, Kin_Pos_RRR (its table of Denavit and Hartenberg's
/// parameters).
struct ArmRrr {
  static constexpr int kJoints = 3;
  static constexpr unsigned kTurning = 7;
  static constexpr Task kTask = Task::Place;
  static constexpr bool kFlangeKeepsTurn = false;

  double d1; ///< height of the shoulder [u]
  double a1; ///< way of the shoulder in front of the first axis [u]
  double a2; ///< upper arm [u]
  double d3; ///< how far the forearm is to the right of the first axis [u]
  double a3; ///< how far the forearm's axis is above the elbow [u]
  double d4; ///< forearm, from the elbow to the wrist's centre [u]

  double forearm() const noexcept { return ::stride::sqrt(a3 * a3 + d4 * d4); }
  double reach() const noexcept { return exact::fabs(a1) + a2 + forearm() + exact::fabs(d3); }

  Posture postureOf(const double *joints) const noexcept {
    const double bend = joints[2] + angleOf(-d4, a3);
    const double upper = joints[1] + kPi / 2;
    const double forward = a1 + a2 * ::stride::cos(upper) + forearm() * ::stride::cos(upper + bend);
    const bool backwards = forward < 0;
    return {
        .backwards = backwards, .elbow = (::stride::sin(bend) >= 0) != backwards, .hand = false};
  }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    pose = chainStep(joints[0], d1, a1, 1);
    addStep(pose, joints[1] + Scalar(kPi / 2), 0, a2, 0);
    addStep(pose, joints[2], d3, a3, 1);
    for (int row = 0; row < 3; ++row)
      pose.place(row) += pose.turn(row, 2) * d4;
    return a2 > 0 && forearm() > 0 ? Outcome::Done : Outcome::WrongMeasures;
  }
  /// The inverse steps one after the other, without the products with zeros. Upper arm and forearm
  /// turn about parallel axes, so that their sum counts.
  template <class Scalar>
  Matrix<Scalar> seenFromFlange(const Scalar *joints, const Matrix<Scalar> &turn) const {
    const TurnOf<Scalar> base = turnBy(joints[0]);
    const TurnOf<Scalar> tilt = turnBy(joints[1] + joints[2]);
    Matrix<Scalar> seen;
    for (int column = 0; column < 3; ++column) {
      const Scalar &x = turn(0, column);
      const Scalar &y = turn(1, column);
      const Scalar &up = turn(2, column);
      const Scalar forth = x * base.c + y * base.s;
      seen(0, column) = withoutMinus0(up * tilt.c - forth * tilt.s);
      seen(1, column) = withoutMinus0(x * base.s - y * base.c);
      seen(2, column) = withoutMinus0(forth * tilt.c + up * tilt.s);
    }
    return seen;
  }

  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture posture, const double *reference,
                  Scalar *joints) const {
    const Scalar &x = pose.place(0);
    const Scalar &y = pose.place(1);
    const Scalar inFront = x * x + y * y - Scalar(d3 * d3);
    if (isNegative(inFront))
      return Outcome::Unreachable;
    const Scalar way = posture.backwards ? -rootOf(inFront) : rootOf(inFront);
    // The first axis turns (way, -d3) to (x, y).
    const bool above = isOrigin(x, y, reach());
    joints[0] = above ? Scalar(reference[0])
                      : nearTo(reference[0], angleOf(y * way + x * d3, x * way - y * d3));
    Scalar angle[2];
    const Outcome outcome =
        bendArm(a2, forearm(), way - Scalar(a1), pose.place(2) - Scalar(d1),
                posture.elbow != posture.backwards, reference[1] + kPi / 2, angle);
    if (outcome != Outcome::Done)
      return outcome;
    joints[1] = nearTo(reference[1], angle[0] - Scalar(kPi / 2));
    joints[2] = nearTo(reference[2], angle[1] - Scalar(angleOf(-d4, a3)));
    return Outcome::Done;
  }
};

/// A palletiser: base, two arms by parallelograms, and a turning axis that they keep upright. Joint
/// 1 is the upper arm against upright, joint 2 the forearm against level, both as the motors in the
/// base turn them: forwards and upwards positive. Posture: `backwards` and `elbow` as with ArmRrr.
struct Palletiser {
  static constexpr int kJoints = 4;
  static constexpr unsigned kTurning = 15;
  static constexpr Task kTask = Task::PlaceTurn;
  static constexpr bool kFlangeKeepsTurn = false;

  double shoulderHeight; ///< [u]
  double shoulderFront;  ///< way of the shoulder in front of the first axis [u]
  double upperArm;       ///< [u]
  double forearm;        ///< [u]
  double handFront;      ///< from the forearm's end to the last axis, always level [u]
  double handDown;       ///< from the forearm's end down to the tool [u]

  double reach() const noexcept {
    return exact::fabs(shoulderFront) + upperArm + forearm + exact::fabs(handFront);
  }
  Posture postureOf(const double *joints) const noexcept {
    const double way = shoulderFront + upperArm * ::stride::sin(joints[1]) +
                       forearm * ::stride::cos(joints[2]) + handFront;
    const double bend = joints[2] - (kPi / 2 - joints[1]);
    const bool backwards = way < 0;
    return {
        .backwards = backwards, .elbow = (::stride::sin(bend) >= 0) != backwards, .hand = false};
  }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    const TurnOf<Scalar> upper = turnBy(joints[1]);
    const TurnOf<Scalar> fore = turnBy(joints[2]);
    const Scalar way =
        Scalar(shoulderFront + handFront) + Scalar(upperArm) * upper.s + Scalar(forearm) * fore.c;
    const Scalar height =
        Scalar(shoulderHeight - handDown) + Scalar(upperArm) * upper.c + Scalar(forearm) * fore.s;
    const Matrix<Scalar> base = aboutZ(joints[0]);
    pose.place = base.col(0) * way;
    pose.place(2) = height;
    pose.turn = base * aboutZ(joints[3]);
    return upperArm > 0 && forearm > 0 ? Outcome::Done : Outcome::WrongMeasures;
  }

  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture posture, const double *reference,
                  Scalar *joints) const {
    const Scalar &x = pose.place(0);
    const Scalar &y = pose.place(1);
    const bool above = isOrigin(x, y, reach());
    const Scalar side(posture.backwards ? -1.0 : 1.0);
    const Scalar way = side * rootOf(x * x + y * y);
    joints[0] = above ? Scalar(reference[0]) : nearTo(reference[0], angleOf(side * y, side * x));
    Scalar angle[2];
    const Outcome outcome =
        bendArm(upperArm, forearm, way - Scalar(shoulderFront + handFront),
                pose.place(2) - Scalar(shoulderHeight - handDown),
                posture.elbow != posture.backwards, kPi / 2 - reference[1], angle);
    if (outcome != Outcome::Done)
      return outcome;
    joints[1] = nearTo(reference[1], Scalar(kPi / 2) - angle[0]);
    joints[2] = nearTo(reference[2], angle[0] + angle[1]);
    joints[3] = nearTo(reference[3], turnAboutZ(pose.turn) - joints[0]);
    return Outcome::Done;
  }
};

/// The arm of six turning axes whose last three do not meet in a point, as collaborative robots
/// have it: axes 1, 2 and 3 are parallel. Denavit and Hartenberg: (d1, 0, 90°), (0, a2, 0), (0, a3,
/// 0), (d4, 0, 90°), (d5, 0, -90°), (d6, 0, 0); a2 and a3 are negative where the maker's table has
/// them so. Posture: `backwards` for the shoulder's other side, `elbow` where joint 2 is positive,
/// `hand` where joint 4 is positive.
struct OffsetWristArm {
  static constexpr int kJoints = 6;
  static constexpr unsigned kTurning = 63;
  static constexpr Task kTask = Task::Full;
  static constexpr bool kFlangeKeepsTurn = false;

  double d1, a2, a3, d4, d5, d6; ///< [u]

  double reach() const noexcept {
    return exact::fabs(a2) + exact::fabs(a3) + exact::fabs(d4) + exact::fabs(d5) + exact::fabs(d6);
  }
  Posture postureOf(const double *joints) const noexcept;

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    pose = chainStep(joints[0], d1, 0, 1);
    addStep(pose, joints[1], 0, a2, 0);
    addStep(pose, joints[2], 0, a3, 0);
    addStep(pose, joints[3], d4, 0, 1);
    addStep(pose, joints[4], d5, 0, -1);
    addStep(pose, joints[5], d6, 0, 0);
    return a2 != 0 && a3 != 0 ? Outcome::Done : Outcome::WrongMeasures;
  }
  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture posture, const double *reference,
                  Scalar *joints) const;
};

inline Posture OffsetWristArm::postureOf(const double *joints) const noexcept {
  // The wrist's point before d6, seen along the direction in which the arm's plane lies.
  const Frame<double> wrist = chainStep(joints[0], d1, 0, 1) * chainStep(joints[1], 0, a2, 0) *
                              chainStep(joints[2], 0, a3, 0) * chainStep(joints[3], d4, 0, 1) *
                              chainStep(joints[4], d5, 0, -1);
  const double inFront =
      wrist.place(0) * ::stride::cos(joints[0]) + wrist.place(1) * ::stride::sin(joints[0]);
  return {.backwards = inFront < 0,
          .elbow = ::stride::sin(joints[2]) >= 0,
          .hand = ::stride::sin(joints[4]) >= 0};
}

/// An axis of the tool seen from the plane of an arm, which `base` has turned about z: in front,
/// above, and at right angles (the axis of joints 1 to 3 of an OffsetWristArm).
template <class Scalar>
void seeFromPlane(const TurnOf<Scalar> &base, const Vector<Scalar> &axis, Scalar (&out)[3]) {
  out[0] = base.c * axis(0) + base.s * axis(1);
  out[1] = axis(2);
  out[2] = base.s * axis(0) - base.c * axis(1);
}

template <class Scalar>
Outcome OffsetWristArm::inverse(const Frame<Scalar> &pose, Posture posture, const double *reference,
                                Scalar *joints) const {
  const Vector<Scalar> approach = pose.turn.col(2);
  Vector<Scalar> wrist;
  for (int row = 0; row < 3; ++row)
    wrist(row) = pose.place(row) - approach(row) * d6;
  // d4 stands at right angles to the arm's plane: joint 0 turns (way, -d4) to (x, y) of the wrist.
  const Scalar inFront = square(wrist(0)) + square(wrist(1)) - Scalar(d4 * d4);
  if (isNegative(inFront))
    return Outcome::Unreachable;
  const Scalar way = posture.backwards ? -rootOf(inFront) : rootOf(inFront);
  const Scalar ahead = wrist(0) * way - wrist(1) * d4;
  const Scalar aside = wrist(1) * way + wrist(0) * d4;
  joints[0] = nearTo(reference[0], angleOf(aside, ahead));
  const TurnOf<Scalar> base = turnTowards(aside, ahead, joints[0]);
  Scalar x[3];
  Scalar y[3];
  Scalar z[3];
  seeFromPlane<Scalar>(base, pose.turn.col(0), x);
  seeFromPlane<Scalar>(base, pose.turn.col(1), y);
  seeFromPlane(base, approach, z);
  const Scalar across = rootOf(square(x[2]) + square(y[2]));
  const Scalar s = posture.hand ? across : -across;
  joints[4] = nearTo(reference[4], angleOf(s, z[2]));
  Scalar sum; // of joints 1, 2 and 3
  TurnOf<Scalar> tilt;
  if (valueOf(across) < 1e-12) {
    // The last axis is parallel to joints 1 to 3: only its sum with theirs counts.
    joints[5] = Scalar(reference[5]);
    const TurnOf<Scalar> last = turnBy(joints[5]);
    const double side = valueOf(z[2]) < 0 ? -1.0 : 1.0;
    sum = angleOf(side * (x[1] * last.c - y[1] * last.s), side * (x[0] * last.c - y[0] * last.s));
    tilt = turnBy(sum);
  } else {
    const double side = posture.hand ? 1.0 : -1.0;
    joints[5] = nearTo(reference[5], angleOf(-side * y[2], side * x[2]));
    const Scalar upwards = -side * z[1];
    const Scalar forwards = -side * z[0];
    sum = angleOf(upwards, forwards);
    tilt = turnTowards(upwards, forwards, sum);
  }
  // Back from the wrist along d5, which stands at right angles to joint 3's x axis in the arm's
  // plane.
  const Scalar forth = way - d5 * tilt.s;
  const Scalar up = wrist(2) - Scalar(d1) + d5 * tilt.c;
  // Negative links are positive ones that look the other way.
  const double flip = a2 < 0 ? -1.0 : 1.0;
  const bool mixed = (a2 < 0) != (a3 < 0);
  Scalar angle[2];
  const Outcome outcome = bendArm(exact::fabs(a2), exact::fabs(a3), flip * forth, flip * up,
                                  posture.elbow != mixed, reference[1], angle);
  if (outcome != Outcome::Done)
    return outcome;
  const Scalar elbow = mixed ? angle[1] - Scalar(kPi) : angle[1];
  joints[1] = nearTo(reference[1], angle[0]);
  joints[2] = nearTo(reference[2], elbow);
  joints[3] = nearTo(reference[3], sum - joints[1] - joints[2]);
  return Outcome::Done;
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_ARMS_HPP
