#include "runtime/numeric/cnc/chord_merge.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {
namespace {

using exact::larger;
using exact::smaller;
using numeric::dot;

/// What numbers leave of a straight line, as a part of its length.
constexpr double kStraight = 1e-14;

/// Whether an object may be merged with others at all.
bool isPlainLine(const PathObject &object) noexcept {
  if (object.moveType != MoveType::Line || object.marks != 0 || object.probe != 0 ||
      object.planar != 0 || object.slopes != 0 || object.start.sProfile != 0)
    return false;
  for (const int16_t id : object.switchId)
    if (id != 0)
      return false;
  ObjectShape shape{};
  return shapeOf(object, shape) == ShapeError::None && shape.measure == Measure::Space;
}

bool haveSameLimits(const PathObject &a, const PathObject &b) noexcept {
  for (int32_t i = 0; i < 9; ++i)
    if (a.limits[i].velocity != b.limits[i].velocity ||
        a.limits[i].acceleration != b.limits[i].acceleration ||
        a.limits[i].deceleration != b.limits[i].deceleration)
      return false;
  for (int32_t i = 0; i < kAdditionalParameters; ++i)
    if (a.additional[i] != b.additional[i])
      return false;
  return true;
}

/// Whether `object` goes on where `run` ends, in the same manner.
bool goesOn(const PathObject &run, const PathObject &object) noexcept {
  for (int32_t i = 0; i < kAxes; ++i)
    if (run.end.coordinate[i] != object.start.coordinate[i])
      return false;
  return run.velocityEnd > 0.0 && run.velocity == object.velocity &&
         run.acceleration == object.acceleration && run.deceleration == object.deceleration &&
         run.end.axes == object.end.axes && run.end.frame == object.end.frame &&
         run.toolRadius == object.toolRadius && run.features == object.features &&
         run.cornerDistance == object.cornerDistance && haveSameLimits(run, object);
}

/// A part of a line, as parameters from 0 to 1.
struct Range {
  double low, high;
};

void intersect(Range &range, double low, double high) noexcept {
  range.low = larger(range.low, low);
  range.high = smaller(range.high, high);
}

/// The line that shall stand for a run.
struct Chord {
  const double (&start)[kAxes];
  double delta[kAxes];
  Vector3 way;
  double square; ///< Of its length in space. [u^2]
  unsigned axes; ///< Which axes count besides X, Y, Z.
};

/// Where on the chord one is near enough to a place.
Range nearTo(const Chord &chord, const double (&place)[kAxes], double tolerance) noexcept {
  const Vector3 off = {place[0] - chord.start[0], place[1] - chord.start[1],
                       place[2] - chord.start[2]};
  const double foot = dot(off, chord.way) / chord.square;
  const Vector3 away = off - chord.way * foot;
  const double left = tolerance * tolerance - dot(away, away);
  if (!(left >= 0.0))
    return {1.0, 0.0};
  const double half = exact::sqrt(left / chord.square);
  Range range{foot - half, foot + half};
  for (int32_t i = kAxisA; i < kAxes; ++i) {
    if ((chord.axes >> static_cast<unsigned>(i) & 1U) == 0)
      continue;
    const double along = place[i] - chord.start[i];
    const double delta = chord.delta[i];
    if (delta == 0.0)
      intersect(range, 0.0, exact::fabs(along) <= tolerance ? 1.0 : -1.0);
    else if (delta > 0.0)
      intersect(range, (along - tolerance) / delta, (along + tolerance) / delta);
    else
      intersect(range, (along + tolerance) / delta, (along - tolerance) / delta);
  }
  return range;
}

/// Whether one line to `end` can stand for the run and all up to there.
bool reaches(const Merger &merger, const Position &end) noexcept {
  const PathObject &run = merger.run;
  Chord chord{run.start.coordinate, {}, placeOf(end) - placeOf(run.start), 0.0, end.axes};
  for (int32_t i = 0; i < kAxes; ++i)
    chord.delta[i] = end.coordinate[i] - run.start.coordinate[i];
  chord.square = dot(chord.way, chord.way);
  if (!exact::isPositive(chord.square))
    return false;
  const double tolerance = merger.tolerance + kStraight * exact::sqrt(chord.square);
  // The least that one has to have gone at each place.
  double gone = 0.0;
  for (int32_t k = 0; k < merger.lines; ++k) {
    Range range =
        nearTo(chord, k + 1 < merger.lines ? merger.place[k] : run.end.coordinate, tolerance);
    intersect(range, gone, 1.0);
    if (!(range.low <= range.high))
      return false;
    gone = range.low;
  }
  return true;
}

} // namespace

int32_t mergeNext(Merger &merger, const PathObject &object, PathObject (&ready)[2]) noexcept {
  PathObject &run = merger.run;
  int32_t count = 0;
  const bool isPlain = isPlainLine(object);
  if (merger.lines > 0 && isPlain && merger.lines < kMostMerged && goesOn(run, object) &&
      reaches(merger, object.end)) {
    for (int32_t i = 0; i < kAxes; ++i)
      merger.place[merger.lines - 1][i] = run.end.coordinate[i];
    run.end = object.end;
    run.velocityEnd = object.velocityEnd;
    run.length = numeric::norm(placeOf(run.end) - placeOf(run.start));
    ++merger.lines;
    return 0;
  }
  if (merger.lines > 0)
    ready[count++] = run;
  merger.lines = isPlain ? 1 : 0;
  if (isPlain)
    run = object;
  else
    ready[count++] = object;
  return count;
}

int32_t mergeEnd(Merger &merger, PathObject &ready) noexcept {
  const bool has = merger.lines > 0;
  if (has)
    ready = merger.run;
  merger.lines = 0;
  return has ? 1 : 0;
}

} // namespace stride::cnc
