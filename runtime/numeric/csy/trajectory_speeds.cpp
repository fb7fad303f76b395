#include "runtime/numeric/csy/trajectory_speeds.hpp"

#include "runtime/iec/math.h"
#include "runtime/numeric/profile/bracketed_root.hpp"

namespace stride::csy {

using exact::fabs;
using exact::larger;
using exact::smaller;

namespace {

constexpr double kPi = 3.141592653589793;

double coordinateOf(const Vector3 &v, uint32_t coordinate) noexcept {
  return coordinate == 0 ? v.x : coordinate == 1 ? v.y : v.z;
}

/// The greatest |cos| between two angles. [rad]
double greatestCosine(double from, double to) noexcept {
  const double low = smaller(from, to) / kPi;
  const double high = larger(from, to) / kPi;
  if (exact::floor(high) >= exact::ceil(low))
    return 1.0;
  return larger(fabs(::stride::cos(from)), fabs(::stride::cos(to)));
}

/// Of a coordinate r cos(phi) + l sin(phi); its derivatives are those of a cosine of its own.
double greatestOfArc(const path::Shape &arc, uint32_t coordinate, uint32_t k) noexcept {
  const double radial = coordinateOf(arc.v[1], coordinate);
  const double lateral = coordinateOf(arc.v[2], coordinate);
  const double size = exact::sqrt(radial * radial + lateral * lateral);
  const double phase =
      k == 1 ? ::stride::atan2(-radial, lateral) : ::stride::atan2(lateral, radial);
  const double sweep = fabs(arc.sweep);
  return size * (k == 1 ? sweep : sweep * sweep) *
         greatestCosine(arc.angle - phase, arc.angle + arc.sweep - phase);
}

/// A polynomial of one coordinate.
struct Polynomial {
  double c[6];

  /// Its k-th derivative.
  [[nodiscard]] double at(uint32_t k, double u) const noexcept {
    double value = 0.0;
    for (uint32_t power = 6; power-- > k;) {
      double factor = c[power];
      for (uint32_t i = 0; i < k; ++i)
        factor *= power - i;
      value = value * u + factor;
    }
    return value;
  }
};

/// Where the second derivative turns: the ends of [0, 1] and roots of the third, in order.
uint32_t turnsOf(const Polynomial &p, double (&turns)[4]) noexcept {
  const double a = 60.0 * p.c[5];
  const double b = 24.0 * p.c[4];
  const double c = 6.0 * p.c[3];
  double roots[2] = {-1.0, -1.0};
  if (a == 0.0) {
    if (b != 0.0)
      roots[0] = -c / b;
  } else if (const double below = b * b - 4.0 * a * c; below > 0.0) {
    const double q = -0.5 * (b + exact::signOf(b) * exact::sqrt(below));
    roots[0] = q / a;
    roots[1] = q != 0.0 ? c / q : -1.0;
  }
  uint32_t count = 0;
  turns[count++] = 0.0;
  const bool swapped = roots[0] > roots[1];
  for (uint32_t i = 0; i < 2; ++i)
    if (const double root = roots[swapped ? 1 - i : i]; root > 0.0 && root < 1.0)
      turns[count++] = root;
  turns[count++] = 1.0;
  return count;
}

double greatestOfPolynomial(const Polynomial &p, uint32_t k) noexcept {
  double turns[4];
  const uint32_t count = turnsOf(p, turns);
  double most = 0.0;
  for (uint32_t i = 0; i < count; ++i)
    most = larger(most, fabs(p.at(k, turns[i])));
  if (k == 2)
    return most;
  // The first derivative turns where the second one is 0: once at most between its own turns.
  for (uint32_t i = 1; i < count; ++i) {
    const double sign = p.at(2, turns[i - 1]) < 0.0 ? 1.0 : -1.0;
    const auto rising = [&p, sign](double u) noexcept { return sign * p.at(2, u); };
    if (rising(turns[i - 1]) < 0.0 && rising(turns[i]) >= 0.0)
      most = larger(most, fabs(p.at(1, motion::bracketedRoot(rising, turns[i - 1], turns[i]))));
  }
  return most;
}

double allowedSpeed(const Piece &piece, const SlaveLimits &limits) noexcept {
  double speed = exact::kInfinity;
  for (uint32_t i = 0; i < 3; ++i) {
    const double velocity = coordinateOf(limits.velocity, i);
    const double slope = greatestDerivative(piece.shape, i, 1) / piece.length;
    if (velocity > 0.0 && slope > 0.0)
      speed = smaller(speed, velocity / slope);
    const double acceleration = coordinateOf(limits.acceleration, i);
    const double bend = greatestDerivative(piece.shape, i, 2) / (piece.length * piece.length);
    if (acceleration > 0.0 && bend > 0.0)
      speed = smaller(speed, exact::sqrt(acceleration / bend));
  }
  return speed;
}

} // namespace

double greatestDerivative(const path::Shape &shape, uint32_t coordinate, uint32_t k) noexcept {
  switch (shape.kind) {
  case path::ShapeKind::Line:
    return k == 1 ? fabs(coordinateOf(shape.v[1], coordinate)) : 0.0;
  case path::ShapeKind::Arc:
  case path::ShapeKind::Ellipse:
    return greatestOfArc(shape, coordinate, k);
  case path::ShapeKind::Polynomial:
    break;
  }
  Polynomial polynomial{};
  for (uint32_t i = 0; i < 6; ++i)
    polynomial.c[i] = coordinateOf(shape.v[i], coordinate);
  return greatestOfPolynomial(polynomial, k);
}

void computeSpeed(const TrajectoryTable &table, const Trajectory &trajectory,
                  const SlaveLimits &limits, uint32_t piece, Speeds &speeds) noexcept {
  const double asked = table.point[trajectory.piece[piece].point].speed;
  const double allowed = allowedSpeed(trajectory.piece[piece], limits);
  speeds.allowed[piece] = allowed;
  speeds.computed[piece] = asked > 0.0 ? smaller(asked, allowed) : allowed;
}

void computeSpeeds(const TrajectoryTable &table, const Trajectory &trajectory,
                   const SlaveLimits &limits, Speeds &speeds) noexcept {
  for (uint32_t i = 0; i < trajectory.pieces; ++i)
    computeSpeed(table, trajectory, limits, i, speeds);
}

double constantSpeed(const Trajectory &trajectory, const Speeds &speeds) noexcept {
  double least = exact::kInfinity;
  for (uint32_t i = 0; i < trajectory.pieces; ++i)
    least = smaller(least, speeds.allowed[i]);
  return least;
}

void fillResults(const Trajectory &trajectory, const Speeds &speeds, ResultTable which,
                 double *values) noexcept {
  for (uint32_t i = 0; i < 2 * trajectory.points; ++i)
    values[i] = 0.0;
  if (which == ResultTable::MasterPositions) {
    for (uint32_t i = 0; i < trajectory.points; ++i) {
      values[2 * i] = trajectory.endOfLine[i];
      values[2 * i + 1] = trajectory.endOfBlend[i];
    }
    return;
  }
  const double *speed = which == ResultTable::AllowedSpeeds ? speeds.allowed : speeds.computed;
  for (uint32_t i = 0; i < trajectory.pieces; ++i) {
    const Piece &piece = trajectory.piece[i];
    // The first piece of a point speaks for both, until its blend comes.
    if (i == 0 || trajectory.piece[i - 1].point != piece.point)
      values[2 * piece.point] = speed[i];
    values[2 * piece.point + 1] = speed[i];
  }
}

} // namespace stride::csy
