// Motion commands of a single axis: how they are planned, replaced, buffered, blended, overridden.
// The blocks give commands and move the axis on; what an axis does is the same for all of them.
#ifndef STRIDE_RUNTIME_AXIS_COMMAND_HPP
#define STRIDE_RUNTIME_AXIS_COMMAND_HPP

#include "runtime/axis/set_point.hpp"

#include "st/SM_DriveBasic/MC_BUFFER_MODE.h"
#include "st/SM_DriveBasic/SMC_MOTION_COMMAND.h"
#include "st/SM_DriveBasic/SMC_MOTION_KIND.h"

namespace stride::motion {

using axis::AxisRef;
using Command = ::st::SM_DriveBasic::SMC_MOTION_COMMAND;

/// SMC_MOTION_COMMAND.eKind.
namespace kind {
inline constexpr int16_t kAbsolute = ::st::SM_DriveBasic::SMC_MOTION_KIND__absolute_move;
inline constexpr int16_t kRelative = ::st::SM_DriveBasic::SMC_MOTION_KIND__relative_move;
inline constexpr int16_t kAdditive = ::st::SM_DriveBasic::SMC_MOTION_KIND__additive_move;
inline constexpr int16_t kVelocity = ::st::SM_DriveBasic::SMC_MOTION_KIND__velocity_move;
inline constexpr int16_t kContinuousAbsolute =
    ::st::SM_DriveBasic::SMC_MOTION_KIND__continuous_absolute;
inline constexpr int16_t kContinuousRelative =
    ::st::SM_DriveBasic::SMC_MOTION_KIND__continuous_relative;
inline constexpr int16_t kHalt = ::st::SM_DriveBasic::SMC_MOTION_KIND__halt;
inline constexpr int16_t kStop = ::st::SM_DriveBasic::SMC_MOTION_KIND__stop;
inline constexpr int16_t kSynchronized = ::st::SM_DriveBasic::SMC_MOTION_KIND__synchronized_motion;
} // namespace kind

/// Whether the axis can carry the command out from where it is: kNone, or the SMC_ERROR of the
/// block that gives commands of this kind (invalid velocity or acceleration, invalid direction).
/// Not for kSynchronized, of which only owner and kind count: its block moves the axis.
int16_t checkCommand(const AxisRef &axis, const Command &command) noexcept;

/// Makes the command the axis's motion, from its present set values; waiting commands and a
/// superimposed motion end. The caller owns the axis then (command.ulOwner). An SMC_ERROR as
/// checkCommand; then nothing has changed.
int16_t beginCommand(AxisRef &axis, const Command &command) noexcept;

/// Lets the command wait for the motion in progress, which is planned anew where it is to be
/// blended. False if too many wait already.
bool queueCommand(AxisRef &axis, const Command &command) noexcept;

/// The instance's command does not wait any more.
void withdrawCommand(AxisRef &axis, uint64_t owner) noexcept;

/// Whether the instance's command waits.
bool isQueued(const AxisRef &axis, uint64_t owner) noexcept;

/// Begins the instance's waiting command on an axis that nobody owns, and moves the axis by one
/// cycle (kSynchronized: gives it the axis). False if it is not the next one or cannot be carried
/// out.
bool beginQueued(AxisRef &axis, uint64_t owner) noexcept;

/// Gives the axis to the command that waits next, which begins with the set values of this cycle.
/// For blocks that move the axis by themselves, when they have what was asked of them. False if
/// none waits that can be carried out.
bool giveToNext(AxisRef &axis) noexcept;

/// Lets the axis go on with the velocity of its present set values, until another command takes it:
/// as a velocity command that has reached it. The instance `owner` owns the axis.
void beginCoasting(AxisRef &axis, uint64_t owner) noexcept;

/// Moves the axis's motion on by one cycle and writes its set values, unless they have been written
/// in this cycle. Called by its owner. When the target has been reached, stPlanner.bReached is set,
/// and stPlanner.bActive says whether the axis goes on from there. True: it has been reached and
/// the next command owns the axis.
bool advance(AxisRef &axis) noexcept;

/// advance, where the cycle neither begins beyond the target nor reaches it, and the axis has not
/// been moved in it: as good as always. False: nothing has been done.
inline bool advanceOnWay(AxisRef &axis) noexcept {
  auto &plan = axis.stPlanner;
  if (axis.bMovedInThisCycle != 0 || plan.bActive == 0 || plan.bReached != 0)
    return false;
  const double t = axis::planTime(plan, plan.ulCycle + 1);
  if (axis::isPlanOver(plan, t))
    return false;
  ++plan.ulCycle;
  axis::writeSetPoint(axis, axis::pieceState(plan, t));
  return true;
}

/// Plans the motion in progress anew towards the same target, after the overrides have changed.
void applyOverrides(AxisRef &axis) noexcept;

} // namespace stride::motion

#endif
