// SMC_ControlAxisByPos, SMC_ControlAxisByPosVel, SMC_ControlAxisByVel: set values of an
// interpolator, with gaps between them bridged.
#include "runtime/axis/follow.hpp"
#include "runtime/axis/plan_axis.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_CNC/SMC_INT_STATUS.h"
#include "st/SM_DriveBasic/SMC_ControlAxisByPos.h"
#include "st/SM_DriveBasic/SMC_ControlAxisByPosVel.h"
#include "st/SM_DriveBasic/SMC_ControlAxisByVel.h"
#include "st/SM_DriveBasic/SMC_MOTION_KIND.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using ControlState = ::st::SM_DriveBasic::SMC_CONTROL_STATE;
using motion::AxisRef;

/// SMC_CONTROL_STATE.byMode.
constexpr uint8_t kFollows = 0;
constexpr uint8_t kBridges = 1;
constexpr uint8_t kBrakes = 2;

constexpr double kSlack = 1.0 + 1e-9; ///< Limits may be exceeded by rounding.

/// What a call of one of the blocks asks for.
struct Demand {
  bool enable;
  bool avoidGaps;
  bool waits;       ///< There are no set values yet.
  bool byPosition;  ///< Else by velocity.
  bool hasVelocity; ///< The velocity is given; else it follows from the positions.
  double position;
  double velocity;
  motion::BlockLimits gap;
  int16_t badGap; ///< The error of gap values that cannot be used.
};

/// Whether the axis's ramp type has the jerk that it needs.
bool hasJerk(const motion::Dynamics &dynamics) noexcept {
  return dynamics.ramp == motion::RampType::Trapezoid || exact::isPositive(dynamics.jerk);
}

bool canBridge(const AxisRef &ref, const Demand &demand) noexcept {
  return exact::isPositive(demand.gap.acceleration) && exact::isPositive(demand.gap.deceleration) &&
         (!demand.byPosition || exact::isPositive(demand.gap.velocity)) &&
         hasJerk(motion::plainDynamics(ref, demand.gap));
}

bool areNumbers(const Demand &demand) noexcept {
  return (!demand.byPosition || exact::isfinite(demand.position)) &&
         (!demand.hasVelocity || exact::isfinite(demand.velocity));
}

motion::State present(const ControlState &control) noexcept {
  const auto &follow = control.stFollow;
  return {follow.fPosition, follow.fVelocity, follow.fAcceleration};
}

/// Makes the profile, which starts at the last set values, the axis's plan.
void load(AxisRef &ref, const motion::Profile &profile) noexcept {
  auto &plan = ref.stPlanner;
  motion::loadPlan(plan, profile, ref.fTaskCycle);
  plan.stCommand = {}; // nothing that a change of the overrides plans anew
  plan.stCommand.eKind = ::st::SM_DriveBasic::SMC_MOTION_KIND__stop;
  plan.fTarget = axis::shownPosition(ref, plan.fEnd);
  plan.fDeceleration = 0.0;
}

/// Moves the axis along its plan. True at the end.
bool stepAlong(ControlState &control, AxisRef &ref) noexcept {
  auto &follow = control.stFollow;
  auto &plan = ref.stPlanner;
  const bool reached = axis::stepPlan(ref);
  motion::State state = axis::planState(plan, axis::planTime(plan));
  if (reached && plan.fEndVelocity == 0.0)
    state.position = plan.fTarget;
  follow.fPosition = axis::shownPosition(ref, state.position);
  follow.fVelocity = state.velocity;
  follow.fAcceleration = state.acceleration;
  return reached;
}

/// Brakes, then stands still.
void brake(ControlState &control, AxisRef &ref, const Demand &demand) noexcept {
  auto &follow = control.stFollow;
  if (control.byMode != kBrakes) {
    control.byMode = kBrakes;
    ref.stPlanner.bActive = 0;
    motion::BlockLimits limits = demand.gap;
    if (!exact::isPositive(limits.deceleration))
      limits.deceleration = ref.fSWMaxDeceleration;
    motion::Dynamics dynamics = motion::plainDynamics(ref, limits);
    if (!hasJerk(dynamics))
      dynamics.ramp = motion::RampType::Trapezoid;
    motion::Profile profile;
    if (follow.fVelocity != 0.0 &&
        motion::planStop(profile, present(control), dynamics) == motion::PlanError::None)
      load(ref, profile);
  }
  if (ref.stPlanner.bActive != 0)
    (void)stepAlong(control, ref);
  else
    motion::followState(follow, ref, {follow.fPosition, 0.0, 0.0}, 0.0);
}

