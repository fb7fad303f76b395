// A model of motions of limited jerk: it uses nothing of the code that it judges.
#ifndef STRIDE_TESTS_PROPERTY_JERK_MODEL_HPP
#define STRIDE_TESTS_PROPERTY_JERK_MODEL_HPP

#include <algorithm>
#include <cmath>

namespace stride::test {

/// Position, velocity and acceleration, in the model.
struct Moment {
  long double time = 0;
  long double s = 0;
  long double v = 0;
  long double a = 0;

  [[nodiscard]] Moment on(long double jerk, long double t) const {
    return {time + t, s + t * (v + t * (a / 2 + t * jerk / 6)), v + t * (a + t * jerk / 2),
            a + t * jerk};
  }
};

/// A task of the model: all velocities within [low, high], the acceleration within [-fall, rise].
struct Model {
  long double low, high, rise, fall, jerk;
  long double endVelocity;
  long double distance;

  [[nodiscard]] Model mirrored() const {
    return {-high, -low, fall, rise, jerk, -endVelocity, -distance};
  }
  /// The fastest change to the velocity `to` and no acceleration.
  [[nodiscard]] Moment changed(const Moment &from, long double to) const {
    const long double rest = from.v + from.a * std::fabs(from.a) / (2 * jerk);
    const long double side = to >= rest ? 1 : -1;
    const long double limit = side > 0 ? rise : fall;
    const long double a = side * from.a;
    const long double gain = side * (to - from.v);
    const long double peak = std::min(limit, std::sqrt(std::max(0.0L, jerk * gain + a * a / 2)));
    Moment now = from.on(side * jerk, std::max(0.0L, (peak - a) / jerk));
    const long double missing = side * (to - now.v) - now.a * now.a / (2 * jerk);
    if (missing > 0 && peak >= limit)
      now = now.on(0, missing / limit);
    return now.on(-side * jerk, std::fabs(now.a) / jerk);
  }
};

/// How long a motion takes that is pushed up until `part` of the way to the highest velocity
/// (0 to 1: to the greatest acceleration, to 2: at it), and how far it gets.
inline Moment pushed(const Model &model, const Moment &start, long double part) {
  const long double square = model.jerk * (model.high - start.v) + start.a * start.a / 2;
  const long double most = std::min(model.rise, std::sqrt(std::max(0.0L, square)));
  Moment now =
      start.on(model.jerk, std::min(part, 1.0L) * std::max(0.0L, most - start.a) / model.jerk);
  const long double hold = (model.high - now.v - now.a * now.a / (2 * model.jerk)) / model.rise;
  if (part > 1 && hold > 0)
    now = now.on(0, (part - 1) * hold);
  return model.changed(now, model.endVelocity);
}

} // namespace stride::test

#endif
