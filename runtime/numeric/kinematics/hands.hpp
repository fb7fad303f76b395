// What a flange carries: a tool that stands still, a turning axis, wrists with two and with three
// axes; and the coupling of one that places with one that turns. Free of the C++ standard library:
// linked into every application.
//
// A hand is a structure with kJoints, kTurning, `forward` (the tool's frame in the flange's),
// `turnTo` (joints that bring the tool into an orientation given in the flange's frame) and
// `offset` (from the flange to the tool's point, in the tool's axes, where it does not depend on
// the joints).
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_HANDS_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_HANDS_HPP

#include "runtime/numeric/kinematics/arms.hpp"
#include "runtime/numeric/kinematics/portals.hpp"

namespace stride::kinematics {

/// A tool whose point stands still in the axes of the last joint.
struct RigidTool {
  static constexpr bool kOffsetIsRigid = true;

  double toolX, toolY, toolZ; ///< the tool's point, in the tool's axes [u]

  Vector<double> offset() const { return {toolX, toolY, toolZ}; }
  /// The tool's frame, where the last joint has turned it.
  template <class Scalar> Frame<Scalar> turnedBy(const Matrix<Scalar> &turn) const {
    return {turn, times(turn, offset())};
  }
};

/// One axis that turns the tool about the flange's z axis. Sources: SoftMotion 3, Kin_CAxis,
/// Kin_CAxis_Tool.
struct TurningAxis : RigidTool {
  static constexpr int kJoints = 1;
  static constexpr unsigned kTurning = 1;
  static constexpr bool kTurnsAboutZ = true; ///< and about nothing else

  Posture postureOf(const double *) const noexcept { return {}; }
  static constexpr Task together(Task flange) noexcept {
    return flange == Task::Plane ? Task::PlaneTurn : Task::PlaceTurn;
  }

  template <class Scalar> Matrix<Scalar> nearest(const Matrix<Scalar> &turn) const {
    return aboutZ(turnAboutZ(turn));
  }
  template <class Scalar> Frame<Scalar> forward(const Scalar *joints) const {
    return turnedBy(aboutZ(joints[0]));
  }
  template <class Scalar>
  void turnTo(const Matrix<Scalar> &turn, Posture, const double *reference, Scalar *joints) const {
    joints[0] = nearTo(reference[0], turnAboutZ(turn));
  }
};

/// Two axes: yaw about the flange's z axis, then roll about the new y axis. The tool lies along the
/// last z axis. Only for flanges that keep their turn. Posture: `hand` where the roll is negative.
/// Source: SoftMotion 3, Kin_Wrist2; with Gantry3 it is Kin_5Axes (as from its version 4.16).
struct Wrist2 {
  static constexpr int kJoints = 2;
  static constexpr unsigned kTurning = 3;
  static constexpr bool kOffsetIsRigid = false;

  double toolLength;          ///< from the roll axis to the tool's point [u]
  double rollX, rollY, rollZ; ///< where the roll axis is, in the frame that the yaw turns [u]

  Vector<double> offset() const { return {0, 0, toolLength}; }
  Posture postureOf(const double *joints) const noexcept {
    return {.backwards = false, .elbow = false, .hand = ::stride::sin(joints[1]) < 0};
  }
  static constexpr Task together(Task) noexcept { return Task::PlaceDirection; }

  template <class Scalar> Matrix<Scalar> nearest(const Matrix<Scalar> &turn) const { return turn; }
  template <class Scalar> Frame<Scalar> forward(const Scalar *joints) const {
    const Matrix<Scalar> yaw = aboutZ(joints[0]);
    const Matrix<Scalar> turn = yaw * aboutY(joints[1]);
    const Vector<Scalar> roll{Scalar(rollX), Scalar(rollY), Scalar(rollZ)};
    return {turn, yaw * roll + turn.col(2) * Scalar(toolLength)};
  }
  template <class Scalar>
  void turnTo(const Matrix<Scalar> &turn, Posture posture, const double *reference,
              Scalar *joints) const {
    const Scalar side(posture.hand ? -1.0 : 1.0);
    const Scalar &x = turn(0, 2);
    const Scalar &y = turn(1, 2);
    const bool upright = isOrigin(x, y, 1.0);
    const Scalar ahead = side * x;
    const Scalar aside = side * y;
    joints[0] = upright ? Scalar(reference[0]) : nearTo(reference[0], angleOf(aside, ahead));
    const TurnOf<Scalar> yaw = upright ? turnBy(joints[0]) : turnTowards(aside, ahead, joints[0]);
    joints[1] = nearTo(reference[1], angleOf(x * yaw.c + y * yaw.s, turn(2, 2)));
  }
};

/// Three axes that meet in a point: about z, about the negative y, about z. Posture: `hand` where
/// the middle joint is positive (hand down). Where the outer axes lie in one line, the first one
/// keeps its place. Source: SoftMotion 3, Kin_Wrist3.
struct Wrist3 : RigidTool {
  static constexpr int kJoints = 3;
  static constexpr unsigned kTurning = 7;

