// Jogging: SMC_GroupJog2.
#include "runtime/blocks/SM3_Robotics/movement_inputs.hpp"
#include "runtime/blocks/SM3_Robotics/requests.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"
#include "st/SM3_Robotics/SMC_GroupJog2.h"
#include "st/SM_DriveBasic/MC_BUFFER_MODE.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;
namespace buffer = ::st::SM_DriveBasic;
using exact::larger;
using exact::smaller;
using group::Obstacle;
using group::Series;
using kinematics::Frame;
using kinematics::Outcome;
using kinematics::Vector;

/// Each axis goes its way, up to where it may be.
void jogAxes(const GroupArm &arm, const Request &request, Ends &ends) {
  for (int32_t k = 0; k < arm.arm.joints; ++k) {
    const bool turns = arm.outcome == Outcome::Done && arm.arm.kinematics.turns(k);
    const double to = ends.from[k] + request.position[k] * request.aux[turns ? 1 : 0];
    const group::AxisLimits &limits = arm.arm.limits[k];
    const double low = smaller(limits.low, ends.from[k]); // one that is beyond does not go back
    const double high = larger(limits.high, ends.from[k]);
    ends.to[k] = smaller(larger(to, low), high);
  }
}

/// The pose as far as the keys lead.
Frame<double> jogPose(const Request &request, const Frame<double> &begin) {
  const bool inTool = request.system == decl::SMC_COORD_SYSTEM__TCS;
  const Frame<double> system = inTool ? begin : group::frameOf(request.frame);
  const Vector<double> way(request.position[0], request.position[1], request.position[2]);
  const Vector<double> about(request.position[3], request.position[4], request.position[5]);
  Frame<double> target = begin;
  target.place += system.turn * way * request.aux[0];
  if (about.norm() > 0.0) {
    constexpr double kMost = 170.0; // [°] a line's tool turns by the shortest way
    const double angle = smaller(request.aux[1], kMost) * numeric::kDegree;
    target.turn =
        kinematics::about(Vector<double>(system.turn * about.normalized()), angle) * begin.turn;
  }
  return target;
}

/// Whether the axes bring the tool to a place of a leg, from where they are nearby.
bool follows(const group::Arm &arm, const group::Leg &leg, double way, double (&axes)[kAxes]) {
  group::PathPlace place;
  group::placeAt(leg, group::growing(way, 1.0), place);
  Series found[kAxes];
  if (group::axesAt(arm, place, axes, found) != Obstacle::None)
    return false;
  double at[kAxes] = {};
  for (int32_t k = 0; k < arm.joints; ++k)
    at[k] = found[k].c[0];
  Frame<double> reached;
  if (arm.kinematics.forward(at, reached) != Outcome::Done)
    return false;
  constexpr double kNear = 1e-6;
  double far = 0.0; // what a kinematics cannot choose it does not look at
  for (int i = 0; i < 3; ++i)
    far = larger(far,
                 exact::fabs(reached.place(i) - place.tool.place(i).c[0]) / arm.kinematics.reach());
  for (int i = 0; i < 9; ++i)
    far = larger(far, exact::fabs(reached.turn(i / 3, i % 3) - place.tool.turn(i / 3, i % 3).c[0]));
  for (int32_t k = 0; k < arm.joints && far <= kNear; ++k)
    axes[k] = at[k];
  return far <= kNear;
}

/// How far the axes can follow a leg; they are there then. [u]
double reachAlong(const GroupArm &arm, const group::Leg &leg, double (&axes)[kAxes]) {
  constexpr int32_t kParts = 48;
  constexpr int32_t kHalves = 8;
  const group::Arm &all = arm.arm;
  const group::Arm one{all.kinematics, all.joints, all.more, all.limits,
                       all.kinematics.configurationOf(axes)};
  double good = 0.0;
  double step = leg.length / kParts;
  for (int32_t i = 1; i <= kParts; ++i) {
    const double way = i == kParts ? leg.length : i * step;
    if (!follows(one, leg, way, axes))
      break;
    good = way;
  }
  for (int32_t i = 0; i < kHalves && good < leg.length; ++i) {
    step *= 0.5;
    if (follows(one, leg, good + step, axes))
      good += step;
  }
  return good;
}

