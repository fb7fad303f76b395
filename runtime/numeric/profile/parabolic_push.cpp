#include "runtime/numeric/profile/parabolic_push.hpp"

// All motions of a push consist of a side that rises, from the virtual velocity s/J at which its
// acceleration would be 0, to the greatest velocity u/J, and one that falls from there to the end
// velocity e/J. (If the push ends while the axis still slows down, there is no greatest velocity,
// and the formulas hold all the same.) Velocities are counted in squares of accelerations: times
// the jerk J; ways times its square. A side whose acceleration gets to q, and not to its limit L,
// changes the velocity by q^2 in the time 2q; one that gets there changes it by c in c/L + L. The
// way is the mean velocity times the time. So the acceleration at which one of the sides ends is
// the only unknown, and the way is a polynomial in it, or with one root of a square.

namespace stride::motion::parabolic {
namespace {

/// A function's value and derivatives.
struct Value {
  double at;
  double slope;
  double bend;
};

/// Both sides without their limits; `q` is the acceleration of the one that begins at `near`, and
/// whose velocities lie beyond those of the other, from `far`.
struct BothFree {
  double near;
  double far;
  double way;

  Value operator()(double q) const noexcept {
    const double w = exact::sqrt(q * q + (near - far)); // the acceleration of the other side
    const double part = q / w;
    const double growth = near + q * q + 0.5 * q * w;
    return {(2.0 * near + q * q) * q + (near + far + q * q) * w - way, 2.0 * (1.0 + part) * growth,
            2.0 * (1.0 - part * part) / w * growth + (1.0 + part) * (4.0 * q + w + q * part)};
  }
};

/// Both sides without their limits and alike.
struct BothAlike {
  double from;
  double way;

  Value operator()(double q) const noexcept {
    return {2.0 * (2.0 * from + q * q) * q - way, 4.0 * from + 6.0 * q * q, 12.0 * q};
  }
};

/// One side, from `far`, is held at its limit.
struct OneHeld {
  double near;
  double far;
  double limit;
  double inverse; ///< Of the limit.
  double way;

  Value operator()(double q) const noexcept {
    const double most = near + q * q;
    const double part = q * inverse;
    const double growth = most + 0.5 * q * limit;
    return {(2.0 * near + q * q) * q + 0.5 * (most + far) * ((most - far) * inverse + limit) - way,
            2.0 * (1.0 + part) * growth, 2.0 * inverse * growth + (1.0 + part) * (4.0 * q + limit)};
  }
};

/// The root of a function between `low` (there it is below 0) and `high` (at least 0), with at most
/// 60 evaluations, by Halley's method. Halves the bracket where that leads out of it.
template <class Function>
double rootOf(const Function &function, double low, double high, double guess) noexcept {
  double q = guess > low && guess < high ? guess : 0.5 * (low + high);
  for (int i = 0; i < 60; ++i) {
    const Value value = function(q);
    if (value.at < 0.0)
      low = q;
    else
      high = q;
    const double step =
        value.at * value.slope / (value.slope * value.slope - 0.5 * value.at * value.bend);
    const double next = q - step;
    // The next step would have three times as many digits.
    if (exact::fabs(step) <= 0x1p-17 * exact::fabs(next))
      return next > low ? next < high ? next : high : low;
    q = next > low && next < high ? next : 0.5 * (low + high);
    if (!(high - low > kEpsilon * exact::fabs(q)))
      break;
  }
  return q;
}

/// About the cube root, to a few percent.
double roughCubeRoot(double x) noexcept {
  const auto bits = __builtin_bit_cast(uint64_t, x);
  return __builtin_bit_cast(double, bits / 3 + 0x2a9f7625119d328eULL);
}

/// A task in the numbers of the equation.
class Equation {
public:
  explicit Equation(const Task &task) noexcept
      : jerk_(task.rates.jerk), from_(task.acceleration), rising_(task.rates.rising),
        falling_(task.rates.falling), perRising_(1.0 / rising_), perFalling_(1.0 / falling_) {
    const double velocity = task.velocity * jerk_;
    const double square = from_ * from_;
    start_ = velocity - 0.5 * square;
    settled_ = from_ > 0.0 ? velocity + 0.5 * square : start_;
    end_ = task.endVelocity * jerk_;
    top_ = task.top * jerk_;
    way_ = jerk_ * jerk_ * task.distance + from_ * (velocity - square * (1.0 / 3.0));
  }

