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

/// The start of a task in the numbers of the equation.
struct Start {
  double virtually; ///< The velocity at the start of the rising side.
  double settled;   ///< The velocity when the acceleration of the start is gone.
  double way;       ///< From the virtual start.

  explicit Start(const Task &task) noexcept {
    const double jerk = task.rates.jerk;
    const double from = task.acceleration;
    const double velocity = task.velocity * jerk;
    const double square = from * from;
    virtually = velocity - 0.5 * square;
    settled = from > 0.0 ? velocity + 0.5 * square : virtually;
    way = jerk * jerk * task.distance + from * (velocity - square * (1.0 / 3.0));
  }
};

/// Rates with what is divided by them.
struct Limits {
  double jerk;
  double rising;
  double falling;
  double perRising;
  double perFalling;

  explicit Limits(const Rates &rates) noexcept
      : jerk(rates.jerk), rising(rates.rising), falling(rates.falling), perRising(1.0 / rising),
        perFalling(1.0 / falling) {}

  [[nodiscard]] Limits mirrored() const noexcept {
    Limits other = *this;
    other.rising = falling;
    other.falling = rising;
    other.perRising = perFalling;
    other.perFalling = perRising;
    return other;
  }
};

/// The way by both sides, less the one that is asked for.
class Equation {
public:
  Equation(double start, double end, double top, double way, const Limits &limits) noexcept
      : jerk_(limits.jerk), rising_(limits.rising), falling_(limits.falling),
        perRising_(limits.perRising), perFalling_(limits.perFalling), start_(start), end_(end),
        top_(top), way_(way) {}

  /// Finds the push to above the velocity `lowest`, with at least the acceleration `from`; false if
  /// the way by the top velocity is too short.
  bool solve(Push &push, double lowest, double from) const noexcept {
    if (risingTo(top_) + fallingFrom(top_) < way_)
      return false;
    solveBelowTop(push, lowest, from);
    return true;
  }

  /// The same where that way is long enough.
  void solveBelowTop(Push &push, double lowest, double from) const noexcept {
    const double full = start_ + rising_ * rising_; // the velocity of a rising side of no hold
    if (full < top_ && (lowest >= full || at(rising_) < 0.0)) {
      push.rate = rising_;
      push.hold = (held(exact::larger(lowest, full)) - full) / (rising_ * jerk_);
      return;
    }
    const double least = lowest - start_;
    const double most = exact::smaller(top_, full) - start_;
    push.rate = belowRising(exact::larger(from, least > 0.0 ? exact::sqrt(least) : 0.0),
                            most > 0.0 ? exact::sqrt(most) : 0.0);
  }

