#include "runtime/blocks/SM3_Robotics/frames.hpp"

#include "runtime/axis/axis_ref.hpp"
#include "runtime/blocks/SM3_Robotics/carriers.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
using kinematics::Frame;

static_assert(sizeof(decl::MC_COORD_REF) == kArmAxes * sizeof(double));

group::AxisLimits limitsOf(const axis::AxisRef &axis) noexcept {
  const bool bounded = axis.iMovementType != 0 && axis.bSWLimitEnable != 0;
  double low = -exact::kInfinity;
  double high = exact::kInfinity;
  if (bounded) {
    low = axis.fSWLimitNegative;
    high = axis.fSWLimitPositive;
  }
  return {axis.fSWMaxVelocity, exact::smaller(axis.fSWMaxAcceleration, axis.fSWMaxDeceleration),
          axis.fSWMaxJerk, low, high};
}

kinematics::KinematicsRef refOf(const kinematics::KinematicsOf &kinematics,
                                const kinematics::AnyKinematics &none) {
  return kinematics.check() == kinematics::Outcome::Done ? kinematics.ref() : none.ref();
}

} // namespace

void countJoints(Ctx &ctx, GroupRef &group) {
  const kinematics::KinematicsOf kinematics(ctx, group.itfKinematics);
  int32_t joints = kArmAxes;
  if (kinematics.check() == kinematics::Outcome::Done)
    joints = kinematics.ref().joints();
  // Until the group is enabled nobody has refused too many axes that go along: they have no place.
  const int32_t axes = group.uiAxes;
  joints = axes - joints > kMoreAxes ? axes - kMoreAxes : joints;
  group.uiJoints = static_cast<UINT>(axes < joints ? axes : joints);
}

int16_t whyNoTool(const GroupRef &group, const GroupArm &arm) noexcept {
  if (arm.outcome != kinematics::Outcome::Done)
    return kinematics::errorOf(arm.outcome);
  return group.uiJoints == arm.arm.kinematics.joints()
             ? int16_t{0}
             : ::st::SM_Error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_NUMBER_OF_AXES;
}

GroupArm::GroupArm(Ctx &ctx, const GroupRef &group)
    : kinematics_(ctx, group.itfKinematics), none_{}, limits_{}, outcome(kinematics_.check()),
      arm{refOf(kinematics_, none_), group.uiJoints, group.uiAxes - group.uiJoints, limits_, {}} {
  for (int32_t i = 0; i < group.uiAxes; ++i)
    limits_[placeOf(group, i)] = limitsOf(*group.apAxis.v[i]);
  const Tool tool = group.bOwns != 0 ? stateOf(group).tool : toolOf(group);
  if (tool.set)
    setTool(tool);
}

void GroupArm::setTool(const Tool &tool) {
  using kinematics::Outcome;
  if (kinematics_.check() != Outcome::Done)
    return;
  outcome = kinematics_.setTool(frameOf(tool));
}

bool GroupArm::isPlain() const noexcept {
  return kinematics_.check() != kinematics::Outcome::Done || kinematics_.plain() != nullptr;
}

const kinematics::AnyKinematics &GroupArm::plainKinematics() const noexcept {
  const kinematics::AnyKinematics *const plain = kinematics_.plain();
  return kinematics_.check() == kinematics::Outcome::Done && plain != nullptr ? *plain : none_;
}

bool isFinite(const double (&numbers)[kArmAxes]) noexcept {
  for (const double number : numbers)
    if (!exact::isfinite(number))
      return false;
  return true;
}
bool isFinite(const decl::MC_COORD_REF &pose) noexcept {
  double numbers[kArmAxes];
  __builtin_memcpy(numbers, &pose, sizeof numbers);
  return isFinite(numbers);
}

Frame<double> frameOf(const double (&pose)[kArmAxes]) {
  return {kinematics::turnFrom(kinematics::Convention::Zyz, {pose[3], pose[4], pose[5]}),
          {pose[0], pose[1], pose[2]}};
}

Frame<double> frameOf(const decl::MC_COORD_REF &pose) {
  double numbers[kArmAxes];
  __builtin_memcpy(numbers, &pose, sizeof numbers);
  return frameOf(numbers);
}

Frame<double> frameOf(const Tool &tool) {
  return tool.set ? frameOf(tool.frame)
                  : kinematics::unturned(kinematics::Vector<double>(0.0, 0.0, 0.0));
}

void toPose(const Frame<double> &frame, double (&pose)[kArmAxes]) {
  const kinematics::Angles angles = kinematics::anglesOf(kinematics::Convention::Zyz, frame.turn);
  for (int i = 0; i < 3; ++i)
    pose[i] = frame.place(i);
  pose[3] = angles.a;
  pose[4] = angles.b;
  pose[5] = angles.c;
}

int32_t settableSystem(int16_t system) noexcept {
  switch (system) {
  case decl::SMC_COORD_SYSTEM__MCS:
    return 0;
  case decl::SMC_COORD_SYSTEM__PCS_1:
    return 1;
  case decl::SMC_COORD_SYSTEM__PCS_2:
    return 2;
  default:
    return -1;
  }
}

bool systemInMachine(const GroupRef &group, int16_t system, Frame<double> &frame) {
  if (system == decl::SMC_COORD_SYSTEM__MCS) {
    frame = kinematics::unturned(kinematics::Vector<double>(0.0, 0.0, 0.0));
    return true;
  }
  frame = kinematics::inverted(frameOf(group.astSystem.v[0])); // WCS
  const int32_t index = settableSystem(system);
  const int32_t carrier = carrierOf(group, system);
  if (carrier != 0)
    frame = frame * systemInWorld(group, carrier);
  else if (index > 0)
    frame = frame * frameOf(group.astSystem.v[index]);
  return index > 0 || system == decl::SMC_COORD_SYSTEM__WCS;
}

int16_t originOf(const GroupRef &group, const GroupArm &arm, int16_t system,
                 Frame<double> &origin) {
  if (system != decl::SMC_COORD_SYSTEM__TCS)
    return systemInMachine(group, system, origin)
               ? int16_t{0}
               : ::st::SM_Error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  double now[kAxes] = {};
  for (int32_t i = 0; i < group.uiAxes; ++i)
    now[placeOf(group, i)] = group.apAxis.v[i]->fSetPosition;
  return kinematics::errorOf(arm.arm.kinematics.forward(now, origin));
}

} // namespace stride::robotics
