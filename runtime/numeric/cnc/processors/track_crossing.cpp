#include "runtime/numeric/cnc/processors/track_crossing.hpp"

#include "runtime/iec/math.h"

namespace stride::cnc {
namespace {

using numeric::dot;

constexpr double kTurn = 6.283185307179586477;
/// How far beyond their ends curves may meet, as a part of them.
constexpr double kEnds = 1e-12;
/// Below this sine lines are parallel.
constexpr double kParallel = 1e-12;
/// How often free curves are halved before Newton's method finds their meeting.
constexpr int32_t kDeepest = 7;
constexpr int32_t kRounds = 12;
/// How far places are off that have been computed, as a part of what the numbers are.
constexpr double kRounding = 1e-14;

struct Found {
  Crossing (&crossings)[kMostCrossings];
  int32_t count;
};

double crossOf(const Vector3 &a, const Vector3 &b) noexcept { return a.x * b.y - a.y * b.x; }

/// Into 0 to 1 if it is there but for rounding; false if it is not.
bool within(double &u) noexcept {
  if (!(u >= -kEnds && u <= 1.0 + kEnds))
    return false;
  u = u < 0.0 ? 0.0 : u > 1.0 ? 1.0 : u;
  return true;
}

void add(Found &found, double first, double second) noexcept {
  if (found.count >= kMostCrossings || !within(first) || !within(second))
    return;
  for (int32_t i = 0; i < found.count; ++i)
    if (exact::fabs(found.crossings[i].first - first) < 1e-9 &&
        exact::fabs(found.crossings[i].second - second) < 1e-9)
      return;
  found.crossings[found.count++] = {first, second};
}

void crossLines(const path::Shape &a, const path::Shape &b, Found &found) noexcept {
  const double sine = crossOf(a.v[1], b.v[1]);
  if (!(exact::fabs(sine) > kParallel * a.length * b.length))
    return;
  const Vector3 apart = b.v[0] - a.v[0];
  add(found, crossOf(apart, b.v[1]) / sine, crossOf(apart, a.v[1]) / sine);
}

/// The parameter of an arc in a direction from its centre.
double parameterTowards(const path::Shape &arc, const Vector3 &away) noexcept {
  const double angle = ::stride::atan2(away.y, away.x) - arc.angle;
  const double sweep = exact::fabs(arc.sweep);
  double turned = arc.sweep > 0.0 ? angle : -angle;
  turned -= kTurn * exact::floor(turned / kTurn);
  // Just before the start: rounding.
  if (turned > sweep && kTurn - turned < kEnds * kTurn)
    turned = 0.0;
  return turned / sweep;
}

double radiusOf(const path::Shape &arc) noexcept { return exact::sqrt(dot(arc.v[1], arc.v[1])); }

/// `swapped`: the arc is the first one.
void crossLineArc(const path::Shape &line, const path::Shape &arc, bool swapped,
                  Found &found) noexcept {
  const Vector3 unit = line.v[1] * (1.0 / line.length);
  const Vector3 apart = line.v[0] - arc.v[0];
  const double off = crossOf(unit, apart);
  const double radius = radiusOf(arc);
  double square = (radius - off) * (radius + off);
  if (square < 0.0 && square > -1e-12 * radius * radius)
    square = 0.0; // it touches
  if (!(square >= 0.0))
    return;
  const double middle = -dot(apart, unit);
  const double half = exact::sqrt(square);
  for (int32_t side = -1; side <= 1; side += 2) {
    const double way = middle + side * half;
    const double u = way / line.length;
    const double v = parameterTowards(arc, apart + unit * way);
    add(found, swapped ? v : u, swapped ? u : v);
  }
}

void crossArcs(const path::Shape &a, const path::Shape &b, Found &found) noexcept {
  const Vector3 apart = b.v[0] - a.v[0];
  const double distance = exact::sqrt(dot(apart, apart));
  const double r = radiusOf(a);
  const double q = radiusOf(b);
  if (!(distance > kParallel * (r + q)))
    return;
  const double along = 0.5 * (distance + (r - q) * (r + q) / distance);
  double square = (r - along) * (r + along);
  if (square < 0.0 && square > -1e-12 * r * r)
    square = 0.0;
  if (!(square >= 0.0))
    return;
  const Vector3 unit = apart * (1.0 / distance);
  const Vector3 across{-unit.y, unit.x, 0.0};
  const double half = exact::sqrt(square);
  for (int32_t side = -1; side <= 1; side += 2) {
    const Vector3 away = unit * along + across * (side * half);
    add(found, parameterTowards(a, away), parameterTowards(b, away - apart));
  }
}

// ---- free curves

/// A part of a curve: its ends, and how far it leaves their line at most.
struct Part {
  double from, to;
  Vector3 a, b;
};

Part partOf(const Track &track, double from, double to) noexcept {
  return {from, to, placeOn(track, from), placeOn(track, to)};
}

Box around(const Track &track, const Part &part) noexcept {
  // The curve stays near the chord of a part: by twice what its middle leaves it.
  const Vector3 middle = placeOn(track, 0.5 * (part.from + part.to));
  const Vector3 off = middle - (part.a + part.b) * 0.5;
  const double slack = 2.0 * exact::sqrt(dot(off, off));
  return {exact::smaller(part.a.x, part.b.x) - slack, exact::larger(part.a.x, part.b.x) + slack,
          exact::smaller(part.a.y, part.b.y) - slack, exact::larger(part.a.y, part.b.y) + slack};
}

/// Newton's method for both parameters.
void refine(const Track &a, const Track &b, double u, double v, Found &found) noexcept {
  for (int32_t round = 0; round < kRounds; ++round) {
    const path::Derivatives p = path::overParameter(a.shape, u);
    const path::Derivatives q = path::overParameter(b.shape, v);
    const Vector3 apart = q.p - p.p;
    const double sine = crossOf(p.d1, q.d1);
    if (!(exact::fabs(sine) > 0.0))
      return;
    const double du = crossOf(apart, q.d1) / sine;
    const double dv = crossOf(apart, p.d1) / sine;
    u += du;
    v += dv;
    if (!(exact::fabs(u) < 2.0 && exact::fabs(v) < 2.0))
      return;
    if (exact::fabs(du) < 1e-13 && exact::fabs(dv) < 1e-13) {
      add(found, u, v);
      return;
    }
  }
  // At a small angle rounding moves the meeting along both.
  const Vector3 p = placeOn(a, u);
  const Vector3 apart = placeOn(b, v) - p;
  const double size = a.shape.length + b.shape.length + numeric::norm(p);
  if (numeric::norm(apart) <= kRounding * size)
    add(found, u, v);
}

void crossParts(const Track &a, const Part &first, const Track &b, const Part &second,
                int32_t depth, Found &found) noexcept {
  if (found.count >= kMostCrossings || !overlap(around(a, first), around(b, second)))
    return;
  if (depth == kDeepest) {
    refine(a, b, 0.5 * (first.from + first.to), 0.5 * (second.from + second.to), found);
    return;
  }
  const double u = 0.5 * (first.from + first.to);
  const double v = 0.5 * (second.from + second.to);
  const Part firsts[] = {partOf(a, first.from, u), partOf(a, u, first.to)};
  const Part seconds[] = {partOf(b, second.from, v), partOf(b, v, second.to)};
  for (const Part &p : firsts)
    for (const Part &q : seconds)
      crossParts(a, p, b, q, depth + 1, found);
}

/// In four parts each, so that none turns far.
void crossFree(const Track &a, const Track &b, Found &found) noexcept {
  constexpr int32_t kParts = 4;
  // Beside a corner of a small angle the middle of a part leads to where both meet once more,
  // beyond their ends.
  refine(a, b, 1.0, 0.0, found);
  refine(a, b, 0.0, 1.0, found);
  for (int32_t i = 0; i < kParts; ++i)
    for (int32_t k = 0; k < kParts; ++k)
      crossParts(a, partOf(a, i * (1.0 / kParts), (i + 1) * (1.0 / kParts)), b,
                 partOf(b, k * (1.0 / kParts), (k + 1) * (1.0 / kParts)), 2, found);
}

void widen(Box &box, const Vector3 &p) noexcept {
  box.left = exact::smaller(box.left, p.x);
  box.right = exact::larger(box.right, p.x);
  box.low = exact::smaller(box.low, p.y);
  box.high = exact::larger(box.high, p.y);
}

} // namespace

int32_t crossingsOf(const Track &first, const Track &second,
                    Crossing (&crossings)[kMostCrossings]) noexcept {
  Found found{crossings, 0};
  const path::Shape &a = first.shape;
  const path::Shape &b = second.shape;
  if (!(a.length > 0.0 && b.length > 0.0))
    return 0;
  if (isFreeForm(first) || isFreeForm(second))
    crossFree(first, second, found);
  else if (a.kind == path::ShapeKind::Line)
    b.kind == path::ShapeKind::Line ? crossLines(a, b, found) : crossLineArc(a, b, false, found);
  else
    b.kind == path::ShapeKind::Line ? crossLineArc(b, a, true, found) : crossArcs(a, b, found);
  return found.count;
}

Box boxOf(const Track &track) noexcept {
  const Vector3 start = placeOn(track, 0.0);
  Box box{start.x, start.x, start.y, start.y};
  const path::Shape &shape = track.shape;
  if (shape.kind == path::ShapeKind::Line) {
    widen(box, start + shape.v[1]);
    return box;
  }
  if (shape.kind == path::ShapeKind::Arc) {
    widen(box, placeOn(track, 1.0));
    const double radius = radiusOf(shape);
    const Vector3 extremes[] = {
        {radius, 0.0, 0.0}, {-radius, 0.0, 0.0}, {0.0, radius, 0.0}, {0.0, -radius, 0.0}};
    for (const Vector3 &extreme : extremes)
      if (parameterTowards(shape, extreme) <= 1.0)
        widen(box, shape.v[0] + extreme);
    return box;
  }
  constexpr int32_t kParts = 8;
  for (int32_t i = 0; i < kParts; ++i) {
    const Box part = around(track, partOf(track, i * (1.0 / kParts), (i + 1) * (1.0 / kParts)));
    widen(box, {part.left, part.low, 0.0});
    widen(box, {part.right, part.high, 0.0});
  }
  return box;
}

} // namespace stride::cnc