  Posture postureOf(const double *joints) const noexcept {
    return {.backwards = false, .elbow = false, .hand = ::stride::sin(joints[1]) >= 0};
  }
  static constexpr Task together(Task) noexcept { return Task::Full; }

  template <class Scalar> Matrix<Scalar> nearest(const Matrix<Scalar> &turn) const { return turn; }
  template <class Scalar> Frame<Scalar> forward(const Scalar *joints) const {
    return turnedBy<Scalar>(aboutZ(joints[0]) * aboutY(-joints[1]) * aboutZ(joints[2]));
  }
  template <class Scalar>
  void turnTo(const Matrix<Scalar> &turn, Posture posture, const double *reference,
              Scalar *joints) const {
    const double side = posture.hand ? -1.0 : 1.0;
    const Scalar &x = turn(0, 2);
    const Scalar &y = turn(1, 2);
    const bool inLine = isOrigin(x, y, 1.0);
    const Scalar ahead = side * x;
    const Scalar aside = side * y;
    joints[0] = inLine ? Scalar(reference[0]) : nearTo(reference[0], angleOf(aside, ahead));
    const TurnOf<Scalar> first = inLine ? turnBy(joints[0]) : turnTowards(aside, ahead, joints[0]);
    joints[1] = nearTo(reference[1], angleOf(-(x * first.c + y * first.s), turn(2, 2)));
    // What the first joint leaves of the tool's own axes at right angles to the middle one.
    joints[2] = nearTo(reference[2], angleOf(turn(1, 0) * first.c - turn(0, 0) * first.s,
                                             turn(1, 1) * first.c - turn(0, 1) * first.s));
  }
};

/// Where a flange is that turns the tool about z: before the tool's offset, given in its own axes.
template <class Scalar>
Vector<Scalar> flangePlace(const Vector<Scalar> &place, const Scalar &heading,
                           const Vector<double> &offset) {
  if (offset(0) == 0 && offset(1) == 0 && offset(2) == 0)
    return place;
  return place - times(aboutZ(heading), offset);
}

/// One that places and one that turns. Source: SoftMotion 3, Kin_Coupled.
template <class Arm, class Hand> struct Coupled {
  static constexpr int kJoints = Arm::kJoints + Hand::kJoints;
  static constexpr unsigned kTurning = Arm::kTurning | Hand::kTurning << Arm::kJoints;
  static constexpr Task kTask = Hand::together(Arm::kTask);
  static constexpr bool kFlangeKeepsTurn = false;
  static_assert(Arm::kFlangeKeepsTurn || Hand::kOffsetIsRigid,
                "nothing says where the flange is before its turn is known");

  Arm arm;
  Hand hand;

  double reach() const { return arm.reach() + hand.offset().norm(); }
  Posture postureOf(const double *joints) const noexcept {
    Posture posture = arm.postureOf(joints);
    posture.hand = hand.postureOf(joints + Arm::kJoints).hand;
    return posture;
  }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    Frame<Scalar> flange;
    const Outcome outcome = arm.forward(joints, flange);
    pose = flange * hand.forward(joints + Arm::kJoints);
    return outcome;
  }

  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture posture, const double *reference,
                  Scalar *joints) const {
    Scalar *handJoints = joints + Arm::kJoints;
    const double *handReference = reference + Arm::kJoints;
    if constexpr (kHasHeading<Arm, Scalar> && requires { Hand::kTurnsAboutZ; }) {
      const Scalar heading = turnAboutZ(pose.turn);
      const Frame<Scalar> flange{pose.turn, flangePlace(pose.place, heading, hand.offset())};
      const Outcome outcome = arm.inverse(flange, posture, reference, joints);
      if (outcome == Outcome::Done)
        handJoints[0] = nearTo(handReference[0], heading - arm.heading(joints));
      return outcome;
    }
    Frame<Scalar> flange{hand.nearest(pose.turn), pose.place};
    const Matrix<Scalar> turn = flange.turn;
    if constexpr (Arm::kFlangeKeepsTurn) {
      hand.turnTo(turn, posture, handReference, handJoints);
      flange.place -= hand.forward(handJoints).place;
      return arm.inverse(flange, posture, reference, joints);
    } else {
      flange.place -= turn * hand.offset().template cast<Scalar>();
      const Outcome outcome = arm.inverse(flange, posture, reference, joints);
      if (outcome != Outcome::Done)
        return outcome;
      hand.turnTo(seenFromFlange(arm, joints, turn), posture, handReference, handJoints);
      return Outcome::Done;
    }
  }
};

