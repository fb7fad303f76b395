#include "tests/oracle/path/blended_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace stride::oracle {

namespace {

constexpr int kIntervals = 64; ///< Of the table of arc lengths; Simpson's rule in each.

Point mixed(const Point &a, double factorA, const Point &b, double factorB) {
  return {factorA * a[0] + factorB * b[0], factorA * a[1] + factorB * b[1],
          factorA * a[2] + factorB * b[2]};
}

double inner(const Point &a, const Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double norm(const Point &a) { return std::sqrt(inner(a, a)); }

/// A derivative of the polynomial: 0, 1 or 2.
Point derivative(const QuinticElement &quintic, double u, int order) {
  Point value{};
  for (size_t k = 6; k-- > static_cast<size_t>(order);) {
    const auto power = static_cast<double>(k);
    const double factor = order == 0 ? 1.0 : order == 1 ? power : power * (power - 1);
    value = mixed(value, u, quintic.coefficients[k], factor);
  }
  return value;
}

double speed(const QuinticElement &quintic, double u) { return norm(derivative(quintic, u, 1)); }

double simpson(const QuinticElement &quintic, double from, double to) {
  return (to - from) / 6 *
         (speed(quintic, from) + 4 * speed(quintic, 0.5 * (from + to)) + speed(quintic, to));
}

double parameterAt(const QuinticElement &quintic, double way) {
  const auto above = std::upper_bound(quintic.ways.begin(), quintic.ways.end() - 1, way);
  const size_t i = static_cast<size_t>(above - quintic.ways.begin()) - 1;
  const double start = static_cast<double>(std::min<size_t>(i, kIntervals - 1)) / kIntervals;
  const double base = quintic.ways[std::min<size_t>(i, kIntervals - 1)];
  double u = start + (way - base) / std::max(speed(quintic, start), 1e-300);
  for (int k = 0; k < 5; ++k) {
    u = std::clamp(u, start, start + 1.0 / kIntervals);
    u -= (base + simpson(quintic, start, u) - way) / std::max(speed(quintic, u), 1e-300);
  }
  return std::clamp(u, 0.0, 1.0);
}

/// Place, tangent and curvature of a line or an arc.
std::array<Point, 3> along(const ChainElement &element, double way) {
  const double part = way / element.length;
  const Place at = element.at(part);
  Point tangent{};
  Point curvature{};
  const double angle = part * element.sweep;
  for (size_t axis = 0; axis < 3; ++axis) {
    tangent[axis] = element.drift[axis];
    if (element.isArc) {
      const double radial = element.radial[axis];
      const double lateral = element.lateral[axis];
      tangent[axis] += element.sweep * (lateral * std::cos(angle) - radial * std::sin(angle));
      curvature[axis] = -element.sweep * element.sweep *
                        (radial * std::cos(angle) + lateral * std::sin(angle)) /
                        (element.length * element.length);
    }
    tangent[axis] /= element.length;
  }
  return {Point{at[0], at[1], at[2]}, tangent, curvature};
}

std::array<Point, 3> along(const QuinticElement &quintic, double way) {
  const double u = parameterAt(quintic, way);
  const Point first = derivative(quintic, u, 1);
  const Point second = derivative(quintic, u, 2);
  const double size = norm(first);
  const Point tangent = mixed(first, 1 / size, first, 0);
  const Point bend = mixed(second, 1, tangent, -inner(second, tangent));
  return {derivative(quintic, u, 0), tangent, mixed(bend, 1 / (size * size), bend, 0)};
}

double turnOf(const Point &before, const Point &after) {
  const double half = 0.5 * norm(mixed(before, 1, after, -1));
  return 2 * std::asin(std::min(1.0, half));
}

/// What is known of symmetric blends of two lines, by the angle; in between linear.
struct BlendRow {
  double degrees, parameterLength, deviation, curvature; ///< In chords, cuts, 1 / cuts.
};
constexpr std::array<BlendRow, 8> kBlends = {{{0, 0.875, 0, 0},
                                              {15, 0.88, 0.059, 0.155},
                                              {30, 0.90, 0.118, 0.315},
                                              {60, 0.96, 0.240, 0.677},
                                              {90, 1.08, 0.369, 1.170},
                                              {120, 1.26, 0.525, 2.02},
                                              {150, 1.62, 0.712, 4.31},
                                              {170, 2.2, 0.87, 14}}};

BlendRow blendRow(double turn) {
  const double degrees = turn * 180 / std::numbers::pi;
  size_t i = 0;
  while (i + 2 < kBlends.size() && kBlends[i + 1].degrees < degrees)
    ++i;
  const BlendRow &low = kBlends[i];
  const BlendRow &high = kBlends[i + 1];
  const double part = (degrees - low.degrees) / (high.degrees - low.degrees);
  const auto mix = [&](double a, double b) { return a + part * (b - a); };
  return {degrees, mix(low.parameterLength, high.parameterLength),
          mix(low.deviation, high.deviation), mix(low.curvature, high.curvature)};
}

/// Blends one corner; the cut that keeps the tolerance.
struct Blend {
  QuinticElement quintic;
  double cut;
};

double leastDistance(const QuinticElement &quintic, const Point &corner) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 64; ++i)
    least = std::min(least, norm(mixed(derivative(quintic, i / 64.0, 0), 1, corner, -1)));
  return least;
}

