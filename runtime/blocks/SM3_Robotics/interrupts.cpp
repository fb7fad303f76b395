// Movements that are interrupted and continued: MC_GroupInterrupt, MC_GroupContinue,
// SMC_GroupSaveContinueData, SMC_GroupUpdateContinueData, SMC_GroupEnableResumeAfterError,
// SMC_GroupGetContinuePosition, SMC_GroupGetContinueToolOffset.
#include "runtime/axis/set_point.hpp"
#include "runtime/blocks/SM3_Robotics/carriers.hpp"
#include "runtime/blocks/SM3_Robotics/group_block.hpp"
#include "runtime/blocks/SM3_Robotics/planning.hpp"
#include "runtime/blocks/SM3_Robotics/tool_led.hpp"
#include "runtime/numeric/group/kept_path.hpp"

#include "st/SM3_Robotics/MC_GroupContinue.h"
#include "st/SM3_Robotics/MC_GroupInterrupt.h"
#include "st/SM3_Robotics/SMC_AXIS_GROUP_CONTINUE_DATA.h"
#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"
#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"
#include "st/SM3_Robotics/SMC_GroupEnableResumeAfterError.h"
#include "st/SM3_Robotics/SMC_GroupGetContinuePosition.h"
#include "st/SM3_Robotics/SMC_GroupGetContinueToolOffset.h"
#include "st/SM3_Robotics/SMC_GroupSaveContinueData.h"
#include "st/SM3_Robotics/SMC_GroupUpdateContinueData.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;
using DataRef = decl::SMC_AXIS_GROUP_CONTINUE_DATA;

/// Where movements can be continued; on a system that moves, SMC_GroupUpdateContinueData says where
/// that is now. Trivially copyable.
struct ContinuePlace {
  uint64_t check; ///< Of all that follows.
  double axes[kAxes];
};

/// What SMC_AXIS_GROUP_CONTINUE_DATA holds. Trivially copyable.
struct ContinueData {
  ContinuePlace place;
  uint64_t check;       ///< Of all that follows.
  int64_t rides;        ///< In which moving system the path is, 1 or 2; 0: in the machine.
  group::Pose toolPose; ///< Where the tool is in that.
  group::Pose endPose;  ///< See GroupState.
  int32_t joints, axes;
  int32_t requests; ///< Those that waited, the first one first.
  Tool tool;
  double end[kAxes]; ///< See GroupState.
  group::KeptPath path;
  Request request[kRequests];
};
static_assert(sizeof(ContinueData) <= sizeof(DataRef::aData));
static_assert(alignof(ContinueData) <= alignof(uint64_t));

ContinueData &contentOf(DataRef &data) noexcept {
  return *reinterpret_cast<ContinueData *>(&data.aData);
}
const ContinueData &contentOf(const DataRef &data) noexcept {
  return *reinterpret_cast<const ContinueData *>(&data.aData);
}

/// A number that other bytes hardly have; never 0.
uint64_t checkOf(const char *begin, const char *end) noexcept {
  constexpr uint64_t kFactor = 0x9E3779B97F4A7C15U;
  constexpr unsigned kShift = 29;
  uint64_t sum = kFactor;
  for (; begin < end; begin += sizeof(uint64_t)) {
    uint64_t word = 0;
    __builtin_memcpy(&word, begin, sizeof word);
    sum = (sum ^ word) * kFactor;
    sum ^= sum >> kShift;
  }
  return sum | 1U;
}

uint64_t checkOf(const ContinueData &content) noexcept {
  static_assert(sizeof(ContinueData) % sizeof(uint64_t) == 0);
  return checkOf(reinterpret_cast<const char *>(&content.rides),
                 reinterpret_cast<const char *>(&content + 1));
}
uint64_t checkOf(const ContinuePlace &place) noexcept {
  return checkOf(reinterpret_cast<const char *>(&place.axes),
                 reinterpret_cast<const char *>(&place + 1));
}

