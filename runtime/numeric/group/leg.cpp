#include "runtime/numeric/group/leg.hpp"

#include "runtime/numeric/kinematics/orientation.hpp"

namespace stride::group {
namespace {

using exact::fabs;
using exact::larger;

/// How the tool turns between two orientations.
void setTurn(Leg &leg, const Pose &from, const Pose &to) noexcept {
  const kinematics::GreatCircle circle =
      kinematics::greatCircle(matrixOf(from.turn), matrixOf(to.turn));
  for (int i = 0; i < 9; ++i)
    leg.turn[i] = from.turn[i];
  leg.about = plain(circle.axis);
  leg.angle = circle.angle;
}

void setMoreAxes(Leg &leg, const MoreAxes &more) noexcept {
  for (int32_t k = 0; k < kMoreAxes; ++k) {
    leg.from[kArmAxes + k] = more.from[k];
    leg.delta[kArmAxes + k] = more.to[k] - more.from[k];
  }
}

/// The way of a leg whose tool's point stays where it is.
double stillLength(const Leg &leg) noexcept {
  constexpr double kDegrees = 57.29577951308232;
  constexpr double kNothing = 1e-12; // [rad]
  if (leg.given == 0 && leg.angle > kNothing)
    return kDegrees * leg.angle;
  double square = 0.0;
  for (int32_t k = 0; k < kArmAxes; ++k)
    if (isGiven(leg.given, k))
      square += leg.delta[k] * leg.delta[k];
  if (square > 0.0)
    return exact::sqrt(square);
  double most = 0.0;
  for (int32_t k = kArmAxes; k < kAxes; ++k)
    most = larger(most, fabs(leg.delta[k]));
  return most;
}

/// The sum a + b * series, vector by vector.
Vector<Series> alongLine(const Vector3 &a, const Vector3 &b, const Series &series) noexcept {
  return {Series(a.x) + b.x * series, Series(a.y) + b.y * series, Series(a.z) + b.z * series};
}

Vector<Series> alongCircle(const Leg &leg, const Series &way) noexcept {
  const kinematics::TurnOf<Series> t = kinematics::turnBy(way * (1.0 / leg.radius));
  const Vector3 &a = leg.first;
  const Vector3 &b = leg.second;
  return {Series(leg.start.x) + a.x * t.c + b.x * t.s, Series(leg.start.y) + a.y * t.c + b.y * t.s,
          Series(leg.start.z) + a.z * t.c + b.z * t.s};
}

} // namespace

Leg lineLeg(const Pose &from, const Pose &to, const MoreAxes &more) noexcept {
  Leg leg{};
  setTurn(leg, from, to);
  setMoreAxes(leg, more);
  leg.start = from.place;
  const Vector3 way = to.place - from.place;
  leg.length = numeric::norm(way);
  leg.kind = LegKind::Line;
  if (leg.length > 0.0) {
    leg.first = way * (1.0 / leg.length);
  } else {
    leg.kind = LegKind::Turn;
    leg.length = stillLength(leg);
  }
  return leg;
}

Leg circleLeg(const Pose &from, const Arc &arc, const Pose &to, const MoreAxes &more) noexcept {
  Leg leg{};
  leg.kind = LegKind::Circle;
  setTurn(leg, from, to);
  setMoreAxes(leg, more);
  leg.start = arc.centre;
  leg.first = arc.first;
  leg.second = arc.second;
  leg.radius = numeric::norm(arc.first);
  leg.length = leg.radius * arc.sweep;
  return leg;
}

void giveToolAxes(Leg &leg, uint8_t given, const double (&from)[kAxes],
                  const double (&to)[kAxes]) noexcept {
  leg.given = given;
  leg.angle = 0.0;
  for (int32_t k = 0; k < kArmAxes; ++k) {
    if (!isGiven(given, k))
      continue;
    leg.from[k] = from[k];
    leg.delta[k] = to[k] - from[k];
  }
  if (leg.kind == LegKind::Turn)
    leg.length = stillLength(leg);
}

Leg axesLeg(const double (&from)[kAxes], const double (&to)[kAxes], const double (&perTime)[kAxes],
            double speed) noexcept {
  Leg leg{};
  leg.kind = LegKind::Axes;
  double time = 0.0;
  for (int32_t k = 0; k < kAxes; ++k) {
    leg.from[k] = from[k];
    leg.delta[k] = to[k] - from[k];
    if (leg.delta[k] != 0.0)
      time = larger(time, fabs(leg.delta[k]) / perTime[k]);
  }
  leg.length = time * speed;
  return leg;
}

void placeAt(const Leg &leg, const Series &way, PathPlace &place) noexcept {
  const Series part = way / leg.length; // exactly 1 at the end
  place.byTool = leadsTool(leg);
  place.alsoTurns = false;
  for (int32_t k = place.byTool ? kArmAxes : 0; k < kAxes; ++k)
    place.axes[k] = Series(leg.from[k]) + leg.delta[k] * part;
  if (!place.byTool)
    return;
  place.tool.place =
      leg.kind == LegKind::Circle ? alongCircle(leg, way) : alongLine(leg.start, leg.first, way);
  place.given = leg.given;
  for (int32_t k = 0; k < kArmAxes && leg.given != 0; ++k)
    if (isGiven(leg.given, k))
      place.axes[k] = Series(leg.from[k]) + leg.delta[k] * part;
  place.tool.turn = turnedOn(leg.about, part * leg.angle, leg.turn);
}

Pose endOf(const Leg &leg) noexcept {
  PathPlace place;
  placeAt(leg, Series(leg.length), place);
  Pose pose;
  pose.place = {place.tool.place(0).c[0], place.tool.place(1).c[0], place.tool.place(2).c[0]};
  for (int i = 0; i < 9; ++i)
    pose.turn[i] = place.tool.turn(i / 3, i % 3).c[0];
  return pose;
}

} // namespace stride::group
