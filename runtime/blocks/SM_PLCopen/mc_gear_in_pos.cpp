// MC_GearInPos: a gear whose slave is at a place when the master is at another.
#include "runtime/axis/catch_up.hpp"
#include "runtime/axis/gear.hpp"
#include "runtime/axis/present_state.hpp"
#include "runtime/axis/run_follower.hpp"
#include "runtime/numeric/cam/approach.hpp"
#include "runtime/numeric/modulo_wrap.hpp"
#include "runtime/numeric/profile/profile.hpp"

#include "st/SM_PLCopen/MC_GearInPos.h"

namespace {

namespace axis = ::stride::axis;
namespace cam = ::stride::cam;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_GearInPos;
using motion::AxisRef;
using motion::MasterMotion;
using motion::Turn;

/// SMC_SYNC_STATE.iStage.
namespace stage {
constexpr int16_t kLurk = 0;
constexpr int16_t kHold = 1;
constexpr int16_t kWay = 2;
constexpr int16_t kCoupled = 3;
} // namespace stage

/// What became of an attempt to leave for the coupling.
struct Attempt {
  bool started;
  int16_t error;
};

constexpr Attempt kNotYet{false, axis::error::kNone};

/// Looks at the inputs and, if they are good, keeps them. An SMC_ERROR.
int16_t readInputs(Block &block) noexcept {
  if (block.RatioDenominator == 0)
    return ::st::SM_Error::SMC_ERROR__SMC_GI_RATIO_DENOM;
  if (!exact::isfinite(block.MasterSyncPosition) || !exact::isfinite(block.SlaveSyncPosition) ||
      !exact::isfinite(block.MasterStartDistance))
    return axis::error::kOutOfRange;
  block.stGear.fNumerator = static_cast<double>(block.RatioNumerator);
  block.stGear.fDenominator = static_cast<double>(block.RatioDenominator);
  block.stSync.fMasterSync = block.MasterSyncPosition;
  block.stSync.fSlaveSync = block.SlaveSyncPosition;
  block.stSync.fStartDistance = block.MasterStartDistance;
  block.stSync.bAvoidReversal = block.AvoidReversal;
  return axis::error::kNone;
}

/// This cycle's look at the master.
MasterMotion look(Block &block, bool first) noexcept {
  if (!first)
    return motion::readMaster(block.stMaster, *block.Master);
  const MasterMotion master = motion::beginMaster(block.stMaster, *block.Master);
  block.stSync.fVelocity = motion::cycleBefore(*block.Slave, master).velocity;
  block.stSync.fAcceleration = master.acceleration;
  return motion::sinceCycleBefore(*block.Slave, master);
}

/// How far the master has to go, in its direction `side`, from where it was in the cycle before to
/// MasterSyncPosition; not > 0 if it has passed that.
double distanceAhead(const Block &block, double side, double run) noexcept {
  const AxisRef &master = *block.Master;
  const auto &sync = block.stSync;
  const double left = side * (sync.fMasterSync - block.stMaster.fPosition) + run;
  if (!axis::isRotary(master))
    return left;
  const double period = master.fPositionPeriod;
  const double ahead = stride::numeric::wrapPosition(left, period);
  return ahead > 1e-9 * period ? ahead : ahead + period; // from the very place: a turn later
}

/// Puts the end of the way where it suits the slave's velocities best, or where it need not go
/// back. False if it must.
bool chooseTurns(const Block &block, const AxisRef &slave, cam::Approach &approach,
                 int64_t &turns) noexcept {
  const double direct = approach.end.y;
  turns = 0;
  if (!axis::isRotary(slave))
    return block.stSync.bAvoidReversal == 0 || !cam::reverses(approach);
  const double period = slave.fPositionPeriod;
  const double wanted = (cam::evenWay(approach) - direct) / period;
  const double best = exact::floor(wanted + 0.5);
  if (!(exact::fabs(best) < 1e9))
    return false;
  const double nearer = wanted < best ? -1.0 : 1.0;
  for (int i = 0; i < 6; ++i) { // best, then the ones beside it by turns
    const int away = (i + 1) / 2;
    const double step = (i % 2 != 0 ? nearer : -nearer) * away;
    turns = static_cast<int64_t>(best + step);
    approach.end.y = direct + (best + step) * period;
    if (block.stSync.bAvoidReversal == 0 || !cam::reverses(approach))
      return true;
  }
  return false;
}

/// Leaves for the coupling, from the slave's state `from`, if the master is near enough. That state
/// belongs to this cycle if `moved`, else to the one before.
Attempt leave(Block &block, const stride::numeric::MotionState &from, const MasterMotion &master,
              bool moved) noexcept {
  auto &sync = block.stSync;
  const AxisRef &slave = *block.Slave;
  if (master.travel == 0.0 && master.velocity == 0.0)
    return kNotYet;
  const double side = exact::signOf(master.travel != 0.0 ? master.travel : master.velocity);
  const double run = exact::fabs(master.travel);
  const double ahead = distanceAhead(block, side, run);
  const double distance = sync.fStartDistance;
  if (!(ahead > 0.0) || (distance > 0.0 && ahead - run > distance))
    return kNotYet;
  double length = ahead;
  if (axis::isRotary(*block.Master) && distance > ahead) {
    const double period = block.Master->fPositionPeriod;
    length += exact::floor((distance - ahead) / period) * period;
  }
  if (moved)
    length -= run;
  cam::Approach approach;
  if (!cam::placeOver({0.0, from.velocity, from.acceleration}, 0.0,
                      moved ? master.velocity : sync.fVelocity,
                      moved ? master.acceleration : sync.fAcceleration, approach.begin))
    return kNotYet;
  approach.end = {side * length, sync.fSlaveSync - from.position, motion::gearFactor(block.stGear),
                  0.0};
  int64_t turns = 0;
  if (!chooseTurns(block, slave, approach, turns))
    return {false, ::st::SM_Error::SMC_ERROR__SMC_GIP_SLAVE_REVERSAL_CANNOT_BE_AVOIDED};
  const cam::Total begin =
      moved ? master.position : ::stride::detail::add(master.position, {-master.travel, 0.0});
  sync.fBegin = begin.hi;
  sync.fBeginRest = begin.lo;
  sync.fLength = approach.end.x;
  sync.fFrom = from.position;
  sync.fOffset = slave.fOffsetPosition;
  sync.fSlope = approach.begin.v;
  sync.fCurvature = approach.begin.a;
  sync.fWay = approach.end.y;
  sync.liTurns = turns;
  sync.fDone = 0.0;
  sync.iStage = stage::kWay;
  return {true, axis::error::kNone};
}

/// Writes the set values of a cycle on the way. An SMC_ERROR: the master turned back, or the slave
/// would have to be nowhere.
int16_t moveOnWay(Block &block, AxisRef &slave, const MasterMotion &master) noexcept {
  auto &sync = block.stSync;
  const double side = exact::signOf(sync.fLength);
  const double length = exact::fabs(sync.fLength);
  const cam::Total begin{sync.fBegin, sync.fBeginRest};
  const double x = cam::toDouble(::stride::detail::add(master.position, {-begin.hi, -begin.lo}));
  // Actual values tremble: they have to be back where the way began.
  if (side * (block.stMaster.bActual != 0 ? x : master.travel) < -1e-9 * length)
    return ::st::SM_Error::SMC_ERROR__SMC_GIP_MASTER_DIRECTION_CHANGE;
  const double shift = slave.fOffsetPosition - sync.fOffset;
  if (side * x >= length || !(side * sync.fLength > 0.0)) {
    const double period = axis::isRotary(slave) ? slave.fPositionPeriod : 0.0;
    motion::engageGear(
        block.stGear, slave, ::stride::detail::add(begin, {sync.fLength, 0.0}),
        ::stride::detail::add(cam::totalOf(sync.liTurns, period, sync.fSlaveSync), {shift, 0.0}),
        ::stride::detail::twoSum(sync.fFrom + shift, sync.fDone));
    sync.iStage = stage::kCoupled;
    motion::turnGear(block.stGear, block.stFollow, slave, master);
    return axis::error::kNone;
  }
  const cam::Node left{0.0, 0.0, sync.fSlope, sync.fCurvature};
  const cam::Node right{sync.fLength, sync.fWay, motion::gearFactor(block.stGear), 0.0};
  const cam::Point place = cam::evaluateQuintic(left, right, x);
  stride::numeric::MotionState now = cam::motionOver(place, master.velocity, master.acceleration);
  now.position += sync.fFrom + shift;
  if (!motion::isFinite(now))
    return axis::error::kOutOfRange;
  motion::followState(block.stFollow, slave, now, place.y - sync.fDone);
  sync.fDone = place.y;
  return axis::error::kNone;
}

/// One cycle of a slave that is the block's.
void move(Block &block, AxisRef &slave, const MasterMotion &master, bool moved) noexcept {
  auto &sync = block.stSync;
  auto &follow = block.stFollow;
  motion::alignFollowing(follow, slave);
  if (sync.iStage == stage::kHold) {
    const stride::numeric::MotionState from{follow.fPosition, follow.fVelocity,
                                            follow.fAcceleration};
    const Attempt attempt = leave(block, from, master, moved);
    if (attempt.error != axis::error::kNone) {
      motion::fail(block.stBlock, &slave, attempt.error);
      return;
    }
  }
  if (moved)
    return;
  if (sync.iStage == stage::kHold) {
    const double way = follow.fVelocity * slave.fTaskCycle;
    motion::followState(follow, slave, {follow.fPosition + way, follow.fVelocity, 0.0}, way);
  } else if (sync.iStage == stage::kCoupled) {
    motion::turnGear(block.stGear, follow, slave, master);
  } else if (const int16_t error = moveOnWay(block, slave, master); error != axis::error::kNone) {
    motion::fail(block.stBlock, &slave, error);
  }
}

/// Remembers how the master was.
void note(Block &block, const MasterMotion &master) noexcept {
  block.stSync.fVelocity = master.velocity;
  block.stSync.fAcceleration = master.acceleration;
}

/// One cycle after callFollower.
void drive(Block &block, AxisRef &slave, Turn turn) noexcept {
  const bool moved = slave.bMovedInThisCycle != 0;
  if (turn == Turn::Move && moved)
    return;
  if (turn == Turn::Begin)
    block.stSync.iStage = stage::kHold;
  const MasterMotion master = look(block, turn == Turn::Begin);
  move(block, slave, master, moved);
  note(block, master);
  if (block.stBlock.bRunning != 0)
    motion::showReached(block.stBlock, slave, block.stSync.iStage == stage::kCoupled);
}

/// One cycle in which the master may come near, and others move the slave until it does.
void lurk(Block &block, AxisRef &slave, bool first) noexcept {
  auto &state = block.stBlock;
  if (slave.nAxisState == axis::state::kErrorStop) {
    motion::fail(state, &slave, static_cast<int16_t>(slave.stPlanner.wStopReason));
    return;
  }
  if (!axis::isPowered(slave)) {
    motion::fail(state, &slave, axis::error::kNotPowered);
    return;
  }
  if (slave.ulOwnerCount > state.ulOwner) { // a command that was given later
    motion::abort(state);
    return;
  }
  const bool moved = slave.bMovedInThisCycle != 0;
  const MasterMotion master = look(block, first);
  const Attempt attempt = leave(block, axis::presentState(slave), master, moved);
  if (attempt.error != axis::error::kNone) {
    motion::fail(state, &slave, attempt.error);
  } else if (attempt.started) {
    motion::beginFollowing(block.stFollow, state, slave);
    move(block, slave, master, moved);
  }
  note(block, master);
  if (state.bRunning != 0 && attempt.started)
    motion::showReached(state, slave, block.stSync.iStage == stage::kCoupled);
}

/// At a rising edge with good inputs.
void start(Block &block, AxisRef &slave) noexcept {
  auto &state = block.stBlock;
  const bool owner = state.bRunning != 0 && axis::ownsAxis(slave, state.ulOwner);
  block.stMaster.pAxis = block.Master;
  if (block.BufferMode != ::st::SM_DriveBasic::MC_BUFFER_MODE__Aborting || owner) {
    block.stSync.iStage = stage::kHold;
    if (motion::startFollower(state, block.stFollow, slave, block.BufferMode) == Turn::Begin)
      drive(block, slave, Turn::Begin);
    return;
  }
  motion::withdrawFollower(state, slave);
  state.ulOwner = axis::drawOwner(slave);
  state.bRunning = 1;
  state.bWaiting = 1;
  state.bReached = 0;
  block.stSync.iStage = stage::kLurk;
  lurk(block, slave, true);
}

void run(Block &block) noexcept {
  auto &state = block.stBlock;
  AxisRef *slave = block.Slave;
  switch (motion::beginCall(state, block.Execute != 0, slave)) {
  case motion::Call::Start: {
    int16_t problem = motion::couplingRefusal(block.Master, *slave, block.BufferMode);
    if (problem == axis::error::kNone)
      problem = readInputs(block);
    if (problem != axis::error::kNone)
      motion::fail(state, slave, problem);
    else
      start(block, *slave);
    break;
  }
  case motion::Call::Go:
    if (block.Master != block.stMaster.pAxis)
      motion::fail(state, slave, axis::error::kAxisChanged);
    else if (state.bWaiting != 0 && block.stSync.iStage == stage::kLurk)
      lurk(block, *slave, false);
    else if (const Turn turn = motion::continueFollower(state, block.stFollow, *slave);
             turn != Turn::None)
      drive(block, *slave, turn);
    break;
  case motion::Call::Idle:
    break;
  }
}

} // namespace

void st::SM_PLCopen::MC_GearInPos::body__(::stride::Ctx & /*ctx__*/) {
  run(*this);
  StartSync = stBlock.bRunning != 0 && stSync.iStage == stage::kWay;
  InSync = stBlock.bDone;
  motion::showOutcome(*this);
}
