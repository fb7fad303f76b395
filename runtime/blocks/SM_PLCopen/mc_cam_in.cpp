// MC_CamIn: a slave follows its master by a cam.
#include "runtime/axis/cam/cam_entry.hpp"
#include "runtime/axis/cam/tappets.hpp"
#include "runtime/axis/run_follower.hpp"
#include "runtime/axis/set_point.hpp"
#include "runtime/iec/ctx.h"

#include "st/SM_PLCopen/MC_CamIn.h"

namespace {

namespace axis = ::stride::axis;
namespace cam = ::stride::cam;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_CamIn;
using motion::AxisRef;

motion::CamCommand commandOf(const Block &block) noexcept {
  motion::CamCommand command{};
  command.stCam = block.CamTableID;
  command.fMasterOffset = block.MasterOffset;
  command.fSlaveOffset = block.SlaveOffset;
  command.fMasterScaling = block.MasterScaling;
  command.fSlaveScaling = block.SlaveScaling;
  command.fVelocity = block.VelocityDiff;
  command.fAcceleration = block.Acceleration;
  command.fDeceleration = block.Deceleration;
  command.fJerk = block.Jerk;
  command.fStartDistance = block.MasterStartDistance;
  command.fSyncPosition = block.MasterSyncPosition;
  command.fHysteresis = block.TappetHysteresis;
  command.eStartMode = block.StartMode;
  return command;
}

/// The way of the slave in this cycle before this call: another block may have moved it.
double earlierTravel(const AxisRef &slave) noexcept {
  if (slave.bMovedInThisCycle == 0)
    return 0.0;
  return slave.bTravelGiven != 0
             ? slave.fTravel
             : 0.5 * (slave.fSaveVelocity + slave.fSetVelocity) * slave.fTaskCycle;
}

cam::TappetList tappetsOf(const motion::CamId &id) noexcept {
  return cam::tappetsOf(*id.pCam, id.Periodic != 0);
}

/// Which tappets the master passes on its way to `place` in the running cam.
void follow(motion::CamState &state, const cam::Place &place, int64_t now) noexcept {
  cam::followTappets(state.stTappets, tappetsOf(state.stTappetCam), place,
                     state.stCommand.fHysteresis, now);
}

/// Tells SMC_GetTappetValue what has been passed, in the cam that has ended first.
void report(Block &block) noexcept {
  auto &state = block.stCam;
  cam::beginReport(block.Tappets);
  if (state.stEndedTappets.bPending != 0)
    cam::reportTappets(block.Tappets, state.stEndedTappets, tappetsOf(state.stEndedCam));
  if (state.stTappets.bPending != 0)
    cam::reportTappets(block.Tappets, state.stTappets, tappetsOf(state.stTappetCam));
}

/// When the master was `beyond` [master u] before where it is now, on its way of `travel` in a
/// cycle of `cycle` [s]. [ns]
int64_t timeOfJoint(double cycle, double beyond, double travel, int64_t now) noexcept {
  if (!(beyond * travel > 0.0))
    return now;
  const double cycles = beyond / travel;
  return now - static_cast<int64_t>((cycles < 2.0 ? cycles : 2.0) * cycle * 1e9 + 0.5);
}

/// The command's cam begins, and the way onto it. Does not need the slave to belong to the block.
/// An SMC_ERROR.
int16_t enter(motion::CamState &state, cam::Curve &curve, AxisRef &slave, AxisRef &master,
              motion::CamTarget &target, const motion::CamJoint *joint = nullptr) noexcept {
  const int16_t problem = motion::startCam(state, curve, slave, master, target, joint);
  return problem != axis::error::kNone ? problem : motion::beginEntry(state, curve, slave, target);
}

/// What is wrong with the command at its rising edge. One that waits for its turn finds out then
/// whether the master is within the cam.
int16_t check(Block &block) noexcept {
  const motion::CamCommand command = commandOf(block);
  cam::Curve curve;
  int16_t problem = motion::openCam(command.stCam, curve);
  if (problem == axis::error::kNone)
    problem = motion::checkCamInputs(command);
  if (problem == axis::error::kNone)
    problem = motion::checkEntry(*block.Slave, command);
  if (problem == axis::error::kNone &&
      block.BufferMode == ::st::SM_DriveBasic::MC_BUFFER_MODE__Aborting) {
    motion::CamState trial = block.stCam;
    trial.stCommand = command;
    motion::CamTarget target;
    problem = enter(trial, curve, *block.Slave, *block.Master, target);
  }
  if (problem == axis::error::kNone)
    block.stCam.stCommand = command;
  return problem;
}

/// Writes the slave's set values, `way` [u] from the last ones; false if they are no numbers.
bool write(Block &block, AxisRef &slave, const motion::CamTarget &target,
           const stride::numeric::MotionState &set, double way) noexcept {
  if (!exact::isfinite(set.position) || !exact::isfinite(set.velocity) ||
      !exact::isfinite(set.acceleration) || !exact::isfinite(way))
    return false;
  auto &state = block.stCam;
  motion::followState(state.stFollow, slave, set, way);
  state.liPeriod = target.place.period;
  state.fLocal = target.local;
  return true;
}

/// Where the cam has ended that this command has waited for; `travel` becomes the master's way in
/// this cycle. [master u] False: it has waited for none, or for one of another master.
bool takeJoint(const Block &block, AxisRef &slave, motion::CamJoint &joint,
               double &travel) noexcept {
  auto &left = slave.stCamJoint;
  if (left.ulOwner == 0 || left.ulOwner != block.stBlock.ulOwner ||
      left.stMaster.pAxis != block.Master)
    return false;
  left.ulOwner = 0;
  const motion::MasterMotion since = motion::readMaster(left.stMaster, *block.Master);
  joint = {left.fBeyond + since.travel, left.fSlave};
  travel = since.velocity * slave.fTaskCycle;
  return true;
}

/// The tappets of the command's cam count from where the master was at the start, at `time`.
void beginTappets(Block &block, const cam::Curve &curve, double beyond, int64_t time,
                  const cam::Place &now, int64_t cycleStart) noexcept {
  auto &state = block.stCam;
  state.stTappetCam = state.stCommand.stCam;
  if (beyond == 0.0) {
    cam::beginTappets(state.stTappets, now, cycleStart);
    return;
  }
  motion::MasterMotion start{};
  start.position = {state.stMaster.fPosition - beyond, 0.0};
  cam::beginTappets(state.stTappets, motion::placeInCam(state, curve, start), time);
  follow(state, now, cycleStart);
}

/// The slave is the block's: its first set values, also if another block has moved it already in
/// this cycle.
int16_t begin(Block &block, AxisRef &slave, int64_t cycleStart) noexcept {
  auto &state = block.stCam;
  motion::CamTarget target;
  stride::numeric::MotionState set;
  cam::Curve curve;
  motion::CamJoint joint{};
  double travel = 0.0;
  const bool goesOn = takeJoint(block, slave, joint, travel);
  int16_t problem = enter(state, curve, slave, *block.Master, target, goesOn ? &joint : nullptr);
  if (problem == axis::error::kNone)
    problem = motion::stepEntry(state, curve, slave, target, set);
  if (problem != axis::error::kNone)
    return problem;
  const double way = motion::wayTo(state.stFollow, slave, set.position) + earlierTravel(slave);
  if (!write(block, slave, target, set, way))
    return axis::error::kOutOfRange;
  state.stEndedTappets.bPending = 0;
  ++block.Tappets.udiRestarts;
  const int64_t time = timeOfJoint(slave.fTaskCycle, joint.beyond, travel, cycleStart);
  beginTappets(block, curve, joint.beyond, time, target.place, cycleStart);
  report(block);
  block.EndOfProfile = 0;
  return axis::error::kNone;
}

void showEnd(Block &block, const motion::CamTarget &target, double travel) noexcept {
  const auto &state = block.stCam;
  const motion::CamId &id = state.stCommand.stCam;
  if (id.Periodic != 0) {
    block.EndOfProfile = target.place.period != state.liPeriod;
    return;
  }
  const double x = target.place.position;
  const bool still = travel == 0.0 && block.EndOfProfile != 0;
  block.EndOfProfile = target.outside || (x >= id.pCam->xEnd && (travel > 0.0 || still)) ||
                       (x <= id.pCam->xStart && (travel < 0.0 || still));
}

bool isSame(const motion::CamId &a, const motion::CamId &b) noexcept {
  return a.pCam == b.pCam && a.Periodic == b.Periodic && a.MasterAbsolute == b.MasterAbsolute &&
         a.SlaveAbsolute == b.SlaveAbsolute;
}

/// Whether the cam has come to its end, forwards (who comes back to the start has not), and the
/// program has given another one. After showEnd: exactly at the end counts for both, so that
/// EndOfProfile is TRUE once.
bool isReplaced(const Block &block, const motion::CamTarget &target) noexcept {
  const auto &state = block.stCam;
  const motion::CamId &id = state.stCommand.stCam;
  const bool ended =
      id.Periodic != 0
          ? target.place.period > state.liPeriod && target.place.period > state.liFirstPeriod
          : block.EndOfProfile != 0 && target.place.position >= id.pCam->xEnd;
  return ended && motion::phaseOf(state) == motion::CamPhase::OnCam &&
         block.CamTableID.pCam != nullptr && !isSame(block.CamTableID, id);
}

/// The end of the running cam, and what came after it.
struct End {
  bool now;               ///< The master has come to it in this cycle ...
  int64_t time;           ///< ... then. [ns]
  cam::Place place;       ///< In the cam that has ended.
  motion::CamJoint joint; ///< For the cam that goes on.
};

/// The running cam has come to its end in this cycle, on the master's way of `travel`. [master u]
End endOf(const motion::CamState &state, const cam::Curve &curve, const motion::CamTarget &target,
          double travel, int64_t cycleStart) noexcept {
  const motion::CamCommand &command = state.stCommand;
  const bool periodic = command.stCam.Periodic != 0;
  const bool forwards = travel * command.fMasterScaling >= 0.0;
  // A periodic cam has begun again: its end is the start of the period it is in.
  const double place = forwards != periodic ? curve.end : curve.start;
  motion::CamJoint joint{};
  joint.beyond = (target.place.position - place) / command.fMasterScaling;
  joint.slave = target.state.position;
  if (periodic) {
    uint32_t index = 0;
    const double there = cam::evaluateCurve(curve, place, true, index).y;
    joint.slave -= target.local - command.fSlaveScaling * there;
  }
  const int64_t time =
      timeOfJoint(state.stMaster.pAxis->fTaskCycle, joint.beyond, travel, cycleStart);
  return {true, time, {target.place.period, place}, joint};
}

/// The other cam begins where the running one has ended, earlier in this cycle. `target` becomes
/// the other one's.
int16_t replace(Block &block, AxisRef &slave, const End &end, motion::CamTarget &target,
                int64_t cycleStart) noexcept {
  auto &state = block.stCam;
  auto &command = state.stCommand;
  follow(state, end.place, end.time);
  if (state.stEndedTappets.bPending == 0) {
    state.stEndedTappets = state.stTappets;
    state.stEndedCam = state.stTappetCam;
  }
  cam::Curve curve;
  if (const int16_t error = motion::openCam(block.CamTableID, curve); error != axis::error::kNone)
    return error;
  command.stCam = block.CamTableID;
  state.udiIndex = 0;
  // Counted anew from here, so that no digits are lost.
  const motion::MasterMotion master = motion::beginMaster(state.stMaster, *block.Master);
  state.stFollow.fFirstOffset = slave.fOffsetPosition;
  const motion::CamStart start{cam::toDouble(master.position) - end.joint.beyond, end.joint.slave,
                               command.stCam.SlaveAbsolute == 0};
  if (const int16_t error = motion::enterCam(state, curve, start, master);
      error != axis::error::kNone)
    return error;
  if (!motion::evaluateCam(state, curve, master, slave, target))
    return axis::error::kOutOfRange;
  beginTappets(block, curve, end.joint.beyond, end.time, target.place, cycleStart);
  return axis::error::kNone;
}

/// One cycle of the running block; `end` becomes where its cam has ended if no other one goes on.
/// An SMC_ERROR.
int16_t go(Block &block, AxisRef &slave, End &end, int64_t cycleStart) noexcept {
  auto &state = block.stCam;
  motion::alignFollowing(state.stFollow, slave);
  const motion::MasterMotion master = motion::readMaster(state.stMaster, *block.Master);
  cam::Curve curve;
  if (const int16_t error = motion::openCam(state.stCommand.stCam, curve);
      error != axis::error::kNone)
    return error;
  motion::CamTarget target;
  if (!motion::evaluateCam(state, curve, master, slave, target))
    return axis::error::kOutOfRange;
  const bool over = block.EndOfProfile != 0 && state.stCommand.stCam.Periodic == 0;
  showEnd(block, target, master.travel * state.stCommand.fMasterScaling);
  if (block.EndOfProfile != 0) // who has come to the end before goes on from where the master is
    end = over ? End{false, cycleStart, target.place, {0.0, target.state.position}}
               : endOf(state, curve, target, master.travel, cycleStart);
  const bool replaced = isReplaced(block, target);
  if (replaced) {
    if (const int16_t error = replace(block, slave, end, target, cycleStart);
        error != axis::error::kNone)
      return error;
    end.now = false;
  }
  const motion::CamPhase phase = motion::phaseOf(state);
  const double ramp = state.fRamp;
  stride::numeric::MotionState set;
  if (const int16_t error = motion::stepEntry(state, curve, slave, target, set);
      error != axis::error::kNone)
    return error;
  // On the cam the way is known, however many turns it is; else the slave is nearer than a turn.
  double way = 0.0;
  if (!replaced && (phase == motion::CamPhase::OnCam || phase == motion::CamPhase::Compensating))
    way = (target.local - state.fLocal) +
          static_cast<double>(target.place.period - state.liPeriod) * target.rise +
          (state.fRamp - ramp);
  else
    way = motion::wayTo(state.stFollow, slave, set.position);
  if (!write(block, slave, target, set, way))
    return axis::error::kOutOfRange;
  // What comes after the end is passed by the cam that goes on.
  if (end.now && slave.stQueue.uiCount > 0)
    follow(state, end.place, end.time);
  else if (!replaced)
    follow(state, target.place, cycleStart);
  report(block);
  return axis::error::kNone;
}

} // namespace