void setPlace(ContinuePlace &place, const double (&axes)[kAxes]) noexcept {
  __builtin_memcpy(place.axes, axes, sizeof place.axes);
  place.check = checkOf(place);
}

/// Writes what can be continued from where the group is now.
void save(const GroupRef &group, DataRef &data) noexcept {
  const GroupState &state = stateOf(group);
  ContinueData &content = contentOf(data);
  __builtin_memset(static_cast<void *>(&content), 0, sizeof content);
  content.joints = group.uiJoints;
  content.axes = group.uiAxes;
  content.tool = group.bOwns != 0 || state.motion.abandoned ? state.tool : toolOf(group);
  content.rides = group::isCarried(state.motion) ? state.rides : 0;
  content.toolPose = state.motion.tool;
  content.endPose = state.endPose;
  for (int32_t k = 0; k < kAxes; ++k)
    content.end[k] = state.end[k];
  group::keepPath(state.motion, content.path);
  const bool stopped = state.motion.abandoned;
  const int64_t first = stopped ? state.abortedRequest : state.firstRequest;
  const int64_t next = stopped ? state.abortedEnd : state.nextRequest;
  for (int64_t k = first; k < next && content.requests < kRequests; ++k)
    content.request[content.requests++] = requestAt(state, k);
  const bool rests = group.bOwns == 0 && !stopped;
  for (int32_t i = 0; rests && i < group.uiAxes; ++i) // the movements may be from somewhere else
    content.path.axes[placeOf(group, i)] = group.apAxis.v[i]->fSetPosition;
  if (rests)
    content.path.first = content.path.next = content.path.looked;
  setPlace(content.place, content.path.axes);
  content.check = checkOf(content);
}

/// Adds what has been asked for after that in the same cycle, from a number of requests on: until
/// it was aborted.
void saveMore(const GroupRef &group, int64_t first, uint64_t cycle, DataRef &data) noexcept {
  const GroupState &state = stateOf(group);
  ContinueData &content = contentOf(data);
  if (state.nextRequest - first > kRequestRing)
    return;
  for (int64_t k = first; k < state.nextRequest && content.requests < kRequests; ++k) {
    const Request &request = requestAt(state, k);
    if (request.cycle != cycle || aborts(request))
      break;
    content.request[content.requests++] = request;
  }
  content.check = checkOf(content);
}

bool isValid(const GroupRef &group, const DataRef &data) noexcept {
  const ContinueData &content = contentOf(data);
  return content.check != 0 && content.joints == group.uiJoints && content.axes == group.uiAxes &&
         content.check == checkOf(content) && content.place.check == checkOf(content.place);
}

/// Whether all axes stand where movements can be continued, but for rounding.
bool isAt(const GroupRef &group, const ContinueData &content) noexcept {
  constexpr double kPart = 1e-6; // of the way of a cycle at the greatest velocity
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    const axis::AxisRef &axis = *group.apAxis.v[i];
    const double place = axis::shownPosition(axis, content.place.axes[placeOf(group, i)]);
    const double apart = exact::fabs(axis.fSetPosition - place);
    if (!(apart <= kPart * axis.fSWMaxVelocity * axis.fTaskCycle))
      return false;
  }
  return true;
}

void putBack(GroupState &state, const ContinueData &content) noexcept {
  if (content.rides == 0) {
    group::resume(state.motion, content.path);
  } else {
    group::resumeCarried(state.motion, content.path);
    for (int32_t k = 0; k < kAxes; ++k) {
      state.motion.lookedReference[k] += content.place.axes[k] - content.path.axes[k];
      state.motion.axes[k] = content.place.axes[k];
    }
    state.motion.tool = content.toolPose;
    state.endPose = content.endPose;
  }
  state.suspendedIn = 0;
  state.uncapped = path::endOf(state.motion.motion.course);
  state.tool = content.tool;
  for (int32_t k = 0; k < kAxes; ++k)
    state.end[k] = content.end[k];
  for (int32_t i = 0; i < content.requests; ++i) {
    const Request &request = content.request[i];
    requestAt(state, state.nextRequest) = request;
    ++state.nextRequest;
    group::setOutcome(state.motion, request.id, group::Outcome::Waiting);
  }
}

