// MC_PositionProfile, MC_VelocityProfile, MC_AccelerationProfile: courses through points in time.
#include "runtime/axis/command.hpp"
#include "runtime/axis/motion_block.hpp"
#include "runtime/axis/set_point.hpp"
#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/profile/time_profile.hpp"

#include "st/SM_PLCopen/MC_AccelerationProfile.h"
#include "st/SM_PLCopen/MC_PositionProfile.h"
#include "st/SM_PLCopen/MC_TA_REF.h"
#include "st/SM_PLCopen/MC_TP_REF.h"
#include "st/SM_PLCopen/MC_TV_REF.h"
#include "st/SM_PLCopen/MC_VelocityProfile.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Course = ::st::SM_PLCopen::SMC_TIME_COURSE;
using motion::AxisRef;

constexpr int16_t kMaxPoints = motion::TimeProfile::kMaxPoints;
static_assert(motion::TimeProfile::kMaxPieces == decltype(Course::aPiece)::kSize);

using Planner = motion::PlanError (*)(motion::TimeProfile &, const motion::State &,
                                      const motion::TimePoint *, int32_t);

/// What tells the three blocks apart.
struct Kind {
  Planner plan;
  int16_t axisState;
  int16_t badSize;
  int16_t badStep;
  motion::Needs needs;
};

constexpr Kind kPositions{&motion::planPositions, axis::state::kDiscrete,
                          ::st::SM_Error::SMC_ERROR__SMC_PP_ARRAYSIZE,
                          ::st::SM_Error::SMC_ERROR__SMC_PP_STEP0MS, motion::Needs::Position};
constexpr Kind kVelocities{&motion::planVelocities, axis::state::kContinuous,
                           ::st::SM_Error::SMC_ERROR__SMC_VP_ARRAYSIZE,
                           ::st::SM_Error::SMC_ERROR__SMC_VP_STEP0MS, motion::Needs::Velocity};
constexpr Kind kAccelerations{&motion::planAccelerations, axis::state::kContinuous,
                              ::st::SM_Error::SMC_ERROR__SMC_AP_ARRAYSIZE,
                              ::st::SM_Error::SMC_ERROR__SMC_AP_STEP0MS, motion::Needs::Velocity};

/// The points of the three reference types, alike.
auto &pointsOf(const ::st::SM_PLCopen::MC_TP_REF &ref) noexcept { return ref.MC_TP_Array; }
auto &pointsOf(const ::st::SM_PLCopen::MC_TV_REF &ref) noexcept { return ref.MC_TV_Array; }
auto &pointsOf(const ::st::SM_PLCopen::MC_TA_REF &ref) noexcept { return ref.MC_TA_Array; }
double valueOf(const ::st::SM_PLCopen::SMC_TP &point) noexcept { return point.position; }
double valueOf(const ::st::SM_PLCopen::SMC_TV &point) noexcept { return point.velocity; }
double valueOf(const ::st::SM_PLCopen::SMC_TA &point) noexcept { return point.acceleration; }

/// The values of all points are `factor` * value + `offset`.
struct Mapping {
  double factor;
  double offset;
};

/// Reads `count` points. False if a step is 0.
template <class Reference>
bool readPoints(const Reference &reference, const Mapping &mapping, int16_t count,
                motion::TimePoint *points) noexcept {
  for (int16_t i = 0; i < count; ++i) {
    const auto &point = pointsOf(reference).v[i];
    if (point.delta_time == 0)
      return false;
    points[i] = {static_cast<double>(point.delta_time) / 1000.0,
                 valueOf(point) * mapping.factor + mapping.offset};
  }
  return true;
}

/// What values are relative to.
double startValue(const Kind &kind, const motion::State &start) noexcept {
  if (kind.plan == kPositions.plan)
    return start.position;
  return kind.plan == kVelocities.plan ? start.velocity : start.acceleration;
}

void store(Course &course, const motion::TimeProfile &profile, const AxisRef &ref) noexcept {
  course.uiCount = static_cast<uint16_t>(profile.count);
  course.uiPiece = 0;
  course.ulCycle = 0;
  course.fCycle = ref.fTaskCycle;
  course.fDuration = profile.duration;
  course.fEnd = profile.end.position;
  course.fEndVelocity = profile.end.velocity;
  course.fOffset = ref.fOffsetPosition;
  for (int32_t i = 0; i < profile.count; ++i) {
    const motion::TimePiece &piece = profile.pieces[i];
    course.aPiece.v[i] = {piece.start, piece.origin.position, piece.origin.velocity,
                          piece.origin.acceleration, piece.jerk};
  }
}

