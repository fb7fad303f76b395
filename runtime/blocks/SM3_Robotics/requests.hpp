// For the sources of axis groups: what waits to be taken, and how it becomes movements.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_REQUESTS_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_REQUESTS_HPP

#include "runtime/blocks/SM3_Robotics/frames.hpp"

#include "st/SM3_Robotics/SMC_ORIENTATION_MODE.h"

namespace stride::robotics {

/// The pose that coordinates of a request mean, in a coordinate system, from the pose where it
/// begins.
kinematics::Frame<double> targetIn(const kinematics::Frame<double> &system, const Request &request,
                                   const double (&coordinates)[kArmAxes],
                                   const kinematics::Frame<double> &begin);

/// The group takes its axes, if it has not.
void beginMoving(GroupRef &group) noexcept;

/// Puts a request after those that wait; it gets its id. One that aborts ends all before it. An
/// SMC_ERROR if there is no room, or if its inputs are wrong.
int16_t enqueue(GroupRef &group, Request &request) noexcept;

/// Whether a request ends all before it.
bool aborts(const Request &request) noexcept;

/// Makes movements of the requests that wait, as far as they can be taken now.
void takeRequests(GroupRef &group, GroupArm &arm);

/// Notes where the coordinate system of a request is now: later changes of it are not meant. An
/// SMC_ERROR if there is no such system.
int16_t noteSystem(const GroupRef &group, Request &request) noexcept;

/// The pose that a request means by `coordinates`, from the pose where it begins.
kinematics::Frame<double> targetFrame(const Request &request, const double (&coordinates)[kArmAxes],
                                      const kinematics::Frame<double> &begin);

/// From where a movement goes to where: axes at both ends.
struct Ends {
  double from[kAxes];
  double to[kAxes];
};

/// What is wrong with the inputs of a circular movement besides those of all: an SMC_ERROR.
int16_t wrongCircle(const Request &request) noexcept;

/// The arc of a circular movement from ends.from on; where it ends goes into ends.to. An SMC_ERROR.
int16_t circularLeg(const GroupArm &arm, const Request &request, Ends &ends, group::Leg &leg);

/// The leg of a circular movement between two poses of the tool, by a third place. An SMC_ERROR.
int16_t arcLeg(const Request &request, const group::Pose &from, const numeric::Vector3 &aux,
               const group::Pose &to, const group::MoreAxes &more, group::Leg &leg) noexcept;

/// What is wrong with the inputs of jogging: an SMC_ERROR.
int16_t wrongJog(const Request &request) noexcept;

/// The leg of jogging from ends.from on, as far as it can go; where it ends goes into ends.to. An
/// SMC_ERROR.
int16_t jogLeg(const GroupRef &group, const GroupArm &arm, const Request &request, Ends &ends,
               group::Leg &leg);

/// How long ways of axes are beside ways of the tool: the velocity that a second's way is taken
/// for.
double speedOf(const group::GroupMotion &motion, const group::Order &order) noexcept;

/// What waits is over, and movements with it; what has been kept to be continued, too, if `all`.
void abortAll(GroupState &state, bool all) noexcept;

/// What is wrong with the inputs of MC_GroupHalt or MC_GroupStop: an SMC_ERROR.
int16_t wrongHalt(const Request &halt) noexcept;

/// How the group comes to rest for a request that stops it, or for another one.
void setBraking(GroupState &state, const Request &request) noexcept;

/// Nothing is followed any more: all rests. A path in a system that moves cannot be continued.
void forgetSystems(GroupState &state) noexcept;

/// A request of the ring.
inline Request &requestAt(GroupState &state, int64_t number) noexcept {
  return state.request[static_cast<uint64_t>(number) % kRequestRing];
}
inline const Request &requestAt(const GroupState &state, int64_t number) noexcept {
  return state.request[static_cast<uint64_t>(number) % kRequestRing];
}

/// A movement is over, for an SMC_ERROR.
void fail(GroupState &state, uint64_t id, int16_t error) noexcept;

/// Whether the request that is the next one waits until the group is at rest on its path.
bool demandsRest(const GroupState &state) noexcept;

/// Whether the tool's own axes go evenly on a line or an arc.
inline bool givesToolAxes(const Request &request) noexcept {
  return request.orientationMode == ::st::SM3_Robotics::SMC_ORIENTATION_MODE__Axis &&
         (request.kind == RequestKind::Linear || request.kind == RequestKind::Circular);
}

/// Whether a movement can be along a path in a system that moves.
inline bool canRide(const Request &request) noexcept {
  return (request.kind == RequestKind::Linear || request.kind == RequestKind::Circular) &&
         !givesToolAxes(request);
}

/// Whether it is its turn, and it waits until the group does not follow a moving system any more.
bool demandsStandstill(const GroupRef &group) noexcept;

/// Whether it comes to rest at once, whatever has been planned.
bool stopsAtOnce(const GroupRef &group, const GroupState &state) noexcept;

/// The movement whose path does not go on.
uint64_t failedMovement(const GroupState &state) noexcept;

/// What has been prepared in the present cycle (`cycle`, plus 1) belongs to a movement now, also if
/// that is refused: an SMC_ERROR.
void bindTriggers(GroupRef &group, uint64_t cycle, uint64_t movement, int16_t refusal) noexcept;

/// Where too many triggers are remembered, those of movements that wait to be continued go: they
/// may never be.
void makeRoomForTrigger(GroupState &state) noexcept;

/// Finds where on a movement its triggers are.
void locateTriggers(GroupState &state, const group::Arm &arm, uint64_t movement,
                    const group::Leg &leg) noexcept;

/// Finds the times of triggers: between planning and going on.
void updateTriggers(const Ctx &ctx, GroupState &state, double cycle) noexcept;

/// The ways of the motion have become smaller. [u]
void shiftTriggers(GroupState &state, double by) noexcept;

/// The motion ends, before it is cleared: what has not been reached will not be.
void endTriggers(GroupState &state) noexcept;

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_REQUESTS_HPP