/// Whether the group rests on the system in which a path was, without movements: an SMC_ERROR if
/// not.
int16_t whyNotOnSystem(const GroupRef &group, const ContinueData &content) noexcept {
  const GroupState &state = stateOf(group);
  if (!takesMovements(group) || state.firstRequest < state.nextRequest ||
      state.motion.first < state.motion.next)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  const bool follows =
      state.rides == content.rides && state.motion.ride.inSync && group::isStill(state.motion.left);
  return follows ? int16_t{0} : error::SMC_ERROR__SMC_AXIS_GROUP_CONTINUE_POSITION;
}

/// An SMC_ERROR.
int16_t goOn(GroupRef &group, const DataRef &data) noexcept {
  const bool carried = contentOf(data).rides != 0;
  if (!carried && group.eState != decl::SMC_AXIS_GROUP_STATE__GroupStandby)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  if (!isValid(group, data))
    return error::SMC_ERROR__SMC_AXIS_GROUP_CONTINUE_DATA_INVALID;
  if (carried)
    if (const int16_t wrong = whyNotOnSystem(group, contentOf(data)); wrong != 0)
      return wrong;
  if (const int16_t wrong = whyNotReady(group); wrong != 0)
    return wrong;
  const ContinueData &content = contentOf(data);
  if (!isAt(group, content))
    return error::SMC_ERROR__SMC_AXIS_GROUP_CONTINUE_POSITION;
  if (content.path.first == content.path.next && content.requests == 0)
    return 0;
  beginMoving(group);
  putBack(stateOf(group), content);
  return 0;
}

bool isStopping(const GroupRef &group) noexcept {
  return group.eState == decl::SMC_AXIS_GROUP_STATE__GroupStopping;
}

/// The movements wait to be continued, and the group is in standby.
void finishInterrupt(GroupRef &group, DataRef &data) noexcept {
  GroupState &state = stateOf(group);
  save(group, data);
  for (; state.firstRequest < state.nextRequest; ++state.firstRequest)
    group::setOutcome(state.motion, requestAt(state, state.firstRequest).id,
                      group::Outcome::Interrupted);
  const bool carried = group::isCarried(state.motion);
  if (!state.motion.abandoned)
    group::suspend(state.motion);
  state.interrupting = false;
  state.suspendedIn = carried ? state.rides : 0;
  if (!carried)
    endMoving(group);
}

/// Whether the group rests on its path, which may go on with a system.
bool restsOnPath(const GroupRef &group) noexcept {
  const GroupState &state = stateOf(group);
  return group::isCarried(state.motion) ? group::isAtRest(state.motion) : rests(group);
}

/// Whether a path in a system that moves cannot be interrupted now: while it is got to or left
/// nobody knows where it would go on. Another task plans for where the system was.
bool isNotResumable(const GroupRef &group) noexcept {
  const GroupState &state = stateOf(group);
  return group::isCarried(state.motion) &&
         (isPlannedAside(group) || state.rides == 0 || !state.motion.ride.inSync ||
          !group::isStill(state.motion.left));
}

/// The rising edge of MC_GroupInterrupt.
void beginInterrupt(decl::MC_GroupInterrupt &block, GroupRef &group) noexcept {
  GroupState &state = stateOf(group);
  const bool ending = group.bOwns != 0 && state.motion.abandoned;
  block.CommandAborted = isStopping(group) || state.interrupting || ending;
  if (block.CommandAborted != 0)
    return;
  if (!takesMovements(group)) {
    setError(block, error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE);
    return;
  }
  if (isNotResumable(group)) {
    setError(block, error::SMC_ERROR__SMC_AXIS_GROUP_NOT_RESUMABLE);
    return;
  }
  setBraking(state, Request{});
  state.interrupting = true;
  block.stBlock.bRunning = 1;
}

