// A motion along a path that becomes known piece by piece: what is known of it is planned, while
// what has been planned is gone over. It always ends in rest, so that it may be left alone at any
// time; it is planned anew, from a place a little ahead, when more of the path is known, with
// another override, or to stop.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_MOTION_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_MOTION_HPP

#include "runtime/numeric/path/plan.hpp"

namespace stride::path {

inline constexpr int32_t kPieces = 412;

/// What kind of law the motion follows.
enum class LawKind : uint8_t {
  Trapezoid, ///< Constant accelerations.
  Sigmoid,   ///< The same times, but the velocity changes as sin^2 does: accelerations are exceeded
             ///< by pi / 2.
  Jerk,      ///< Limited tangential jerk.
};

/// How the velocity changes.
struct MotionSettings {
  LawKind kind;
  double jerk;  ///< For LawKind::Jerk, > 0. [u/s^3]
  double share; ///< For the others: of the path's accelerations; less than 1 for a law that exceeds
                ///< them.
  bool lean;    ///< Plans are to cost little, and may be a little slower for that.
};

/// The planned motion: pieces one after the other, a ring.
struct Law {
  TimePiece piece[kPieces];
  double until[kPieces]; ///< Time at the end of a piece, since a time that is the same for all. [s]
  double end[kPieces];   ///< Way at the end of a piece: start + length, but not rounded. [u]
  uint8_t mark[kPieces]; ///< See PieceMark.
  int64_t first;         ///< Number of the piece in which the motion is, or of the next one.
  int64_t next;          ///< The number that the next one gets.
};

/// What is at the end of a piece.
enum PieceMark : uint8_t {
  kRest = 1,  ///< The run ends.
  kFinal = 2, ///< It ends in a stop of the path; else no more was known.
  kGate = 4,  ///< See Strip.
};

/// What has been asked for while the motion goes on.
struct Wish {
  double override;         ///< Factor of feeds, > 0.
  double limit;            ///< It goes no further than this way; kInfinity: as far as it can. [u]
  Braking braking;         ///< To stop: see PlanTask.
  bool stop;               ///< It comes to rest as soon as it can, and stays there.
  MotionSettings settings; ///< Others wait until the motion does not accelerate or brake.
};

/// How far the making of the next law is.
enum class Session : uint8_t {
  None,
  Seeking,  ///< The place from which to plan is looked for.
  Planning, ///< The plan is made.
  Writing,  ///< The plan becomes the law.
};

/// All of it. Trivially copyable, may be moved in memory between two calls.
struct Motion {
  Course course;
  Law law;
  Plan plan;
  Wish wish;             ///< May be changed at any time.
  Wish planned;          ///< With which the law was planned.
  MotionSettings former; ///< Those of the pieces before `changed`, if they are others.
  int64_t changed;       ///< Piece from which on the law has the settings of `planned`.
  double way;            ///< Where the motion is. [u]
  double since;          ///< Start of the piece until the cycles of one length began. [s]
  double cycle;          ///< Length of these cycles. [s]
  double keep;           ///< For so long the law ahead stays, whatever is asked for; 0: no longer
                         ///< than plans need. It may be changed at any time. [s]
  int64_t cycles;        ///< How many there were.
  double tail;           ///< In which its last run only brakes. [s]
  double calm;           ///< Since its last place from where plans succeed best: before it has to
                         ///< give way to what is ahead; kInfinity: there is none. [s]
  double lead;           ///< How far ahead the session plans. [s]
  double urgentLead;     ///< The least one of the next session for another wish. [s]
  double passed;         ///< Session: time of the pieces that have been looked at. [s]
  double cut;            ///< Session: time in the piece where the plan takes over. [s]
  double stopLength;     ///< Session: within which it tries to stop. [u]
  double stopFactor;     ///< Of the shortest way to stop, until one is found.
  TimePiece ramp;        ///< Session: may go on in the next strip; no length: none.
  double rampRoom;       ///< Of the ramp: what is free above it at borders of strips. [u^2/s^2]
  int64_t seek;    ///< Session: piece that is looked at; the one in which the plan takes over.
  int64_t fresh;   ///< Session: first piece that is written.
  int64_t writing; ///< Session: cell or strip that is written next.
  double cellTime; ///< Of plans' cells: a part of the time to stop. [s]
  int32_t cells;   ///< With how many the next plan is made.
  int32_t steps;   ///< Of the session until now.
  int32_t tries;   ///< Of the session.
  Session session;
  Wish asked;     ///< Session: what it is planned for.
  int32_t pause;  ///< Calls of think() until another wish is tried again.
  double promise; ///< So much of the law ahead stays, unless a stop is asked for at once. [s]
  bool atOnce;    ///< A stop that is asked for does not care for `keep`. May be changed.
  bool askedLate; ///< Session: a stop that cares for `keep`.
  bool stopsLate; ///< The law ends in such a stop.
  bool urgent;    ///< Session: because of another wish.
  bool changing;  ///< Session: it plans for other settings.
  bool byRamp;    ///< Session: to stop by a ramp in closed form, which takes a few steps.
  bool refused;   ///< The last other wish was not to be had from where the motion was.
  bool resting;   ///< It is where the path rests.
  bool gate;      ///< It is at rest where it has to wait until it is told to go on.
};

/// At rest at way 0, with nothing known of the path.
void reset(Motion &motion, const MotionSettings &settings) noexcept;

/// Makes more of the path known. `strip.end` must be beyond endOf(motion.course). False: there is
/// no room now.
bool extend(Motion &motion, const Strip &strip) noexcept;

/// Plans for at most `budget` steps; how many it has taken.
int32_t think(Motion &motion, int32_t budget) noexcept;

/// By which settings a piece of the law goes.
inline const MotionSettings &settingsAt(const Motion &motion, int64_t piece) noexcept {
  return piece < motion.changed ? motion.former : motion.planned.settings;
}

/// Whether the law has come to its end. (A plan may be under way.)
inline bool isAtRest(const Motion &motion) noexcept { return motion.law.first == motion.law.next; }

/// Goes on by `time` and says where the motion is then. With `pass`, it goes on beyond rests of the
/// path at once; else it stays there. [s] in
WayState move(Motion &motion, double time, bool pass) noexcept;

/// Where the motion could come to rest at the earliest, about, if it were asked to now. [u]
double stoppingWay(const Motion &motion) noexcept;

/// The motion stands still at once, wherever it is.
void freeze(Motion &motion) noexcept;

/// Forgets how far the way already is, to keep it precise: all ways get smaller by the result. [u]
double rebase(Motion &motion) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_MOTION_HPP
