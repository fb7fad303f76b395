#include "runtime/numeric/cnc/processors/avoid_loop.hpp"

#include "runtime/iec/math.h"
#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {
namespace {

using numeric::dot;

/// Ways below this part of the objects count as none.
constexpr double kNothing = 1e-9;
/// Below this sine curves only touch.
constexpr double kTouch = 1e-9;
constexpr uint8_t kBeginnings = kToolLeft | kToolRight | kSmooth | kRound;

double crossOf(const Vector3 &a, const Vector3 &b) noexcept { return a.x * b.y - a.y * b.x; }

/// Where an object is crossed by one that is `n` places after it.
struct Meeting {
  Crossing at;
  uint32_t n;
};

/// The first object of the queue, and what is known of it.
struct Search {
  const LoopAvoider &loops;
  const Queue *queue;
  Track track;
  uint32_t last; ///< How far followers belong to it.
  Meeting best;
  bool found;
};

/// The direction in which the path goes on after the n-th object, or comes to it; 0: none.
Vector3 neighbourDirection(const Search &search, uint32_t n, bool after) noexcept {
  constexpr uint32_t kFar = 16; // objects without a way between
  for (uint32_t i = 1; i <= kFar; ++i) {
    if (!after && n < i)
      break;
    const PathObject *object = objectAt(search.queue, after ? n + i : n - i);
    if (object == nullptr || object->moveType == MoveType::Jump)
      break;
    if (object->moveType == MoveType::Function)
      continue;
    Track track;
    if (trackOf(*object, search.loops.plane, track) != TrackError::None)
      break;
    if (track.shape.length > 0.0)
      return after ? directionAtStart(track) : directionAtEnd(track);
  }
  return numeric::kZero;
}

double angleOf(const Vector3 &v) noexcept { return ::stride::atan2(v.y, v.x); }

/// Whether two paths through one place cross there, by the directions from which they come and to
/// which they go.
bool passThrough(const Vector3 &in, const Vector3 &out, const Vector3 &otherIn,
                 const Vector3 &otherOut) noexcept {
  constexpr double kTurn = 6.283185307179586477;
  if (!(dot(in, in) > 0.0 && dot(out, out) > 0.0 && dot(otherIn, otherIn) > 0.0 &&
        dot(otherOut, otherOut) > 0.0))
    return false;
  const double base = angleOf(-in);
  const auto turned = [base](const Vector3 &v) {
    const double angle = angleOf(v) - base;
    return angle - kTurn * exact::floor(angle / kTurn);
  };
  const double border = turned(out);
  const double a = turned(-otherIn);
  const double b = turned(otherOut);
  const auto isAtBorder = [border](double angle) {
    return exact::fabs(angle - border) < kTouch || angle < kTouch || kTurn - angle < kTouch;
  };
  if (isAtBorder(a) || isAtBorder(b))
    return false;
  return (a < border) != (b < border);
}

Vector3 directionAt(const Track &track, double u) noexcept {
  const Vector3 d = path::overParameter(track.shape, u).d1;
  const double length = exact::sqrt(dot(d, d));
  return length > 0.0 ? d * (1.0 / length) : numeric::kZero;
}

/// Whether the path crosses itself at a place that two of its objects have in common.
bool isCrossing(const Search &search, const Track &other, uint32_t n, Crossing &at) noexcept {
  if (at.second < kNothing)
    at.second = 0.0;
  if (at.second > 1.0 - kNothing)
    at.second = 1.0;
  if (at.first > 1.0 - kNothing)
    at.first = 1.0;
  const bool inside = at.first < 1.0;
  const bool otherInside = at.second > 0.0 && at.second < 1.0;
  const Vector3 here = inside ? directionAt(search.track, at.first) : directionAtEnd(search.track);
  const Vector3 there = otherInside       ? directionAt(other, at.second)
                        : at.second > 0.0 ? directionAtEnd(other)
                                          : directionAtStart(other);
  if (inside && otherInside)
    return exact::fabs(crossOf(here, there)) > kTouch;
  const Vector3 out = inside ? here : neighbourDirection(search, 0, true);
  const Vector3 otherIn = at.second > 0.0 ? there : neighbourDirection(search, n, false);
  const Vector3 otherOut = at.second < 1.0 ? there : neighbourDirection(search, n, true);
  return passThrough(here, out, otherIn, otherOut);
}

void meet(Search &search, uint32_t n, const PathObject &object) noexcept {
  Track other;
  if (!isMotion(object) || trackOf(object, search.loops.plane, other) != TrackError::None ||
      !(other.shape.length > 0.0))
    return;
  Crossing crossings[kMostCrossings];
  const int32_t count = crossingsOf(search.track, other, crossings);
  for (int32_t i = 0; i < count; ++i) {
    Crossing at = crossings[i];
    const bool isBefore = at.first <= search.loops.from + kNothing;
    const bool isLater = search.found && (at.first > search.best.at.first ||
                                          (at.first == search.best.at.first && n < search.best.n));
    // The next object begins where this one ends.
    const bool isJoint = at.first > 1.0 - kNothing && at.second < kNothing && n == 1;
    if (isBefore || isLater || isJoint || !isCrossing(search, other, n, at))
      continue;
    search.best = {at, n};
    search.found = true;
  }
}

/// Cuts an object to a part of its track.
void cutTo(PathObject &object, const Plane &plane, const Track &track, double from,
           double to) noexcept {
  if (from == 0.0 && to == 1.0)
    return;
  double first = from;
  double last = to;
  if (isFreeForm(track)) {
    const double all = path::lengthBetween(track.shape, 0.0, 1.0);
    first = path::lengthBetween(track.shape, 0.0, from) / all;
    last = 1.0 - path::lengthBetween(track.shape, to, 1.0) / all;
  }
  const PathObject whole = object;
  for (int32_t i = 0; i < kAxes; ++i) {
    const double way = whole.end.coordinate[i] - whole.start.coordinate[i];
    if (from > 0.0)
      object.start.coordinate[i] = whole.start.coordinate[i] + way * first;
    if (to < 1.0)
      object.end.coordinate[i] = whole.start.coordinate[i] + way * last;
  }
  keepSwitches(object, first, last);
  follow(object, plane, track, from, to);
  if (from == 0.0)
    object.start = whole.start;
  if (to == 1.0)
    object.end = whole.end;
}

/// The object goes on where the path is after a loop.
void goOn(LoopAvoider &loops, PathObject &object) noexcept {
  if (loops.moved) {
    object.start = loops.end;
    (void)calculateLength(object); // it may climb further than before
  }
  loops.moved = false;
  if (loops.lost) {
    takeSwitches(object, loops.vanished, 0.0);
    object.marks |= loops.vanished.marks;
  }
  loops.lost = false;
}

/// An object of a loop is left out; functions stay.
void leaveOut(LoopAvoider &loops, const PathObject &object, Output &output) noexcept {
  --loops.skip;
  if (object.moveType == MoveType::Function) {
    PathObject kept = object;
    for (int32_t i = 0; i < kAxes; ++i)
      kept.start.coordinate[i] = kept.end.coordinate[i] = loops.end.coordinate[i];
    put(output, kept);
    return;
  }
  if (!loops.lost) {
    loops.vanished = object;
    for (int16_t &id : loops.vanished.switchId)
      id = 0;
    loops.vanished.marks = 0;
    loops.lost = true;
  }
  takeSwitches(loops.vanished, object, 0.0);
  const uint8_t begins = object.marks & kBeginnings;
  loops.vanished.marks |= begins;
}

/// Looks for the object that ends the part without loops. False: not all have been looked at.
bool searchEnd(LoopAvoider &loops, const Queue *queue) noexcept {
  for (uint32_t i = 0; i < kIndexedPerCall && !loops.ended && loops.known < loops.index.indexed;
       ++i) {
    const PathObject *object = objectAt(queue, loops.known);
    if (object == nullptr)
      break;
    if ((object->marks & kEndAvoidLoops) != 0)
      loops.ended = true;
    else
      ++loops.known;
  }
  return loops.ended || loops.known == loops.index.indexed;
}

/// The first object of the queue is done.
void removeFirst(LoopAvoider &loops) noexcept {
  forgetFirst(loops.index);
  if (loops.known > 0)
    --loops.known;
  else
    loops.ended = false;
}

Step cut(LoopAvoider &loops, const Source &source, const Search &search, Output &output) noexcept {
  PathObject object = source.object;
  const double to = search.found ? search.best.at.first : 1.0;
  cutTo(object, loops.plane, search.track, loops.from, to);
  goOn(loops, object);
  if (search.found) {
    // What ends after the object still ends there.
    loops.skip = search.best.n - 1;
    loops.from = search.best.at.second;
    loops.moved = true;
    loops.end = object.end;
  } else {
    loops.from = 0.0;
  }
  put(output, object);
  removeFirst(loops);
  return Step::Took;
}

/// What does not move in the plane, or is not within G61 and G60.
Step pass(LoopAvoider &loops, const PathObject &object, Output &output) noexcept {
  PathObject *same = put(output, object);
  if (same != nullptr && isMotion(object)) {
    goOn(loops, *same);
    loops.from = 0.0;
  }
  removeFirst(loops);
  return Step::Took;
}

} // namespace

