// An axis group at run time: its state, its axes, and the requests of its blocks. What a group does
// in a cycle happens at the first call of one of its blocks.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_GROUP_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_GROUP_HPP

#include "runtime/app/ctx.h"
#include "runtime/blocks/SM3_Robotics/triggers.hpp"
#include "runtime/numeric/group/group_motion.hpp"

#include "st/SM3_Robotics/AXIS_GROUP_REF_SM3.h"
#include "st/SM3_Robotics/SMC_POS_REF.h"
#include "st/SM_Error/SMC_ERROR.h"

namespace stride::robotics {

using GroupRef = ::st::SM3_Robotics::AXIS_GROUP_REF_SM3;
using group::kArmAxes;
using group::kAxes;
using group::kMoreAxes;

/// Requests that wait until the group takes them; the ring has room for a halt after them.
inline constexpr int32_t kRequests = 16;
inline constexpr int32_t kRequestRing = kRequests + 1;

/// A tool as ST says it; none: the flange itself. Trivially copyable.
struct Tool {
  ::st::SM3_Robotics::MC_COORD_REF frame;
  bool set;
};
inline bool isSame(const Tool &a, const Tool &b) noexcept {
  return a.set == b.set && (!a.set || __builtin_memcmp(&a.frame, &b.frame, sizeof a.frame) == 0);
}

enum class RequestKind : uint8_t {
  Direct,   ///< The axes lead.
  Linear,   ///< The tool goes straight.
  Circular, ///< It goes along an arc.
  Halt,     ///< The group comes to rest.
  Jog,      ///< It goes on in a direction as far as it can: see jog.cpp.
};

/// What a block asks of a group.
struct Request {
  uint64_t id;
  uint64_t cycle; ///< In which it was asked for: GroupRef::ulServed.
  RequestKind kind;
  bool relative;
  int16_t system;            ///< SMC_COORD_SYSTEM
  int16_t bufferMode;        ///< MC_BUFFER_MODE
  int16_t transitionMode;    ///< MC_TRANSITION_MODE
  double position[kArmAxes]; ///< Of axes, or a pose by X, Y, Z, A, B, C. [u], [°]
  int16_t orientationMode;   ///< SMC_ORIENTATION_MODE
  double torqueFactor;       ///< Of a movement; nothing depends on it.
  int16_t moreMode;          ///< Of the axes that go along: SMC_GROUP_ADDITIONAL_MODE
  double more[kMoreAxes];    ///< Where these go. [u]
  int16_t circleMode;        ///< Circular: SMC_CIRC_MODE
  int16_t pathChoice;        ///< Circular: MC_CIRC_PATHCHOICE
  double aux[kArmAxes]; ///< Circular: AuxPoint, like `position`. Jog: how far at most [u], [°].
  group::Order order;   ///< But for its configuration. Halt: factors of acceleration and jerk.
  double deceleration;  ///< Halt: see MC_GroupHalt. [u/s^2]
  double jerk;          ///< Likewise. [u/s^3]
  bool forgets;         ///< Halt: what it aborts cannot be continued.
  Tool tool;            ///< When it was asked for.
  group::Pose frame;    ///< Of `system` in the machine, likewise; not of ACS and TCS.
  int32_t carrier;      ///< Which moving system that was: 1 or 2, PCS_1 or PCS_2; 0: none.
  ::st::SM3_Robotics::SMC_GROUP_TOLERANCE tolerance; ///< Likewise.
};

/// What a group keeps besides what ST sees. Trivially copyable.
struct GroupState {
  group::GroupMotion motion;
  Request request[kRequestRing]; ///< A ring.
  int64_t firstRequest, nextRequest;
  int64_t abortedRequest; ///< The first one of those that waited when all was aborted last.
  int64_t abortedEnd;     ///< And the first one after them.
  int16_t error[group::kOutcomes]; ///< Why movements have failed, by id: SMC_ERROR.
  double end[kAxes];               ///< Axes where the movements end that have been taken. [u]
  double zero[kAxes];              ///< Where the zero points of the group's axes are, by their
                                   ///< numbers in the group, since it owns them. [u]
  double deceleration;             ///< Of the present stop. [u/s^2]
  double jerk;                     ///< Likewise. [u/s^3]
  double accelerationPart;         ///< Likewise: see group::GroupCommand.
  double jerkPart;                 ///< Likewise.
  uint64_t lastAccepted;           ///< The movement that has been taken last.
  group::Pose endPose;             ///< Where these end, in the path's system, if that moves.
  int32_t rides;                   ///< That system: 1 or 2, PCS_1 or PCS_2; 0: the machine's.
  int32_t leaves;                  ///< The one before, which may not be at rest yet.
  uint64_t referenced;             ///< The movement before the system was changed last.
  Tool tool;                       ///< Of the movements.
  uint64_t resumable;  ///< The last cycle, plus 1, in which errors were to be resumable.
  uint64_t refused;    ///< The last cycle, plus 1, in which a movement was refused in its own call.
  bool interrupting;   ///< It comes to rest to be continued later.
  int32_t suspendedIn; ///< In which moving system movements wait to be continued, as `rides`.
  ::st::SM3_Robotics::SMC_GROUP_TOLERANCE tolerance; ///< Of the movements.
  double orientationLag;                             ///< Behind the system that is followed. [°]
  bool hasReached;               ///< That has been reached since it is followed.
  group::MovingSystem master[2]; ///< PCS_1 and PCS_2 in WCS, if they are on other groups' tools.
  double uncapped; ///< Way of the motion up to which ancillary limits of axes are not planned
                   ///< with. [u]
  uint64_t stop;   ///< How often MC_GroupStop has taken the group.
  int32_t stops;   ///< Blocks of MC_GroupStop that hold it now.
  Triggers triggers;
  double forecast;       ///< How much of the motion is planned, since the start of the cycle. [s]
  group::GroupRest rest; ///< The next one, since then.
};

/// Forgets the movements of a group at rest.
inline void clearMotion(GroupState &state) noexcept {
  group::clear(state.motion);
  state.uncapped = 0.0;
}

GroupState &stateOf(GroupRef &group) noexcept;
const GroupState &stateOf(const GroupRef &group) noexcept;

/// Whether the group takes movements.
bool takesMovements(const GroupRef &group) noexcept;

/// Asks the group for something; an SMC_ERROR if it refuses at once. The request gets its id.
int16_t ask(Ctx &ctx, GroupRef &group, Request &request);

/// Lets MC_GroupStop begin, and end: the last block of those that hold the group lets it go.
/// `holder`: GroupState::stop of the block. An SMC_ERROR.
int16_t beginStop(Ctx &ctx, GroupRef &group, const Request &stop, uint64_t &holder);
void endStop(GroupRef &group);

/// Lets the group go on by the present cycle, unless it has done so.
void serve(Ctx &ctx, GroupRef &group);

/// Whether a command may take the group's axes now: an SMC_ERROR if not.
int16_t whyNotReady(const GroupRef &group) noexcept;

/// Lets the axes go that the group has: it is in standby.
void endMoving(GroupRef &group) noexcept;

/// Whether it is at rest on its path, and follows nothing that moves.
inline bool standsStill(const GroupState &state) noexcept {
  return group::isAtRest(state.motion) && group::isStill(state.motion.ride) &&
         group::isStill(state.motion.left);
}

/// Whether its axes are at rest.
bool rests(const GroupRef &group) noexcept;

int16_t enable(Ctx &ctx, GroupRef &group);

/// A place of the group's axes as `system` counts it: of the axes in ACS [u], else of the tool. An
/// SMC_ERROR.
int16_t positionOf(Ctx &ctx, GroupRef &group, int16_t system, const double (&axes)[kAxes],
                   ::st::SM3_Robotics::SMC_POS_REF &position,
                   ::st::SM3_Transformation::CONFIGDATA &configuration);

/// The position of the group's axes [u], or of its tool in a coordinate system, from the axes' own
/// positions, actual or set ones. An SMC_ERROR.
int16_t readPosition(Ctx &ctx, GroupRef &group, int16_t system, bool actual,
                     ::st::SM3_Robotics::SMC_POS_REF &position,
                     ::st::SM3_Transformation::CONFIGDATA &configuration);

/// The kinematics is set, and the tool taken away. An SMC_ERROR.
int16_t setKinematics(Ctx &ctx, GroupRef &group, Interface kinematics);
int16_t setTool(Ctx &ctx, GroupRef &group, const ::st::SM3_Robotics::MC_COORD_REF &tool);

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_GROUP_HPP
