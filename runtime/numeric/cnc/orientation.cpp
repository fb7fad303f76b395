#include "runtime/numeric/cnc/orientation.hpp"

#include "runtime/iec/math.h"
#include "runtime/numeric/exact_math.hpp"

namespace stride::cnc {
namespace {

using numeric::norm;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
/// Sines as small as this are 0.
constexpr double kSame = 1e-12;

/// About X (0), Y (1) or Z (2). Quarters are exact.
Turn turnAbout(int32_t axis, double degrees) noexcept {
  const double quarters = degrees / 90.0;
  const bool whole = exact::fabs(quarters) < 1e9 && exact::floor(quarters) == quarters;
  const auto quarter =
      static_cast<int32_t>(whole ? quarters - 4.0 * exact::floor(quarters / 4.0) : 0.0);
  constexpr double kCosines[4] = {1, 0, -1, 0};
  constexpr double kSines[4] = {0, 1, 0, -1};
  const double c = whole ? kCosines[quarter] : ::stride::cos(degrees * kDegree);
  const double s = whole ? kSines[quarter] : ::stride::sin(degrees * kDegree);
  if (axis == 0)
    return {{1, 0, 0}, {0, c, s}, {0, -s, c}};
  if (axis == 1)
    return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

/// The angles of a turn about Z, Y, Z; `near` says C where only A and C together are known.
void anglesZyz(const Turn &t, const double (&near)[3], double (&angle)[3]) noexcept {
  const double sine = norm({t.z.x, t.z.y, 0.0});
  angle[1] = degreesOf(sine, t.z.z);
  if (sine > kSame) {
    angle[0] = degreesOf(t.z.y, t.z.x);
    angle[2] = degreesOf(t.y.z, -t.x.z);
    return;
  }
  angle[2] = near[2];
  angle[0] = t.z.z > 0.0 ? degreesOf(t.x.y, t.x.x) - near[2] : degreesOf(-t.x.y, -t.x.x) + near[2];
}

/// Likewise about Z, Y, X.
void anglesZyx(const Turn &t, const double (&near)[3], double (&angle)[3]) noexcept {
  const double cosine = norm({t.x.x, t.x.y, 0.0});
  angle[1] = degreesOf(-t.x.z, cosine);
  if (cosine > kSame) {
    angle[0] = degreesOf(t.x.y, t.x.x);
    angle[2] = degreesOf(t.y.z, t.z.z);
    return;
  }
  angle[2] = near[2];
  angle[0] = t.x.z < 0.0 ? near[2] - degreesOf(t.y.x, t.y.y) : degreesOf(-t.y.x, t.y.y) - near[2];
}

/// Adds full turns, so that the angles are as close as possible. Gives how far they are away.
double approach(const double (&near)[3], double (&angle)[3]) noexcept {
  constexpr double kFull = 360.0;
  double sum = 0.0;
  for (int32_t i = 0; i < 3; ++i) {
    angle[i] += kFull * exact::floor((near[i] - angle[i]) / kFull + 0.5);
    sum += exact::fabs(near[i] - angle[i]);
  }
  return sum;
}

} // namespace

Turn turnBy(Orientation orientation, const double (&angle)[3]) noexcept {
  const bool zFirst = orientation != Orientation::Xyz;
  const int32_t last = orientation == Orientation::Zyx ? 0 : 2;
  return turnAbout(zFirst ? 2 : 0, angle[0]) * turnAbout(1, angle[1]) * turnAbout(last, angle[2]);
}

double degreesOf(double y, double x) noexcept { return ::stride::atan2(y, x) / kDegree; }

void anglesOf(Orientation orientation, const Turn &turn, const double (&near)[3],
              double (&angle)[3]) noexcept {
  constexpr double kHalf = 180.0;
  double other[3];
  if (orientation == Orientation::Zyz) {
    anglesZyz(turn, near, angle);
    other[1] = -angle[1];
  } else if (orientation == Orientation::Zyx) {
    anglesZyx(turn, near, angle);
    other[1] = kHalf - angle[1];
  } else {
    // The way back is about Z, Y and X.
    const double back[3] = {-near[2], -near[1], -near[0]};
    double found[3];
    anglesZyx(inverse(turn), back, found);
    for (int32_t i = 0; i < 3; ++i)
      angle[i] = -found[2 - i];
    other[1] = kHalf - angle[1];
  }
  other[0] = angle[0] + kHalf;
  other[2] = angle[2] + kHalf;
  const double first = approach(near, angle);
  if (approach(near, other) < first)
    for (int32_t i = 0; i < 3; ++i)
      angle[i] = other[i];
}

} // namespace stride::cnc
