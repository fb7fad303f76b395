// Placing axes where the tool axes are given: with these as they stand, the tool's point is a fixed
// point of the last placing link, so that a longer link ends in it. By that the axes follow in
// closed form; their derivatives follow order by order through the Jacobian.
#include "runtime/numeric/kinematics/any_parts.hpp"
#include "runtime/numeric/kinematics/arms.hpp"
#include "runtime/numeric/kinematics/hands.hpp"
#include "runtime/numeric/quarter_turns.hpp"

#include <Eigen/LU>

namespace stride::kinematics {
namespace {

using numeric::kDegree;

constexpr double kQuarter = kPi / 2;

/// The tool's point in the frame of the last joint. [u]
Vector<double> toolPoint(const AnyKinematics &kinematics) {
  if (!kinematics.hasTool)
    return Vector<double>::Zero();
  return {kinematics.toolPlace[0], kinematics.toolPlace[1], kinematics.toolPlace[2]};
}

/// The tool's point in the frame of the last placing link; not of a table that swivels. [u]
Vector<double> heldPoint(const AnyKinematics &kinematics, const double *joints) {
  const Vector<double> tool = toolPoint(kinematics);
  const double *const measures = kinematics.armMeasure;
  if (kinematics.hand != HandKind::None) {
    const int first = tableOf(kinematics.arm).joints;
    const Frame<double> hand =
        tableOf(kinematics.hand).numbers.forward(kinematics.handMeasure, joints + first);
    return hand.place + times(hand.turn, tool);
  }
  switch (kinematics.arm) {
  case ArmKind::Scara3:
  case ArmKind::Scara3Z: {
    const auto arm = modelOf<Scara3>(measures);
    return times(aboutZ(joints[2]), Vector<double>(arm.thirdArm + tool(0), tool(1), tool(2)));
  }
  case ArmKind::Palletiser:
    return times(aboutZ(joints[3]), tool);
  case ArmKind::OffsetWristArm: {
    const auto arm = modelOf<OffsetWristArm>(measures);
    const Frame<double> wrist = chainStep(joints[3], arm.d4, 0, 1) *
                                chainStep(joints[4], arm.d5, 0, -1) *
                                chainStep(joints[5], arm.d6, 0, 0);
    return wrist.place + times(wrist.turn, tool);
  }
  default:
    return tool;
  }
}

/// A lower and an upper arm that bend in an upright plane, and how their joints are counted: by
/// those of an ArmRrr.
struct Bending {
  ArmRrr arm;
  double turned; ///< Joint 1 of the ArmRrr over that of the machine, as that is with `mirrored`.
  double bent;   ///< Likewise joint 2.
  bool mirrored; ///< A palletiser: joint 1 counts forwards, joint 2 against level.

