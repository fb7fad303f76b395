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

/// Requests that wait until the group takes them.
inline constexpr int32_t kRequests = 16;

enum class RequestKind : uint8_t {
  Direct, ///< The axes lead.
  Linear, ///< The tool goes straight.
  Halt,   ///< The group comes to rest.
};

/// What a block asks of a group.
struct Request {
  uint64_t id;
  RequestKind kind;
  bool relative;
  int16_t system;            ///< SMC_COORD_SYSTEM
  int16_t bufferMode;        ///< MC_BUFFER_MODE
  double position[kArmAxes]; ///< Of axes, or a pose by X, Y, Z, A, B, C. [u], [°]
  group::Order order;        ///< But for its configuration.
  double deceleration;       ///< Halt: see MC_GroupHalt. [u/s^2]
};

/// What a group keeps besides what ST sees. Trivially copyable.
struct GroupState {
  group::GroupMotion motion;
  Request request[kRequests]; ///< A ring.
  int64_t firstRequest, nextRequest;
  int16_t error[group::kOutcomes]; ///< Why movements have failed, by id: SMC_ERROR.
  double end[kAxes];               ///< Axes where the movements end that have been taken. [u]
  double deceleration;             ///< Of the present stop. [u/s^2]
  uint64_t lastAccepted;           ///< The movement that has been taken last.
  Triggers triggers;
  double forecast;       ///< How much of the motion is planned, since the start of the cycle. [s]
  group::GroupRest rest; ///< The next one, since then.
};

GroupState &stateOf(GroupRef &group) noexcept;

/// Whether the group takes movements.
bool takesMovements(const GroupRef &group) noexcept;

/// Asks the group for something; an SMC_ERROR if it refuses at once. The request gets its id.
int16_t ask(Ctx &ctx, GroupRef &group, Request &request);

/// Lets MC_GroupStop begin, and end.
int16_t beginStop(Ctx &ctx, GroupRef &group, double deceleration);
void endStop(GroupRef &group);

/// Lets the group go on by the present cycle, unless it has done so.
void serve(Ctx &ctx, GroupRef &group);

/// Whether its axes are at rest.
bool rests(const GroupRef &group) noexcept;

int16_t enable(Ctx &ctx, GroupRef &group);

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