void runInterrupt(Ctx &ctx, decl::MC_GroupInterrupt &block) {
  if (block.AxisGroup != nullptr)
    serve(ctx, *block.AxisGroup);
  const bool rising = rises(block);
  if (rising || (block.Execute == 0 && block.stBlock.bRunning == 0)) {
    setError(block, 0);
    block.Done = block.CommandAborted = 0;
    block.mvtIdInterruptPosition = 0;
  }
  if (rising && (block.AxisGroup == nullptr || block.continueData == nullptr))
    setError(block, kNoGroup);
  else if (rising)
    beginInterrupt(block, *block.AxisGroup);
  if (block.stBlock.bRunning != 0) {
    GroupRef &group = *block.AxisGroup;
    const bool holds = stateOf(group).interrupting;
    block.CommandAborted = !holds;
    block.Done = holds && (group.bOwns == 0 || restsOnPath(group));
    if (block.Done != 0) {
      finishInterrupt(group, *block.continueData);
      block.mvtIdInterruptPosition = group::keptMovement(contentOf(*block.continueData).path);
    }
    block.stBlock.bRunning = holds && block.Done == 0;
  }
  block.Busy = block.stBlock.bRunning;
}

/// Says where a path on a system that moves can be continued now. An SMC_ERROR.
int16_t update(Ctx &ctx, GroupRef &group, DataRef &data) {
  ContinueData &content = contentOf(data);
  if (content.check == 0 || content.rides < 1 || content.rides > kCarriers ||
      content.place.check != checkOf(content.place) || content.joints != group.uiJoints ||
      content.axes != group.uiAxes)
    return 0; // there is nothing to update
  GroupArm arm(ctx, group);
  arm.setTool(content.tool);
  if (const int16_t wrong = whyNoTool(group, arm); wrong != 0)
    return wrong;
  kinematics::Frame<double> system;
  (void)systemInMachine(group, systemNumber(static_cast<int32_t>(content.rides)), system);
  double axes[kAxes];
  __builtin_memcpy(axes, content.place.axes, sizeof axes);
  const kinematics::Configuration stands = arm.arm.kinematics.configurationOf(content.place.axes);
  if (const int16_t wrong = axesFor(arm.arm, system * group::frameOf(content.toolPose), stands,
                                    content.place.axes, axes);
      wrong != 0)
    return wrong;
  setPlace(content.place, axes);
  return 0;
}

/// A block that reads what has been saved.
template <class Block, class Read> void runDataReader(Ctx &ctx, Block &block, const Read &read) {
  runOnce(ctx, block, [&](GroupRef &group) -> int16_t {
    if (block.continueData == nullptr || !isValid(group, *block.continueData))
      return error::SMC_ERROR__SMC_AXIS_GROUP_CONTINUE_DATA_INVALID;
    read(contentOf(*block.continueData));
    return 0;
  });
}

/// One call of SMC_GroupEnableResumeAfterError for a group that it can save.
int16_t watch(decl::SMC_GroupEnableResumeAfterError &block, GroupRef &group) noexcept {
  const bool failed = group.eState == decl::SMC_AXIS_GROUP_STATE__GroupErrorStop;
  const bool fails = failed && block.stBlock.bRunning == 0;
  stateOf(group).resumable = group.ulServed;
  block.stBlock.bRunning = failed; // it has been written
  if (!fails)
    return failed ? static_cast<int16_t>(block.ErrorID) : int16_t{0};
  if (stateOf(group).motion.obstacle != group::Obstacle::None)
    return error::SMC_ERROR__SMC_AXIS_GROUP_NOT_RESUMABLE;
  save(group, *block.continueData);
  block.Active = 1;
  return 0;
}

} // namespace
} // namespace stride::robotics

namespace {

namespace robotics = ::stride::robotics;
namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;

} // namespace

