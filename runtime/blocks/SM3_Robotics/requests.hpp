// For the sources of axis groups: what waits to be taken, and how it becomes movements.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_REQUESTS_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_REQUESTS_HPP

#include "runtime/blocks/SM3_Robotics/frames.hpp"

namespace stride::robotics {

const GroupState &stateOf(const GroupRef &group) noexcept;

inline Request &requestAt(GroupState &state, int64_t number) noexcept {
  return state.request[static_cast<uint64_t>(number) % kRequests];
}
inline const Request &requestAt(const GroupState &state, int64_t number) noexcept {
  return state.request[static_cast<uint64_t>(number) % kRequests];
}

/// The pose that a request means, in a coordinate system, from the pose where it begins.
kinematics::Frame<double> targetIn(const kinematics::Frame<double> &system, const Request &request,
                                   const kinematics::Frame<double> &begin);

/// The group takes its axes, if it has not.
void beginMoving(GroupRef &group) noexcept;

/// Puts a request after those that wait; it gets its id. One that aborts ends all before it. An
/// SMC_ERROR if there is no room, or if its inputs are wrong.
int16_t enqueue(GroupRef &group, Request &request) noexcept;

/// Makes movements of the requests that wait, as far as they can be taken now.
void takeRequests(GroupRef &group, const GroupArm &arm);

/// What waits is over.
void abortRequests(GroupState &state) noexcept;

/// A movement is over, for an SMC_ERROR.
void fail(GroupState &state, uint64_t id, int16_t error) noexcept;

/// Whether the request that is the next one waits until the group is at rest on its path.
bool demandsRest(const GroupState &state) noexcept;

/// Whether it waits until the group does not follow a moving system any more.
bool demandsStandstill(const GroupRef &group) noexcept;

/// The movement whose path does not go on.
uint64_t failedMovement(const GroupState &state) noexcept;

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_REQUESTS_HPP
