// What limits of the axes mean for the motion along a segment.
#include "runtime/numeric/cube_root.hpp"
#include "runtime/numeric/path/segment.hpp"

namespace stride::path {
namespace {

using exact::fabs;
using exact::larger;
using exact::smaller;

/// Of what the axes' accelerations allow, the part that a curve may take: the rest is for changes
/// of the velocity.
constexpr double kCurveShare = 0.9;
/// Of what the axes' jerks allow, the part that a curve at constant velocity may take.
constexpr double kJerkShare = 0.5;
/// How far derivatives in a part may be from a straight line between those at its ends.
constexpr double kEvenness = 0.02;
/// Parts that are not longer are taken as they are.
constexpr double kShortest = 1e-8; // of the segment

double most(const double (&values)[kCoordinates]) noexcept {
  double result = 0.0;
  for (const double value : values)
    result = larger(result, fabs(value));
  return result;
}

bool hasLimits(const AxesLimits &limits) noexcept {
  return most(limits.velocity) > 0.0 || most(limits.acceleration) > 0.0 || most(limits.jerk) > 0.0;
}

/// A place of a segment.
struct Place {
  double parameter;
  double way; ///< [u]
};

/// Whether parts are chosen by the parameter: where a curve nearly stands still, the one at a way
/// takes long to find, and there the parameter tells more.
bool byParameter(const Segment &segment) noexcept {
  return hasTable(segment) && segment.table.uneven != 0;
}

Place atWay(const Segment &segment, double way) noexcept {
  return {parameterAt(segment, way), way};
}

Place atParameter(const Segment &segment, double parameter) noexcept {
  return {parameter, wayAt(segment, parameter)};
}

Place between(const Segment &segment, const Place &a, const Place &b) noexcept {
  return byParameter(segment) ? atParameter(segment, 0.5 * (a.parameter + b.parameter))
                              : atWay(segment, 0.5 * (a.way + b.way));
}

PathPoint pointOf(const Segment &segment, const Place &place) noexcept {
  return pointOver(segment, place.parameter, place.way);
}

/// Where a part that begins at `from` ends at most: polynomials may have peaks between the samples
/// of all of their way.
Place partEnd(const Segment &segment, const Place &from) noexcept {
  constexpr double kLongest = 0.25;
  if (segment.profile == 0 && segment.shape.kind != ShapeKind::Polynomial)
    return atWay(segment, segment.length);
  if (byParameter(segment))
    return atParameter(segment, smaller(1.0, from.parameter + kLongest));
  return atWay(segment, smaller(segment.length, from.way + kLongest * segment.length));
}

bool isStraight(const Segment &segment) noexcept {
  return segment.profile == 0 && segment.bent == 0 &&
         (segment.isStill || segment.shape.kind == ShapeKind::Line);
}

/// A part of the way by the derivatives at its ends and in its middle.
struct Part {
  PathPoint begin, middle, end;
};

/// How far the middle is from where a straight line has it, at most over the coordinates.
double bend(const double (&begin)[kCoordinates], const double (&middle)[kCoordinates],
            const double (&end)[kCoordinates]) noexcept {
  double result = 0.0;
  for (int32_t k = 0; k < kCoordinates; ++k)
    result = larger(result, fabs(middle[k] - 0.5 * (begin[k] + end[k])));
  return result;
}

bool isEven(const Part &part) noexcept {
  const double first = larger(most(part.begin.d1), most(part.end.d1));
  const double second =
      larger(larger(most(part.begin.d2), most(part.end.d2)), most(part.middle.d2));
  return bend(part.begin.d1, part.middle.d1, part.end.d1) <= kEvenness * first &&
         bend(part.begin.d2, part.middle.d2, part.end.d2) <= kEvenness * second;
}

/// The greatest amount of a derivative in the part: of its samples, and what a parabola through
/// them can be more.
double bound(const double (&begin)[kCoordinates], const double (&middle)[kCoordinates],
             const double (&end)[kCoordinates], int32_t k) noexcept {
  const double samples = larger(larger(fabs(begin[k]), fabs(middle[k])), fabs(end[k]));
  return samples + 0.5 * fabs(middle[k] - 0.5 * (begin[k] + end[k]));
}

/// The greatest amounts of a coordinate's derivatives over the way.
struct Steepest {
  double first, second, third;
};

void limitAxis(const Steepest &steepest, const AxesLimits &limits, int32_t k,
               Strip &strip) noexcept {
  if (limits.velocity[k] > 0.0 && steepest.first > 0.0) {
    const double velocity = limits.velocity[k] / steepest.first;
    strip.ceiling = smaller(strip.ceiling, velocity * velocity);
  }
  if (limits.acceleration[k] > 0.0) {
    strip.along = larger(strip.along, steepest.first / limits.acceleration[k]);
    strip.across = larger(strip.across, steepest.second / limits.acceleration[k]);
  }
  if (limits.jerk[k] > 0.0 && steepest.third > 0.0) {
    const double velocity = numeric::cubeRoot(kJerkShare * limits.jerk[k] / steepest.third);
    strip.ceiling = smaller(strip.ceiling, velocity * velocity);
  }
}

void limitCurve(Strip &strip) noexcept {
  if (strip.across > 0.0)
    strip.ceiling = smaller(strip.ceiling, kCurveShare / strip.across);
}

void limitPart(const Part &part, const AxesLimits &limits, Strip &strip) noexcept {
  for (int32_t k = 0; k < kCoordinates; ++k)
    limitAxis({bound(part.begin.d1, part.middle.d1, part.end.d1, k),
               bound(part.begin.d2, part.middle.d2, part.end.d2, k),
               bound(part.begin.d3, part.middle.d3, part.end.d3, k)},
              limits, k, strip);
  limitCurve(strip);
}

/// A sine over the way, by its values at both ends, which are of the same sign if it has no zero
/// between them: the greatest amount. `half`: it goes over half a turn at least, or an extreme of
/// it lies between the ends.
double greatest(double begin, double end, double amplitude, bool half) noexcept {
  return half ? amplitude : larger(fabs(begin), fabs(end));
}

/// A coordinate of an arc: `d1` and `d2` at both ends, of which `even` is the climb's part of d1.
Steepest steepestOf(const PathPoint &begin, const PathPoint &end, int32_t k, double even,
                    double turnPerWay, bool isHalf) noexcept {
  const double w = fabs(turnPerWay);
  const double from = begin.d1[k] - even;
  const double to = end.d1[k] - even;
  // d1 - even is a sine, d2 its derivative: an extreme of one is a zero of the other.
  const double second = begin.d2[k] / w;
  const double amplitude = exact::sqrt(from * from + second * second);
  const bool turns = isHalf || (begin.d2[k] > 0.0) != (end.d2[k] > 0.0);
  const bool crosses = isHalf || (from > 0.0) != (to > 0.0);
  const double sine = greatest(from, to, amplitude, turns);
  // With a climb: an extreme may be on either side.
  const double first = turns ? sine + fabs(even) : larger(fabs(begin.d1[k]), fabs(end.d1[k]));
  return {first, w * greatest(second, end.d2[k] / w, amplitude, crosses), w * w * sine};
}

} // namespace

void limitBetween(const Segment &segment, const AxesLimits &limits, double from, double to,
                  Strip &strip) noexcept {
  strip.along = 0.0;
  strip.across = 0.0;
  strip.ceiling = exact::kInfinity;
  limitPart({pointAt(segment, from), pointAt(segment, 0.5 * (from + to)), pointAt(segment, to)},
            limits, strip);
}

void limitArc(const Segment &segment, const AxesLimits &limits, Strip &strip) noexcept {
  constexpr double kHalfTurn = 3.14159265358979323846;
  strip.along = 0.0;
  strip.across = 0.0;
  strip.ceiling = exact::kInfinity;
  const PathPoint begin = pointAt(segment, 0.0);
  const PathPoint end = pointAt(segment, segment.length);
  const Shape &shape = segment.shape;
  const double turnPerWay = shape.sweep / segment.length;
  const bool isHalf = fabs(shape.sweep) >= kHalfTurn;
  const Vector3 climb = shape.v[3] * (1.0 / segment.length);
  const double even[kSpace] = {climb.x, climb.y, climb.z};
  for (int32_t k = 0; k < kCoordinates; ++k) {
    const bool isOfArc = k < kSpace && (static_cast<unsigned>(segment.along) >> k & 1U) == 0;
    limitAxis(isOfArc ? steepestOf(begin, end, k, even[k], turnPerWay, isHalf)
                      : Steepest{fabs(begin.d1[k]), 0.0, 0.0},
              limits, k, strip);
  }
  limitCurve(strip);
}

double limitStrip(const Segment &segment, const AxesLimits &limits, double from,
                  Strip &strip) noexcept {
  strip.along = 0.0;
  strip.across = 0.0;
  strip.ceiling = exact::kInfinity;
  if (!hasLimits(limits))
    return segment.length;
  if (isStraight(segment)) {
    const PathPoint point = pointAt(segment, from);
    limitPart({point, point, point}, limits, strip);
    return segment.length;
  }
  const Place begin = atWay(segment, from);
  Place end = partEnd(segment, begin);
  Part part;
  part.begin = pointOf(segment, begin);
  for (;;) {
    const Place middle = between(segment, begin, end);
    part.middle = pointOf(segment, middle);
    part.end = pointOf(segment, end);
    if (isEven(part) || !(middle.way - from > kShortest * segment.length))
      break;
    end = middle;
  }
  limitPart(part, limits, strip);
  return end.way;
}

double kinkCeiling(const PathPoint &before, const PathPoint &after, const AxesLimits &limits,
                   double other, double time) noexcept {
  double velocity = exact::kInfinity;
  for (int32_t k = 0; k < kCoordinates; ++k) {
    const double change = fabs(after.d1[k] - before.d1[k]);
    const double limit = limits.acceleration[k] > 0.0 ? limits.acceleration[k] : other;
    if (change > 1e-9)
      velocity = smaller(velocity, limit * time / change);
  }
  return velocity * velocity;
}

} // namespace stride::path
