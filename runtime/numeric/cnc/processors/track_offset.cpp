#include "runtime/numeric/cnc/processors/track_offset.hpp"

namespace stride::cnc {
namespace {

using numeric::dot;

/// What is left of a radius counts as nothing below this part of it.
constexpr double kNothing = 1e-9;
/// Pieces are not shorter than this part of the curve.
constexpr double kLeastStep = 1.0 / 4096.0;

Vector3 leftOf(const Vector3 &direction) noexcept { return {-direction.y, direction.x, 0.0}; }

/// A place of the curve beside it, and the derivative over the parameter.
struct Beside {
  Vector3 p, d;
};

Beside besideAt(const Track &track, double left, double u) noexcept {
  const path::Derivatives d = path::overParameter(track.shape, u);
  const double speed = exact::sqrt(dot(d.d1, d.d1));
  if (!(speed > 0.0)) {
    const Vector3 direction = u < 0.5 ? directionAtStart(track) : directionAtEnd(track);
    return {d.p + leftOf(direction) * left, d.d1};
  }
  const double bend = (d.d1.x * d.d2.y - d.d1.y * d.d2.x) / (speed * speed * speed);
  return {d.p + leftOf(d.d1) * (left / speed), d.d1 * (1.0 - left * bend)};
}

Track hermite(const Beside &a, const Beside &b, double step) noexcept {
  const Vector3 from = a.d * step;
  const Vector3 to = b.d * step;
  const Vector3 way = b.p - a.p;
  const Vector3 zero = numeric::kZero;
  Track track{};
  track.shape.kind = path::ShapeKind::Polynomial;
  track.shape.v[0] = a.p;
  track.shape.v[1] = from;
  track.shape.v[2] = way * 3.0 - from * 2.0 - to;
  track.shape.v[3] = from + to - way * 2.0;
  track.shape.v[4] = track.shape.v[5] = zero;
  track.shape.length = exact::sqrt(dot(way, way));
  return track;
}

bool isWithin(const Track &track, double left, double from, double step, double tolerance,
              const Track &piece) noexcept {
  constexpr double kParts[] = {0.2, 0.4, 0.6, 0.8};
  for (const double part : kParts) {
    const Vector3 off = besideAt(track, left, from + part * step).p - placeOn(piece, part);
    if (!(dot(off, off) <= tolerance * tolerance))
      return false;
  }
  return true;
}

} // namespace

bool offsetTrack(const Track &track, double left, Track &result) noexcept {
  result = track;
  path::Shape &shape = result.shape;
  if (shape.kind == path::ShapeKind::Line) {
    shape.v[0] = shape.v[0] + leftOf(directionAtStart(track)) * left;
    return true;
  }
  const double radius = exact::sqrt(dot(shape.v[1], shape.v[1]));
  // Counterclockwise the left is inside.
  const double now = shape.sweep > 0.0 ? radius - left : radius + left;
  if (!(now > kNothing * radius))
    return false;
  shape.v[1] = shape.v[1] * (now / radius);
  shape.v[2] = shape.v[2] * (now / radius);
  shape.length = shape.length * (now / radius);
  return true;
}

Vector3 offsetPlace(const Track &track, double left, bool atEnd) noexcept {
  const Vector3 direction = atEnd ? directionAtEnd(track) : directionAtStart(track);
  return placeOn(track, atEnd ? 1.0 : 0.0) + leftOf(direction) * left;
}

double offsetPiece(const Track &track, double left, double from, double step, double tolerance,
                   Track &piece) noexcept {
  const Beside begin = besideAt(track, left, from);
  const double rest = 1.0 - from;
  double length = step < rest ? step : rest;
  for (;;) {
    // No short remainder.
    const double to = rest - length < kLeastStep ? 1.0 : from + length;
    piece = hermite(begin, besideAt(track, left, to), to - from);
    if (length <= kLeastStep || isWithin(track, left, from, to - from, 0.5 * tolerance, piece))
      return to;
    length *= 0.5;
  }
}

} // namespace stride::cnc
