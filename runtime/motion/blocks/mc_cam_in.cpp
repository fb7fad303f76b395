// MC_CamIn: a slave follows its master by a cam.
#include "runtime/axis/set_point.hpp"
#include "runtime/cam/tappets.hpp"
#include "runtime/iec/ctx.h"
#include "runtime/motion/blocks/cam_course.hpp"
#include "runtime/motion/blocks/follow.hpp"
#include "runtime/motion/modulo.hpp"
#include "runtime/motion/plan_axis.hpp"

#include "st/SM_PLCopen/MC_CamIn.h"
#include "st/SM_PLCopen/MC_StartMode.h"

namespace {

namespace axis = ::stride::axis;
namespace cam = ::stride::cam;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
namespace mode = ::st::SM_PLCopen;
using Block = ::st::SM_PLCopen::MC_CamIn;
using motion::AxisRef;

constexpr int16_t kRampNeedsValues = ::st::SM_Error::SMC_ERROR__SMC_CI_RAMPIN_NEEDS_VELACC_VALUES;

motion::CamInputs inputsOf(const Block &block) noexcept {
  return {block.MasterOffset, block.SlaveOffset, block.MasterScaling, block.SlaveScaling};
}

bool isRamp(int16_t startMode) noexcept {
  return startMode == mode::MC_StartMode__ramp_in || startMode == mode::MC_StartMode__ramp_in_pos ||
         startMode == mode::MC_StartMode__ramp_in_neg;
}

/// Whether the slave's positions count from where it is at the start.
bool isRelative(const Block &block, const motion::CamId &id) noexcept {
  return block.StartMode == mode::MC_StartMode__relative || id.SlaveAbsolute == 0;
}

/// The way of the slave in this cycle before this call; its block may have been called already.
double earlierTravel(const AxisRef &slave) noexcept {
  if (slave.bMovedInThisCycle == 0)
    return 0.0;
  return slave.bTravelGiven != 0
             ? slave.fTravel
             : 0.5 * (slave.fSaveVelocity + slave.fSetVelocity) * slave.fTaskCycle;
}

/// The slave's set values at the end of this cycle if it went on as it does.
axis::MotionState onwards(const AxisRef &slave) noexcept {
  axis::MotionState state = axis::setState(slave);
  if (slave.bMovedInThisCycle == 0)
    state.position += state.velocity * slave.fTaskCycle;
  return state;
}

/// Plans the compensating motion: it leads the slave's distance from the cam to zero, on a rotary
/// slave to a whole number of turns. False if the limits do not allow it.
bool planRamp(Block &block, const AxisRef &slave, const motion::CamTarget &target) noexcept {
  const motion::Dynamics dynamics = motion::plainDynamics(
      slave, {block.VelocityDiff, block.Acceleration, block.Deceleration, block.Jerk});
  const axis::MotionState now = onwards(slave);
  motion::State distance{now.position - target.state.position, now.velocity - target.state.velocity,
                         now.acceleration - target.state.acceleration};
  double goal = 0.0;
  if (axis::isRotary(slave)) {
    distance.position = axis::wrapPosition(distance.position, slave.fPositionPeriod);
    motion::Direction direction = motion::Direction::Shortest;
    if (block.StartMode == mode::MC_StartMode__ramp_in_pos)
      direction = motion::Direction::Positive;
    else if (block.StartMode == mode::MC_StartMode__ramp_in_neg)
      direction = motion::Direction::Negative;
    if (!motion::resolveModulo({distance, 0.0, 0.0, slave.fPositionPeriod, direction,
                                motion::Direction::Positive, dynamics},
                               goal))
      return false;
  }
  distance.position -= goal; // so that it ends at 0
  motion::Profile profile;
  if (!exact::isPositive(block.VelocityDiff) ||
      motion::planMove(profile, distance, 0.0, 0.0, dynamics) != motion::PlanError::None)
    return false;
  motion::loadPlan(block.stCam.stRamp, profile, slave.fTaskCycle);
  block.stCam.bRamping = 1;
  return true;
}

/// The compensating motion in this cycle.
axis::MotionState compensation(motion::CamState &state) noexcept {
  if (state.bRamping == 0)
    return {0.0, 0.0, 0.0};
  auto &plan = state.stRamp;
  const double t = axis::planTime(plan);
  ++plan.ulCycle;
  if (axis::isPlanOver(plan, t)) {
    state.bRamping = 0;
    return {0.0, 0.0, 0.0};
  }
  return axis::pieceState(plan, t);
}

/// Writes the slave's set values: on the cam, plus the compensating motion. `way` [u] is its way in
/// this cycle.
void write(Block &block, AxisRef &slave, const motion::CamTarget &target, double way,
           const axis::MotionState &added) noexcept {
  auto &state = block.stCam;
  const axis::MotionState sum{target.state.position + added.position,
                              target.state.velocity + added.velocity,
                              target.state.acceleration + added.acceleration};
  motion::followState(state.stFollow, slave, sum, way);
  state.liPeriod = target.place.period;
  state.fLocal = target.local;
  state.fRamp = added.position;
}

void showEnd(Block &block, const motion::CamTarget &target, double travel) noexcept {
  auto &state = block.stCam;
  if (state.stCam.Periodic != 0) {
    block.EndOfProfile = target.place.period != state.liPeriod;
    return;
  }
  const auto &curve = *state.stCam.pCam;
  const double x = target.place.position;
  block.EndOfProfile =
      target.outside ||
      (x >= curve.xEnd && (travel > 0.0 || (travel == 0.0 && block.EndOfProfile != 0))) ||
      (x <= curve.xStart && (travel < 0.0 || (travel == 0.0 && block.EndOfProfile != 0)));
}

/// Which tappets the master passes on its way to `place` in the running cam.
void follow(Block &block, const cam::Place &place, int64_t now) noexcept {
  auto &state = block.stCam;
  const double hysteresis =
      exact::isPositive(block.TappetHysteresis) ? block.TappetHysteresis : 0.0;
  cam::reportTappets(block.Tappets, state.stTappets,
                     cam::tappetsOf(*state.stCam.pCam, state.stCam.Periodic != 0), place,
                     hysteresis, now);
}

/// The selected cam begins, from where master and slave are.
int16_t enter(Block &block, AxisRef &slave, const motion::MasterMotion &master,
              int64_t cycleStart) noexcept {
  auto &state = block.stCam;
  const motion::CamInputs inputs = inputsOf(block);
  cam::Curve curve;
  if (const int16_t error = motion::openCam(block.CamTableID, curve); error != axis::error::kNone)
    return error;
  if (block.StartMode < mode::MC_StartMode__absolute ||
      block.StartMode > mode::MC_StartMode__ramp_in_dist)
    return axis::error::kOutOfRange;
  state.stCam = block.CamTableID;
  state.bRamping = 0;
  state.stFollow.fFirstOffset = slave.fOffsetPosition;
  const axis::MotionState now = onwards(slave);
  const motion::CamStart start{cam::toDouble(master.position), now.position,
                               isRelative(block, state.stCam)};
  if (const int16_t error = motion::enterCam(state, curve, inputs, start, master);
      error != axis::error::kNone)
    return error;
  motion::CamTarget target;
  if (!motion::evaluateCam(state, curve, master, slave, target))
    return axis::error::kOutOfRange;
  if (isRamp(block.StartMode) && !planRamp(block, slave, target))
    return kRampNeedsValues;
  const double earlier = earlierTravel(slave);
  motion::beginFollowing(state.stFollow, block.stBlock, slave);
  const axis::MotionState added = compensation(state);
  const double way = motion::wayTo(state.stFollow, slave, target.state.position + added.position);
  write(block, slave, target, way + earlier, added);
  cam::beginTappetData(block.Tappets, state.stTappets, target.place, cycleStart);
  block.EndOfProfile = 0;
  return axis::error::kNone;
}

void start(Block &block, AxisRef &slave, int64_t cycleStart) noexcept {
  auto &state = block.stBlock;
  int16_t problem = motion::refusal(slave);
  if (problem == axis::error::kNone && (block.Master == nullptr || block.Master == &slave))
    problem = axis::error::kNoAxis;
  if (problem == axis::error::kNone) {
    const motion::MasterMotion master = motion::beginMaster(block.stCam.stMaster, *block.Master);
    problem = enter(block, slave, master, cycleStart);
  }
  if (problem != axis::error::kNone)
    motion::fail(state, &slave, problem);
}

bool isSame(const motion::CamId &a, const motion::CamId &b) noexcept {
  return a.pCam == b.pCam && a.Periodic == b.Periodic && a.MasterAbsolute == b.MasterAbsolute &&
         a.SlaveAbsolute == b.SlaveAbsolute;
}

/// Whether the cam has come to its end, forwards, and the program has given another one.
bool isReplaced(const Block &block, const motion::CamTarget &target) noexcept {
  const auto &state = block.stCam;
  const bool ended = state.stCam.Periodic != 0
                         ? target.place.period > state.liPeriod
                         : target.outside && target.place.position > state.stCam.pCam->xEnd;
  return ended && block.CamTableID.pCam != nullptr && !isSame(block.CamTableID, state.stCam);
}

/// The other cam begins where the running one has ended, earlier in this cycle. `target` becomes
/// the other one's.
int16_t replace(Block &block, AxisRef &slave, const cam::Curve &ended, motion::CamTarget &target,
                int64_t cycleStart) noexcept {
  auto &state = block.stCam;
  const bool periodic = state.stCam.Periodic != 0;
  const double overshoot = target.place.position - (periodic ? ended.start : ended.end);
  uint32_t first = 0;
  const double joint =
      target.state.position -
      (periodic ? target.local -
                      state.fSlaveScaling * cam::evaluateCurve(ended, ended.start, true, first).y
                : 0.0);
  const motion::CamInputs inputs{block.MasterOffset, block.SlaveOffset, state.fMasterScaling,
                                 state.fSlaveScaling};
  cam::Curve curve;
  if (const int16_t error = motion::openCam(block.CamTableID, curve); error != axis::error::kNone)
    return error;
  // What is passed after the joint belongs to the other cam; it is reported in the next cycle.
  const cam::Place end{target.place.period, periodic ? ended.start : ended.end};
  follow(block, end, cycleStart);
  // Counted anew from here, so that no digits are lost.
  const motion::MasterMotion master = motion::beginMaster(state.stMaster, *block.Master);
  state.stCam = block.CamTableID;
  state.udiIndex = 0;
  const motion::CamStart start{cam::toDouble(master.position) - overshoot / state.fMasterScaling,
                               joint, state.stCam.SlaveAbsolute == 0};
  state.stFollow.fFirstOffset = slave.fOffsetPosition;
  if (const int16_t error = motion::enterCam(state, curve, inputs, start, master);
      error != axis::error::kNone)
    return error;
  if (!motion::evaluateCam(state, curve, master, slave, target))
    return axis::error::kOutOfRange;
  motion::MasterMotion atJoint = master;
  atJoint.position = {start.masterZero, 0.0};
  cam::beginTappets(state.stTappets, motion::placeInCam(state, curve, atJoint), cycleStart);
  return axis::error::kNone;
}

/// One cycle on the cam.
void go(Block &block, AxisRef &slave, int64_t cycleStart) noexcept {
  auto &state = block.stCam;
  if (slave.bMovedInThisCycle != 0)
    return;
  motion::alignFollowing(state.stFollow, slave);
  const motion::MasterMotion master = motion::readMaster(state.stMaster, *block.Master);
  cam::Curve curve;
  motion::CamTarget target;
  int16_t problem = motion::openCam(state.stCam, curve);
  if (problem == axis::error::kNone && !motion::evaluateCam(state, curve, master, slave, target))
    problem = axis::error::kOutOfRange;
  const axis::MotionState added = compensation(state);
  double way = 0.0;
  bool replaced = false;
  if (problem == axis::error::kNone) {
    way = (target.local - state.fLocal) +
          static_cast<double>(target.place.period - state.liPeriod) * target.rise +
          (added.position - state.fRamp);
    showEnd(block, target, master.travel * state.fMasterScaling);
    replaced = isReplaced(block, target);
    if (replaced) {
      problem = replace(block, slave, curve, target, cycleStart);
      way = motion::wayTo(state.stFollow, slave, target.state.position + added.position);
    }
  }
  if (problem != axis::error::kNone) {
    motion::fail(block.stBlock, &slave, problem);
    return;
  }
  write(block, slave, target, way, added);
  if (!replaced)
    follow(block, target.place, cycleStart);
}

} // namespace

void st::SM_PLCopen::MC_CamIn::body__(::stride::Ctx &ctx__) {
  switch (motion::beginCall(stBlock, Execute != 0, Slave)) {
  case motion::Call::Start:
    start(*this, *Slave, ctx__.cycleStartNs);
    break;
  case motion::Call::Go:
    if (motion::keep(stBlock, *Slave)) {
      if (Master == nullptr || stCam.stMaster.pAxis != Master)
        motion::fail(stBlock, Slave, axis::error::kAxisChanged);
      else
        go(*this, *Slave, ctx__.cycleStartNs);
    }
    break;
  case motion::Call::Idle:
    break;
  }
  if (stBlock.bRunning == 0)
    EndOfProfile = 0;
  InSync = stBlock.bRunning != 0 && stBlock.bWaiting == 0 && stCam.bRamping == 0;
  motion::showOutcome(*this);
}
