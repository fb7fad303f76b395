#include "runtime/numeric/group/arc.hpp"

#include "runtime/numeric/quarter_turns.hpp"

namespace stride::group {
namespace {

using exact::fabs;
using numeric::cross;
using numeric::dot;
using numeric::norm;

/// Vectors with a smaller sine between them lie in a line: the circle would be so large that its
/// centre could not be told to a part of its path that counts.
constexpr double kLeastSine = 1e-6;
/// Places that are nearer to each other, as a part of how far off they are, are one, but for
/// rounding.
constexpr double kSame = 1e-10;
/// How far apart, as a part of it, a radius may be at both ends.
constexpr double kEqual = 1e-6;

bool areCollinear(const Vector3 &a, const Vector3 &b) noexcept {
  return !(norm(cross(a, b)) > kLeastSine * norm(a) * norm(b));
}

bool isNothing(const Vector3 &way, const Vector3 &start, const Vector3 &end) noexcept {
  return !(norm(way) > kSame * exact::larger(norm(start), norm(end)));
}

/// The arc about a centre in a plane whose unit vector the way is right-handed about. The end may
/// be a little off the circle: the radius is that of the start.
void setArc(const Vector3 &start, const Vector3 &centre, const Vector3 &end, const Vector3 &normal,
            Arc &arc) noexcept {
  constexpr double kTurn = 360.0 * numeric::kDegree;
  arc.centre = centre;
  arc.first = start - centre;
  arc.second = cross(normal, arc.first);
  const Vector3 last = end - centre;
  const double angle = kinematics::angleOf(dot(last, arc.second), dot(last, arc.first));
  arc.sweep = angle > 0.0 ? angle : angle + kTurn;
}

Vector3 seen(const Vector3 &normal, ArcWay way) noexcept {
  return way == ArcWay::CounterClockwise ? normal : normal * -1.0;
}

} // namespace

ArcFault arcThrough(const Vector3 &start, const Vector3 &border, const Vector3 &end,
                    Arc &arc) noexcept {
  const Vector3 a = border - start;
  const Vector3 b = end - start;
  if (areCollinear(a, b) || areCollinear(a, end - border))
    return ArcFault::Collinear;
  const Vector3 n = cross(a, b);
  const double square = dot(n, n);
  const Vector3 towards = cross(cross(a, b), a) * dot(b, b) + cross(b, cross(a, b)) * dot(a, a);
  const Vector3 centre = start + towards * (0.5 / square);
  setArc(start, centre, end, n * (1.0 / exact::sqrt(square)), arc);
  return ArcFault::None;
}

ArcFault arcAbout(const Vector3 &start, const Vector3 &centre, const Vector3 &end, ArcWay way,
                  Arc &arc) noexcept {
  const Vector3 a = start - centre;
  const Vector3 b = end - centre;
  const double radius = norm(a);
  if (isNothing(a, start, end))
    return ArcFault::NoRadius;
  if (!(fabs(norm(b) - radius) <= kEqual * radius))
    return ArcFault::OffBisector;
  if (areCollinear(a, b))
    return ArcFault::Collinear;
  // Rounded numbers rarely name a centre that is on the bisector to the last digit.
  const Vector3 chord = end - start;
  const Vector3 middle = start + chord * 0.5;
  const Vector3 off = chord * (dot(centre - middle, chord) / dot(chord, chord));
  const Vector3 n = cross(a, b);
  setArc(start, centre - off, end, seen(n * (1.0 / norm(n)), way), arc);
  return ArcFault::None;
}

ArcFault arcWithNormal(const Vector3 &start, const Vector3 &normal, const Vector3 &end, ArcWay way,
                       Arc &arc) noexcept {
  const Vector3 chord = end - start;
  const double length = norm(chord);
  const double radius = norm(normal);
  if (isNothing(chord, start, end))
    return ArcFault::SameEnds;
  if (isNothing(normal, start, end))
    return ArcFault::NoRadius;
  if (!(fabs(dot(chord, normal)) <= kEqual * length * radius))
    return ArcFault::OffBisector;
  const double half = 0.5 * length;
  if (!(half <= radius * (1.0 + kEqual)))
    return ArcFault::ChordTooLong;
  const Vector3 side = cross(normal, chord);
  const Vector3 left = side * (1.0 / norm(side));
  const double square = radius * radius - half * half;
  const double far = square > 0.0 ? exact::sqrt(square) : 0.0;
  const Vector3 centre = start + chord * 0.5 + left * far;
  const Vector3 n = cross(chord, left);
  setArc(start, centre, end, seen(n * (1.0 / norm(n)), way), arc);
  return ArcFault::None;
}

} // namespace stride::group
