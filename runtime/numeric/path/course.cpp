#include "runtime/numeric/path/course.hpp"

namespace stride::path {
namespace {

using exact::larger;
using exact::smaller;

/// Whether what stands between two strips may be moved to all of both.
bool mayMerge(const Strip &before, const Strip &after, double begin, double time) noexcept {
  if (before.stop || before.gate)
    return false;
  const double least = smaller(squareIn(before, 1.0), squareIn(after, 1.0));
  const double length = after.end - begin;
  return length * length <= least * time * time;
}

void mergeInto(Strip &strip, const Strip &next) noexcept {
  strip.feed = smaller(smaller(strip.feed, next.feed), strip.endFeed);
  strip.ceiling = smaller(smaller(strip.ceiling, next.ceiling), strip.endCeiling);
  strip.acceleration = smaller(strip.acceleration, next.acceleration);
  strip.deceleration = smaller(strip.deceleration, next.deceleration);
  strip.along = larger(strip.along, next.along);
  strip.across = larger(strip.across, next.across);
  if (next.jerk > 0.0F && (!(strip.jerk > 0.0F) || next.jerk < strip.jerk))
    strip.jerk = next.jerk;
  strip.spare = next.spare < strip.spare ? next.spare : strip.spare; // in the order of the values
  strip.end = next.end;
  strip.endFeed = next.endFeed;
  strip.endCeiling = next.endCeiling;
  strip.stop = next.stop;
  strip.gate = next.gate;
}

} // namespace

bool append(Course &course, const Strip &strip, double time) noexcept {
  if (course.next - course.first > 1) {
    Strip &last = stripAt(course, course.next - 1);
    if (mayMerge(last, strip, beginOf(course, course.next - 1), time)) {
      mergeInto(last, strip);
      return true;
    }
  }
  if (roomIn(course) == 0)
    return false;
  stripAt(course, course.next) = strip;
  ++course.next;
  return true;
}

void forgetBefore(Course &course, double way) noexcept {
  while (course.first < course.next && stripAt(course, course.first).end <= way) {
    course.begin = stripAt(course, course.first).end;
    ++course.first;
  }
}

int64_t stripOf(const Course &course, double way) noexcept {
  int64_t low = course.first;
  int64_t high = course.next - 1;
  if (low < high && stripAt(course, low).end > way) // as a rule: where the motion is
    return low;
  while (low < high) {
    const int64_t middle = low + (high - low) / 2;
    if (stripAt(course, middle).end <= way)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

const Strip *endedByRounding(const Course &course, double way) noexcept {
  constexpr double kUnits = 5e-14; // 225 units in the last place; plans fail up to 160
  if (course.first == course.next)
    return nullptr;
  const Strip &strip = stripAt(course, stripOf(course, way));
  const double left = strip.end - way;
  return left > 0.0 && left <= kUnits * way ? &strip : nullptr;
}

} // namespace stride::path
