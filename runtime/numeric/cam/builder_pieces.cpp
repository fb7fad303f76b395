// One piece alone: whether it is possible, and the segments that it becomes.
#include "runtime/numeric/cam/builder.hpp"

#include "runtime/numeric/cam/builder_shapes.hpp"
#include "runtime/numeric/exact_math.hpp"

namespace stride::cam {
namespace {

/// `z`: v, a, j on the left, then on the right.
void polynomial(const Shape &shape, const double (&z)[kUnknowns + 1], double h, double way,
                Segment &segment) noexcept {
  const double scaled[kUnknowns + 1] = {
      z[0] * h, z[1] * h * h, z[2] * h * h * h, z[3] * h, z[4] * h * h, z[5] * h * h * h, way};
  segment.coefficients[1] = scaled[0];
  segment.coefficients[2] = 0.5 * scaled[1];
  for (int r = 0; r < 5; ++r) {
    double sum = 0.0;
    for (int q = 0; q <= kUnknowns; ++q)
      sum += shape.row[r][q] * scaled[q];
    segment.coefficients[r + 3] = sum;
  }
}

bool isFinite(const Boundary &boundary) noexcept {
  return exact::isfinite(boundary.x) && exact::isfinite(boundary.y) &&
         exact::isfinite(boundary.v) && exact::isfinite(boundary.a) &&
         exact::isfinite(boundary.j) &&
         (boundary.given == 0 || (boundary.given >= 2 && boundary.given <= 5));
}

bool isFinite(const Segment &segment) noexcept {
  bool good = exact::isfinite(segment.stroke);
  for (const double coefficient : segment.coefficients)
    good = good && exact::isfinite(coefficient);
  return good;
}

BuildError checkPiece(const Piece &piece) noexcept {
  bool good = piece.kind >= PieceKind::Line && piece.kind <= PieceKind::Law &&
              isFinite(piece.left) && isFinite(piece.right) && exact::isfinite(piece.parameter) &&
              exact::isfinite(piece.inflexion);
  for (const double coefficient : piece.coefficients)
    good = good && exact::isfinite(coefficient);
  if (!good)
    return BuildError::InvalidValue;
  switch (piece.kind) {
  case PieceKind::ModifiedSine:
    good = piece.inflexion >= 0.0 && piece.inflexion <= 1.0;
    break;
  case PieceKind::ModifiedSineLimited:
    good = piece.parameter != 0.0;
    break;
  case PieceKind::Law:
    good = isUsable({piece.law, piece.parameter, piece.inflexion});
    break;
  default:
    break;
  }
  return good ? BuildError::None : BuildError::InvalidParameter;
}

/// A segment that is a polynomial of degree 1 as yet.
Segment line(double x0, double x1, double y, double way) noexcept {
  return {x0, x1, {y, way}, 0.0, 0.0, 1.0, 0.25, 0.5, Law::Polynomial};
}

/// One half of a modified sine, from velocity `v0` to `v1`.
Segment halfSine(double x0, double x1, double y, double v0, double v1, bool second) noexcept {
  const double h = x1 - x0;
  Segment segment = line(x0, x1, y, (second ? v1 : v0) * h);
  const double top = evaluateLaw({Law::ModifiedSine, 0.25, 0.5}, 0.5).v;
  segment.law = Law::ModifiedSine;
  segment.lawBegin = second ? 0.5 : 0.0;
  segment.lawEnd = second ? 1.0 : 0.5;
  segment.stroke = 2.0 * h * (second ? v0 - v1 : v1 - v0) / top;
  if (second) // the law is half way up already
    segment.coefficients[0] -= 0.5 * segment.stroke;
  return segment;
}

/// Of the velocity that is gained before the inflexion, the mean over that time: the law is at 0.5
/// by then.
double meanOfHalf() noexcept { return 1.0 / evaluateLaw({Law::ModifiedSine, 0.25, 0.5}, 0.5).v; }

/// The velocity at the inflexion of a modified sine that goes `d` in all, both measured in its
/// length.
double velocityAtInflexion(double d, double v0, double v1, double inflexion) noexcept {
  const double mean = meanOfHalf();
  return (d - (1.0 - mean) * (inflexion * v0 + (1.0 - inflexion) * v1)) / mean;
}

/// Where the inflexion must be for the acceleration after it to have the peak `limit`; else not
/// within 0 to 1. Lengths are measured in the segment's.
double inflexionFor(double d, double v0, double v1, double limit) noexcept {
  // The quarter sines of the second half have the mean 2 / pi: (top - v1) * pi / 2 = peak * (1 -
  // u), where top is linear in u.
  constexpr double kHalfPi = 0x1.921fb54442d18p+0;
  const double base = velocityAtInflexion(d, v0, v1, 0.0);
  const double slope = velocityAtInflexion(d, v0, v1, 1.0) - base;
  const auto inflexion = [&](double peak) {
    return (peak - (base - v1) * kHalfPi) / (peak + slope * kHalfPi);
  };
  const double peak = exact::signOf(base - v1) * limit;
  const double u = inflexion(peak);
  return u >= 0.0 && u <= 1.0 ? u : inflexion(-peak);
}

} // namespace

BuildError checkLast(const Piece *pieces, int32_t count) noexcept {
  if (count < 1)
    return BuildError::NoPieces;
  const Piece &piece = pieces[count - 1];
  const BuildError problem = checkPiece(piece);
  if (problem != BuildError::None)
    return problem;
  double x = piece.left.x;
  if (count > 1) {
    const Piece &before = pieces[count - 2];
    if (before.right.given == 0 && piece.left.given == 0)
      return BuildError::BoundaryUnknown;
    if (before.right.given != 0 && piece.left.given != 0 && before.right.x != piece.left.x)
      return BuildError::NotAdjacent;
    if (piece.left.given == 0)
      x = before.right.x;
    if (before.right.given == 0) { // now it is known how far that goes
      const double start = before.left.given != 0 ? before.left.x
                           : count > 2            ? pieces[count - 3].right.x
                                                  : 0.0;
      if (!(x > start))
        return BuildError::NoExtent;
    }
  } else if (piece.left.given == 0) {
    x = 0.0;
  }
  return piece.right.given == 0 || piece.right.x > x ? BuildError::None : BuildError::NoExtent;
}

/// Piece `index` with the derivatives `z`: v, a, j on the left, then on the right.
BuildError Builder::build(int32_t index, const double (&z)[7], Segment (&result)[2],
                          int32_t &count) const noexcept {
  const Piece &piece = pieces_[index];
  const Ends at = ends(index);
  const double h = at.x[1] - at.x[0];
  const double way = at.y[1] - at.y[0];
  Segment &segment = result[0];
  segment = line(at.x[0], at.x[1], at.y[0], way);
  count = 1;
  double inflexion = piece.inflexion;
  switch (piece.kind) {
  case PieceKind::Line:
    break;
  case PieceKind::Poly5:
  case PieceKind::Poly7:
    polynomial(piece.kind == PieceKind::Poly5 ? kQuintic : kSeptic, z, h, way, segment);
    break;
  case PieceKind::Coefficients: {
    double power = 1.0;
    for (int i = 0; i < 8; ++i, power *= h)
      segment.coefficients[i] = piece.coefficients[i] * power;
    break;
  }
  case PieceKind::InclinedSine:
    segment = makeSegment({Law::Cycloidal, 0.25, 0.5}, {at.x[0], at.y[0], 0.0, 0.0},
                          {at.x[1], at.y[1], 0.0, 0.0});
    break;
  case PieceKind::Law:
    segment = makeSegment({piece.law, piece.parameter, piece.inflexion},
                          {at.x[0], at.y[0], z[0], z[1]}, {at.x[1], at.y[1], z[3], z[4]});
    break;
  case PieceKind::ModifiedSineLimited:
    inflexion = inflexionFor(way / h, z[0], z[3], exact::fabs(piece.parameter) * h);
    if (!(inflexion >= 0.0 && inflexion <= 1.0))
      return BuildError::InvalidParameter;
    [[fallthrough]];
  case PieceKind::ModifiedSine: {
    const double top = velocityAtInflexion(way / h, z[0], z[3], inflexion);
    const double middle = at.x[0] + inflexion * h;
    const bool first = middle > at.x[0];
    const bool second = middle < at.x[1];
    count = 0;
    double y = at.y[0];
    if (first) {
      result[count++] = halfSine(at.x[0], second ? middle : at.x[1], y, z[0], top, false);
      y = evaluateSegment(result[0], middle).y;
    }
    if (second)
      result[count++] = halfSine(first ? middle : at.x[0], at.x[1], y, top, z[3], true);
    break;
  }
  }
  for (int32_t i = 0; i < count; ++i)
    if (!isFinite(result[i]))
      return BuildError::InvalidValue;
  return BuildError::None;
}

} // namespace stride::cam