  bool solve(Push &push, const Task &task) const noexcept {
    if (from_ < 0.0 && start_ > end_) { // the axis may still slow down
      const double summit = summitOf(task, {0.0, task.velocity, from_});
      const double last = summit < 0.0 && at(summit) >= 0.0 ? summit : 0.0;
      if (at(last) >= 0.0) {
        push.rate = belowRising(from_, last);
        return true;
      }
    }
    if (side(top_, start_, rising_, perRising_) + side(top_, end_, falling_, perFalling_) < way_)
      return false;
    const double lowest = exact::larger(settled_, end_);
    const double full = start_ + rising_ * rising_; // the velocity of a rising side of no hold
    if (full < top_ && (lowest >= full || at(rising_) < 0.0)) {
      push.rate = rising_;
      push.hold = (held(exact::larger(lowest, full)) - full) / (rising_ * jerk_);
      return true;
    }
    const double least = lowest - start_;
    const double most = exact::smaller(top_, full) - start_;
    push.rate = belowRising(exact::larger(from_, least > 0.0 ? exact::sqrt(least) : 0.0),
                            most > 0.0 ? exact::sqrt(most) : 0.0);
    return true;
  }

private:
  /// The way, less the one that is asked for, of a push that ends at `rate`.
  [[nodiscard]] double at(double rate) const noexcept {
    const double most = start_ + rate * rate;
    return (2.0 * start_ + rate * rate) * rate + side(most, end_, falling_, perFalling_) - way_;
  }
  static double side(double most, double from, double limit, double perLimit) noexcept {
    const double change = most - from;
    if (change >= limit * limit)
      return 0.5 * (most + from) * (change * perLimit + limit);
    return change > 0.0 ? (most + from) * exact::sqrt(change) : 0.0;
  }

  /// The greatest velocity where the rising side is held at its limit; it is above `low`.
  [[nodiscard]] double held(double low) const noexcept {
    const double full = end_ + falling_ * falling_;
    if (full < top_ && (low >= full || side(full, start_, rising_, perRising_) +
                                               (2.0 * end_ + falling_ * falling_) * falling_ <
                                           way_)) {
      const double square = 0.5 * (perRising_ + perFalling_);
      const double line = 0.5 * (rising_ + falling_);
      const double rest = 0.5 * start_ * (rising_ - start_ * perRising_) +
                          0.5 * end_ * (falling_ - end_ * perFalling_) - way_;
      const double root = exact::sqrt(exact::larger(line * line - 4.0 * square * rest, 0.0));
      const double most = -2.0 * rest / (line + root);
      return exact::smaller(exact::larger(most, exact::larger(low, full)), top_);
    }
    const double least = low - end_;
    const double most = exact::smaller(top_, full) - end_;
    const double q = rootOf(OneHeld{end_, start_, rising_, perRising_, way_},
                            least > 0.0 ? exact::sqrt(least) : 0.0,
                            most > 0.0 ? exact::sqrt(most) : 0.0, guess(end_, start_));
    return exact::larger(end_ + q * q, low);
  }

  /// The acceleration at which the push ends, between these, where the rising side is not held.
  [[nodiscard]] double belowRising(double low, double high) const noexcept {
    const double limit = falling_ * falling_ - (start_ - end_); // of accelerations that do not hold
    const double edge = limit > 0.0 ? exact::sqrt(limit) : 0.0;
    const OneHeld oneHeld{start_, end_, falling_, perFalling_, way_};
    if (low < -edge) {
      if (high <= -edge || at(-edge) >= 0.0)
        return rootOf(oneHeld, low, exact::smaller(high, -edge), 0.5 * (low + high));
      low = -edge;
    }
    if (high > edge) {
      if (low >= edge || at(edge) < 0.0)
        return rootOf(oneHeld, exact::larger(low, edge), high, guess(start_, end_));
      high = edge;
    }
    if (start_ == end_)
      return rootOf(BothAlike{start_, way_}, low, high, guess(start_, start_));
    if (start_ > end_)
      return rootOf(BothFree{start_, end_, way_}, low, high, guess(start_, end_));
    // By the acceleration of the falling side, whose velocities lie beyond.
    const double change = end_ - start_;
    const double least = low * low - change;
    const double most = high * high - change;
    const double q = rootOf(BothFree{end_, start_, way_}, least > 0.0 ? exact::sqrt(least) : 0.0,
                            most > 0.0 ? exact::sqrt(most) : 0.0, guess(end_, start_));
    return exact::sqrt(q * q + change);
  }

