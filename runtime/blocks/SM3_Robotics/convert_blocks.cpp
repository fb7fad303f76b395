// Positions, velocities and targets of a group in its coordinate systems, and what it says of
// itself: MC_GroupReadActualVelocity, SMC_GroupTargetPosition, SMC_GroupConvertPosition,
// MC_GroupSetPosition, MC_ReadKinTransform, SMC_GroupAcceptsMovements.
#include "runtime/axis/shift_position.hpp"
#include "runtime/blocks/SM3_Robotics/carriers.hpp"
#include "runtime/blocks/SM3_Robotics/group_block.hpp"
#include "runtime/blocks/SM3_Robotics/movement_inputs.hpp"
#include "runtime/blocks/SM3_Robotics/tool_led.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Robotics/MC_GroupReadActualVelocity.h"
#include "st/SM3_Robotics/MC_GroupSetPosition.h"
#include "st/SM3_Robotics/MC_ReadKinTransform.h"
#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"
#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"
#include "st/SM3_Robotics/SMC_GroupAcceptsMovements.h"
#include "st/SM3_Robotics/SMC_GroupConvertPosition.h"
#include "st/SM3_Robotics/SMC_GroupTargetPosition.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;
using group::Series;
using kinematics::Frame;
using kinematics::Matrix;
using kinematics::Outcome;
using kinematics::Vector;

Vector<double> coefficient(const Vector<Series> &vector, int n) {
  return {vector(0).c[n], vector(1).c[n], vector(2).c[n]};
}
Matrix<double> coefficient(const Matrix<Series> &matrix, int n) {
  Matrix<double> result;
  for (int i = 0; i < 9; ++i)
    result(i / 3, i % 3) = matrix(i / 3, i % 3).c[n];
  return result;
}

/// How fast the tool is by its axes' velocities: its point, and its angular velocity. An SMC_ERROR.
int16_t toolVelocity(Ctx &ctx, const GroupRef &group, int16_t system, double (&result)[kArmAxes]) {
  const GroupArm arm(ctx, group);
  if (const int16_t wrong = whyNoTool(group, arm); wrong != 0)
    return wrong;
  Series axes[kAxes];
  for (int32_t i = 0; i < group.uiAxes; ++i)
    axes[placeOf(group, i)] =
        group::growing(group.apAxis.v[i]->fActPosition, group.apAxis.v[i]->fActVelocity);
  Frame<Series> tool;
  if (const Outcome outcome = arm.arm.kinematics.forward(axes, tool); outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  const Frame<double> now{coefficient(tool.turn, 0), coefficient(tool.place, 0)};
  Frame<double> origin;
  if (const int16_t wrong = originOf(group, arm, system, origin); wrong != 0)
    return wrong;
  const Matrix<double> turn = origin.turn;
  const Matrix<double> spin = coefficient(tool.turn, 1) * now.turn.transpose();
  const Vector<double> about(0.5 * (spin(2, 1) - spin(1, 2)), 0.5 * (spin(0, 2) - spin(2, 0)),
                             0.5 * (spin(1, 0) - spin(0, 1)));
  const Vector<double> place = turn.transpose() * coefficient(tool.place, 1);
  const Vector<double> angular = turn.transpose() * about;
  for (int i = 0; i < 3; ++i) {
    result[i] = place(i);
    result[3 + i] = angular(i) / numeric::kDegree;
  }
  return 0;
}

int16_t readVelocity(Ctx &ctx, const GroupRef &group, int16_t system, decl::SMC_POS_REF &velocity) {
  double result[kArmAxes] = {};
  if (system == decl::SMC_COORD_SYSTEM__ACS) {
    for (int32_t i = 0; i < group.uiJoints; ++i)
      result[i] = group.apAxis.v[i]->fActVelocity;
  } else if (const int16_t wrong = toolVelocity(ctx, group, system, result); wrong != 0) {
    return wrong;
  }
  __builtin_memcpy(&velocity, result, sizeof velocity);
  return 0;
}

/// Whether it is known where the movements end that the group has taken.
bool isEndKnown(const GroupRef &group) noexcept {
  const GroupState &state = stateOf(group);
  return state.firstRequest == state.nextRequest && !state.interrupting &&
         !(group.bOwns != 0 && state.motion.abandoned);
}

/// The tool's frame in the machine where they end: of a path in a system that moves, where that is
/// now. An SMC_ERROR.
int16_t targetInMachine(const GroupRef &group, const GroupArm &arm, const double (&axes)[kAxes],
                        Frame<double> &target) {
  const GroupState &state = stateOf(group);
  const bool moves = group.bOwns != 0 && state.motion.first < state.motion.next;
  if (!moves || !group::isCarried(state.motion))
    return kinematics::errorOf(arm.arm.kinematics.forward(axes, target));
  Frame<double> system = kinematics::unturned(Vector<double>(0.0, 0.0, 0.0));
  if (state.rides != 0)
    (void)systemInMachine(group, systemNumber(state.rides), system);
  target = system * group::frameOf(state.endPose);
  return 0;
}

/// The axes where they end, but for a path in a system that moves: where they are.
void targetAxes(const GroupRef &group, double (&axes)[kAxes]) noexcept {
  const GroupState &state = stateOf(group);
  const bool moves = group.bOwns != 0 && state.motion.first < state.motion.next;
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    const int32_t k = placeOf(group, i);
    axes[k] =
        moves && !group::isCarried(state.motion) ? state.end[k] : group.apAxis.v[i]->fSetPosition;
  }
}

