#include "runtime/numeric/path/segment.hpp"

#include "runtime/numeric/path/bend.hpp"

namespace stride::path {
namespace {

using exact::fabs;

Progress evenly(double u, double length) noexcept { return {u, 1.0 / length, 0.0, 0.0}; }

Progress sProfile(double u, double length) noexcept {
  const double v = 1.0 - u;
  const double r = 1.0 / length;
  return {u * u * u * (10.0 + u * (-15.0 + 6.0 * u)), 30.0 * u * u * v * v * r,
          60.0 * u * v * (v - u) * r * r, 60.0 * (1.0 + 6.0 * u * (u - 1.0)) * r * r * r};
}

bool hasBit(uint16_t bits, int32_t k) noexcept {
  return (static_cast<unsigned>(bits) >> static_cast<unsigned>(k) & 1U) != 0;
}

uint16_t bitOf(int32_t k) noexcept { return static_cast<uint16_t>(1U << static_cast<unsigned>(k)); }

void putSpace(PathPoint &point, const Derivatives &d) noexcept {
  const Vector3 *const of[] = {&d.p, &d.d1, &d.d2, &d.d3};
  double *const to[] = {point.at, point.d1, point.d2, point.d3};
  for (int i = 0; i < 4; ++i) {
    to[i][0] = of[i]->x;
    to[i][1] = of[i]->y;
    to[i][2] = of[i]->z;
  }
}

} // namespace

Segment makeSegment(const Shape &shape, const Companion (&companions)[kCoordinates]) noexcept {
  Segment segment{};
  segment.shape = shape;
  segment.length = shape.length;
  segment.isStill = !(shape.length > 0.0);
  for (int32_t k = 0; k < kCoordinates; ++k) {
    const Companion &companion = companions[k];
    if (!companion.follows)
      continue;
    segment.start[k] = companion.start;
    segment.delta[k] = companion.end - companion.start;
    segment.along |= bitOf(k);
    if (companion.slopes && k < kSpace + kBent)
      segment.bent |= bitOf(k);
    else if (companion.sProfile)
      segment.profile |= bitOf(k);
    if (segment.isStill)
      segment.length = exact::larger(segment.length, fabs(segment.delta[k]));
  }
  for (int32_t i = 0; i < kBent && segment.length > 0.0; ++i) {
    const double even = segment.delta[kSpace + i] / segment.length;
    segment.startSlope[i] = companions[kSpace + i].startSlope - even;
    segment.endSlope[i] = companions[kSpace + i].endSlope - even;
  }
  if (hasTable(segment))
    segment.table = tableOf(shape);
  return segment;
}

double parameterAt(const Segment &segment, double way) noexcept {
  return hasTable(segment) ? parameterAt(segment.shape, segment.table, way) : way / segment.length;
}

double wayAt(const Segment &segment, double u) noexcept {
  if (hasTable(segment))
    return wayAt(segment.shape, segment.table, u);
  return u < 1.0 ? u * segment.length : segment.length;
}

PathPoint pointAt(const Segment &segment, double way) noexcept {
  return pointOver(segment, parameterAt(segment, way), way);
}

PathPoint pointOver(const Segment &segment, double parameter, double way) noexcept {
  PathPoint point{};
  if (segment.isStill)
    putSpace(point, {segment.shape.v[0], numeric::kZero, numeric::kZero, numeric::kZero});
  else
    putSpace(point, overLength(overParameter(segment.shape, parameter)));
  const double u = way / segment.length;
  const Progress even = evenly(u, segment.length);
  const Progress profile = segment.profile != 0 ? sProfile(u, segment.length) : even;
  for (int32_t k = 0; k < kCoordinates; ++k) {
    if (!hasBit(segment.along, k))
      continue;
    const Progress &progress = hasBit(segment.profile, k) ? profile : even;
    point.at[k] = segment.start[k] + segment.delta[k] * progress.f;
    point.d1[k] = segment.delta[k] * progress.d1;
    point.d2[k] = segment.delta[k] * progress.d2;
    point.d3[k] = segment.delta[k] * progress.d3;
  }
  for (int32_t i = 0; i < kBent && segment.bent != 0; ++i) {
    if (!hasBit(segment.bent, kSpace + i))
      continue;
    const Progress more = bentBy(segment.startSlope[i], segment.endSlope[i], u, segment.length);
    point.at[kSpace + i] += more.f;
    point.d1[kSpace + i] += more.d1;
    point.d2[kSpace + i] += more.d2;
    point.d3[kSpace + i] += more.d3;
  }
  return point;
}

} // namespace stride::path