  /// Of a push that ends at `rate`, which is not held.
  [[nodiscard]] double at(double rate) const noexcept {
    const double most = start_ + rate * rate;
    return (2.0 * start_ + rate * rate) * rate + side(most, end_, falling_, perFalling_) - way_;
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

  /// The ways of both sides to and from the velocity `most`.
  [[nodiscard]] double risingTo(double most) const noexcept {
    return side(most, start_, rising_, perRising_);
  }
  [[nodiscard]] double fallingFrom(double most) const noexcept {
    return side(most, end_, falling_, perFalling_);
  }

private:
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
  double rising_;
  double falling_;
  double perRising_;
  double perFalling_;
  double start_; ///< Virtual velocity at the start of the rising side.
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

bool findPush(Push &push, const Task &task) noexcept {
  const Start start(task);
  const double jerk = task.rates.jerk;
  const double from = task.acceleration;
  const double end = task.endVelocity * jerk;
  const Equation equation(start.virtually, end, task.top * jerk, start.way, Limits(task.rates));
  if (from < 0.0 && start.virtually > end) { // the axis may still slow down
    const double summit = summitOf(task, {0.0, task.velocity, from});
    const double last = summit < 0.0 && equation.at(summit) >= 0.0 ? summit : 0.0;
    if (equation.at(last) >= 0.0) {
      push.rate = equation.belowRising(from, last);
      return true;
    }
  }
  return equation.solve(push, exact::larger(start.settled, end), from);
}

// A task whose velocity passes standstill, with different rates on its two sides, is one of the
// equations above, or of two of them. Let u be the velocity of the vertex of the parabola by which
// the axis falls with the jerk after the push, m the weaker rate, and E = m^2 / 2. At standstill
// the acceleration is at most m.
//
// The rising side: where its square at standstill, -2s, is at most 2E, standstill changes nothing.
// Else all its velocities below 0 belong to u < E, since to standstill the axis falls by the
// parabola of E; and beyond, for u > E, it is the side that begins at the virtual velocity -E, and
// a way that does not change any more. The falling side is the same, seen from the end e. So for u
// < E the task is an equation with the rates of negative velocities, and for u > E one with those
// of positive velocities, in which s and e are at least -E. At E both are the same motion.
//
// The reach grows with the sign of u + az/2, whatever the sides are: a is the acceleration at the
// end of the push, and z how fast the velocity falls where the parabola ends. (A later end moves
// the vertex, and what comes after the parabola by the vertex' change over z.) So:
// - a >= 0, u >= 0: it grows.
// - a >= 0, u < 0: a and z grow with u, so that it falls, and then grows.
// - a < 0, u > E: z^2 <= u + E < 2u and -a < z, so that it grows.
// - a < 0, u < E: z is the smaller one of the root of u - e and of the rate. With b = -a, both
//   s + b^2 - bz/2 are convex over b. Where both are negative, the reach falls: between two roots
//   of square equations. Before and after, it grows.
// So the first push that reaches the target lies before the fall, or in the one growth after it.
// Where the change to the end velocity begins with what the push does, too, both are the same
// motion, and the reach stays: while e is above the velocity at which the acceleration would be
// gone, and while there is more acceleration than the limits allow.
namespace {

double rootOfPositive(double x) noexcept { return x > 0.0 ? exact::sqrt(x) : 0.0; }

/// Where the reach falls while the axis slows down: between these magnitudes of its acceleration;
/// nowhere if they are 0.
struct Fall {
  double least = 0.0;
  double most = 0.0;

  /// `limit` is the greatest acceleration after the push, `edge` is E.
  Fall(double start, double end, double limit, double edge) noexcept {
    // Free: the squares of the roots have the mean 2/3 line and the product 4/3 start^2.
    const double line = 0.25 * (start - end) - 2.0 * start;
    const double free = line * line - 3.0 * start * start;
    const double held = limit * limit * (1.0 / 16.0) - start;
    if (!(line > 0.0 && free > 0.0 && held > 0.0))
      return;
    const double square = (2.0 / 3.0) * (line + exact::sqrt(free));
    const double later = 0.25 * limit + exact::sqrt(held);
    double high = exact::smaller(exact::sqrt(square), later);
    if (start >= -edge) // else it moves below 0, where no edge lies ahead
      high = exact::smaller(high, rootOfPositive(edge - start));
    double low = 0.0;
    if (start > 0.0)
      low = start * exact::larger(1.0 / later, exact::sqrt((4.0 / 3.0) / square));
    if (low < high) {
      least = low;
      most = high;
    }
  }
};

/// A task whose velocity passes standstill.
class TurningEquation {
public:
  explicit TurningEquation(const Task &task) noexcept : TurningEquation(task, Limits(task.rates)) {}

  bool solve(TurningPush &push) const noexcept {
    const double from = task_.acceleration;
    if (from < 0.0 && start_.virtually > end_ && solveSlowing(push))
      return true;
    double lowest = exact::larger(start_.settled, end_);
    if (rises_ || falls_) {
      if (lowest < exact::smaller(edge_, top_) && rising_ + falling_ >= start_.way) {
        below_.solveBelowTop(push, lowest, from);
        return true;
      }
      if (!(edge_ < top_))
        return false;
      lowest = exact::larger(lowest, edge_);
    }
    push.passes = rises_;
    return above_.solve(push, lowest, rises_ ? exact::sqrt(2.0 * edge_) : from);
  }

  /// Half of the square of the acceleration at standstill.
  static double edgeOf(const Task &task) noexcept {
    const double weaker = exact::smaller(task.rates.rising, task.rates.falling);
    return 0.5 * weaker * weaker;
  }

private:
  TurningEquation(const Task &task, const Limits &limits) noexcept
      : task_(task), start_(task), end_(task.endVelocity * limits.jerk),
        top_(task.top * limits.jerk), edge_(edgeOf(task)),
        rises_(start_.virtually < -edge_ && (task.acceleration < 0.0 || task.velocity < 0.0)),
        falls_(end_ < -edge_),
        below_(start_.virtually, end_, exact::smaller(edge_, top_), start_.way, limits.mirrored()),
        rising_(rises_ || falls_ ? below_.risingTo(exact::smaller(edge_, top_)) : 0.0),
        falling_(rises_ || falls_ ? below_.fallingFrom(exact::smaller(edge_, top_)) : 0.0),
        above_(rises_ ? -edge_ : start_.virtually, falls_ ? -edge_ : end_, top_,
               start_.way - (rises_ ? rising_ : 0.0) - (falls_ ? falling_ : 0.0), limits) {}

  /// Finds a push that ends while the axis still slows down; false if none gets far enough.
  bool solveSlowing(Push &push) const noexcept {
    const double start = start_.virtually;
    // From this magnitude of the acceleration on, it is the equation above.
    const double change = rises_   ? __builtin_huge_val()
                          : falls_ ? rootOfPositive(edge_ - start)
                                   : 0.0;
    const auto at = [&](double magnitude) noexcept {
      return (magnitude < change ? below_ : above_).at(-magnitude);
    };
    double most = -task_.acceleration;
    double least = 0.0;
    const Fall fall(start, end_, task_.rates.rising, edge_);
    if (fall.least < exact::smaller(fall.most, most)) {
      if (fall.most < most && at(fall.most) >= 0.0)
        least = fall.most;
      else
        most = fall.least;
    }
    if (!(most > least && at(least) >= 0.0))
      return false;
    const bool isAbove = most > change && (least >= change || at(change) >= 0.0);
    if (isAbove)
      push.rate = above_.belowRising(-most, -exact::larger(least, change));
    else
      push.rate = below_.belowRising(-exact::smaller(most, change), -least);
    return true;
  }

  const Task &task_;
  Start start_;
  double end_;
  double top_;
  double edge_; ///< Where both equations meet.
  bool rises_;  ///< Whether standstill changes the rising side.
  bool falls_;
  Equation below_;
  double rising_; ///< The ways of both sides at the edge, or at the top velocity, if that is less.
  double falling_;
  Equation above_;
};

} // namespace

bool isRegularTurn(const Task &task) noexcept {
  const double jerk = task.rates.jerk;
  const double rate = task.acceleration;
  const double greatest = exact::larger(exact::larger(task.rates.rising, task.rates.falling),
                                        exact::larger(task.top, jerk));
  const double settled = settledVelocity(task.velocity, rate, jerk);
  const double limit = rate * task.velocity < 0.0 ? task.rates.falling : task.rates.rising;
  // What turns by itself has no more than the weaker rate at standstill.
  const bool turns =
      task.velocity * settled < 0.0 && exact::fabs(settled) * jerk > TurningEquation::edgeOf(task);
  const bool keeps = exact::fabs(rate) <= limit && !turns;
  const bool takenAway = rate < 0.0 && settled <= task.endVelocity; // by any motion, first of all
  return greatest < kMiddling && jerk > 1.0 / kMiddling && (keeps || takenAway) &&
         settled <= task.top && task.endVelocity <= task.top && task.endVelocity >= -task.top;
}

double turningSummit(const Task &task, const State &from) noexcept {
  const double jerk = task.rates.jerk;
  const double start = jerk * from.velocity - 0.5 * from.acceleration * from.acceleration;
  const double edge = TurningEquation::edgeOf(task);
  return -Fall(start, jerk * task.endVelocity, task.rates.rising, edge).most;
}

bool findTurningPush(TurningPush &push, const Task &task) noexcept {
  return TurningEquation(task).solve(push);
}

} // namespace stride::motion::parabolic