/// Where the movements end, as a system counts it. An SMC_ERROR.
int16_t readTarget(Ctx &ctx, decl::SMC_GroupTargetPosition &block, GroupRef &group) {
  double axes[kAxes] = {};
  targetAxes(group, axes);
  const bool carried = group::isCarried(stateOf(group).motion);
  const int16_t system = block.CoordSystem;
  if (!carried && system != decl::SMC_COORD_SYSTEM__TCS)
    return positionOf(ctx, group, system, axes, block.Position, block.KinematicConfig);
  const GroupArm arm(ctx, group);
  if (const int16_t wrong = whyNoTool(group, arm); wrong != 0)
    return wrong;
  Frame<double> target;
  if (const int16_t wrong = targetInMachine(group, arm, axes, target); wrong != 0)
    return wrong;
  const kinematics::Configuration stands = arm.arm.kinematics.configurationOf(axes);
  double result[kArmAxes] = {};
  block.KinematicConfig = {};
  if (system == decl::SMC_COORD_SYSTEM__ACS) {
    if (const int16_t wrong = axesFor(arm.arm, target, stands, axes, result); wrong != 0)
      return wrong;
  } else {
    Frame<double> origin;
    if (const int16_t wrong = originOf(group, arm, system, origin); wrong != 0)
      return wrong;
    toPose(kinematics::inverted(origin) * target, result);
    __builtin_memcpy(&block.KinematicConfig, &stands, sizeof stands);
  }
  __builtin_memcpy(&block.Position, result, sizeof block.Position);
  return 0;
}

/// Whether a place where a path ends stays where it is, as a system counts it.
bool isStable(const GroupRef &group, int16_t system) noexcept {
  if (system == decl::SMC_COORD_SYSTEM__TCS)
    return group.bOwns == 0;
  return carrierOf(group, system) == stateOf(group).rides;
}

