// A group whose motion is planned in another task than the one of its axes, a slower one. The
// axes' task goes along what has been planned, which always ends in rest: if nothing comes from the
// other task, the group comes to rest on its path. What has to be stopped at once it stops by
// itself.
//
// Both tasks share a mail, which one of them has at a time: nobody locks, nobody waits. The axes'
// task writes where the motion is and what is wanted; the other one takes that, plans for some
// time, and answers with what has changed of path and law, and from which place of the law on. The
// axes' task takes that unless the motion has passed the place; then it hands over all that it has
// itself, to begin anew from.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_PLANNING_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_PLANNING_HPP

#include "runtime/numeric/group/group_motion.hpp"
#include "runtime/numeric/kinematics/any_kinematics.hpp"
#include "runtime/numeric/path/motion_handover.hpp"

namespace stride::group {

/// Who has the mail.
enum class MailHolder : uint32_t {
  Axes,     ///< The axes' task.
  Posted,   ///< Whoever takes it first.
  Planner,  ///< The task that plans.
  Answered, ///< The axes' task, which has not seen the answer yet.
};

/// What the axes' task says.
struct PlanningJob {
  int64_t epoch;        ///< GroupMotion::epoch
  bool whole;           ///< The path in the mail is all that the axes' task has.
  bool moves;           ///< The motion goes on.
  bool resting, gate;   ///< See path::Motion.
  bool dwelling;        ///< See GroupMotion.
  path::LawPlace place; ///< Where the motion is.
  double way;           ///< Likewise. [u]
  double axes[kAxes];   ///< Likewise. [u]
  double promise;       ///< See path::Motion. [s]
  int64_t first, next;  ///< See GroupMotion.
  int64_t given;        ///< Number of the first movement that is new.
  double clock;         ///< Time that has passed in the axes' task. [s]
  double late;          ///< So much later an answer may be taken. [s]
  GroupCommand command; ///< But for steps and samples.
  kinematics::AnyKinematics kinematics;
  int32_t joints, more; ///< See Arm.
  AxisLimits limits[kAxes];
  Ride ride, left; ///< See GroupMotion.
};

/// What the other task answers.
struct PlanningAnswer {
  bool changed;       ///< The law, from `cut` on.
  bool lost;          ///< It has to begin anew.
  bool goesOn;        ///< A plan is under way.
  path::LawPlace cut; ///< Where the law becomes another one.
  int64_t fromStrip;  ///< Number of the first strip that may be new.
  int64_t next;       ///< How many movements it knows.
};

/// What goes from the one task to the other one. Trivially copyable.
struct PlanningMail {
  PlanningJob job;
  PlanningAnswer answer;
  path::PlannedPath path;
  Movement movement[kMovements]; ///< A ring, by number.
  int64_t looked;                ///< See GroupMotion, as all of these.
  double lookedWay, lookedStep;
  double lookedReference[kAxes];
  Obstacle obstacle;
};

/// All that a group needs to be planned in another task. Zero at first; trivially copyable.
struct GroupPlanning {
  uint32_t holder; ///< MailHolder
  PlanningMail mail;
  // What only the axes' task uses:
  int64_t epoch; ///< Of the last job.
  int64_t given; ///< Number of the first movement that the other task does not know.
  double clock;  ///< [s]
  double moved;  ///< For how long the motion has gone on since the last job. [s]
  double late;   ///< See PlanningJob. [s]
  bool whole;    ///< The next job hands over all.
  // What only the other one uses:
  GroupMotion planner;
  double interval; ///< From job to job. [s]
  double seen;     ///< PlanningJob::clock of the last one. [s]
};

/// In the axes' task, in place of plan(): takes an answer, and plans stops and other overrides.
/// Whether it has taken one; `planning.mail.job` is what that was planned for.
bool follow(GroupMotion &group, GroupPlanning &planning, const Arm &arm,
            const GroupCommand &command) noexcept;

/// After that, in place of goOn(): goes on.
void goOn(GroupMotion &group, GroupPlanning &planning, const Arm &arm,
          const GroupCommand &command) noexcept;

/// After that, in place of rebase(), whose result it has: lets the other task plan, unless it still
/// does so. `kinematics` is the arm's. [u]
double post(GroupMotion &group, GroupPlanning &planning, const Arm &arm,
            const kinematics::AnyKinematics &kinematics, const GroupCommand &command) noexcept;

/// What is to be planned with in one call.
struct PlanningShare {
  double interval; ///< From call to call. [s]
  int32_t steps;   ///< See GroupCommand.
  int32_t samples; ///< See GroupCommand.
};

/// In the other task: plans for some time, if there is a job.
void planAside(GroupPlanning &planning, const PlanningShare &share) noexcept;

/// Its parts: takes the job, if there is one; plans; answers.
bool takeJob(GroupPlanning &planning) noexcept;
void doJob(GroupPlanning &planning, const PlanningShare &share) noexcept;
void answerJob(GroupPlanning &planning) noexcept;

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_PLANNING_HPP