/// Plans the way to the demanded set values. An SMC_ERROR.
int16_t bridge(ControlState &control, AxisRef &ref, const Demand &demand) noexcept {
  if (!canBridge(ref, demand))
    return demand.badGap;
  const motion::State start = present(control);
  const motion::Dynamics dynamics = motion::plainDynamics(ref, demand.gap);
  motion::Profile profile;
  const motion::PlanError problem =
      demand.byPosition
          ? motion::planMove(profile, start,
                             start.position + motion::wayTo(control.stFollow, ref, demand.position),
                             0.0, dynamics)
          : motion::planVelocity(profile, start, demand.velocity, dynamics);
  if (problem != motion::PlanError::None)
    return demand.badGap;
  load(ref, profile);
  if (demand.byPosition)
    ref.stPlanner.fTarget = axis::shownPosition(ref, demand.position);
  control.byMode = kBridges;
  control.fTarget = demand.position;
  control.fTargetVelocity = demand.velocity;
  return axis::error::kNone;
}

/// Whether the axis cannot go on to the demanded set values in one cycle. `way` leads there.
bool isGap(const ControlState &control, const AxisRef &ref, const Demand &demand,
           double way) noexcept {
  const double cycle = ref.fTaskCycle;
  if (demand.byPosition) {
    const double limit = ref.fSWMaxVelocity * kSlack;
    // Between large numbers a difference is not exact.
    const double rounding =
        1e-15 * (exact::fabs(demand.position) + exact::fabs(control.stFollow.fPosition));
    return !(exact::fabs(way) <= limit * cycle + rounding) ||
           (demand.hasVelocity && !(exact::fabs(demand.velocity) <= limit));
  }
  const double before = control.stFollow.fVelocity;
  const double rising = exact::fabs(demand.velocity) - exact::fabs(before);
  const double limit = rising > 0.0 ? ref.fSWMaxAcceleration : ref.fSWMaxDeceleration;
  const double rounding = 1e-15 * (exact::fabs(demand.velocity) + exact::fabs(before));
  return !(exact::fabs(demand.velocity - before) <= limit * kSlack * cycle + rounding);
}

/// Whether the set values have changed since the gap began to be bridged.
bool isElsewhere(const ControlState &control, const Demand &demand) noexcept {
  return demand.byPosition ? demand.position != control.fTarget
                           : demand.velocity != control.fTargetVelocity;
}

/// Goes on with the bridge, or begins one at a gap, or follows. An SMC_ERROR.
int16_t proceed(ControlState &control, AxisRef &ref, const Demand &demand) noexcept {
  auto &follow = control.stFollow;
  if (control.byMode == kBrakes) {
    control.byMode = kFollows;
    ref.stPlanner.bActive = 0;
  } else if (control.byMode == kBridges && ref.stPlanner.bActive == 0 &&
             !isElsewhere(control, demand)) {
    control.byMode = kFollows; // the whole gap has been bridged in the cycle before
  }
  const double way = demand.byPosition
                         ? motion::wayTo(follow, ref, demand.position)
                         : 0.5 * (follow.fVelocity + demand.velocity) * ref.fTaskCycle;
  const bool begins =
      control.byMode == kFollows && demand.avoidGaps && isGap(control, ref, demand, way);
  if (begins || (control.byMode == kBridges && isElsewhere(control, demand)))
    if (const int16_t problem = bridge(control, ref, demand); problem != axis::error::kNone)
      return problem;
  if (control.byMode == kFollows) {
    const double velocity = demand.hasVelocity ? demand.velocity : way / ref.fTaskCycle;
    motion::followStep(follow, ref, demand.byPosition ? demand.position : follow.fPosition + way,
                       way, velocity);
  } else if (stepAlong(control, ref)) {
    ref.stPlanner.bActive = 0;
    if (!begins) // a gap is shown for one cycle at least
      control.byMode = kFollows;
  }
  return axis::error::kNone;
}

