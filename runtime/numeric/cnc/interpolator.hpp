// Drives a path: takes objects from a queue, plans the motion over them, and says in each cycle
// where it is. What SMC_Interpolator does, without ST. Free of the C++ standard library: linked
// into every application.
// Source: SoftMotion V2.3 manual, section 6.2.8; the profile with limited jerk is SoftMotion 3's.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_INTERPOLATOR_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_INTERPOLATOR_HPP

#include "runtime/numeric/cnc/path_object.hpp"
#include "runtime/numeric/cnc/queue.hpp"
#include "runtime/numeric/path/motion.hpp"
#include "runtime/numeric/path/segment.hpp"

namespace stride::cnc {

/// What is asked for in one cycle.
struct Command {
  Queue *queue;
  double cycle;             ///< Time since the last call, > 0. [s]
  double override;          ///< Factor of the program's velocities; up to kLeastOverride: stop.
  double quickDeceleration; ///< For quickStop, if more than the path's. [u/s^2]
  double jerk;              ///< For LawKind::Jerk, > 0. [u/s^3]
  path::LawKind law;
  double share; ///< Of the path's accelerations: 1, or less for a law that exceeds it.
  path::AxesLimits limits;
  bool slowStop;       ///< Come to rest on the path as its deceleration allows, and stay there.
  bool quickStop;      ///< The same with quickDeceleration.
  bool emergencyStop;  ///< Stand still at once.
  bool waitAtNextStop; ///< Stay where the path comes to rest.
  bool singleStep;     ///< Come to rest at the end of each object.
  bool acknowledge;    ///< The M function is done.
  bool limitKinks;     ///< Slow down at kinks for the axes' accelerations; with LawKind::Jerk only.
  bool twoWays;        ///< A negative override goes back; the queue keeps all objects.
  int32_t budget;      ///< Steps of planning.
};

/// At most this override stops the motion.
inline constexpr double kLeastOverride = 0.01;

/// What an interpolator is doing.
enum class Phase : uint8_t {
  Filling,  ///< It waits for the queue to be full or complete.
  Moving,   ///< Or waiting for something.
  Finished, ///< The path has ended.
  Failed,   ///< See `error`.
};

/// Where the motion is after a cycle.
struct Progress {
  Position position;     ///< Set position.
  path::WayState motion; ///< Along the path; the way counts from somewhere.
  Vector3 tangent;       ///< Of length 1; 0 at rest.
  double length;         ///< Way of this cycle. [u]
  double objectLength;   ///< Of the present object. [u]
  double objectWay;      ///< Along it. [u]
  int32_t source;        ///< Its sourceLine; -1: there is none.
  int16_t lastSwitch;    ///< Passed in this cycle, 0: none.
  uint16_t function;     ///< Number of the M function that waits; 0: none.
  bool waits;            ///< It is at rest because it has to be.
  bool atEnd;            ///< There is no more path in this direction.
};

/// What the interpolator keeps from cycle to cycle. Trivially copyable, may be moved in memory
/// between two calls.
struct Interpolator {
  path::Motion motion;
  path::Segment here; ///< Of the first object of the queue, if it moves.
  path::Segment next; ///< Of the object that is being made known to `motion`.
  Position position;  ///< Where the path is.
  Progress progress;  ///< Of the last cycle.
  double hereBegin;   ///< Way where `here` begins. [u]
  double nextBegin;   ///< Way where `next` begins. [u]
  double nextEnd;     ///< Way where it ends. [u]
  double nextWay;     ///< How far along `next` is known. [u]
  double dwell;       ///< Time that is left of a dwell. [s]
  int64_t first;      ///< Index in the queue of the present object; 0 if objects leave it.
  int64_t known;      ///< How many objects from there on are known to `motion`.
  double shift;       ///< How far ways have been made smaller since `shifted` objects ... [u]
  int64_t shifted;    ///< ... from there on became known.
  uint32_t switches;  ///< Bit n - 1: switch n is on.
  int16_t error;      ///< SMC_ERROR
  int16_t warning;    ///< SMC_ERROR that does not stop anything.
  uint8_t passed;     ///< Which switch points of the present object have been passed.
  Phase phase;
  bool backwards;    ///< The path is gone back.
  bool synchronises; ///< It has come to a synchronisation: there is nothing more on purpose.
  bool hasHere;      ///< `here` is that of the first object.
  bool hasNext;      ///< `next` is not completely known yet.
  bool begun; ///< The first object of the queue, which has no way, has been there for a cycle.
};

/// Begins a path. The position stays where it was until the first object says where the path
/// begins.
void start(Interpolator &interpolator, const Command &command) noexcept;

/// One cycle. The result stays in interpolator.progress.
void cycle(Interpolator &interpolator, const Command &command) noexcept;

/// The object that the path is in, or waits at; null: there is none, before the path and after it.
const PathObject *presentObject(const Interpolator &interpolator, const Command &command) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_INTERPOLATOR_HPP
