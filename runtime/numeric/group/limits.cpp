#include "runtime/numeric/group/limits.hpp"

#include "runtime/numeric/cube_root.hpp"

namespace stride::group {
namespace {

using exact::fabs;
using exact::kInfinity;
using exact::larger;
using exact::smaller;

/// Of what the axes' accelerations allow, the part that a bend may take: the rest is for changes of
/// the velocity.
constexpr double kBendShare = 0.9;
/// Of what an axis's jerk allows, the part that a bend may take at a constant velocity. Of what is
/// left of it at the velocity of the strip, the part for changes of the acceleration along the
/// path; the rest is for accelerations in the bend.
constexpr double kBendJerkShare = 0.6;
constexpr double kChangeShare = 0.5;
/// How far derivatives in the middle of a part may be from a straight line between its ends.
constexpr double kEvenness = 0.2;
/// A path is straight for an axis if, over the length of the strip, bends change its velocity by no
/// more than this part of what the path does, in units of the axes' accelerations: by rounding.
constexpr double kStraight = 1e-9;
/// Parts shorter than this part of Look::least are not halved any more.
constexpr double kLeastPart = 1.0 / 1024.0;
constexpr int kMostDepth = 12; ///< Of halves of halves: as many as lead there.

/// The greatest amounts in a part, likewise.
struct Peaks {
  double d[4][kAxes];
  bool bent[kAxes]; ///< The path is not straight for this axis.
  Pace pace[kPaces];
};

int32_t axisCount(const Arm &arm) noexcept { return kArmAxes + arm.more; }
bool hasAxis(const Arm &arm, int32_t k) noexcept {
  return k < arm.joints || (k >= kArmAxes && k < axisCount(arm));
}

/// Sums of products of derivatives of coordinates.
struct Products {
  double square;    ///< Of the first ones.
  double along;     ///< Of first and second ones.
  double alongNext; ///< Derivative of that.
  double third;     ///< Of the third ones, squared.
};

Products productsOf(const Series *series, int count) noexcept {
  Products sum{};
  for (int i = 0; i < count; ++i) {
    const double(&c)[4] = series[i].c;
    sum.square += c[1] * c[1];
    sum.along += 2.0 * c[1] * c[2];
    sum.alongNext += 4.0 * c[2] * c[2] + 6.0 * c[1] * c[3];
    sum.third += 36.0 * c[3] * c[3];
  }
  return sum;
}

/// How fast a point goes.
Pace paceOf(const Products &sum) noexcept {
  if (!(sum.square > 0.0)) // it starts, or stops: smoothly
    return {{0.0, 0.0, exact::sqrt(sum.third)}};
  const double speed = exact::sqrt(sum.square);
  const double change = sum.along / speed;
  return {{speed, fabs(change), fabs(sum.alongNext - change * change) / speed}};
}

/// How fast an orientation turns, by its nine numbers: together they change by the root of 2 times
/// the angle. [rad] Where it nearly turns round, the amount changes in no time, which is no jerk.
Pace paceOfTurn(const Matrix<Series> &turn) noexcept {
  Products sum = productsOf(turn.data(), 9);
  for (double *const product : {&sum.square, &sum.along, &sum.alongNext, &sum.third})
    *product *= 0.5;
  Pace pace = paceOf(sum);
  const double most = exact::sqrt(sum.third) + pace.d[0] * sum.square;
  pace.d[2] = smaller(pace.d[2], most);
  return pace;
}

/// How fast tool axes go that are given, all together. [°]
Pace paceOfGiven(const PathPlace &place) noexcept {
  Series axes[kArmAxes];
  int count = 0;
  for (int32_t k = 0; k < kArmAxes; ++k)
    if (isGiven(place.given, k))
      axes[count++] = place.axes[k];
  return paceOf(productsOf(axes, count));
}

/// How fast the tool's point moves, and in a corner where that stops or starts, how fast it turns.
/// [u], [°]
void setPaces(const PathPlace &place, Sample &sample) noexcept {
  for (Pace &pace : sample.pace)
    pace = {};
  if (!place.byTool)
    return;
  Pace(&pace)[kPaces] = sample.pace;
  pace[0] = paceOf(productsOf(place.tool.place.data(), 3));
  if (!place.alsoTurns) {
    if (!(pace[0].d[0] > 0.0))
      pace[0] = {{1.0, 0.0, 0.0}};
    return;
  }
  constexpr double kDegrees = 57.29577951308232;
  if (place.given != 0) {
    pace[1] = paceOfGiven(place);
  } else {
    pace[1] = paceOfTurn(place.tool.turn);
    for (double &d : pace[1].d)
      d *= kDegrees;
  }
  pace[2] = {{1.0, 0.0, 0.0}};
}

Obstacle take(const Arm &arm, const Track &track, double way, Look &look, Sample &sample) noexcept {
  PathPlace place;
  Series axes[kAxes];
  track.placeAt(track.track, growing(way, 1.0), place);
  ++look.samples;
  const Obstacle obstacle = axesAt(arm, place, look.reference, axes);
  if (obstacle != Obstacle::None)
    return obstacle;
  sample.way = way;
  constexpr double kFactorials[] = {1.0, 1.0, 2.0, 6.0};
  for (int32_t k = 0; k < kAxes; ++k)
    for (int n = 0; n < 4; ++n)
      sample.d[n][k] = hasAxis(arm, k) ? kFactorials[n] * axes[k].c[n] : 0.0;
  setPaces(place, sample);
  return Obstacle::None;
}

/// Whether each axis is that near to where it is now that it can only be there: less than half a
/// turn away.
bool isNear(const Arm &arm, const Sample &sample, const Look &look) noexcept {
  constexpr double kNear = 170.0; // [°]
  for (int32_t k = 0; k < axisCount(arm); ++k)
    if (hasAxis(arm, k) && !(fabs(sample.d[0][k] - look.reference[k]) < kNear))
      return false;
  return true;
}

/// The same, of what has been kept where it is that place, but for rounding.
Obstacle takeKept(const Arm &arm, const Track &track, double way, Look &look,
                  Sample &sample) noexcept {
  constexpr double kRounding = 1e-12;
  while (look.keptCount > 0 && look.kept[look.keptCount - 1].way < look.from)
    --look.keptCount;
  for (int32_t k = look.keptCount - 1; k >= 0; --k) {
    if (!(fabs(look.kept[k].way - way) <= kRounding * way) || !isNear(arm, look.kept[k], look))
      continue;
    sample = look.kept[k];
    ++look.samples; // of what a cycle may look at: the path is made known when it was before
    return Obstacle::None;
  }
  return take(arm, track, way, look, sample);
}

/// Keeps a place at the end of a part that has become shorter; of too many the furthest goes.
void keep(const Sample &sample, Look &look) noexcept {
  int32_t place = look.keptCount;
  while (place > 0 && look.kept[place - 1].way < sample.way)
    --place;
  if (place > 0 && look.kept[place - 1].way == sample.way)
    return;
  if (look.keptCount == kKeptSamples) {
    if (place == 0)
      return;
    for (int32_t k = 1; k < place; ++k)
      look.kept[k - 1] = look.kept[k];
    look.kept[place - 1] = sample;
    return;
  }
  for (int32_t k = look.keptCount; k > place; --k)
    look.kept[k] = look.kept[k - 1];
  look.kept[place] = sample;
  ++look.keptCount;
}

/// How far the middle is from where a straight line has it, over the axes, in units of their
/// limits.
bool isEven(const Arm &arm, const Sample &a, const Sample &m, const Sample &b) noexcept {
  for (int n = 1; n <= 2; ++n) {
    double bend = 0.0;
    double most = 0.0;
    for (int32_t k = 0; k < axisCount(arm); ++k) {
      if (!hasAxis(arm, k))
        continue;
      const double limit = arm.limits[k].acceleration;
      bend = larger(bend, fabs(m.d[n][k] - 0.5 * (a.d[n][k] + b.d[n][k])) / limit);
      most =
          larger(most, larger(fabs(a.d[n][k]), larger(fabs(m.d[n][k]), fabs(b.d[n][k]))) / limit);
    }
    if (bend > kEvenness * most)
      return false;
  }
  return true;
}

/// The greatest amount of a derivative: of the samples, and what a parabola through them can be
/// more: twice that. Of `hidden`, what a cubic through them can be more than the parabola, only
/// what is beyond the double counts.
double peakOf(double a, double m, double b, double hidden = 0.0) noexcept {
  const double bend = fabs(m - 0.5 * (a + b));
  return larger(fabs(a), larger(fabs(m), fabs(b))) + larger(0.5 * bend, 0.25 * bend + hidden);
}

/// What the samples of a derivative do not show of a cubic through them: the next derivative in the
/// middle does.
double hiddenOf(const Sample &a, const Sample &m, const Sample &b, int n, int32_t k) noexcept {
  constexpr double kShare = 0.19245; // 4 times the greatest amount of x (x - 1/2) (x - 1)
  const double slope = (b.way - a.way) * m.d[n + 1][k];
  return kShare * fabs(slope - (b.d[n][k] - a.d[n][k]));
}

void raise(Peaks &peaks, const Sample &a, const Sample &m, const Sample &b) noexcept {
  for (int n = 1; n < 4; ++n)
    for (int32_t k = 0; k < kAxes; ++k) {
      const double hidden = n < 3 ? hiddenOf(a, m, b, n, k) : 0.0;
      peaks.d[n][k] = larger(peaks.d[n][k], peakOf(a.d[n][k], m.d[n][k], b.d[n][k], hidden));
    }
  for (int32_t i = 0; i < kPaces; ++i)
    for (int n = 0; n < 3; ++n)
      peaks.pace[i].d[n] =
          larger(peaks.pace[i].d[n], peakOf(a.pace[i].d[n], m.pace[i].d[n], b.pace[i].d[n]));
}

/// Raises peaks over a part that is too short to be a strip of its own, or even.
Obstacle lookInto(const Arm &arm, const Track &track, Look &look, const Sample &a, const Sample &b,
                  Peaks &peaks) noexcept {
  // The halves that are left to be looked at, the nearest last.
  Sample ends[kMostDepth + 1];
  int depth = 0;
  ends[0] = b;
  Sample begin = a;
  while (depth >= 0) {
    Sample middle;
    const Sample &end = ends[depth];
    const Obstacle obstacle =
        take(arm, track, begin.way + 0.5 * (end.way - begin.way), look, middle);
    if (obstacle != Obstacle::None)
      return obstacle;
    const bool divisible = end.way - begin.way > kLeastPart * look.least && depth < kMostDepth;
    if (divisible && !isEven(arm, begin, middle, end)) {
      ends[++depth] = middle;
      continue;
    }
    raise(peaks, begin, middle, end);
    begin = end;
    --depth;
  }
  return Obstacle::None;
}

void limitVelocity(path::Strip &strip, double velocity) noexcept {
  strip.ceiling = smaller(strip.ceiling, velocity * velocity);
}

/// Forgets bends that are rounding only.
void straighten(const Arm &arm, double length, Peaks &peaks) noexcept {
  double most = 0.0;
  for (int32_t k = 0; k < axisCount(arm); ++k)
    if (hasAxis(arm, k))
      most = larger(most, peaks.d[1][k] / arm.limits[k].acceleration);
  for (int32_t k = 0; k < axisCount(arm); ++k) {
    if (!hasAxis(arm, k))
      continue;
    const double little = kStraight * most * arm.limits[k].acceleration;
    peaks.bent[k] = peaks.d[2][k] * length > little || peaks.d[3][k] * length * length > little;
    if (!peaks.bent[k])
      peaks.d[2][k] = peaks.d[3][k] = 0.0;
  }
  for (Pace &pace : peaks.pace) {
    const double(&d)[3] = pace.d;
    if (d[1] * length <= kStraight * d[0] && d[2] * length * length <= kStraight * d[0])
      pace.d[1] = pace.d[2] = 0.0;
  }
}

void limitByAxes(const Arm &arm, const Peaks &peaks, path::Strip &strip) noexcept {
  for (int32_t k = 0; k < axisCount(arm); ++k) {
    const double first = peaks.d[1][k];
    const AxisLimits &limits = arm.limits[k];
    if (!hasAxis(arm, k) || !(first > 0.0))
      continue;
    strip.feed = smaller(strip.feed, limits.velocity / first);
    strip.along = larger(strip.along, first / limits.acceleration);
    strip.across = larger(strip.across, peaks.d[2][k] / limits.acceleration);
    if (peaks.bent[k])
      limitVelocity(strip, numeric::cubeRoot(kBendJerkShare * limits.jerk / peaks.d[3][k]));
  }
  if (strip.across > 0.0)
    strip.ceiling = smaller(strip.ceiling, kBendShare / strip.across);
}

/// What the velocity of the strip leaves of an axis's jerk.
double jerkLeft(const Arm &arm, const Peaks &peaks, int32_t k, double velocity) noexcept {
  return arm.limits[k].jerk - velocity * velocity * velocity * peaks.d[3][k];
}

/// After the velocity: the jerk along the path, and what the axes would allow.
void limitJerk(const Arm &arm, const Peaks &peaks, path::Strip &strip) noexcept {
  const double velocity = exact::sqrt(path::squareIn(strip, 1.0));
  double jerk = 1e30;
  for (int32_t k = 0; k < axisCount(arm); ++k)
    if (hasAxis(arm, k) && peaks.d[1][k] > 0.0)
      jerk = smaller(jerk, (peaks.bent[k] ? kChangeShare * jerkLeft(arm, peaks, k, velocity)
                                          : arm.limits[k].jerk) /
                               peaks.d[1][k]);
  path::setSpareJerk(strip, jerk);
  strip.jerk = static_cast<float>(smaller(jerk, static_cast<double>(strip.jerk)));
}

/// After all else: three times the second derivative times velocity times acceleration must not
/// take more of an axis's jerk than what is left of it.
void limitInBends(const Arm &arm, const Peaks &peaks, path::Strip &strip) noexcept {
  const double velocity = exact::sqrt(path::squareIn(strip, 1.0));
  const auto change = static_cast<double>(strip.jerk);
  double most = kInfinity;
  for (int32_t k = 0; k < axisCount(arm); ++k)
    if (hasAxis(arm, k) && peaks.bent[k] && peaks.d[2][k] > 0.0)
      most = smaller(most, (jerkLeft(arm, peaks, k, velocity) - peaks.d[1][k] * change) /
                               (3.0 * peaks.d[2][k] * velocity));
  strip.acceleration = smaller(strip.acceleration, most);
  strip.deceleration = smaller(strip.deceleration, most);
}

/// The velocity at which a pace that changes along the way takes no more than its shares of what
/// the command allows.
void limitPace(const Pace &pace, const PathLimits &path, path::Strip &strip) noexcept {
  if (pace.d[0] > 0.0)
    strip.feed = smaller(strip.feed, path.velocity / pace.d[0]);
  if (pace.d[1] > 0.0)
    strip.ceiling = smaller(strip.ceiling,
                            kBendShare * smaller(path.acceleration, path.deceleration) / pace.d[1]);
  if (pace.d[2] > 0.0)
    limitVelocity(strip, numeric::cubeRoot(kBendJerkShare * path.jerk / pace.d[2]));
}

void limitByPath(const Peaks &peaks, const PathLimits &path, path::Strip &strip) noexcept {
  for (const Pace &pace : peaks.pace)
    limitPace(pace, path, strip);
}

/// After the velocity: what it leaves of the command's accelerations and jerk. A pace p that
/// changes makes of velocity v, acceleration a and jerk j: p a + p' v^2 and
/// p j + 3 p' v a + p'' v^3.
void limitAlongPath(const Peaks &peaks, const PathLimits &path, path::Strip &strip) noexcept {
  const double velocity = exact::sqrt(path::squareIn(strip, 1.0));
  for (const Pace &pace : peaks.pace) {
    const double(&p)[3] = pace.d;
    if (!(p[0] > 0.0))
      continue;
    // Nothing of what is infinite where nothing changes.
    const double taken = p[1] > 0.0 ? p[1] * velocity * velocity : 0.0;
    const double jerkTaken = p[2] > 0.0 ? p[2] * velocity * velocity * velocity : 0.0;
    double acceleration = (path.acceleration - taken) / p[0];
    double deceleration = (path.deceleration - taken) / p[0];
    double jerk = (path.jerk - jerkTaken) / p[0];
    if (p[1] > 0.0) {
      const double most = (1.0 - kChangeShare) * jerk * p[0] / (3.0 * p[1] * velocity);
      acceleration = smaller(acceleration, most);
      deceleration = smaller(deceleration, most);
      jerk *= kChangeShare;
    }
    strip.acceleration = smaller(strip.acceleration, acceleration);
    strip.deceleration = smaller(strip.deceleration, deceleration);
    strip.jerk = static_cast<float>(smaller(jerk, static_cast<double>(strip.jerk)));
  }
}

/// Nobody can tell an acceleration that rises within half a millisecond from one that jumps, but
/// its plan would need many cells.
void limitRise(path::Strip &strip) noexcept {
  constexpr double kLeastRise = 0.0005; // [s]
  const double most = smaller(larger(strip.acceleration, strip.deceleration), 1.0 / strip.along);
  const double rise = most / kLeastRise;
  strip.jerk = static_cast<float>(smaller(static_cast<double>(strip.jerk), rise));
  path::setSpareJerk(strip, smaller(path::spareJerk(strip), rise));
}

/// In bends a stop may ask for what accelerations leave there.
void limitSpare(const Arm &arm, const Peaks &peaks, path::Strip &strip) noexcept {
  const double velocity = exact::sqrt(path::squareIn(strip, 1.0));
  const double most = smaller(larger(strip.acceleration, strip.deceleration), 1.0 / strip.along);
  double spare = path::spareJerk(strip);
  for (int32_t k = 0; k < axisCount(arm); ++k)
    if (hasAxis(arm, k) && peaks.bent[k] && peaks.d[1][k] > 0.0)
      spare = smaller(spare,
                      (jerkLeft(arm, peaks, k, velocity) - 3.0 * peaks.d[2][k] * velocity * most) /
                          peaks.d[1][k]);
  path::setSpareJerk(strip, larger(spare, static_cast<double>(strip.jerk)));
}

void makeStrip(const Arm &arm, Peaks &peaks, const PathLimits &path, double length,
               path::Strip &strip) noexcept {
  strip = {};
  strip.feed = kInfinity;
  strip.ceiling = kInfinity;
  strip.endCeiling = kInfinity;
  strip.acceleration = kInfinity;
  strip.deceleration = kInfinity;
  strip.jerk = 1e30F;
  straighten(arm, length, peaks);
  limitByPath(peaks, path, strip);
  limitByAxes(arm, peaks, strip);
  limitAlongPath(peaks, path, strip);
  limitJerk(arm, peaks, strip);
  limitRise(strip);
  limitInBends(arm, peaks, strip);
  limitSpare(arm, peaks, strip);
  strip.endFeed = strip.feed;
}

} // namespace

Obstacle axesAt(const Arm &arm, const PathPlace &place, const double (&reference)[kAxes],
                Series (&axes)[kAxes]) noexcept {
  for (int32_t k = place.byTool ? kArmAxes : 0; k < kAxes; ++k)
    axes[k] = place.axes[k];
  if (place.byTool) {
    using kinematics::Outcome;
    for (int32_t k = 0; k < kArmAxes && place.given != 0; ++k)
      if (isGiven(place.given, k))
        axes[k] = place.axes[k];
    const Outcome outcome =
        place.given != 0
            ? arm.kinematics.place(place.tool.place, arm.configuration, reference, axes)
            : arm.kinematics.inverse(place.tool, arm.configuration, reference, axes);
    if (outcome != Outcome::Done)
      return outcome == Outcome::OutOfLimits ? Obstacle::AxisLimit : Obstacle::Unreachable;
  }
  for (int32_t k = 0; k < axisCount(arm); ++k) {
    if (!hasAxis(arm, k))
      continue;
    const Series &axis = axes[k];
    if (!exact::isfinite(axis.c[0]))
      return Obstacle::Unreachable;
    if (!exact::isfinite(axis.c[1]) || !exact::isfinite(axis.c[2]) || !exact::isfinite(axis.c[3]))
      return Obstacle::Singular;
    const double place = withoutRounding(arm.limits[k], axis.c[0]);
    if (place < arm.limits[k].low || place > arm.limits[k].high)
      return Obstacle::AxisLimit;
  }
  return Obstacle::None;
}

Obstacle limitStrip(const Arm &arm, const Track &track, const PathLimits &path, Look &look,
                    path::Strip &strip) noexcept {
  Sample begin;
  Sample middle;
  Sample end;
  Obstacle obstacle = Obstacle::None;
  if (look.goesOn) {
    begin = look.end;
    ++look.samples; // as for those that are kept
  } else {
    obstacle = take(arm, track, look.from, look, begin);
  }
  if (obstacle != Obstacle::None)
    return obstacle;
  Peaks peaks{};
  obstacle = takeKept(arm, track, look.to, look, end);
  while (obstacle == Obstacle::None) {
    const double half = look.from + 0.5 * (look.to - look.from);
    obstacle = takeKept(arm, track, half, look, middle);
    if (obstacle != Obstacle::None)
      return obstacle;
    if (isEven(arm, begin, middle, end)) {
      raise(peaks, begin, middle, end);
      break;
    }
    if (half - look.from < look.least) {
      obstacle = lookInto(arm, track, look, begin, end, peaks);
      if (obstacle != Obstacle::None)
        return obstacle;
      break;
    }
    look.to = half;
    keep(end, look);
    end = middle;
  }
  if (obstacle != Obstacle::None)
    return obstacle;
  for (int32_t k = 0; k < kAxes; ++k)
    look.reference[k] = end.d[0][k];
  look.end = end;
  makeStrip(arm, peaks, path, look.to - look.from, strip);
  return Obstacle::None;
}

} // namespace stride::group