void start(LoopAvoider &loops) noexcept {
  __builtin_memset(static_cast<void *>(&loops), 0, sizeof loops);
}

Step next(LoopAvoider &loops, const Source &source, Output &output) noexcept {
  const PathObject &object = source.object;
  if (!loops.on && (object.marks & kAvoidLoops) != 0) {
    loops.on = true;
    loops.ended = false;
    loops.known = 0;
    loops.plane = planeOf(object);
  }
  if (!loops.on) {
    PathObject *same = put(output, object);
    if (same != nullptr && isMotion(object))
      goOn(loops, *same);
    return Step::Took;
  }
  const bool isKnown = updateIndex(loops.index, source.queue, loops.plane);
  if (!isKnown || !searchEnd(loops, source.queue))
    return Step::Again;
  const bool isLast = (object.marks & kEndAvoidLoops) != 0;
  if (loops.skip > 0) {
    leaveOut(loops, object, output);
    removeFirst(loops);
    return Step::Took;
  }
  Search search{loops, source.queue, {}, loops.known, {}, false};
  if (!loops.ended)
    search.last = UINT32_MAX;
  TrackError error = TrackError::None;
  if (isMotion(object))
    error = trackOf(object, loops.plane, search.track);
  if (error == TrackError::Geometry) {
    output.error = StreamError::InvalidObject;
    return Step::Failed;
  }
  if (isLast)
    loops.on = false;
  const bool isAway = error != TrackError::None || !isMotion(object);
  if (isAway || !(search.track.shape.length > 0.0))
    return pass(loops, object, output);
  if (loops.from >= 1.0) { // the loop ends at its end
    loops.skip = 1;
    leaveOut(loops, object, output);
    loops.from = 0.0;
    removeFirst(loops);
    return Step::Took;
  }
  if (!isLast)
    visitNear(loops.index, boxOf(search.track), search.last,
              [&search](uint32_t n, const PathObject &other) { meet(search, n, other); });
  return cut(loops, source, search, output);
}

Step finish(LoopAvoider & /*loops*/, Ending /*ending*/, Output & /*output*/) noexcept {
  return Step::Took;
}

} // namespace stride::cnc