/// One call: an SMC_ERROR with which the block fails.
int16_t control(ControlState &state, AxisRef &ref, const Demand &demand) noexcept {
  if (ref.bMovedInThisCycle != 0)
    return axis::error::kNone;
  motion::alignFollowing(state.stFollow, ref);
  if (demand.enable && !demand.waits)
    return areNumbers(demand) ? proceed(state, ref, demand) : axis::error::kOutOfRange;
  brake(state, ref, demand);
  if (!demand.enable && ref.stPlanner.bActive == 0) {
    motion::finish(state.stBlock);
    motion::clearOutcome(state.stBlock);
    motion::release(ref);
  }
  return axis::error::kNone;
}

int16_t start(ControlState &state, AxisRef &ref, const Demand &demand) noexcept {
  const auto needs = demand.byPosition ? motion::Needs::Position : motion::Needs::Velocity;
  if (const int16_t problem = motion::refusal(ref, needs); problem != axis::error::kNone)
    return problem;
  if (demand.avoidGaps && !canBridge(ref, demand))
    return demand.badGap;
  if (!demand.waits && !areNumbers(demand))
    return axis::error::kOutOfRange;
  motion::beginFollowing(state.stFollow, state.stBlock, ref);
  state.byMode = kFollows;
  return axis::error::kNone;
}

template <class Block> void run(Block &block, Demand demand) noexcept {
  ControlState &state = block.stControl;
  auto &outcome = state.stBlock;
  demand.enable = block.bEnable != 0;
  demand.avoidGaps = block.bAvoidGaps != 0;
  demand.waits = block.iStatus == ::st::SM_CNC::SMC_INT_STATUS__IPO_INIT;
  demand.gap = {block.fGapVelocity, block.fGapAcceleration, block.fGapDeceleration, block.fGapJerk};
  AxisRef *ref = block.Axis;
  int16_t problem = axis::error::kNone;
  switch (motion::beginCall(outcome, demand.enable, ref)) {
  case motion::Call::Start:
    // Enabled again while it was still braking: the axis is the block's, and moves.
    problem = start(state, *ref, demand);
    if (problem == axis::error::kNone)
      problem = control(state, *ref, demand);
    break;
  case motion::Call::Go:
    if (motion::keep(outcome, *ref))
      problem = control(state, *ref, demand);
    break;
  case motion::Call::Idle:
    break;
  }
  if (problem != axis::error::kNone) // what is the block's and moves brakes into error stop
    motion::fail(outcome, ref, problem);
  block.bBusy = outcome.bRunning;
  block.bCommandAborted = outcome.bAborted;
  block.bError = outcome.iError != axis::error::kNone;
  block.iErrorID = outcome.iError;
  block.bStopIpo = outcome.bRunning != 0 && demand.enable && state.byMode == kBridges;
}

Demand byPosition(double position) noexcept {
  Demand demand{};
  demand.byPosition = true;
  demand.position = position;
  demand.badGap = axis::error::kMoveAbsoluteValues;
  return demand;
}

} // namespace

void st::SM_DriveBasic::SMC_ControlAxisByPos::body__(::stride::Ctx & /*ctx__*/) {
  run(*this, byPosition(fSetPosition));
}

void st::SM_DriveBasic::SMC_ControlAxisByPosVel::body__(::stride::Ctx & /*ctx__*/) {
  Demand demand = byPosition(fSetPosition);
  demand.hasVelocity = true;
  demand.velocity = fSetVelocity;
  run(*this, demand);
}

void st::SM_DriveBasic::SMC_ControlAxisByVel::body__(::stride::Ctx & /*ctx__*/) {
  Demand demand{};
  demand.hasVelocity = true;
  demand.velocity = fSetVelocity;
  demand.badGap = axis::error::kMoveVelocityValues;
  run(*this, demand);
}
