// CSY_PROFILE: a motion along one coordinate that a group of a TSX CSY 85 makes.
#include "runtime/numeric/profile/planner.hpp"

#include "st/CSY/CSY_PROFILE.h"

namespace {

namespace motion = ::stride::motion;
using Block = ::st::CSY::CSY_PROFILE;

/// What the block keeps in aState. All bits 0: at rest at 0.
struct Course {
  motion::Profile profile;
  motion::State state; ///< now
  double time;         ///< since the profile's start [s]
  bool moving;
};

static_assert(sizeof(Course) <= sizeof(Block::aState));
static_assert(alignof(Course) <= alignof(uint64_t));

/// iRequest.
enum Request : int16_t { kGoOn = 0, kMove = 1, kStop = 2, kTake = 3 };

Course &courseOf(Block &block) noexcept { return *reinterpret_cast<Course *>(&block.aState); }

motion::PlanError plan(const Block &block, Course &course) noexcept {
  const motion::Dynamics dynamics{
      block.fJerk > 0.0 ? motion::RampType::Parabolic : motion::RampType::Trapezoid,
      block.fVelocity, block.fAcceleration, block.fDeceleration, block.fJerk};
  return block.iRequest == kMove
             ? motion::planMove(course.profile, course.state, block.fTarget, 0.0, dynamics)
             : motion::planStop(course.profile, course.state, dynamics);
}

/// Leads one cycle on.
void step(Course &course, double cycle) noexcept {
  course.time += cycle;
  course.state = course.profile.at(course.time);
  if (course.time < course.profile.duration)
    return;
  course.state = {course.profile.end.position, 0.0, 0.0};
  course.moving = false;
}

} // namespace

void st::CSY::CSY_PROFILE::body__(::stride::Ctx & /*ctx__*/) {
  Course &course = courseOf(*this);
  bError = 0;
  if (iRequest == kTake) {
    course.state = {fTarget, fVelocity, fAcceleration};
    course.moving = false;
  } else if (iRequest == kMove || iRequest == kStop) {
    // What is refused leaves the motion as it is.
    Course next = course;
    bError = plan(*this, next) == motion::PlanError::None ? 0 : 1;
    if (bError == 0) {
      course = next;
      course.moving = true;
      course.time = 0.0;
    }
  }
  if (course.moving && iRequest != kTake)
    step(course, fCycle);
  bMoving = course.moving ? 1 : 0;
  fSetPosition = course.state.position;
  fSetVelocity = course.state.velocity;
  fSetAcceleration = course.state.acceleration;
}
