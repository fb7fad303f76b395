#include "runtime/numeric/profile/time_profile.hpp"

#include "runtime/numeric/exact_math.hpp"

namespace stride::motion {
namespace {

constexpr double kResting = 1e-12; ///< An end velocity below this, relative to the others, is 0.

PlanError refuse(TimeProfile &profile, PlanError error) noexcept {
  profile.count = 0;
  profile.duration = 0.0;
  profile.end = {0.0, 0.0, 0.0};
  return error;
}

PlanError check(const State &start, const TimePoint *points, int32_t count) noexcept {
  if (count < 1 || count > TimeProfile::kMaxPoints)
    return PlanError::InvalidLimit;
  if (!isFinite(start))
    return PlanError::InvalidState;
  for (int32_t i = 0; i < count; ++i)
    if (!exact::isfinite(points[i].step) || !(points[i].step > 0.0) ||
        !exact::isfinite(points[i].value))
      return PlanError::InvalidState;
  return PlanError::None;
}

/// Builds a profile piece by piece.
class Builder {
public:
  Builder(TimeProfile &profile, const State &start) noexcept : profile_(profile), place_(start) {
    profile_.count = 0;
  }

  /// A piece of `length` [s] from the present place, the acceleration going to `acceleration`.
  void append(double length, double acceleration) noexcept {
    const double before = place_.acceleration;
    profile_.pieces[profile_.count++] = {time_, place_, (acceleration - before) / length};
    place_.position +=
        (place_.velocity + (2.0 * before + acceleration) * (length * (1.0 / 6.0))) * length;
    place_.velocity += 0.5 * (before + acceleration) * length;
    place_.acceleration = acceleration;
    fastest_ = exact::larger(fastest_, exact::fabs(place_.velocity));
    time_ += length;
  }

  /// What is known better than as an integral.
  void placeAt(double position) noexcept { place_.position = position; }
  void setVelocity(double velocity) noexcept { place_.velocity = velocity; }

