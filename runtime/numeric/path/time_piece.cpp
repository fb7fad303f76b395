#include "runtime/numeric/path/time_piece.hpp"

#include "runtime/iec/math.h"
#include "runtime/numeric/cube_root.hpp"

namespace stride::path {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// cosh q, sinh q / q and (cosh q - 1) / q^2 with q^2 = y; for negative y those of cos and sin.
struct Hyperbolic {
  double c, s, d;
};

/// By power series near 0, and from there by doubling q.
Hyperbolic hyperbolic(double y) noexcept {
  double z = y;
  int doublings = 0;
  for (; exact::fabs(z) > 0.25; ++doublings)
    z *= 0.25;
  double s = 1.0;
  double d = 1.0;
  for (int k = 7; k > 0; --k) {
    const double n = 2.0 * k;
    s = 1.0 + s * z / (n * (n + 1.0));
    d = 1.0 + d * z / ((n + 1.0) * (n + 2.0));
  }
  d *= 0.5;
  double c = 1.0 + z * d;
  for (; doublings > 0; --doublings) {
    s *= c;
    d *= 0.5 * (c + 1.0);
    z *= 4.0;
    c = 1.0 + z * d;
  }
  return {c, s, d};
}

/// atanh(q) / q with q^2 = z < 1; for negative z that of atan. (Of 1 it would be infinite, and
/// rounding may make more of it.)
double arcOverArgument(double z) noexcept {
  constexpr double kBelowOne = 1.0 - 0x1p-53;
  double factor = 1.0;
  z = z > kBelowOne ? kBelowOne : z;
  while (exact::fabs(z) > 0.02) { // half of the angle
    const double root = 1.0 + exact::sqrt(1.0 - z);
    factor *= 2.0 / root;
    z /= root * root;
  }
  constexpr double kSeries[] = {1.0 / 17.0, 1.0 / 15.0, 1.0 / 13.0, 1.0 / 11.0, 1.0 / 9.0,
                                1.0 / 7.0,  1.0 / 5.0,  1.0 / 3.0,  1.0};
  double sum = 1.0 / 19.0;
  for (const double part : kSeries)
    sum = sum * z + part;
  return factor * sum;
}

/// From v0 to v1 over the way x of a piece that is linear in the way.
double crossing(double v0, double v1, double gradient, double x) noexcept {
  const double sum = v0 + v1;
  if (!(sum > 0.0)) // from rest to rest: half a swing
    return x > 0.0 ? kPi / exact::sqrt(-gradient) : 0.0;
  const double q = x / sum;
  return 2.0 * q * arcOverArgument(gradient * q * q);
}

/// The square of the velocity at x after the start of a piece that is linear in the way. What is
/// left of a difference by rounding is rest: its root would be much more than that.
double squareAt(const TimePiece &piece, double x) noexcept {
  constexpr double kRounding = 0x1p-50;
  const double first = piece.velocity * piece.velocity;
  const double square = first + (2.0 * piece.acceleration + piece.gradient * x) * x;
  return square > kRounding * first ? square : 0.0;
}

WayState linearAt(const TimePiece &piece, double t) noexcept {
  const double v0 = piece.velocity;
  const double a0 = piece.acceleration;
  const double g = piece.gradient;
  const Hyperbolic h = hyperbolic(g * t * t);
  WayState state;
  state.way = piece.start + (v0 * h.s + a0 * t * h.d) * t;
  state.velocity = v0 * h.c + a0 * t * h.s;
  state.acceleration = a0 * h.c + g * v0 * t * h.s;
  state.jerk = g * state.velocity;
  return state;
}

/// How far from rest a motion with constant jerk is after t.
double wayFromRest(double jerk, double t) noexcept { return jerk * t * t * t * (1.0 / 6.0); }

double durationFromRest(double jerk, double x) noexcept {
  return numeric::cubeRoot(6.0 * x / jerk);
}

WayState sineSquaredAt(const TimePiece &piece, double t) noexcept {
  const double rate = kPi / piece.duration;
  const double s = ::stride::sin(rate * t);
  const double c = ::stride::cos(rate * t);
  const double half = 0.5 * piece.gradient;
  return {piece.start + piece.velocity * t + half * (t - s / rate),
          piece.velocity + half * (1.0 - c), half * rate * s, half * rate * rate * c};
}

WayState constantJerkAt(const TimePiece &piece, double t) noexcept {
  const double v = piece.velocity;
  const double a = piece.acceleration;
  const double j = piece.gradient;
  return {piece.start + (v + (0.5 * a + j * t * (1.0 / 6.0)) * t) * t,
          exact::larger(v + (a + 0.5 * j * t) * t, 0.0), a + j * t, j};
}

/// Where a motion is whose pieces are given by the time.
WayState byTime(const TimePiece &piece, double t) noexcept {
  return piece.law == PieceLaw::SineSquared ? sineSquaredAt(piece, t) : constantJerkAt(piece, t);
}

/// The way grows with the time: Newton's steps, kept between what is known to be too little and too
/// much.
double timeByTime(const TimePiece &piece, double way) noexcept {
  constexpr int kMostSteps = 64;
  double low = 0.0;
  double high = piece.duration;
  double t = piece.duration * (way - piece.start) / piece.length;
  for (int i = 0; i < kMostSteps; ++i) {
    const WayState state = byTime(piece, t);
    const double off = way - state.way;
    (off > 0.0 ? low : high) = t;
    double next = t + off / state.velocity;
    if (!(next > low && next < high))
      next = 0.5 * (low + high);
    if (next == t)
      break;
    t = next;
  }
  return t;
}

} // namespace