void st::SM_PLCopen::MC_CamIn::body__(::stride::Ctx &ctx__) {
  const motion::Turn turn =
      motion::callFollower(stBlock, stCam.stMaster, stCam.stFollow, Execute != 0, Master, Slave,
                           BufferMode, [this] { return check(*this); });
  int16_t problem = axis::error::kNone;
  End end{};
  if (turn == motion::Turn::Begin)
    problem = begin(*this, *Slave, ctx__.cycleStartNs);
  else if (turn == motion::Turn::Move && Slave->bMovedInThisCycle == 0)
    problem = go(*this, *Slave, end, ctx__.cycleStartNs);
  else if (stBlock.bRunning == 0 &&
           (stCam.stTappets.bPending != 0 || stCam.stEndedTappets.bPending != 0))
    report(*this); // what the finished command has not reported yet
  if (problem != axis::error::kNone) {
    motion::fail(stBlock, Slave, problem);
  } else if (turn != motion::Turn::None) {
    const bool shown = stBlock.bReached != 0;
    motion::noteReached(stBlock, motion::phaseOf(stCam) == motion::CamPhase::OnCam);
    if (EndOfProfile != 0 && turn == motion::Turn::Move && motion::passOn(stBlock, *Slave, shown) &&
        end.now)
      Slave->stCamJoint = {Slave->ulOwnerCount, stCam.stMaster, end.joint.beyond, end.joint.slave};
  }
  if (stBlock.bRunning == 0)
    EndOfProfile = 0;
  InSync = stBlock.bDone;
  motion::showOutcome(*this);
}