  PlanError finish() noexcept {
    if (exact::fabs(place_.velocity) <= kResting * fastest_)
      place_.velocity = 0.0;
    profile_.duration = time_;
    profile_.end = place_;
    bool finite = isFinite(place_);
    for (int32_t i = 0; i < profile_.count; ++i)
      finite =
          finite && isFinite(profile_.pieces[i].origin) && exact::isfinite(profile_.pieces[i].jerk);
    return finite ? PlanError::None : refuse(profile_, PlanError::Unrepresentable);
  }

private:
  TimeProfile &profile_;
  State place_;
  double time_ = 0.0;
  double fastest_ = 0.0;
};

/// `x`, but between 0 and twice each of the slopes `a` and `b`; 0 if they have not the same sign.
double limitedTo(double x, double a, double b) noexcept {
  if (!(a * b > 0.0) || !(x * a > 0.0))
    return 0.0;
  const double most = 2.0 * (exact::fabs(a) < exact::fabs(b) ? a : b);
  return exact::fabs(x) < exact::fabs(most) ? x : most;
}

} // namespace

State TimeProfile::at(double t) const noexcept {
  if (count == 0 || t >= duration) {
    State state = end;
    state.acceleration = 0.0;
    if (end.velocity != 0.0 && t > duration)
      state.position += end.velocity * (t - duration);
    return state;
  }
  int32_t index = count - 1;
  while (index > 0 && t < pieces[index].start)
    --index;
  return numeric::evaluateCubic(pieces[index].origin, pieces[index].jerk, t - pieces[index].start);
}

PlanError planPositions(TimeProfile &profile, const State &start, const TimePoint *points,
                        int32_t count) noexcept {
  if (const PlanError error = check(start, points, count); error != PlanError::None)
    return refuse(profile, error);
  // Unknown: the acceleration `middle` in the middle of the first step and those at the points,
  // acceleration[i] at points[i]. The place in the middle is not given; without it, the first step
  // says middle + acceleration[0] / 6 = first; that the velocity is continuous at a point is one
  // equation of a tridiagonal system each; and the last two accelerations are equal.
  const double half = 0.5 * points[0].step;
  const double first =
      (points[0].value - start.position - points[0].step * start.velocity) / (half * half) -
      start.acceleration * (5.0 / 6.0);
  double diagonal[TimeProfile::kMaxPoints];
  double right[TimeProfile::kMaxPoints];
  double acceleration[TimeProfile::kMaxPoints];
  double middle = 0.0;
  if (count == 1) {
    middle = first * (6.0 / 7.0);
    acceleration[0] = middle;
  } else {
    // Equation i: (step i / 6) a[i-1] + diagonal a[i] + (step i+1 / 6) a[i+1] = right, where
    // `middle` has been eliminated from the first one. Forward elimination, then back substitution.
    const auto slope = [points](int32_t i) {
      return (points[i].value - points[i - 1].value) / points[i].step;
    };
    for (int32_t i = 0; i + 1 < count; ++i) {
      const double next = points[i + 1].step;
      diagonal[i] = (i == 0 ? half : points[i].step) * (1.0 / 3.0) + next * (1.0 / 3.0);
      if (i + 2 == count)
        diagonal[i] += next * (1.0 / 6.0); // a[i+1] = a[i]
      right[i] = i == 0 ? slope(1) - start.velocity - 0.5 * half * start.acceleration - half * first
                        : slope(i + 1) - slope(i);
      if (i > 0) {
        const double below = points[i].step * (1.0 / 6.0);
        const double factor = below / diagonal[i - 1];
        diagonal[i] -= factor * below;
        right[i] -= factor * right[i - 1];
      }
    }
    acceleration[count - 2] = right[count - 2] / diagonal[count - 2];
    acceleration[count - 1] = acceleration[count - 2];
    for (int32_t i = count - 3; i >= 0; --i)
      acceleration[i] =
          (right[i] - points[i + 1].step * (1.0 / 6.0) * acceleration[i + 1]) / diagonal[i];
    middle = first - acceleration[0] * (1.0 / 6.0);
  }
  Builder builder(profile, start);
  builder.append(half, middle);
  builder.append(half, acceleration[0]);
  builder.placeAt(points[0].value);
  for (int32_t i = 1; i < count; ++i) {
    const double step = points[i].step;
    builder.setVelocity((points[i].value - points[i - 1].value) / step -
                        (2.0 * acceleration[i - 1] + acceleration[i]) * (step * (1.0 / 6.0)));
    builder.append(step, acceleration[i]);
    builder.placeAt(points[i].value);
  }
  return builder.finish();
}

PlanError planVelocities(TimeProfile &profile, const State &start, const TimePoint *points,
                         int32_t count) noexcept {
  if (const PlanError error = check(start, points, count); error != PlanError::None)
    return refuse(profile, error);
  const auto slope = [&](int32_t i) {
    return (points[i].value - (i == 0 ? start.velocity : points[i - 1].value)) / points[i].step;
  };
  // At a point the acceleration is that of the parabola through it and its neighbours, but at most
  // twice as steep as either side, and none at a peak or a plateau: then the velocity does not
  // leave the range between two points.
  const auto accelerationAt = [&](int32_t i, double before) {
    const double here = slope(i);
    if (count == 1)
      return limitedTo(2.0 * here - before, here, here);
    const int32_t left = i + 1 < count ? i : i - 1; // of the two steps of the parabola
    const double a = points[left].step;
    const double b = points[left + 1].step;
    if (i + 1 < count) {
      const double next = slope(i + 1);
      return limitedTo((b * here + a * next) / (a + b), here, next);
    }
    return limitedTo(here + (here - slope(i - 1)) * (b / (a + b)), here, here);
  };
  Builder builder(profile, start);
  double before = start.acceleration;
  for (int32_t i = 0; i < count; ++i) {
    const double after = accelerationAt(i, before);
    const double half = 0.5 * points[i].step;
    builder.append(half, 2.0 * slope(i) - 0.5 * (before + after));
    builder.append(half, after);
    builder.setVelocity(points[i].value);
    before = after;
  }
  return builder.finish();
}

PlanError planAccelerations(TimeProfile &profile, const State &start, const TimePoint *points,
                            int32_t count) noexcept {
  if (const PlanError error = check(start, points, count); error != PlanError::None)
    return refuse(profile, error);
  Builder builder(profile, start);
  for (int32_t i = 0; i < count; ++i) {
    builder.append(points[i].step, points[i].value);
  }
  return builder.finish();
}

} // namespace stride::motion