Blend blendCorner(const ChainElement &before, const ChainElement &after, double cut,
                  double tolerance) {
  const Point corner = along(after, 0)[0];
  for (;;) {
    std::array<Point, 3> start = along(before, before.length - cut);
    std::array<Point, 3> end = along(after, cut);
    const double chord = norm(mixed(end[0], 1, start[0], -1));
    const double length = chord * blendRow(turnOf(start[1], end[1])).parameterLength;
    for (std::array<Point, 3> *side : {&start, &end}) {
      (*side)[1] = mixed((*side)[1], length, (*side)[1], 0);
      (*side)[2] = mixed((*side)[2], length * length, (*side)[2], 0);
    }
    Blend blend{quinticBetween(start, end), cut};
    if (leastDistance(blend.quintic, corner) <= tolerance * (1 + 1e-6))
      return blend;
    cut *= 0.95;
  }
}

/// The cut of a corner, or none where it is a stop; 0: straight on.
std::optional<double> cutOf(const ChainElement &before, const ChainElement &after, double feed,
                            double tolerance, const CurveLimits &limits) {
  const double turn = turnOf(along(before, before.length)[1], along(after, 0)[1]);
  if (turn < 1e-7)
    return 0.0;
  if (turn > 170 * std::numbers::pi / 180 || tolerance <= 0.0)
    return std::nullopt;
  const BlendRow row = blendRow(turn);
  double cut = std::min({0.5 * before.length, 0.5 * after.length, tolerance / row.deviation});
  const double acceleration =
      *std::min_element(limits.axisAcceleration.begin(), limits.axisAcceleration.begin() + 3);
  const double velocity = std::min(feed, limits.velocity);
  const double needed = row.curvature * velocity * velocity / (limits.curveShare * acceleration);
  if (needed > 0.0 && std::isfinite(needed))
    cut = std::min(cut, needed);
  return cut;
}

} // namespace

QuinticElement quinticBetween(const std::array<Point, 3> &start, const std::array<Point, 3> &end) {
  QuinticElement quintic;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double p = start[0][axis];
    const double d = start[1][axis];
    const double h = 0.5 * start[2][axis];
    // What the last three terms must add at the end: place, slope, second derivative.
    const double place = end[0][axis] - (p + d + h);
    const double slope = end[1][axis] - (d + 2 * h);
    const double second = end[2][axis] - 2 * h;
    const std::array<double, 6> all = {p,
                                       d,
                                       h,
                                       10 * place - 4 * slope + 0.5 * second,
                                       -15 * place + 7 * slope - second,
                                       6 * place - 3 * slope + 0.5 * second};
    for (size_t k = 0; k < 6; ++k)
      quintic.coefficients[k][axis] = all[k];
  }
  quintic.ways.push_back(0.0);
  for (int i = 0; i < kIntervals; ++i)
    quintic.ways.push_back(quintic.ways.back() +
                           simpson(quintic, i / double(kIntervals), (i + 1) / double(kIntervals)));
  return quintic;
}

void BlendedPath::add(const TrimmedElement &piece, double feed) {
  if (!(piece.to > piece.from))
    return;
  if (starts_.empty())
    starts_.push_back(0.0);
  pieces_.emplace_back(piece);
  feeds_.push_back(feed);
  starts_.push_back(starts_.back() + (piece.to - piece.from));
}

void BlendedPath::add(const QuinticElement &piece, double feed) {
  if (starts_.empty())
    starts_.push_back(0.0);
  starts_.push_back(starts_.back() + piece.ways.back());
  pieces_.emplace_back(piece);
  feeds_.push_back(feed);
}

size_t BlendedPath::pieceAt(double way) const {
  const auto above = std::upper_bound(starts_.begin() + 1, starts_.end() - 1, way);
  return static_cast<size_t>(above - starts_.begin()) - 1;
}

Point BlendedPath::placeAt(double way) const {
  const size_t i = pieceAt(way);
  const double own = way - starts_[i];
  if (const auto *trimmed = std::get_if<TrimmedElement>(&pieces_[i]))
    return along(trimmed->element, trimmed->from + own)[0];
  return along(std::get<QuinticElement>(pieces_[i]), own)[0];
}

CurvePoint BlendedPath::pointAt(double way) const {
  const size_t i = pieceAt(way);
  const double own = way - starts_[i];
  const auto *trimmed = std::get_if<TrimmedElement>(&pieces_[i]);
  const std::array<Point, 3> at = trimmed ? along(trimmed->element, trimmed->from + own)
                                          : along(std::get<QuinticElement>(pieces_[i]), own);
  CurvePoint point{{}, {}, feeds_[i]};
  for (size_t axis = 0; axis < 3; ++axis) {
    point.tangent[axis] = at[1][axis];
    point.curvature[axis] = at[2][axis];
  }
  return point;
}

Curve BlendedPath::curve() const {
  return [this](double way) { return pointAt(way); };
}

std::vector<BlendedPath> blendedPaths(std::span<const ProgramMove> moves, double tolerance,
                                      const CurveLimits &limits) {
  const PathChain chain = chainOf({moves.begin(), moves.end()});
  const std::vector<ChainElement> &elements = chain.elements();
  std::vector<BlendedPath> paths(1);
  double from = 0;
  for (size_t i = 0; i < elements.size(); ++i) {
    const ChainElement &element = elements[i];
    const double feed = moves[i].velocity;
    std::optional<double> cut;
    double slower = feed;
    if (i + 1 < elements.size()) {
      slower = std::min(feed, moves[i + 1].velocity);
      cut = cutOf(element, elements[i + 1], slower, tolerance, limits);
    }
    if (!cut || *cut == 0.0) {
      paths.back().add(TrimmedElement{element, from, element.length}, feed);
      from = 0;
      if (!cut && i + 1 < elements.size())
        paths.emplace_back();
      continue;
    }
    const Blend blend = blendCorner(element, elements[i + 1], *cut, tolerance);
    paths.back().add(TrimmedElement{element, from, element.length - blend.cut}, feed);
    paths.back().add(blend.quintic, slower);
    from = blend.cut;
  }
  return paths;
}

} // namespace stride::oracle