/// The tool's frame in the machine at a position of SMC_GroupConvertPosition; `axes` are those,
/// too, if it is one of axes. An SMC_ERROR.
int16_t frameIn(const decl::SMC_GroupConvertPosition &block, const GroupRef &group,
                const GroupArm &arm, double (&axes)[kAxes], Frame<double> &frame) {
  double given[kArmAxes];
  fillCoordinates(*block.PositionIn, given);
  if (block.CoordSystemIn == decl::SMC_COORD_SYSTEM__ACS) {
    for (int32_t k = 0; k < kArmAxes; ++k)
      axes[k] = given[k];
    return kinematics::errorOf(arm.arm.kinematics.forward(axes, frame));
  }
  if (const int16_t wrong = originOf(group, arm, block.CoordSystemIn, frame); wrong != 0)
    return wrong;
  frame = frame * frameOf(given);
  return 0;
}

/// A frame of the tool as SMC_GroupConvertPosition says it. An SMC_ERROR.
int16_t positionOut(decl::SMC_GroupConvertPosition &block, const GroupRef &group,
                    const GroupArm &arm, const double (&axes)[kAxes], const Frame<double> &frame) {
  const kinematics::KinematicsRef &kinematics = arm.arm.kinematics;
  double result[kArmAxes] = {};
  block.configOut = block.config;
  if (block.CoordSystemOut == decl::SMC_COORD_SYSTEM__ACS) {
    kinematics::Configuration configuration;
    __builtin_memcpy(&configuration, &block.config, sizeof configuration);
    double reference[kArmAxes];
    __builtin_memcpy(reference, &block.aRef, sizeof reference);
    if (const int16_t wrong = axesFor(arm.arm, frame, configuration, reference, result); wrong != 0)
      return wrong;
  } else {
    Frame<double> origin;
    if (const int16_t wrong = originOf(group, arm, block.CoordSystemOut, origin); wrong != 0)
      return wrong;
    toPose(kinematics::inverted(origin) * frame, result);
    if (block.CoordSystemIn == decl::SMC_COORD_SYSTEM__ACS) {
      const kinematics::Configuration stands = kinematics.configurationOf(axes);
      __builtin_memcpy(&block.configOut, &stands, sizeof stands);
    }
  }
  __builtin_memcpy(&block.PositionOut, result, sizeof block.PositionOut);
  return 0;
}

bool areNumbers(const decl::SMC_GroupConvertPosition &block) noexcept {
  double position[kArmAxes];
  fillCoordinates(*block.PositionIn, position);
  double reference[kArmAxes];
  __builtin_memcpy(reference, &block.aRef, sizeof reference);
  return isFinite(position) && isFinite(reference);
}

bool isSystem(int16_t system) noexcept {
  return system >= decl::SMC_COORD_SYSTEM__ACS && system <= decl::SMC_COORD_SYSTEM__TCS;
}

int16_t convert(Ctx &ctx, decl::SMC_GroupConvertPosition &block, const GroupRef &group) {
  if (block.PositionIn == nullptr || !areNumbers(block))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
  if (!isSystem(block.CoordSystemIn) || !isSystem(block.CoordSystemOut))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  if (block.CoordSystemIn == block.CoordSystemOut) {
    block.PositionOut = *block.PositionIn;
    block.configOut = block.config;
    return 0;
  }
  GroupArm arm(ctx, group);
  arm.setTool(block.UseToolOffsetParameter != 0 ? Tool{block.ToolOffset, true} : toolOf(group));
  if (const int16_t wrong = whyNoTool(group, arm); wrong != 0)
    return wrong;
  double axes[kAxes] = {};
  Frame<double> frame;
  if (const int16_t wrong = frameIn(block, group, arm, axes, frame); wrong != 0)
    return wrong;
  return positionOut(block, group, arm, axes, frame);
}