TimePiece linearPiece(double start, double length, double velocity, double acceleration,
                      double gradient) noexcept {
  TimePiece piece{start, length, velocity, acceleration, gradient, 0.0, PieceLaw::LinearInWay};
  piece.duration = crossing(velocity, exact::sqrt(squareAt(piece, length)), gradient, length);
  return piece;
}

TimePiece pieceFromRest(double start, double length, double jerk) noexcept {
  return {start, length, 0.0, 0.0, jerk, durationFromRest(jerk, length), PieceLaw::FromRest};
}

TimePiece pieceToRest(double start, double length, double jerk) noexcept {
  const double duration = durationFromRest(jerk, length);
  return {start,    length,          0.5 * jerk * duration * duration, -jerk * duration, jerk,
          duration, PieceLaw::ToRest};
}

TimePiece constantJerkPiece(double start, double velocity, double acceleration, double jerk,
                            double duration) noexcept {
  TimePiece piece{start, 0.0, velocity, acceleration, jerk, duration, PieceLaw::ConstantJerk};
  piece.length = constantJerkAt(piece, duration).way - start;
  return piece;
}

TimePiece sineSquaredPiece(double start, double length, double velocity,
                           double acceleration) noexcept {
  TimePiece piece = linearPiece(start, length, velocity, acceleration, 0.0);
  piece.gradient = acceleration * piece.duration;
  piece.law = PieceLaw::SineSquared;
  return piece;
}

double rampTime(double velocity, double acceleration, double jerk) noexcept {
  return velocity * jerk >= acceleration * acceleration
             ? velocity / acceleration + acceleration / jerk
             : 2.0 * exact::sqrt(velocity / jerk);
}

WayState stateAt(const TimePiece &piece, double t) noexcept {
  switch (piece.law) {
  case PieceLaw::LinearInWay:
    break;
  case PieceLaw::ConstantJerk:
  case PieceLaw::SineSquared:
    return byTime(piece, t);
  case PieceLaw::FromRest:
    return {piece.start + wayFromRest(piece.gradient, t), 0.5 * piece.gradient * t * t,
            piece.gradient * t, piece.gradient};
  case PieceLaw::ToRest: {
    const double left = piece.duration - t;
    return {piece.start + (piece.length - wayFromRest(piece.gradient, left)),
            0.5 * piece.gradient * left * left, -piece.gradient * left, piece.gradient};
  }
  }
  return linearAt(piece, t);
}

double velocityAt(const TimePiece &piece, double way) noexcept {
  const double x = way - piece.start;
  if (piece.law == PieceLaw::LinearInWay)
    return exact::sqrt(squareAt(piece, x));
  if (piece.law == PieceLaw::SineSquared || piece.law == PieceLaw::ConstantJerk)
    return byTime(piece, timeByTime(piece, way)).velocity;
  const double fromRest = piece.law == PieceLaw::FromRest ? x : piece.length - x;
  const double t = durationFromRest(piece.gradient, fromRest);
  return 0.5 * piece.gradient * t * t;
}

double timeAt(const TimePiece &piece, double way) noexcept {
  const double x = way - piece.start;
  switch (piece.law) {
  case PieceLaw::LinearInWay:
    break;
  case PieceLaw::FromRest:
    return durationFromRest(piece.gradient, x);
  case PieceLaw::ToRest:
    return piece.duration - durationFromRest(piece.gradient, piece.length - x);
  case PieceLaw::ConstantJerk:
  case PieceLaw::SineSquared:
    return timeByTime(piece, way);
  }
  return crossing(piece.velocity, exact::sqrt(squareAt(piece, x)), piece.gradient, x);
}

} // namespace stride::path