  /// As if both sides were alike and free.
  [[nodiscard]] double guess(double near, double far) const noexcept {
    const double half = 0.5 * way_;
    const double mean = near + far;
    if (!(half > 0.0))
      return 0.0;
    double q = roughCubeRoot(half);
    if (mean > 0.0 && q * mean > half)
      q = half / mean;
    return q - ((q * q + mean) * q - half) / (3.0 * q * q + exact::fabs(mean));
  }

  double jerk_;
  double from_;
  double rising_;
  double falling_;
  double perRising_;
  double perFalling_;
  double start_;   ///< Virtual velocity at the start of the rising side.
  double settled_; ///< The velocity when the acceleration of the start is gone.
  double end_;
  double top_;
  double way_; ///< From the virtual start.
};

/// Beyond, squares of squares may not be numbers.
constexpr double kMiddling = 0x1p100;

} // namespace

bool isRegular(const Task &task) noexcept {
  const Rates &rates = task.rates;
  const double greatest = exact::larger(exact::larger(rates.rising, rates.falling),
                                        exact::larger(task.top, rates.jerk));
  const double settled = settledVelocity(task.velocity, task.acceleration, rates.jerk);
  return greatest < kMiddling && rates.jerk > 1.0 / kMiddling &&
         task.acceleration <= rates.rising && task.acceleration >= -rates.falling &&
         settled <= task.top && settled >= task.bottom && task.endVelocity <= task.top &&
         task.endVelocity >= task.bottom;
}

double summitOf(const Task &task, const State &from) noexcept {
  // The change after the push falls to the acceleration -z, where z^2 = a^2 + s - e, or to its
  // limit. The reach then grows with the sign of s + a^2 + a z / 2, which is convex in a.
  const double jerk = task.rates.jerk;
  const double limit = task.rates.falling;
  const double first = exact::larger(from.acceleration, -limit);
  const double settled = jerk * from.velocity - 0.5 * from.acceleration * from.acceleration;
  const double gain = settled - jerk * task.endVelocity;
  const double rest = limit * limit * (1.0 / 16.0) - settled;
  if (!(first < 0.0 && gain > 0.0 && rest > 0.0))
    return 0.0;
  double rate = first;
  if (rate * rate + gain > limit * limit) { // the falling limit is reached
    const double summit = -0.25 * limit - exact::sqrt(rest);
    if (summit * summit + gain >= limit * limit)
      return summit >= first ? summit : 0.0;
    const double last = limit * limit - gain; // of those that reach the limit
    rate = exact::larger(first, last > 0.0 ? -exact::sqrt(last) : 0.0);
  }
  for (int i = 0; i < 30; ++i) { // Newton's tangents lie below a convex function
    const double z = exact::sqrt(rate * rate + gain);
    const double slope = 2.0 * rate + 0.5 * z + 0.5 * rate * (rate / z);
    const double growth = settled + rate * rate + 0.5 * rate * z;
    if (!(growth > 0.0))
      return i > 0 ? rate : 0.0;
    if (!(slope < 0.0))
      return 0.0;
    const double step = growth / slope;
    rate -= step;
    if (!(rate < 0.0))
      return 0.0;
    if (-step <= 4.0 * kEpsilon * -rate)
      break;
  }
  return rate;
}

bool findPush(Push &push, const Task &task) noexcept { return Equation(task).solve(push, task); }

} // namespace stride::motion::parabolic
