// Placing axes where the tool axes are given: with these as they stand, the tool's point is a point
// of the last placing link, so that a longer link, which the tool axes change, ends in it. By that
// the placing axes follow in closed form, for numbers and for jets.
#include "runtime/numeric/kinematics/any_parts.hpp"
#include "runtime/numeric/kinematics/arms.hpp"
#include "runtime/numeric/kinematics/hands.hpp"
#include "runtime/numeric/quarter_turns.hpp"

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

template <class Scalar>
Frame<Scalar> handFrame(const AnyKinematics &kinematics, const Scalar *joints) {
  const HandTable &hand = tableOf(kinematics.hand);
  if constexpr (__is_same(Scalar, double))
    return hand.numbers.forward(kinematics.handMeasure, joints);
  else
    return hand.jets.forward(kinematics.handMeasure, joints);
}

/// The tool's point in the frame of the last placing link; not of a table that swivels. [u]
template <class Scalar>
Vector<Scalar> heldPoint(const AnyKinematics &kinematics, const Scalar *joints) {
  const Vector<double> tool = toolPoint(kinematics);
  const double *const measures = kinematics.armMeasure;
  if (kinematics.hand != HandKind::None) {
    const Frame<Scalar> hand = handFrame(kinematics, joints + tableOf(kinematics.arm).joints);
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
    Frame<Scalar> wrist = chainStep(joints[3], arm.d4, 0, 1);
    addStep(wrist, joints[4], arm.d5, 0, -1);
    addStep(wrist, joints[5], arm.d6, 0, 0);
    return wrist.place + times(wrist.turn, tool);
  }
  default:
    return tool.cast<Scalar>();
  }
}

/// An upper arm and a forearm that bend in an upright plane, measured as an ArmRrr is, but that the
/// tool axes change what the forearm ends in; and how their joints are counted.
template <class Scalar> struct Bending {
  Scalar d1, a1;
  double a2;
  Scalar d3, a3, d4;
  double turned; ///< Joint 1 of an ArmRrr over that of the machine, unless `mirrored`.
  double bent;   ///< Likewise joint 2.
  bool mirrored; ///< A palletiser: joint 1 counts forwards, joint 2 against level.

  void toArm(const double *joints, double (&own)[3]) const noexcept {
    own[0] = joints[0];
    own[1] = mirrored ? -joints[1] : joints[1] + turned;
    own[2] = mirrored ? joints[1] + joints[2] : joints[2] + bent;
  }
  void fromArm(const Scalar (&own)[3], const double *near, Scalar *joints) const noexcept {
    joints[0] = own[0];
    joints[1] = mirrored ? -own[1] : own[1] - Scalar(turned);
    joints[2] = mirrored ? nearTo(near[2], own[1] + own[2]) : own[2] - Scalar(bent);
  }

  /// As ArmRrr::inverse.
  Outcome inverse(const Vector<Scalar> &point, Posture posture, const double *near,
                  Scalar *joints) const {
    double reference[3];
    toArm(near, reference);
    const Scalar &x = point(0);
    const Scalar &y = point(1);
    const Scalar inFront = x * x + y * y - d3 * d3;
    if (isNegative(inFront))
      return Outcome::Unreachable;
    const Scalar way = posture.backwards ? -rootOf(inFront) : rootOf(inFront);
    const Scalar forearm = rootOf(a3 * a3 + d4 * d4);
    const double reach = a2 + valueOf(forearm);
    Scalar own[3];
    own[0] = isOrigin(x, y, reach)
                 ? Scalar(reference[0])
                 : nearTo(reference[0], angleOf(y * way + x * d3, x * way - y * d3));
    Scalar angle[2];
    const Outcome outcome =
        bendArm(a2, forearm, way - a1, point(2) - d1, posture.elbow != posture.backwards,
                reference[1] + kQuarter, angle);
    if (outcome != Outcome::Done)
      return outcome;
    own[1] = nearTo(reference[1], angle[0] - Scalar(kQuarter));
    own[2] = nearTo(reference[2], angle[1] - angleOf(-d4, a3));
    fromArm(own, near, joints);
    return Outcome::Done;
  }
};

