// Circular movements: MC_MoveCircularAbsolute, MC_MoveCircularRelative.
#include "runtime/blocks/SM3_Robotics/movement_inputs.hpp"
#include "runtime/blocks/SM3_Robotics/tool_led.hpp"
#include "runtime/numeric/group/arc.hpp"

#include "st/SM3_Robotics/MC_CIRC_PATHCHOICE.h"
#include "st/SM3_Robotics/MC_MoveCircularAbsolute.h"
#include "st/SM3_Robotics/MC_MoveCircularRelative.h"
#include "st/SM3_Robotics/SMC_CIRC_MODE.h"
#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;
using group::ArcFault;
using group::ArcWay;
using kinematics::Frame;
using kinematics::Outcome;
using numeric::Vector3;

int16_t errorOf(ArcFault fault) noexcept {
  switch (fault) {
  case ArcFault::None:
    break;
  case ArcFault::Collinear:
    return error::SMC_ERROR__SMC_CP_CIRCLE_COLLINEAR;
  case ArcFault::OffBisector:
    return error::SMC_ERROR__SMC_CP_CIRCLE_CENTER_OFF_BISECTOR;
  case ArcFault::NoRadius:
    return error::SMC_ERROR__SMC_CP_CIRCLE_RADIUS_ZERO;
  case ArcFault::ChordTooLong:
    return error::SMC_ERROR__SMC_CP_CIRCLE_RADIUS_TOO_SMALL;
  case ArcFault::SameEnds:
    return error::SMC_ERROR__SMC_CP_CIRCLE_START_IS_END;
  }
  return 0;
}

/// The pose at coordinates of a request; in ACS where the axes bring the tool. An SMC_ERROR.
int16_t poseAt(const GroupArm &arm, const Request &request, const double (&coordinates)[kArmAxes],
               const Ends &ends, const Frame<double> &begin, Frame<double> &pose) {
  if (request.system != decl::SMC_COORD_SYSTEM__ACS) {
    pose = targetFrame(request, coordinates, begin);
    return 0;
  }
  double axes[kAxes];
  for (int32_t k = 0; k < kAxes; ++k)
    axes[k] = k < arm.arm.joints ? (request.relative ? ends.from[k] : 0.0) + coordinates[k]
                                 : ends.from[k];
  return kinematics::errorOf(arm.arm.kinematics.forward(axes, pose));
}

/// The arc that a request means between two places, by a third one.
ArcFault arcOf(const Request &request, const Vector3 &start, const Vector3 &aux, const Vector3 &end,
               group::Arc &arc) noexcept {
  const ArcWay way = request.pathChoice == decl::MC_CIRC_PATHCHOICE__CLOCKWISE
                         ? ArcWay::Clockwise
                         : ArcWay::CounterClockwise;
  switch (request.circleMode) {
  case decl::SMC_CIRC_MODE__BORDER:
    return group::arcThrough(start, aux, end, arc);
  case decl::SMC_CIRC_MODE__CENTER:
    return group::arcAbout(start, aux, end, way, arc);
  default:
    return group::arcWithNormal(start, aux - start, end, way, arc);
  }
}

} // namespace

int16_t wrongCircle(const Request &request) noexcept {
  const bool known = request.circleMode >= decl::SMC_CIRC_MODE__BORDER &&
                     request.circleMode <= decl::SMC_CIRC_MODE__RADIUS &&
                     request.pathChoice >= decl::MC_CIRC_PATHCHOICE__CLOCKWISE &&
                     request.pathChoice <= decl::MC_CIRC_PATHCHOICE__COUNTER_CLOCKWISE;
  if (!known)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
  // A vector is none of axes.
  if (request.system == decl::SMC_COORD_SYSTEM__ACS &&
      request.circleMode == decl::SMC_CIRC_MODE__RADIUS)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  for (const double coordinate : request.aux)
    if (!exact::isfinite(coordinate))
      return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
  return 0;
}

int16_t arcLeg(const Request &request, const group::Pose &from, const Vector3 &aux,
               const group::Pose &to, const group::MoreAxes &more, group::Leg &leg) noexcept {
  group::Arc arc;
  const ArcFault fault = arcOf(request, from.place, aux, to.place, arc);
  if (fault == ArcFault::None)
    leg = group::circleLeg(from, arc, to, more);
  return errorOf(fault);
}

int16_t circularLeg(const GroupArm &arm, const Request &request, Ends &ends, group::Leg &leg) {
  if (arm.outcome != Outcome::Done)
    return kinematics::errorOf(arm.outcome);
  Frame<double> begin;
  Frame<double> aux;
  Frame<double> target;
  if (const Outcome outcome = arm.arm.kinematics.forward(ends.from, begin);
      outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  if (const int16_t wrong = poseAt(arm, request, request.aux, ends, begin, aux); wrong != 0)
    return wrong;
  if (const int16_t wrong = poseAt(arm, request, request.position, ends, begin, target); wrong != 0)
    return wrong;
  group::MoreAxes more;
  for (int32_t k = 0; k < kMoreAxes; ++k) {
    more.from[k] = ends.from[kArmAxes + k];
    more.to[k] = ends.to[kArmAxes + k];
  }
  const group::Pose to = group::poseOf(target);
  if (const int16_t wrong =
          arcLeg(request, group::poseOf(begin), group::plain(aux.place), to, more, leg);
      wrong != 0)
    return wrong;
  constexpr int32_t kParts = 36;
  if (!givesToolAxes(request))
    return followLeg(arm.arm, leg, kParts, ends);
  const bool byPose = request.system != decl::SMC_COORD_SYSTEM__ACS;
  if (!byPose) {
    for (int32_t k = 0; k < arm.arm.joints; ++k)
      ends.to[k] = (request.relative ? ends.from[k] : 0.0) + request.position[k];
  } else if (const int16_t wrong =
                 axesFor(arm.arm, target, arm.arm.kinematics.configurationOf(ends.from), ends.from,
                         ends.to);
             wrong != 0) {
    return wrong;
  }
  return settleWithToolAxes(arm.arm, leg, kParts, byPose, ends);
}

} // namespace stride::robotics

namespace {

namespace robotics = ::stride::robotics;
namespace decl = ::st::SM3_Robotics;
using robotics::Request;

template <class Block> void run(::stride::Ctx &ctx, Block &block, bool relative) {
  robotics::runMovement(ctx, block, [&](Request &request) {
    request.kind = robotics::RequestKind::Circular;
    request.relative = relative;
    request.circleMode = block.CircMode;
    request.pathChoice = block.PathChoice;
    robotics::fillCoordinates(block.AuxPoint, request.aux);
    robotics::fillCoordinates(block.EndPoint, request.position);
    robotics::fillModes(block, request);
    robotics::fillPath(block, request);
    robotics::fillOrientation(block, request);
  });
}

} // namespace

void decl::MC_MoveCircularAbsolute::body__(::stride::Ctx &ctx__) { run(ctx__, *this, false); }
void decl::MC_MoveCircularRelative::body__(::stride::Ctx &ctx__) { run(ctx__, *this, true); }