  void toArm(const double *joints, double (&own)[3]) const noexcept {
    own[0] = joints[0];
    own[1] = mirrored ? -joints[1] : joints[1] + turned;
    own[2] = mirrored ? joints[1] + joints[2] : joints[2] + bent;
  }
  void fromArm(const double (&own)[3], const double *near, double *joints) const noexcept {
    joints[0] = own[0];
    joints[1] = mirrored ? -own[1] : own[1] - turned;
    joints[2] = mirrored ? nearTo(near[2], own[1] + own[2]) : own[2] - bent;
  }
};

/// The same as `kinematics`, with a point of its forearm as its end.
Bending bendingOf(const AnyKinematics &kinematics, const Vector<double> &held) {
  const double *const measures = kinematics.armMeasure;
  if (kinematics.arm == ArmKind::Palletiser) {
    const auto its = modelOf<Palletiser>(measures);
    return {{its.shoulderHeight - its.handDown + held(2),
             its.shoulderFront + its.handFront + held(0), its.upperArm, -held(1), 0.0, its.forearm},
            0.0,
            0.0,
            true};
  }
  if (kinematics.arm == ArmKind::OffsetWristArm) {
    const auto its = modelOf<OffsetWristArm>(measures);
    const double half = its.a2 < 0 ? kPi : 0.0; // a positive link that looks the other way
    return {{its.d1, 0.0, exact::fabs(its.a2), held(2), its.a3 + held(0), -held(1)},
            half - kQuarter,
            -half,
            false};
  }
  const auto its = modelOf<ArmRrr>(measures);
  return {{its.d1, its.a1, its.a2, its.d3 + held(1), its.a3 + held(0), its.d4 + held(2)},
          0.0,
          0.0,
          false};
}

bool bends(const AnyKinematics &kinematics) noexcept {
  return kinematics.arm == ArmKind::ArmRrr || kinematics.arm == ArmKind::Palletiser ||
         kinematics.arm == ArmKind::OffsetWristArm;
}

bool isScara(const AnyKinematics &kinematics) noexcept {
  return kinematics.arm == ArmKind::Scara2 || kinematics.arm == ArmKind::Scara2Z ||
         kinematics.arm == ArmKind::Scara3 || kinematics.arm == ArmKind::Scara3Z;
}

/// Two arms of a Scara, the second one up to a point beside it.
struct Reaching {
  Scara2 arms;
  double aside; ///< By how much it turns the second arm. [rad]
};

Reaching reachingOf(const AnyKinematics &kinematics, const Vector<double> &held) {
  auto arms = modelOf<Scara2>(kinematics.armMeasure); // the first measures of all of them
  const double along = arms.secondArm + held(0);
  arms.secondArm = ::stride::sqrt(along * along + held(1) * held(1));
  return {arms, angleOf(held(1), along)};
}

/// Placing joints in radians; the tool joints stand in `joints`.
Outcome placingJoints(const AnyKinematics &kinematics, const Vector<double> &point, Posture posture,
                      const double *near, double *joints) {
  const Vector<double> held = heldPoint(kinematics, joints);
  Frame<double> pose{Matrix<double>::Identity(), point};
  if (bends(kinematics)) {
    const Bending bending = bendingOf(kinematics, held);
    double reference[3];
    double own[3];
    bending.toArm(near, reference);
    const Outcome outcome = bending.arm.inverse(pose, posture, reference, own);
    if (outcome == Outcome::Done)
      bending.fromArm(own, near, joints);
    return outcome;
  }
  if (isScara(kinematics)) {
    const Reaching reaching = reachingOf(kinematics, held);
    const double reference[2] = {near[0], near[1] + reaching.aside};
    const Outcome outcome = reaching.arms.inverse(pose, posture, reference, joints);
    joints[1] -= reaching.aside;
    if (kinematics.arm == ArmKind::Scara2Z)
      joints[2] = point(2) - held(2);
    else if (kinematics.arm == ArmKind::Scara3Z)
      joints[3] = point(2) - held(2);
    return outcome;
  }
  if (kinematics.arm == ArmKind::FiveAxisTable) {
    const auto table = modelOf<FiveAxisTable>(kinematics.armMeasure);
    const Matrix<double> turn = times(aboutZ(-joints[4]), aboutX(-joints[3]));
    pose.place(2) += table.tableHeight;
    const Vector<double> place = times(Matrix<double>(turn.transpose()), pose.place) - held;
    joints[0] = place(0) + table.centreX;
    joints[1] = place(1) + table.centreY;
    joints[2] = place(2) + table.centreZ;
    return Outcome::Done;
  }
  pose.place -= held; // the flange keeps its turn
  return tableOf(kinematics.arm)
      .numbers.inverse(kinematics.armMeasure, pose, posture, near, joints);
}

/// What the joints of axes are: shifted and in radians.
void toJoints(const AnyKinematics &kinematics, const double *axes, double *joints) {
  const unsigned turning = kinematics.turning();
  for (int i = 0; i < kinematics.joints(); ++i) {
    joints[i] = axes[i] - kinematics.offset[i];
    if ((turning >> i & 1U) != 0)
      joints[i] *= kDegree;
  }
}

/// How fast the tool's point goes when joints do by `moving`. [u]
Vector<double> rateOf(const AnyKinematics &kinematics, const Jet<1> *moving) {
  Frame<Jet<1>> end;
  (void)ratesOf(kinematics, moving, end);
  const Vector<Jet<1>> point = end.place + times(end.turn, toolPoint(kinematics));
  return {point(0).c[1], point(1).c[1], point(2).c[1]};
}

/// How placing axes follow the tool's point, one after the other in the columns of the matrix
/// before it is inverted; infinite or NaN in a singular pose. Of two axes only x and y count.
/// `toolRate`: how fast the point goes with the tool axes alone. [u]
Matrix<double> followOf(const AnyKinematics &kinematics, const Jet<3> *axes, unsigned toolAxes,
                        Vector<double> &toolRate) {
  const int count = kinematics.joints();
  const unsigned turning = kinematics.turning();
  Jet<1> moving[kMostJoints];
  double scale[kMostJoints];
  for (int i = 0; i < count; ++i) {
    scale[i] = (turning >> i & 1U) != 0 ? kDegree : 1.0;
    moving[i] = Jet<1>((axes[i].c[0] - kinematics.offset[i]) * scale[i]);
    moving[i].c[1] = (toolAxes >> i & 1U) != 0 ? axes[i].c[1] * scale[i] : 0.0;
  }
  toolRate = rateOf(kinematics, moving);
  for (int i = 0; i < count; ++i)
    moving[i].c[1] = 0;
  Matrix<double> columns = Matrix<double>::Identity();
  int column = 0;
  for (int i = 0; i < count; ++i) {
    if ((toolAxes >> i & 1U) != 0)
      continue;
    moving[i].c[1] = scale[i];
    columns.col(column++) = rateOf(kinematics, moving);
    moving[i].c[1] = 0;
  }
  if (column == 2) {
    columns.row(2).setZero();
    columns(2, 2) = 1;
  }
  return columns.inverse();
}

} // namespace

bool AnyKinematics::splits(unsigned &toolAxes) const {
  toolAxes = 0;
  if (arm == ArmKind::None || arm == ArmKind::Polar || arm == ArmKind::PolarZ)
    return false;
  if (hand != HandKind::None)
    toolAxes = ((1U << static_cast<unsigned>(tableOf(hand).joints)) - 1U)
               << static_cast<unsigned>(tableOf(arm).joints);
  else if (arm == ArmKind::Scara3 || arm == ArmKind::Scara3Z)
    toolAxes = 0b100;
  else if (arm == ArmKind::Palletiser)
    toolAxes = 0b1000;
  else if (arm == ArmKind::OffsetWristArm)
    toolAxes = 0b111000;
  else if (arm == ArmKind::FiveAxisTable)
    toolAxes = 0b11000;
  return true;
}

Posture AnyKinematics::placingPostureOf(const double *axes) const {
  double joints[kMostJoints];
  toJoints(*this, axes, joints);
  if (bends(*this)) {
    const Bending bending = bendingOf(*this, heldPoint(*this, joints));
    double own[3];
    bending.toArm(joints, own);
    return bending.arm.postureOf(own);
  }
  if (isScara(*this)) {
    const Reaching reaching = reachingOf(*this, heldPoint(*this, joints));
    const double own[2] = {joints[0], joints[1] + reaching.aside};
    return reaching.arms.postureOf(own);
  }
  return arm == ArmKind::FiveAxisTable ? Posture{} : tableOf(arm).postureOf(armMeasure, joints);
}

Outcome AnyKinematics::place(const Vector<double> &point, Posture posture, const double *reference,
                             double *axes) const {
  unsigned toolAxes = 0;
  if (!splits(toolAxes))
    return Outcome::NotSet;
  double near[kMostJoints];
  double joint[kMostJoints];
  toJoints(*this, reference, near);
  const unsigned turns = turning();
  for (int i = 0; i < joints(); ++i) {
    joint[i] = near[i];
    if ((toolAxes >> i & 1U) != 0)
      joint[i] = (turns >> i & 1U) != 0 ? (axes[i] - offset[i]) * kDegree : axes[i] - offset[i];
  }
  Outcome outcome = placingJoints(*this, point, posture, near, joint);
  if (outcome != Outcome::Done)
    return outcome;
  for (int i = 0; i < joints(); ++i) {
    if ((toolAxes >> i & 1U) != 0)
      continue;
    const bool isTurning = (turns >> i & 1U) != 0;
    axes[i] = (isTurning ? joint[i] / kDegree : joint[i]) + offset[i];
    if (!exact::isfinite(axes[i]))
      return Outcome::Unreachable;
    if (!bringIntoRange(range[i], isTurning, axes[i]))
      outcome = Outcome::OutOfLimits;
  }
  return outcome;
}

Outcome AnyKinematics::place(const Vector<Jet<3>> &point, Posture posture, const double *reference,
                             Jet<3> *axes) const {
  unsigned toolAxes = 0;
  if (!splits(toolAxes))
    return Outcome::NotSet;
  const int count = joints();
  double values[kMostJoints];
  for (int i = 0; i < count; ++i)
    values[i] = (toolAxes >> i & 1U) != 0 ? axes[i].c[0] : 0.0;
  const Vector<double> now{point(0).c[0], point(1).c[0], point(2).c[0]};
  const Outcome outcome = place(now, posture, reference, values);
  if (outcome != Outcome::Done)
    return outcome;
  for (int i = 0; i < count; ++i)
    if ((toolAxes >> i & 1U) == 0)
      axes[i] = Jet<3>(values[i]);
  Vector<double> rate;
  const Matrix<double> follow = followOf(*this, axes, toolAxes, rate);
  // What the placing axes lack of an order, they lack of the point's way, too, and nothing else.
  for (int order = 1; order <= 3; ++order) {
    Frame<Jet<3>> tool;
    if (order > 1)
      (void)forward(axes, tool);
    Vector<double> rest;
    for (int row = 0; row < 3; ++row)
      rest(row) = point(row).c[order] - (order > 1 ? tool.place(row).c[order] : rate(row));
    const Vector<double> more = times(follow, rest);
    int column = 0;
    for (int i = 0; i < count; ++i)
      if ((toolAxes >> i & 1U) == 0)
        axes[i].c[order] = more(column++);
  }
  return Outcome::Done;
}

} // namespace stride::kinematics