/// The axes at the position that MC_GroupSetPosition means. An SMC_ERROR.
int16_t axesAt(Ctx &ctx, const decl::MC_GroupSetPosition &block, const GroupRef &group,
               double (&axes)[kAxes]) {
  Request request{};
  request.system = block.CoordSystem;
  request.relative = block.Relative != 0;
  fillCoordinates(block.Position, request.position);
  for (const double coordinate : request.position)
    if (!exact::isfinite(coordinate))
      return error::SMC_ERROR__SMC_TRAFO_OUT_OF_WORKSPACE;
  if (request.system == decl::SMC_COORD_SYSTEM__ACS) {
    for (int32_t k = 0; k < group.uiJoints; ++k)
      axes[k] = (request.relative ? axes[k] : 0.0) + request.position[k];
    return 0;
  }
  if (const int16_t wrong = noteSystem(group, request); wrong != 0)
    return wrong;
  const GroupArm arm(ctx, group);
  if (arm.outcome != Outcome::Done)
    return kinematics::errorOf(arm.outcome);
  Frame<double> begin;
  if (const Outcome outcome = arm.arm.kinematics.forward(axes, begin); outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  const Frame<double> target = targetFrame(request, request.position, begin);
  double from[kAxes];
  __builtin_memcpy(from, axes, sizeof from);
  return axesFor(arm.arm, target, arm.arm.kinematics.configurationOf(from), from, axes);
}

int16_t setPosition(Ctx &ctx, const decl::MC_GroupSetPosition &block, GroupRef &group) {
  if (group.eState != decl::SMC_AXIS_GROUP_STATE__GroupStandby)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  double axes[kAxes] = {};
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    const axis::AxisRef &axis = *group.apAxis.v[i];
    if (axis.fSetVelocity != 0.0)
      return error::SMC_ERROR__SMC_AXIS_GROUP_INTERRUPTED_BY_SINGLE_AXIS;
    axes[placeOf(group, i)] = axis.fSetPosition;
  }
  if (const int16_t wrong = axesAt(ctx, block, group, axes); wrong != 0)
    return wrong;
  for (int32_t i = 0; i < group.uiJoints; ++i) {
    axis::AxisRef &axis = *group.apAxis.v[i];
    axis::shiftPosition(axis, axes[i] - axis.fSetPosition);
  }
  return 0;
}

} // namespace
} // namespace stride::robotics

namespace {

namespace robotics = ::stride::robotics;
namespace decl = ::st::SM3_Robotics;
using robotics::GroupRef;

} // namespace

void decl::MC_GroupReadActualVelocity::body__(::stride::Ctx &ctx__) {
  robotics::runReader(ctx__, *this, [&](GroupRef &group) {
    return robotics::readVelocity(ctx__, group, CoordSystem, Velocity);
  });
}

void decl::SMC_GroupTargetPosition::body__(::stride::Ctx &ctx__) {
  bool known = false;
  bool stable = false;
  robotics::runReader(ctx__, *this, [&](GroupRef &group) -> int16_t {
    known = robotics::isEndKnown(group);
    stable = robotics::isStable(group, CoordSystem);
    return known ? robotics::readTarget(ctx__, *this, group) : int16_t{0};
  });
  Valid = Valid != 0 && known;
  Stable = Valid != 0 && stable;
}

void decl::SMC_GroupConvertPosition::body__(::stride::Ctx &ctx__) {
  robotics::runReader(ctx__, *this,
                      [&](GroupRef &group) { return robotics::convert(ctx__, *this, group); });
}

void decl::MC_ReadKinTransform::body__(::stride::Ctx &ctx__) {
  robotics::runReader(ctx__, *this, [this](GroupRef &group) -> int16_t {
    KinTransform = group.itfKinematics;
    return 0;
  });
}

void decl::MC_GroupSetPosition::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this,
                    [&](GroupRef &group) { return robotics::setPosition(ctx__, *this, group); });
}

::stride::BOOL decl::SMC_GroupAcceptsMovements(::stride::Ctx & /*ctx__*/,
                                               decl::AXIS_GROUP_REF_SM3 &AxisGroup) {
  const robotics::GroupState &state = robotics::stateOf(AxisGroup);
  return robotics::whyNotReady(AxisGroup) == 0 && state.firstRequest == state.nextRequest &&
         ::stride::group::hasRoom(state.motion);
}