/// Computes the course from the inputs. An SMC_ERROR.
template <class Block, class Reference>
int16_t plan(Block &block, const Kind &kind, const Reference *reference, double scale,
             const AxisRef &ref) noexcept {
  if (reference == nullptr || block.ArraySize < 1 || block.ArraySize > kMaxPoints)
    return kind.badSize;
  const int16_t given = reference->Number_of_pairs;
  const int16_t count = given == 0 ? block.ArraySize : given;
  if (count < 1 || count > block.ArraySize)
    return kind.badSize;
  const motion::State start = axis::presentState(ref);
  const double base = reference->IsAbsolute != 0 ? 0.0 : startValue(kind, start);
  motion::TimePoint points[kMaxPoints];
  if (!readPoints(*reference, {block.Scale * scale, block.Offset + base}, count, points))
    return kind.badStep;
  motion::TimeProfile profile;
  if (kind.plan(profile, start, points, count) != motion::PlanError::None)
    return axis::error::kOutOfRange;
  store(block.stCourse, profile, ref);
  return axis::error::kNone;
}

motion::State stateAt(Course &course, double t) noexcept {
  while (course.uiPiece + 1 < course.uiCount && t >= course.aPiece.v[course.uiPiece + 1].fStart)
    ++course.uiPiece;
  const auto &piece = course.aPiece.v[course.uiPiece];
  return stride::numeric::evaluateCubic({piece.fPosition, piece.fVelocity, piece.fAcceleration},
                                        piece.fJerk, t - piece.fStart);
}

/// The last point has been reached, in this cycle or before, and written.
void arrive(motion::BlockState &state, const Course &course, AxisRef &ref) noexcept {
  if (motion::giveToNext(ref)) { // what waits goes on from here
    motion::finish(state);
    return;
  }
  if (course.fEndVelocity == 0.0) {
    motion::finish(state);
    motion::release(ref);
    return;
  }
  ref.nAxisState = axis::state::kContinuous;
  // Without Execute it is shown once.
  state.bDone = state.bExecuteOld != 0 || state.bReached == 0;
  state.bReached = 1;
}

void move(motion::BlockState &state, Course &course, AxisRef &ref) noexcept {
  if (ref.bMovedInThisCycle != 0)
    return;
  ++course.ulCycle;
  const double t = static_cast<double>(course.ulCycle) * course.fCycle;
  // A course that ends with a cycle must not need one more because of the last digit of a product.
  const bool over = !(t + 1e-9 * course.fCycle < course.fDuration);
  motion::State now;
  if (over)
    now = {course.fEnd + course.fEndVelocity * (t - course.fDuration), course.fEndVelocity, 0.0};
  else
    now = stateAt(course, t);
  if (over && course.fEndVelocity == 0.0)
    now.position = course.fEnd;
  now.position += ref.fOffsetPosition - course.fOffset;
  axis::writeSetPoint(ref, now);
  if (over)
    arrive(state, course, ref);
}

template <class Block, class Reference>
void start(Block &block, const Kind &kind, const Reference *reference, double scale,
           AxisRef &ref) noexcept {
  auto &state = block.stBlock;
  int16_t problem = motion::refusal(ref, kind.needs);
  if (problem == axis::error::kNone)
    problem = plan(block, kind, reference, scale, ref);
  if (problem != axis::error::kNone) {
    motion::fail(state, &ref, problem);
    return;
  }
  motion::take(state, ref, kind.axisState);
  state.bReached = 0;
  ref.stQueue.uiCount = 0;
  ref.stPlanner.bActive = 0;
  ref.stPlanner.fDeceleration = 0.0; // an error stop brakes with fSWMaxDeceleration
  ref.fAimPosition = axis::shownPosition(ref, block.stCourse.fEnd);
  move(state, block.stCourse, ref);
}

template <class Block, class Reference>
void run(Block &block, const Kind &kind, const Reference *reference, double scale) noexcept {
  auto &state = block.stBlock;
  AxisRef *ref = block.Axis;
  switch (motion::beginCall(state, block.Execute != 0, ref)) {
  case motion::Call::Start:
    start(block, kind, reference, scale, *ref);
    break;
  case motion::Call::Go:
    if (motion::keep(state, *ref)) {
      move(state, block.stCourse, *ref);
    } else if (state.bAborted != 0 && state.bReached != 0) {
      // It was Done; what follows then does not abort it.
      motion::clearOutcome(state);
      state.bDone = state.bExecuteOld;
    }
    break;
  case motion::Call::Idle:
    break;
  }
  motion::showOutcome(block);
  block.Done = state.bDone;
  block.Busy = state.bRunning != 0 && state.bReached == 0;
  block.Active = block.Busy;
}

} // namespace

void st::SM_PLCopen::MC_PositionProfile::body__(::stride::Ctx & /*ctx__*/) {
  run(*this, kPositions, TimePosition, PositionScale);
}

void st::SM_PLCopen::MC_VelocityProfile::body__(::stride::Ctx & /*ctx__*/) {
  run(*this, kVelocities, TimeVelocity, VelocityScale);
}

void st::SM_PLCopen::MC_AccelerationProfile::body__(::stride::Ctx & /*ctx__*/) {
  run(*this, kAccelerations, TimeAcceleration, AccelerationScale);
}