void decl::MC_GroupInterrupt::body__(::stride::Ctx &ctx__) { robotics::runInterrupt(ctx__, *this); }

void decl::MC_GroupContinue::body__(::stride::Ctx &ctx__) {
  const bool wasExecuted = stBlock.bExecuteOld != 0;
  robotics::runOnce(ctx__, *this, [this](robotics::GroupRef &group) -> int16_t {
    if (continueData == nullptr)
      return robotics::kNoGroup;
    CommandAborted = robotics::isStopping(group);
    return CommandAborted != 0 ? int16_t{0} : robotics::goOn(group, *continueData);
  });
  if (Execute == 0)
    CommandAborted = 0;
  if (Execute != 0 && !wasExecuted)
    Done = Done != 0 && CommandAborted == 0;
}

void decl::SMC_GroupSaveContinueData::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this, [this](robotics::GroupRef &group) -> int16_t {
    if (continueData == nullptr || group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled ||
        group.eState == decl::SMC_AXIS_GROUP_STATE__GroupErrorStop)
      return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
    if (::stride::group::isCarried(robotics::stateOf(group).motion))
      return error::SMC_ERROR__SMC_AXIS_GROUP_NOT_RESUMABLE;
    robotics::save(group, *continueData);
    stBlock.bRunning = group.bOwns;
    stBlock.ulId = static_cast<uint64_t>(robotics::stateOf(group).nextRequest);
    ulCycle = group.ulServed;
    return 0;
  });
  if (stBlock.bRunning != 0 && AxisGroup->ulServed != ulCycle) { // the cycle is over
    robotics::saveMore(*AxisGroup, static_cast<int64_t>(stBlock.ulId), ulCycle, *continueData);
    stBlock.bRunning = 0;
    Done = Execute;
  }
  Busy = stBlock.bRunning;
  if (Busy != 0)
    Done = 0;
}

void decl::SMC_GroupEnableResumeAfterError::body__(::stride::Ctx &ctx__) {
  Active = 0;
  if (AxisGroup != nullptr)
    robotics::serve(ctx__, *AxisGroup);
  int16_t wrong = 0;
  if (Enable != 0)
    wrong = AxisGroup != nullptr && continueData != nullptr ? robotics::watch(*this, *AxisGroup)
                                                            : robotics::kNoGroup;
  else
    stBlock.bRunning = 0;
  robotics::setError(*this, wrong);
}

void decl::SMC_GroupUpdateContinueData::body__(::stride::Ctx &ctx__) {
  int16_t wrong = 0;
  if (AxisGroup != nullptr)
    robotics::serve(ctx__, *AxisGroup);
  if (Enable != 0)
    wrong = AxisGroup != nullptr && continueData != nullptr
                ? robotics::update(ctx__, *AxisGroup, *continueData)
                : robotics::kNoGroup;
  robotics::setError(*this, wrong);
  Busy = Enable;
}

void decl::SMC_GroupGetContinuePosition::body__(::stride::Ctx &ctx__) {
  robotics::runDataReader(ctx__, *this, [this](const robotics::ContinueData &content) {
    double position[robotics::kArmAxes];
    __builtin_memcpy(position, content.path.axes, sizeof position);
    int16_t system = decl::SMC_COORD_SYSTEM__ACS;
    if (content.rides != 0) {
      robotics::toPose(::stride::group::frameOf(content.toolPose), position);
      system = robotics::systemNumber(static_cast<int32_t>(content.rides));
    }
    __builtin_memcpy(&Position, position, sizeof Position);
    CoordSystem = static_cast<decl::SMC_COORD_SYSTEM>(system);
    MovementId = ::stride::group::keptMovement(content.path);
  });
}

void decl::SMC_GroupGetContinueToolOffset::body__(::stride::Ctx &ctx__) {
  robotics::runDataReader(ctx__, *this, [this](const robotics::ContinueData &content) {
    ToolOffset = content.tool.set ? content.tool.frame : decl::MC_COORD_REF{};
  });
}
