// For the sources of axis groups: what waits to be taken, and how it becomes movements.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_REQUESTS_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_REQUESTS_HPP

#include "runtime/blocks/SM3_Robotics/frames.hpp"

namespace stride::robotics {

const GroupState &stateOf(const GroupRef &group) noexcept;

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

/// Whether the request that is the next one waits until the group is at rest.
bool demandsRest(const GroupState &state) noexcept;

/// Whether it comes to rest at once, whatever has been planned.
bool stopsAtOnce(const GroupRef &group, const GroupState &state) noexcept;

/// The movement whose path does not go on.
uint64_t failedMovement(const GroupState &state) noexcept;

/// What has been prepared in the present cycle (`cycle`, plus 1) belongs to a movement now, also if
/// that is refused: an SMC_ERROR.
void bindTriggers(GroupRef &group, uint64_t cycle, uint64_t movement, int16_t refusal) noexcept;

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
