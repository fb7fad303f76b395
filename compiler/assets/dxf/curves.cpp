// Splines: polynomials between knots by blossoms, then pairs of arcs with common tangents.
#include "compiler/assets/dxf/curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace stc::dxf {

namespace {

/// A place and its weight.
struct Weighted {
  double x = 0;
  double y = 0;
  double w = 1;
};
Weighted mix(const Weighted &a, const Weighted &b, double part) {
  return {a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part, a.w + (b.w - a.w) * part};
}

/// Control points of one polynomial (Bernstein's), with weights.
struct Bezier {
  int degree = 0;
  std::array<Weighted, kMostDegree + 1> control{};

  [[nodiscard]] Point place(double t) const {
    const Weighted p = reduced(t, 0).front();
    return {p.x / p.w, p.y / p.w};
  }
  /// Of the derivative; 0 where it stands still.
  [[nodiscard]] Point direction(double t) const {
    const auto two = reduced(t, 1);
    const Point from{two[0].x / two[0].w, two[0].y / two[0].w};
    const Point to{two[1].x / two[1].w, two[1].y / two[1].w};
    return to - from;
  }

private:
  /// De Casteljau's scheme until `left` + 1 points are there.
  [[nodiscard]] std::array<Weighted, kMostDegree + 1> reduced(double t, int left) const {
    std::array<Weighted, kMostDegree + 1> points = control;
    for (int count = degree; count > left; --count)
      for (size_t i = 0; i < static_cast<size_t>(count); ++i)
        points[i] = mix(points[i], points[i + 1], t);
    return points;
  }
};

/// The polynomial between the knots `span` and span + 1, by blossoms: its control point k is the
/// blossom of degree - k times the one knot and k times the other one.
Bezier polynomialOf(const Spline &spline, size_t span) {
  const auto degree = static_cast<size_t>(spline.degree);
  const double from = spline.knots[span];
  const double to = spline.knots[span + 1];
  Bezier result;
  result.degree = spline.degree;
  for (size_t k = 0; k <= degree; ++k) {
    std::array<Weighted, kMostDegree + 1> d;
    for (size_t i = 0; i <= degree; ++i) {
      const size_t at = span - degree + i;
      const double w = spline.weights.empty() ? 1 : spline.weights[at];
      d[i] = {spline.control[at].x * w, spline.control[at].y * w, w};
    }
    for (size_t r = 1; r <= degree; ++r) {
      const double u = r <= k ? to : from;
      for (size_t i = 0; i <= degree - r; ++i) {
        const double low = spline.knots[span - degree + i + r];
        const double high = spline.knots[span + i + 1];
        d[i] = mix(d[i], d[i + 1], (u - low) / (high - low));
      }
    }
    result.control[k] = d[0];
  }
  return result;
}

/// From `start` in a direction to `end`: nothing if it turns by too much.
std::optional<Piece> arcFrom(Point start, Point direction, Point end, double straight) {
  constexpr double kMostTurn = 1.8;
  const Point way = end - start;
  const double side = cross(direction, way);
  const double ahead = dot(direction, way);
  const double size = norm(way);
  const double half = std::atan2(side, ahead);
  if (std::abs(half) > kMostTurn / 2)
    return std::nullopt;
  // How far the arc is from its chord.
  if (size * std::abs(half) / 4 <= straight)
    return lineOf(start, end);
  const double radius = size * size / (2 * side);
  const Point centre = start + Point{-direction.y, direction.x} * radius;
  const Point first = start - centre;
  Piece piece = arcOf(centre, first, {-first.y, first.x}, 0, 2 * half);
  piece.start = start;
  piece.end = end;
  return piece;
}

/// Two arcs with the tangents of the curve at its ends and a common one between.
std::optional<std::array<Piece, 2>> twoArcs(Point start, Point from, Point end, Point into,
                                            double straight) {
  const Point way = end - start;
  const double b = 2 * dot(way, from + into);
  const double a = 2 * (1 - dot(from, into));
  const double square = dot(way, way);
  const double divisor = b + std::sqrt(std::max(0.0, b * b + 4 * a * square));
  if (!(divisor > 0) || !(square > 0))
    return std::nullopt;
  const double leg = 2 * square / divisor;
  const Point middle = (start + end + (from - into) * leg) * 0.5;
  const auto first = arcFrom(start, from, middle, straight);
  const auto back = arcFrom(end, into * -1, middle, straight);
  if (!first || !back)
    return std::nullopt;
  return std::array{*first, reversed(*back)};
}

double distanceTo(const Piece &piece, Point place) {
  if (piece.kind == Piece::Kind::Line) {
    const Point way = piece.end - piece.start;
    const double square = dot(way, way);
    const double part =
        square > 0 ? std::clamp(dot(place - piece.start, way) / square, 0.0, 1.0) : 0;
    return norm(piece.start + way * part - place);
  }
  const Point off = place - piece.centre;
  const double angle = std::atan2(cross(piece.first, off), dot(piece.first, off));
  const double middle = piece.from + piece.sweep / 2;
  if (std::abs(std::remainder(angle - middle, 2 * M_PI)) <= std::abs(piece.sweep) / 2)
    return std::abs(norm(off) - norm(piece.first));
  return std::min(norm(place - piece.start), norm(place - piece.end));
}

/// Makes arcs of a polynomial.
class ArcFit {
public:
  ArcFit(const Bezier &curve, double tolerance, size_t most, std::vector<Piece> &pieces)
      : curve_(curve), tolerance_(tolerance), most_(most), pieces_(pieces) {}