/// The arm of six axes with a spherical wrist. Source: SoftMotion 3, Kin_ArticulatedRobot_6DOF.
using ArticulatedArm = Coupled<ArmRrr, Wrist3>;
/// A portal whose head swivels in two axes. Source: SoftMotion 3, Kin_5Axes (as from its
/// version 4.16).
using FiveAxisHead = Coupled<Gantry3, Wrist2>;
using Gantry3Turn = Coupled<Gantry3, TurningAxis>;
using Gantry2Turn = Coupled<Gantry2, TurningAxis>;
using Scara2ZTurn = Coupled<Scara2Z, TurningAxis>;

/// A portal whose table swivels: about x, and on that about z. The tool stands upright in the
/// machine; poses are given in the frame of the workpiece, which the table carries. Joints: x, y,
/// z, swivel (A), turn (C). Posture: `hand` where the swivel is negative.
struct FiveAxisTable {
  static constexpr int kJoints = 5;
  static constexpr unsigned kTurning = 24;
  static constexpr Task kTask = Task::PlaceDirection;
  static constexpr bool kFlangeKeepsTurn = false;

  double centreX, centreY,
      centreZ; ///< a point of the swivel's axis that the turning axis meets, in the machine [u]
  double tableHeight; ///< from that point along the turning axis to the workpiece's origin [u]

  double reach() const noexcept { return 1.0; }
  Posture postureOf(const double *joints) const noexcept {
    return {.backwards = false, .elbow = false, .hand = ::stride::sin(joints[3]) < 0};
  }

  template <class Scalar> Outcome forward(const Scalar *joints, Frame<Scalar> &pose) const {
    pose.turn = aboutZ(-joints[4]) * aboutX(-joints[3]);
    const Vector<Scalar> fromCentre{joints[0] - Scalar(centreX), joints[1] - Scalar(centreY),
                                    joints[2] - Scalar(centreZ)};
    pose.place = pose.turn * fromCentre;
    pose.place(2) -= Scalar(tableHeight);
    return Outcome::Done;
  }
  template <class Scalar>
  Outcome inverse(const Frame<Scalar> &pose, Posture posture, const double *reference,
                  Scalar *joints) const {
    // The tool's direction in the workpiece is (sin C sin A, cos C sin A, cos A).
    const Scalar side(posture.hand ? -1.0 : 1.0);
    const Scalar &x = pose.turn(0, 2);
    const Scalar &y = pose.turn(1, 2);
    const bool upright = isOrigin(x, y, 1.0);
    const Scalar ahead = side * y;
    const Scalar aside = side * x;
    joints[4] = upright ? Scalar(reference[4]) : nearTo(reference[4], angleOf(aside, ahead));
    const TurnOf<Scalar> c = upright ? turnBy(joints[4]) : turnTowards(aside, ahead, joints[4]);
    joints[3] = nearTo(reference[3], angleOf(x * c.s + y * c.c, pose.turn(2, 2)));
    Vector<Scalar> place = pose.place;
    place(2) += Scalar(tableHeight);
    const Vector<Scalar> fromCentre = aboutX(joints[3]) * (aboutZ(joints[4]) * place);
    joints[0] = fromCentre(0) + Scalar(centreX);
    joints[1] = fromCentre(1) + Scalar(centreY);
    joints[2] = fromCentre(2) + Scalar(centreZ);
    return Outcome::Done;
  }
};

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_HANDS_HPP