int16_t jogTool(const GroupArm &arm, const Request &request, Ends &ends, group::Leg &leg) {
  if (arm.outcome != Outcome::Done)
    return kinematics::errorOf(arm.outcome);
  Frame<double> begin;
  if (const Outcome outcome = arm.arm.kinematics.forward(ends.from, begin);
      outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  const Frame<double> target = jogPose(request, begin);
  group::MoreAxes more;
  for (int32_t k = 0; k < kMoreAxes; ++k)
    more.from[k] = more.to[k] = ends.from[kArmAxes + k];
  const group::Pose from = group::poseOf(begin);
  leg = group::lineLeg(from, group::poseOf(target), more);
  const double reached = reachAlong(arm, leg, ends.to);
  if (reached == leg.length)
    return 0;
  // Arms that are stretched need not be so to the last digit.
  constexpr double kLess = 0.999;
  group::PathPlace place;
  group::placeAt(leg, Series(kLess * reached), place);
  group::Leg whole = leg;
  whole.length = kLess * reached;
  whole.angle = leg.angle * (kLess * reached / leg.length);
  leg = whole;
  for (int32_t k = 0; k < kAxes; ++k)
    ends.to[k] = ends.from[k];
  if (leg.length > 0.0)
    (void)reachAlong(arm, leg, ends.to);
  return 0;
}

/// Which way the keys of a direction lead.
int16_t wayOf(const decl::SMC_GroupJog2 &block, int32_t k) noexcept {
  const bool forward = block.Forward.v[k] != 0;
  const bool backward = block.Backward.v[k] != 0;
  if (block.Enable == 0 || forward == backward)
    return 0;
  return forward ? int16_t{1} : int16_t{-1};
}

void fillJog(const decl::SMC_GroupJog2 &block, Request &request) noexcept {
  request.kind = RequestKind::Jog;
  request.system = block.CoordSystem;
  request.bufferMode = buffer::MC_BUFFER_MODE__Aborting;
  for (int32_t k = 0; k < kArmAxes; ++k)
    request.position[k] = wayOf(block, k);
  request.aux[0] = block.MaxLinearDistance;
  request.aux[1] = block.MaxAngularDistance;
  request.order.velocityFactor = block.VelFactor;
  request.order.accelerationFactor = block.AccFactor;
  request.order.jerkFactor = block.JerkFactor;
  request.torqueFactor = 1.0;
  fillPath(block, request);
}

/// The keys have changed: another movement, or none.
void begin(Ctx &ctx, decl::SMC_GroupJog2 &block, GroupRef &group, bool any) {
  Request request = {};
  setError(block, 0);
  if (any) {
    fillJog(block, request);
  } else {
    if (block.stBlock.bRunning == 0)
      return;
    request.kind = RequestKind::Halt;
    request.order.accelerationFactor = request.order.jerkFactor = request.torqueFactor = 1.0;
    request.bufferMode = buffer::MC_BUFFER_MODE__Aborting;
  }
  const int16_t wrong = any && block.ABC_as_ACS != 0
                            ? error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER
                            : ask(ctx, group, request);
  setError(block, wrong);
  block.stBlock.bRunning = wrong == 0;
  block.stBlock.ulId = request.id;
}

} // namespace

int16_t wrongJog(const Request &request) noexcept {
  return exact::isPositive(request.aux[0]) && exact::isPositive(request.aux[1]) &&
                 exact::isfinite(request.aux[0]) && exact::isfinite(request.aux[1])
             ? int16_t{0}
             : error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
}

int16_t jogLeg(const GroupRef &group, const GroupArm &arm, const Request &request, Ends &ends,
               group::Leg &leg) {
  if (request.system != decl::SMC_COORD_SYSTEM__ACS)
    return jogTool(arm, request, ends, leg);
  jogAxes(arm, request, ends);
  double perTime[kAxes];
  for (int32_t k = 0; k < kAxes; ++k)
    perTime[k] = arm.arm.limits[k].velocity * request.order.velocityFactor *
                 request.order.shares.velocity[k];
  leg = group::axesLeg(ends.from, ends.to, perTime, speedOf(stateOf(group).motion, request.order));
  return 0;
}

/// What has become of the movement: another one may have ended it since the last call.
static void followJog(decl::SMC_GroupJog2 &block, const GroupState &state) noexcept {
  if (block.stBlock.bRunning == 0)
    return;
  const group::Outcome outcome = group::outcomeOf(state.motion, block.stBlock.ulId);
  block.stBlock.bRunning = group::goesOn(outcome) && outcome != group::Outcome::Interrupted;
  if (outcome == group::Outcome::Failed)
    setError(block, state.error[block.stBlock.ulId % group::kOutcomes]);
}

static void runJog(Ctx &ctx, decl::SMC_GroupJog2 &block) {
  if (block.AxisGroup == nullptr) {
    setError(block, block.Enable != 0 ? kNoGroup : int16_t{0});
    block.Active = block.Busy = 0;
    return;
  }
  GroupRef &group = *block.AxisGroup;
  serve(ctx, group);
  bool any = false;
  bool changed = false;
  for (int32_t k = 0; k < kArmAxes; ++k) {
    const int16_t way = wayOf(block, k);
    any = any || way != 0;
    changed = changed || way != block.aiOld.v[k];
    block.aiOld.v[k] = way;
  }
  followJog(block, stateOf(group));
  if (changed)
    begin(ctx, block, group, any);
  followJog(block, stateOf(group));
  if (block.Enable == 0 && block.stBlock.bRunning == 0)
    setError(block, 0);
  ::st::SM3_Transformation::CONFIGDATA stands;
  if (block.CoordSystem != decl::SMC_COORD_SYSTEM__TCS)
    (void)readPosition(ctx, group, block.CoordSystem, false, block.CurrentPosition, stands);
  block.Active = block.Enable != 0 && block.Error == 0;
  block.Busy = block.stBlock.bRunning;
}

} // namespace stride::robotics

void st::SM3_Robotics::SMC_GroupJog2::body__(::stride::Ctx &ctx__) {
  ::stride::robotics::runJog(ctx__, *this);
}
