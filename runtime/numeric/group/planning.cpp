#include "runtime/numeric/group/planning.hpp"

#include "runtime/numeric/group/path_making.hpp"
#include "runtime/numeric/path/motion_session.hpp"

namespace stride::group {
namespace {

using exact::larger;
using exact::smaller;

/// How much later than a job its answer is expected at most. [s]
constexpr double kLatest = 1.0;

MailHolder holderOf(const GroupPlanning &planning) noexcept {
  return static_cast<MailHolder>(__atomic_load_n(&planning.holder, __ATOMIC_ACQUIRE));
}

void give(GroupPlanning &planning, MailHolder holder) noexcept {
  __atomic_store_n(&planning.holder, static_cast<uint32_t>(holder), __ATOMIC_RELEASE);
}

/// Takes what has been posted. False: the other one was sooner.
bool takePosted(GroupPlanning &planning, MailHolder holder) noexcept {
  auto posted = static_cast<uint32_t>(MailHolder::Posted);
  return __atomic_compare_exchange_n(&planning.holder, &posted, static_cast<uint32_t>(holder),
                                     false, __ATOMIC_ACQUIRE, __ATOMIC_RELAXED);
}

Movement &mailed(PlanningMail &mail, int64_t number) noexcept {
  return mail.movement[static_cast<uint64_t>(number) % kMovements];
}
const Movement &mailed(const PlanningMail &mail, int64_t number) noexcept {
  return mail.movement[static_cast<uint64_t>(number) % kMovements];
}

/// The oldest movement that still says where the group is.
int64_t oldest(int64_t first) noexcept { return first > 0 ? first - 1 : 0; }

/// Whether the motion goes on in the next cycle.
bool movesOn(const GroupMotion &group) noexcept {
  return !path::isAtRest(group.motion) && !group.motion.gate && !holds(group);
}

/// The end of the movements of which something has been decided.
int64_t decidedEnd(int64_t looked, int64_t next) noexcept {
  constexpr int64_t kAfter = 2; // a corner is decided with the movement before
  return looked + kAfter < next ? looked + kAfter : next;
}

/// What has been decided of a movement.
void copyDecided(const Movement &from, Movement &to) noexcept {
  to.corner = from.corner;
  to.entry = from.entry;
  to.exit = from.exit;
  to.begin = from.begin;
  to.end = from.end;
  to.endChosen = from.endChosen;
  to.endKnown = from.endKnown;
  to.gated = from.gated;
}

/// How far the path is made known.
void writeLooked(const GroupMotion &group, PlanningMail &mail) noexcept {
  mail.looked = group.looked;
  mail.lookedWay = group.lookedWay;
  mail.lookedStep = group.lookedStep;
  __builtin_memcpy(mail.lookedReference, group.lookedReference, sizeof mail.lookedReference);
  mail.obstacle = group.obstacle;
}
void readLooked(const PlanningMail &mail, GroupMotion &group) noexcept {
  group.looked = mail.looked;
  group.lookedWay = mail.lookedWay;
  group.lookedStep = mail.lookedStep;
  __builtin_memcpy(group.lookedReference, mail.lookedReference, sizeof group.lookedReference);
  group.obstacle = mail.obstacle;
}

// The axes' task:

/// What has been planned becomes the motion.
void take(GroupMotion &group, GroupPlanning &planning) noexcept {
  const PlanningMail &mail = planning.mail;
  const PlanningAnswer &answer = mail.answer;
  const int64_t here = group.motion.law.first;
  const int64_t cut = answer.changed ? answer.cut.piece : mail.path.law.next;
  path::takeOver(group.motion, mail.path, answer.fromStrip, cut > here ? cut : here);
  const double promise = mail.path.promise - planning.moved;
  group.motion.promise = larger(group.motion.promise, smaller(promise, group.motion.keep));
  for (int64_t k = oldest(group.first); k < decidedEnd(mail.looked, answer.next); ++k)
    copyDecided(mailed(mail, k), movementAt(group, k));
  readLooked(mail, group);
  group.awaits = answer.goesOn;
}

/// Looks at the answer to the last job. False: it comes to nothing.
bool receive(GroupMotion &group, GroupPlanning &planning) noexcept {
  const PlanningMail &mail = planning.mail;
  const PlanningAnswer &answer = mail.answer;
  if (mail.job.epoch != group.epoch || group.alone)
    return false;
  planning.given = answer.next;
  const bool passed = answer.changed && !path::isBefore(path::placeIn(group.motion), answer.cut);
  planning.whole = answer.lost || passed;
  constexpr double kLess = 0.98; // of how late answers have been
  constexpr double kMore = 1.5;
  const double late = planning.moved + mail.job.command.cycle;
  planning.late = smaller(larger(late, (passed ? kMore : kLess) * planning.late), kLatest);
  if (!planning.whole)
    take(group, planning);
  return !planning.whole;
}

/// All that the axes' task has of the path.
void writeWhole(const GroupMotion &group, PlanningMail &mail) noexcept {
  path::handOver(group.motion, group.motion.course.first, group.motion.law.first, mail.path);
  writeLooked(group, mail);
}

void writeJob(const GroupMotion &group, GroupPlanning &planning, const Arm &arm,
              const GroupCommand &command) noexcept {
  PlanningMail &mail = planning.mail;
  PlanningJob &job = mail.job;
  const path::Motion &motion = group.motion;
  job.epoch = group.epoch;
  job.whole = planning.whole;
  job.moves = movesOn(group);
  job.resting = motion.resting;
  job.gate = motion.gate;
  job.dwelling = group.dwelling;
  job.place = path::placeIn(motion);
  job.way = motion.way;
  __builtin_memcpy(job.axes, group.axes, sizeof job.axes);
  job.promise = motion.promise;
  job.first = group.first;
  job.next = group.next;
  job.given = planning.whole ? oldest(group.first) : planning.given;
  for (int64_t k = job.given; k < group.next; ++k)
    mailed(mail, k) = movementAt(group, k);
  job.clock = planning.clock;
  job.late = planning.late;
  job.command = command;
  job.joints = arm.joints;
  job.more = arm.more;
  for (int32_t k = 0; k < kAxes; ++k)
    job.limits[k] = arm.limits[k];
  if (planning.whole)
    writeWhole(group, mail);
}

// The task that plans:

/// Begins anew from what the axes' task has.
void beginAnew(GroupMotion &planner, const PlanningMail &mail) noexcept {
  const PlanningJob &job = mail.job;
  reset(planner, job.axes);
  path::Motion &motion = planner.motion;
  motion.law.first = job.place.piece;
  path::takeOver(motion, mail.path, mail.path.course.first, job.place.piece);
  motion.promise = mail.path.promise;
  for (int64_t k = job.given; k < job.next; ++k)
    movementAt(planner, k) = mailed(mail, k);
  planner.next = job.next;
  readLooked(mail, planner);
  planner.obstacle = Obstacle::None;
  planner.epoch = job.epoch;
}

/// The motion is where the job says. What is planned now is taken later: it is where it will be
/// then.
void stand(GroupMotion &planner, const PlanningJob &job, double interval) noexcept {
  path::Motion &motion = planner.motion;
  motion.law.first = job.place.piece;
  motion.since = job.place.time + (job.moves ? job.late : 0.0);
  motion.cycles = 0;
  motion.cycle = interval;
  motion.way = job.way;
  motion.promise = larger(job.promise - (job.moves ? job.late : 0.0), 0.0);
  motion.resting = job.resting;
  motion.gate = job.gate;
  planner.first = job.first;
  planner.dwelling = job.dwelling;
  planner.planTime = 2.0 * interval + job.late;
  __builtin_memcpy(planner.axes, job.axes, sizeof planner.axes);
}

/// What is wanted. Stops at once are the affair of the axes' task.
void wish(GroupMotion &planner, const GroupCommand &command) noexcept {
  path::Motion &motion = planner.motion;
  motion.wish.stop = command.stop || !(command.override > 0.0);
  motion.wish.braking = brakingOf(command);
  if (command.override > 0.0)
    motion.wish.override = command.override;
  motion.keep = command.keep;
  motion.atOnce = false;
}

/// From job to job, as far as that can be counted on. [s]
double intervalOf(const GroupPlanning &planning, double interval) noexcept {
  constexpr double kLess = 0.8;
  constexpr double kMost = 4.0;
  const double since = planning.mail.job.clock - planning.seen;
  return smaller(larger(larger(since, kLess * planning.interval), interval), kMost * interval);
}

/// A law that is being written is written to its end, if there is room: the axes' task takes it as
/// a whole. False: there was none.
bool finishWriting(path::Motion &motion) noexcept {
  while (motion.session == path::Session::Writing)
    if (path::think(motion, 1) == 0)
      return false;
  return true;
}

/// The axes' task gets what has been planned.
void answerWith(const GroupMotion &planner, PlanningMail &mail) noexcept {
  const path::Motion &motion = planner.motion;
  const PlanningJob &job = mail.job;
  PlanningAnswer &answer = mail.answer;
  answer.changed = path::findChange(mail.path, motion, job.place.piece, answer.cut);
  const int64_t known = mail.path.course.next - 1; // the last one may have grown
  answer.fromStrip = known > motion.course.first ? known : motion.course.first;
  path::handOver(motion, answer.fromStrip, answer.changed ? answer.cut.piece : motion.law.next,
                 mail.path);
  if (job.moves)
    mail.path.promise += job.late;
  for (int64_t k = oldest(planner.first); k < decidedEnd(planner.looked, planner.next); ++k)
    copyDecided(movementAt(planner, k), mailed(mail, k));
  writeLooked(planner, mail);
}

} // namespace

bool follow(GroupMotion &group, GroupPlanning &planning, const GroupCommand &command) noexcept {
  prepare(group, command);
  // What is known of the path may be too short for a softer stop, and no more becomes known.
  path::Braking &braking = group.motion.wish.braking;
  braking.accelerationPart = braking.jerkPart = 0.0;
  bool taken = false;
  if (holderOf(planning) == MailHolder::Answered) {
    taken = receive(group, planning);
    give(planning, MailHolder::Axes);
  }
  group.alone = group.alone || (command.stop && command.atOnce);
  if (group.alone) {
    group.awaits = false; // it shall not wait for a plan that it will not take
    (void)path::think(group.motion, command.steps);
  }
  return taken;
}

void goOn(GroupMotion &group, GroupPlanning &planning, const Arm &arm,
          const GroupCommand &command) noexcept {
  const bool moves = movesOn(group);
  goOn(group, arm, command);
  planning.clock += command.cycle;
  if (moves)
    planning.moved += command.cycle;
}

double post(GroupMotion &group, GroupPlanning &planning, const Arm &arm,
            const kinematics::AnyKinematics &kinematics, const GroupCommand &command) noexcept {
  if (group.alone)
    return rebase(group);
  const MailHolder holder = holderOf(planning);
  if (holder == MailHolder::Planner || holder == MailHolder::Answered ||
      (holder == MailHolder::Posted && !takePosted(planning, MailHolder::Axes)))
    return 0.0;
  const double by = rebase(group);
  planning.whole = planning.whole || by > 0.0 || planning.epoch != group.epoch;
  planning.epoch = group.epoch;
  planning.moved = 0.0;
  planning.mail.job.kinematics = kinematics;
  writeJob(group, planning, arm, command);
  give(planning, MailHolder::Posted);
  return by;
}

bool takeJob(GroupPlanning &planning) noexcept { return takePosted(planning, MailHolder::Planner); }

void doJob(GroupPlanning &planning, const PlanningShare &share) noexcept {
  PlanningMail &mail = planning.mail;
  const PlanningJob &job = mail.job;
  GroupMotion &planner = planning.planner;
  planning.interval = intervalOf(planning, share.interval);
  planning.seen = job.clock;
  mail.answer = {};
  mail.answer.next = job.next;
  if (job.whole)
    beginAnew(planner, mail);
  path::LawPlace cut{};
  const bool changes = path::findChange(mail.path, planner.motion, job.place.piece, cut);
  if (planner.epoch != job.epoch || (changes && !path::isBefore(job.place, cut))) {
    mail.answer.lost = true; // it has passed where a plan was to take over
    return;
  }
  stand(planner, job, planning.interval);
  for (int64_t k = job.whole ? job.next : job.given; k < job.next; ++k) {
    planner.lastId = mailed(mail, k).id;
    append(planner, planner.lastId, mailed(mail, k).leg, mailed(mail, k).order);
  }
  wish(planner, job.command);
  const Arm arm{job.kinematics.ref(), job.joints, job.more, job.limits, {}};
  makeKnown(planner, arm, job.command.allowance, share.samples);
  (void)path::think(planner.motion, share.steps);
  if (finishWriting(planner.motion))
    answerWith(planner, mail);
  mail.answer.goesOn = planner.motion.session != path::Session::None;
}

void answerJob(GroupPlanning &planning) noexcept { give(planning, MailHolder::Answered); }

void planAside(GroupPlanning &planning, const PlanningShare &share) noexcept {
  if (!takeJob(planning))
    return;
  doJob(planning, share);
  answerJob(planning);
}

} // namespace stride::group
