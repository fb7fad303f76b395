// Drives a group along its path: movements that come one after the other, with or without corners
// between them, are made known to the planner piece by piece, planned ahead and gone over. Where no
// more is commanded the group comes to rest. Free of the C++ standard library: linked into every
// application.
//
// What is known of a movement to which there is no successor yet ends a little more than the way to
// stop ahead of the group, so that a successor that comes late can still be blended with.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_GROUP_MOTION_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_GROUP_MOTION_HPP

#include "runtime/numeric/group/corner.hpp"
#include "runtime/numeric/group/limits.hpp"
#include "runtime/numeric/group/ride.hpp"
#include "runtime/numeric/path/motion.hpp"

namespace stride::group {

/// Movements that a group has at once: the one that is driven and those that wait.
inline constexpr int32_t kMovements = 32;
/// Of how many the newest movements the outcome is remembered.
inline constexpr int32_t kOutcomes = 256;
/// Of how many older ones that were not over by then: those that have been kept to be gone on with.
inline constexpr int32_t kOldOutcomes = 64;

/// How a movement follows the one before it.
enum class Transition : uint8_t {
  None,          ///< The group rests between both.
  Distance,      ///< A corner begins and ends that far from where both meet. [u]
  StartVelocity, ///< It is as long as braking and accelerating there would be, times a factor.
};

/// Which of the velocities of two movements counts in the corner between them (and acceleration and
/// jerk likewise).
enum class CornerSpeed : uint8_t { Smaller, First, Second, Greater };

/// Factors of each axis's limits, above 0 up to 1.
struct AxisShares {
  double velocity[kAxes];
  double acceleration[kAxes];
  double jerk[kAxes];
};

/// What is said of a movement besides its leg.
struct Order {
  PathLimits path;                                       ///< Where the tool leads.
  double velocityFactor, accelerationFactor, jerkFactor; ///< Of the axes' limits, above 0 up to 1.
  kinematics::Configuration configuration;               ///< Where the tool leads: see Arm.
  Transition transition;
  double transitionValue; ///< See Transition.
  CornerSpeed cornerSpeed;
  double dwell;      ///< Time to wait, instead of a leg; 0: there is a leg. [s]
  bool noCorner;     ///< There can be no corner between the movement before and this one.
  bool isShared;     ///< `shares` count.
  AxisShares shares; ///< Besides the three factors.
};

enum class Outcome : uint8_t {
  Unknown, ///< There is no such movement, or it was long ago.
  Waiting, ///< It has not been appended.
  Queued,  ///< It has been, but its turn has not come.
  Active,
  Done,
  Aborted,
  Failed,     ///< It cannot be driven; the caller knows why.
  Interrupted ///< It has been kept to be gone on with.
};

/// One of them.
struct Movement {
  uint64_t id;
  Leg leg;
  Order order;
  Corner corner;  ///< From the movement before into this one; length 0: there is none.
  double entry;   ///< Way along the leg where the corner ends. [u]
  double exit;    ///< Where the corner to the next one begins; its length if there is none. [u]
  double begin;   ///< Way of the motion where corner or leg begins. [u]
  double end;     ///< Where the leg ends, at `exit`; once it is known up to there. [u]
  bool endChosen; ///< `exit` is right: what comes after it has been decided.
  bool endKnown;  ///< `end` is right.
  bool gated;     ///< It waits, and the motion stays where it begins until it is told to go on.
};

/// The most that an axis may do whatever movements say; kInfinity: no limit. Trivially copyable.
struct AxisCap {
  double velocity = exact::kInfinity;     ///< [u/s]
  double acceleration = exact::kInfinity; ///< Also to brake. [u/s^2]
  double jerk = exact::kInfinity;         ///< [u/s^3]
};

/// What is allowed of the limits besides what movements say. It counts for the parts of the path
/// that are made known from now on; velocities of the rest are GroupCommand::override.
struct Allowance {
  double axisAcceleration, axisJerk;       ///< Factors, above 0 up to 1.
  double pathAcceleration, pathJerk;       ///< Likewise, of the tool's path.
  double acceleration, deceleration, jerk; ///< Most along the tool's path, before its factors.
  AxisCap axis[kAxes]{};                   ///< Before their factors.
};
inline constexpr Allowance kAllAllowed{
    1.0, 1.0, 1.0, 1.0, exact::kInfinity, exact::kInfinity, exact::kInfinity};

/// What the group does in one cycle.
struct GroupCommand {
  double cycle;    ///< Its time, > 0. [s]
  double override; ///< Factor of all velocities, >= 0; 0: it comes to rest on its path.
  bool stop;       ///< It comes to rest on its path, and stays there.
  double
      deceleration; ///< For that, if it is more than the movement's; in units of the way. [u/s^2]
  int32_t steps;    ///< Of planning.
  int32_t samples;  ///< Places of the path that may be looked at.
  Allowance allowance = kAllAllowed;
  double keep = 0.0;  ///< So much of the motion ahead is planned before it begins, and stays as it
                      ///< is unless it is stopped at once. [s]
  bool atOnce = true; ///< To stop: do not care for `keep`.
  motion::State carrier{}; ///< Of the system that is followed, at the end of the cycle. [u] or [°]
  double jerk = 0.0;       ///< To stop with, as far as the axes allow it, if it is more than the
                           ///< movement's; in units of the way. [u/s^3]
  double accelerationPart = 1.0; ///< To stop: of what movements allow of the axes' accelerations,
                                 ///< above 0 up to 1. What bends take is not made less.
  double jerkPart = 1.0;         ///< Likewise.
};

/// What a stop asks for; else nothing.
inline path::Braking brakingOf(const GroupCommand &command) noexcept {
  if (!command.stop)
    return {};
  return {command.deceleration, command.jerk, command.accelerationPart, command.jerkPart};
}

/// What has become of a movement of which too many others have been commanded since.
struct OldOutcome {
  uint64_t id; ///< 0: none.
  Outcome outcome;
};

/// Trivially copyable, may be moved in memory between two calls.
struct GroupMotion {
  path::Motion motion;
  Movement movement[kMovements]; ///< A ring.
  int64_t first;                 ///< Number of the one that is driven, or of the next one.
  int64_t next;                  ///< The number that the next one gets.
  int64_t looked;                ///< Number of the one that is being made known.
  double lookedWay;              ///< Up to where along its leg. [u]
  double lookedStep;             ///< Length of its last strip; kInfinity: there is none yet. [u]
  double lookedReference[kAxes]; ///< Axes there. [u]
  double axes[kAxes];            ///< Where the group is. [u]
  double velocity[kAxes];        ///< [u/s]
  double acceleration[kAxes];    ///< [u/s^2]
  double dwell;                  ///< Time that is left to wait. [s]
  uint64_t lastId;               ///< Of movements.
  uint8_t outcome[kOutcomes];    ///< By id.
  OldOutcome old[kOldOutcomes];  ///< In no order.
  Obstacle obstacle;             ///< Why the path does not go on.
  Ride ride;                     ///< The system in which the path is, if that moves.
  Ride left;                     ///< The one in which it was before, until that rests.
  Pose tool;                     ///< In the path's system, if that moves.
  double planTime; ///< How much later than here plans may be made; see planning.hpp. [s]
  int64_t epoch;   ///< How often what is planned elsewhere has come to nothing: by a reset, …
  bool dwelling;
  bool abandoned; ///< Movements are only driven to rest; see abandon.
  bool awaits;    ///< Who plans elsewhere is at it; see planning.hpp.
  bool alone;     ///< It is planned here for now, whoever plans elsewhere.
};

/// Whether the path is in a system that moves, or still goes along with one.
inline bool isCarried(const GroupMotion &group) noexcept {
  return isUsed(group.ride) || isUsed(group.left);
}

/// At rest at a place, without movements; ids, outcomes and the system that is followed stay.
void reset(GroupMotion &group, const double (&axes)[kAxes]) noexcept;

/// Whether a movement can be appended. The one before the first stays known: the group may be in
/// the corner after it.
inline bool hasRoom(const GroupMotion &group) noexcept {
  return group.next - group.first < kMovements - 1;
}

/// The id of the next movement, which waits until it is appended.
uint64_t drawId(GroupMotion &group) noexcept;

/// Appends a movement: its leg begins where the last one ends, or where the group is. There must be
/// room.
void append(GroupMotion &group, uint64_t id, const Leg &leg, const Order &order) noexcept;

/// Whether a movement is not over.
inline bool goesOn(Outcome outcome) noexcept {
  return outcome == Outcome::Waiting || outcome == Outcome::Queued || outcome == Outcome::Active ||
         outcome == Outcome::Interrupted;
}

/// Says what has become of a movement, unless it was over long ago.
void setOutcome(GroupMotion &group, uint64_t id, Outcome outcome) noexcept;

/// What has become of a movement.
Outcome outcomeOf(const GroupMotion &group, uint64_t id) noexcept;

/// The movement that is driven; null: there is none. In a corner it is the second one.
const Movement *activeOf(const GroupMotion &group) noexcept;

/// Whether the group is at rest, with nothing left to do or stopped.
bool isAtRest(const GroupMotion &group) noexcept;

/// How far along the present movement the group is, 0 to 1: of a corner the first half belongs to
/// the movement before. `id`: of which.
double positionInMovement(const GroupMotion &group, uint64_t &id) noexcept;

/// One cycle: plans ahead and goes on. The place is in group.axes, velocity, acceleration. With an
/// obstacle the group has failed: it shall be stopped.
void cycle(GroupMotion &group, const Arm &arm, const GroupCommand &command) noexcept;

/// Its parts, one after the other: what is planned after the first one is what the second one does;
/// the third one makes ways smaller, to keep them precise, by its result. [u]
void plan(GroupMotion &group, const Arm &arm, const GroupCommand &command) noexcept;
/// The part of plan() that plans nothing.
void prepare(GroupMotion &group, const GroupCommand &command) noexcept;
void goOn(GroupMotion &group, const Arm &arm, const GroupCommand &command) noexcept;
double rebase(GroupMotion &group) noexcept;

/// Whether the group rests until enough of its motion is planned to begin.
bool holds(const GroupMotion &group) noexcept;

/// Aborts all movements. The group goes on along them until it has been stopped; then clear it.
void abandon(GroupMotion &group) noexcept;

/// Forgets all movements of a group at rest; those that are not done are aborted.
void clear(GroupMotion &group) noexcept;

/// From now on movements are in another system, which moves: the group is at rest on its path, has
/// no movements, and what it has followed before last rests. `most`: how the group may get to the
/// system; its velocity counts beside the system's.
void board(GroupMotion &group, const Arm &arm, const MovingSystem &system,
           const motion::State &carrier, const motion::Dynamics &most) noexcept;

/// How the group may get to a system: as the command's path says, as far as the axes reach, of
/// which half is left for the path itself. At least as fast as that it must be able to go. Of a
/// tool what the path says; how long that takes board() finds out.
motion::Dynamics boardingDynamics(const GroupMotion &group, const Arm &arm,
                                  const MovingSystem &system, const motion::State &carrier,
                                  const PathLimits &path) noexcept;

/// The group's copy of the system that it follows comes to rest.
void brake(GroupMotion &group, const Arm &arm) noexcept;

/// From now on movements are in the machine's system, likewise.
void alight(GroupMotion &group, const Arm &arm) noexcept;

/// How far the tool is from where it would be if the group were where the system is that it
/// follows. [u]
double lagOf(const GroupMotion &group) noexcept;

/// Forgets systems that are followed or left, all of which rest.
inline void leaveSystems(GroupMotion &group) noexcept {
  group.ride = {};
  group.left = {};
}

/// The tool in the system of the path, where the group is; it must be one that leads.
Pose poseInPath(const GroupMotion &group, const Arm &arm) noexcept;

/// The tool, given in the system of the path, in the machine: where that is now.
Frame<double> inMachine(const GroupMotion &group, const Pose &pose) noexcept;

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_GROUP_MOTION_HPP
