// SMC_TRAFO_Scara2, SMC_TRAFOF_Scara2, SMC_TRAFO_Scara3, SMC_TRAFOF_Scara3.
#include "runtime/numeric/kinematics/planar_arms.hpp"
#include "runtime/numeric/quarter_turns.hpp"

#include "st/SM_DriveBasic/AXIS_REF.h"
#include "st/SM_Trafo/SMC_TRAFOF_Scara2.h"
#include "st/SM_Trafo/SMC_TRAFOF_Scara3.h"
#include "st/SM_Trafo/SMC_TRAFO_Scara2.h"
#include "st/SM_Trafo/SMC_TRAFO_Scara3.h"

namespace kin = ::stride::kinematics;
using ::stride::numeric::kDegree;

namespace {

/// Angles come out from -180 to 180 degrees.
constexpr double kNoTurns[3] = {};

constexpr kin::Posture postureOf(bool elbowLow) {
  return {.backwards = false, .elbow = elbowLow, .hand = false};
}

/// An axis without its offset. [rad]
double jointOf(const ::st::SM_DriveBasic::AXIS_REF &axis, double offset) {
  return (axis.fActPosition - offset) * kDegree;
}

} // namespace

void st::SM_Trafo::SMC_TRAFO_Scara2::body__(::stride::Ctx & /*ctx__*/) {
  const kin::Scara2 arms{.firstArm = dArmLength1, .secondArm = dArmLength2};
  double joint[2];
  const kin::Outcome outcome = arms.inverse(kin::unturned<double>({pi.dX, pi.dY, 0.0}),
                                            postureOf(bElbowLow != 0), kNoTurns, joint);
  bError = outcome != kin::Outcome::Done ? 1 : 0;
  if (bError != 0)
    return;
  dA = joint[0] / kDegree + dOffsetA;
  dB = joint[1] / kDegree + dOffsetB;
}

void st::SM_Trafo::SMC_TRAFOF_Scara2::body__(::stride::Ctx & /*ctx__*/) {
  const kin::Scara2 arms{.firstArm = dArmLength1, .secondArm = dArmLength2};
  const double joint[] = {jointOf(*DriveA, dOffsetA), jointOf(*DriveB, dOffsetB)};
  kin::Frame<double> tool;
  bError = arms.forward(joint, tool) != kin::Outcome::Done ? 1 : 0;
  if (bError != 0)
    return;
  const double length = arms.reach();
  dx = tool.place(0);
  dy = tool.place(1);
  dAlpha = DriveA->fActPosition - dOffsetA;
  dBeta = DriveB->fActPosition - dOffsetB;
  dpx = dArmLength1 * ::stride::cos(joint[0]) / length;
  dpy = dArmLength1 * ::stride::sin(joint[0]) / length;
  dnx = dx / length;
  dny = dy / length;
  dR1 = dArmLength1 / length;
  dR2 = dArmLength2 / length;
}

void st::SM_Trafo::SMC_TRAFO_Scara3::body__(::stride::Ctx & /*ctx__*/) {
  const kin::Scara3 arms{.arms = {.firstArm = dArmLength1, .secondArm = dArmLength2},
                         .thirdArm = dArmLength3};
  // From west over north is clockwise.
  const double heading = (180.0 - dDirection) * kDegree;
  const kin::Frame<double> pose{kin::aboutZ(heading), {pi.dX, pi.dY, 0.0}};
  double joint[3];
  const kin::Outcome outcome = arms.inverse(pose, postureOf(bElbowLow != 0), kNoTurns, joint);
  bError = outcome != kin::Outcome::Done || !(dArmLength3 > 0) ? 1 : 0;
  if (bError != 0)
    return;
  dA = joint[0] / kDegree + dOffsetA;
  dB = joint[1] / kDegree + dOffsetB;
  dC = joint[2] / kDegree + dOffsetC;
}

void st::SM_Trafo::SMC_TRAFOF_Scara3::body__(::stride::Ctx & /*ctx__*/) {
  const kin::Scara3 arms{.arms = {.firstArm = dArmLength1, .secondArm = dArmLength2},
                         .thirdArm = dArmLength3};
  const double joint[] = {jointOf(*DriveA, dOffsetA), jointOf(*DriveB, dOffsetB),
                          jointOf(*DriveC, dOffsetC)};
  kin::Frame<double> tool;
  kin::Frame<double> wrist;
  const bool works = arms.forward(joint, tool) == kin::Outcome::Done && dArmLength3 > 0;
  bError = works ? 0 : 1;
  if (!works)
    return;
  (void)arms.arms.forward(joint, wrist);
  const double length = arms.reach();
  dx = tool.place(0);
  dy = tool.place(1);
  dAlpha = DriveA->fActPosition - dOffsetA;
  dBeta = DriveB->fActPosition - dOffsetB;
  dGamma = DriveC->fActPosition - dOffsetC;
  dpx = dArmLength1 * ::stride::cos(joint[0]) / length;
  dpy = dArmLength1 * ::stride::sin(joint[0]) / length;
  dppx = wrist.place(0) / length;
  dppy = wrist.place(1) / length;
  dnx = dx / length;
  dny = dy / length;
  dR1 = dArmLength1 / length;
  dR2 = dArmLength2 / length;
  dR3 = dArmLength3 / length;
}