/// The same as `kinematics`, with a point of its forearm as its end.
template <class Scalar>
Bending<Scalar> bendingOf(const AnyKinematics &kinematics, const Vector<Scalar> &held) {
  const double *const measures = kinematics.armMeasure;
  const Scalar zero(0.0);
  if (kinematics.arm == ArmKind::Palletiser) {
    const auto its = modelOf<Palletiser>(measures);
    return {Scalar(its.shoulderHeight - its.handDown) + held(2),
            Scalar(its.shoulderFront + its.handFront) + held(0),
            its.upperArm,
            -held(1),
            zero,
            Scalar(its.forearm),
            0.0,
            0.0,
            true};
  }
  if (kinematics.arm == ArmKind::OffsetWristArm) {
    const auto its = modelOf<OffsetWristArm>(measures);
    const double half = its.a2 < 0 ? kPi : 0.0; // a positive link that looks the other way
    return {Scalar(its.d1),
            zero,
            exact::fabs(its.a2),
            held(2),
            Scalar(its.a3) + held(0),
            -held(1),
            half - kQuarter,
            -half,
            false};
  }
  const auto its = modelOf<ArmRrr>(measures);
  return {Scalar(its.d1),
          Scalar(its.a1),
          its.a2,
          Scalar(its.d3) + held(1),
          Scalar(its.a3) + held(0),
          Scalar(its.d4) + held(2),
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

/// The second arm of a Scara up to a point beside it.
template <class Scalar> struct Reaching {
  double firstArm;
  Scalar secondArm;
  Scalar aside; ///< By how much it turns the second arm. [rad]
};

template <class Scalar>
Reaching<Scalar> reachingOf(const AnyKinematics &kinematics, const Vector<Scalar> &held) {
  const auto arms = modelOf<Scara2>(kinematics.armMeasure); // the first measures of all of them
  const Scalar along = Scalar(arms.secondArm) + held(0);
  return {arms.firstArm, rootOf(along * along + held(1) * held(1)), angleOf(held(1), along)};
}

template <class Scalar>
Outcome placeScara(const AnyKinematics &kinematics, const Vector<Scalar> &held,
                   const Vector<Scalar> &point, Posture posture, const double *near,
                   Scalar *joints) {
  const Reaching<Scalar> reaching = reachingOf(kinematics, held);
  Scalar angle[2];
  const Outcome outcome = bendArm(reaching.firstArm, reaching.secondArm, point(0), point(1),
                                  posture.elbow, near[0], angle);
  if (outcome != Outcome::Done)
    return outcome;
  joints[0] = nearTo(near[0], angle[0]);
  joints[1] = nearTo(near[1], angle[1] - reaching.aside);
  if (kinematics.arm == ArmKind::Scara2Z)
    joints[2] = point(2) - held(2);
  else if (kinematics.arm == ArmKind::Scara3Z)
    joints[3] = point(2) - held(2);
  return Outcome::Done;
}

template <class Scalar>
Outcome placeTable(const AnyKinematics &kinematics, const Vector<Scalar> &held,
                   const Vector<Scalar> &point, Scalar *joints) {
  const auto table = modelOf<FiveAxisTable>(kinematics.armMeasure);
  Vector<Scalar> place = point;
  place(2) += Scalar(table.tableHeight);
  place = times(aboutX(joints[3]), times(aboutZ(joints[4]), place)) - held;
  joints[0] = place(0) + Scalar(table.centreX);
  joints[1] = place(1) + Scalar(table.centreY);
  joints[2] = place(2) + Scalar(table.centreZ);
  return Outcome::Done;
}

/// Placing joints in radians; the tool joints stand in `joints`.
template <class Scalar>
Outcome placingJoints(const AnyKinematics &kinematics, const Vector<Scalar> &point, Posture posture,
                      const double *near, Scalar *joints) {
  const Vector<Scalar> held = heldPoint(kinematics, joints);
  if (bends(kinematics))
    return bendingOf(kinematics, held).inverse(point, posture, near, joints);
  if (isScara(kinematics))
    return placeScara(kinematics, held, point, posture, near, joints);
  if (kinematics.arm == ArmKind::FiveAxisTable)
    return placeTable(kinematics, held, point, joints);
  // The flange keeps its turn.
  const Frame<Scalar> pose = unturned(Vector<Scalar>(point - held));
  const ArmTable &arm = tableOf(kinematics.arm);
  if constexpr (__is_same(Scalar, double))
    return arm.numbers.inverse(kinematics.armMeasure, pose, posture, near, joints);
  else
    return arm.jets.inverse(kinematics.armMeasure, pose, posture, near, joints);
}

/// What the joints of axes are: shifted and in radians.
template <class Scalar>
void toJoints(const AnyKinematics &kinematics, const Scalar *axes, unsigned which, Scalar *joints) {
  const unsigned turning = kinematics.turning();
  for (int i = 0; i < kinematics.joints(); ++i) {
    if ((which >> i & 1U) == 0)
      continue;
    joints[i] = axes[i] - Scalar(kinematics.offset[i]);
    if ((turning >> i & 1U) != 0)
      joints[i] = joints[i] * kDegree;
  }
}

constexpr unsigned kAllJoints = ~0U;

double &numberIn(double &number) { return number; }
double &numberIn(Jet<3> &number) { return number.c[0]; }

template <class Scalar>
Outcome placed(const AnyKinematics &kinematics, const Vector<Scalar> &point, Posture posture,
               const double *reference, Scalar *axes) {
  unsigned toolAxes = 0;
  if (!kinematics.splits(toolAxes))
    return Outcome::NotSet;
  double near[kMostJoints];
  Scalar joints[kMostJoints];
  toJoints(kinematics, reference, kAllJoints, near);
  toJoints(kinematics, axes, toolAxes, joints);
  Outcome outcome = placingJoints(kinematics, point, posture, near, joints);
  if (outcome != Outcome::Done)
    return outcome;
  const unsigned turning = kinematics.turning();
  for (int i = 0; i < kinematics.joints(); ++i) {
    if ((toolAxes >> i & 1U) != 0)
      continue;
    const bool turns = (turning >> i & 1U) != 0;
    axes[i] = (turns ? joints[i] / kDegree : joints[i]) + Scalar(kinematics.offset[i]);
    double &number = numberIn(axes[i]);
    if (!exact::isfinite(number))
      return Outcome::Unreachable;
    if (!bringIntoRange(kinematics.range[i], turns, number))
      outcome = Outcome::OutOfLimits;
  }
  return outcome;
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
  toJoints(*this, axes, kAllJoints, joints);
  if (bends(*this)) {
    const Bending<double> its = bendingOf(*this, heldPoint(*this, joints));
    double own[3];
    its.toArm(joints, own);
    return ArmRrr{its.d1, its.a1, its.a2, its.d3, its.a3, its.d4}.postureOf(own);
  }
  if (isScara(*this)) {
    const Reaching<double> reaching = reachingOf(*this, heldPoint(*this, joints));
    const double own[2] = {joints[0], joints[1] + reaching.aside};
    return Scara2{reaching.firstArm, reaching.secondArm}.postureOf(own);
  }
  return arm == ArmKind::FiveAxisTable ? Posture{} : tableOf(arm).postureOf(armMeasure, joints);
}

Outcome AnyKinematics::place(const Vector<double> &point, Posture posture, const double *reference,
                             double *axes) const {
  return placed(*this, point, posture, reference, axes);
}
Outcome AnyKinematics::place(const Vector<Jet<3>> &point, Posture posture, const double *reference,
                             Jet<3> *axes) const {
  return placed(*this, point, posture, reference, axes);
}

} // namespace stride::kinematics