  bool run() {
    // Parts at first, so that no loop or wave hides between its ends.
    const int parts = curve_.degree + 1;
    for (int i = 0; i < parts; ++i)
      if (!add(static_cast<double>(i) / parts, static_cast<double>(i + 1) / parts, kDepth))
        return false;
    return true;
  }

private:
  static constexpr int kDepth = 30;
  static constexpr int kPlaces = 12; ///< Of a part that are looked at.

  [[nodiscard]] Point direction(double t, double towards) const {
    // At a standstill the one next to it.
    for (const double step : {0.0, 1e-6, 1e-4, 1e-2})
      if (const Point way = unit(curve_.direction(t + (towards - t) * step)); dot(way, way) > 0)
        return way;
    return unit(curve_.place(towards) - curve_.place(t));
  }

  template <size_t N>
  [[nodiscard]] bool isNear(const std::array<Piece, N> &pieces, double from, double to) const {
    for (int i = 1; i < kPlaces; ++i) {
      const Point place = curve_.place(from + (to - from) * i / kPlaces);
      double off = distanceTo(pieces[0], place);
      for (size_t n = 1; n < N; ++n)
        off = std::min(off, distanceTo(pieces[n], place));
      if (!(off <= 0.8 * tolerance_))
        return false;
    }
    return true;
  }

  bool add(double from, double to, int depth) {
    const Point start = curve_.place(from);
    const Point end = curve_.place(to);
    const std::array<Piece, 1> line{lineOf(start, end)};
    const bool tiny = norm(end - start) <= tolerance_ / 2 && isNear(line, from, to);
    if (tiny || depth == 0)
      return append(line[0]);
    if (const auto arcs = twoArcs(start, direction(from, to), end, direction(to, from),
                                  std::min(1e-9, tolerance_ / 100));
        arcs && isNear(*arcs, from, to)) {
      // Both lines are one.
      if ((*arcs)[0].kind == Piece::Kind::Line && (*arcs)[1].kind == Piece::Kind::Line)
        return append(line[0]);
      return append((*arcs)[0]) && append((*arcs)[1]);
    }
    const double middle = (from + to) / 2;
    return add(from, middle, depth - 1) && add(middle, to, depth - 1);
  }

  bool append(const Piece &piece) {
    pieces_.push_back(piece);
    return pieces_.size() <= most_;
  }

  const Bezier &curve_;
  double tolerance_;
  size_t most_;
  std::vector<Piece> &pieces_;
};

bool isPlain(const Bezier &curve) {
  const double w = curve.control[0].w;
  return std::all_of(curve.control.begin(), curve.control.begin() + curve.degree + 1,
                     [w](const Weighted &p) { return std::abs(p.w - w) <= 1e-12 * w; });
}

Point placeOf(const Weighted &p) { return {p.x / p.w, p.y / p.w}; }

/// Two legs that go on or turn to a side, but not back.
bool isParabola(Point start, Point control, Point end) {
  const Point in = control - start;
  const Point out = end - control;
  return std::abs(cross(in, out)) > 1e-6 * norm(in) * norm(out);
}

} // namespace

bool appendSpline(const Spline &spline, double tolerance, size_t most, std::vector<Piece> &pieces) {
  const auto degree = static_cast<size_t>(spline.degree);
  for (size_t span = degree; span < spline.control.size(); ++span) {
    if (!(spline.knots[span + 1] > spline.knots[span]))
      continue;
    const Bezier curve = polynomialOf(spline, span);
    const Point start = placeOf(curve.control[0]);
    const Point end = placeOf(curve.control[degree]);
    if (degree == 1)
      pieces.push_back(lineOf(start, end));
    else if (degree == 2 && isPlain(curve) && isParabola(start, placeOf(curve.control[1]), end))
      pieces.push_back(parabolaOf(start, placeOf(curve.control[1]), end));
    else if (!ArcFit(curve, tolerance, most, pieces).run())
      return false;
    if (pieces.size() > most)
      return false;
  }
  return true;
}

} // namespace stc::dxf
