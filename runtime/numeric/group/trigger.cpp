#include "runtime/numeric/group/trigger.hpp"

#include "runtime/numeric/group/path_making.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"
#include "runtime/numeric/path/motion_times.hpp"

namespace stride::group {
namespace {

using exact::kInfinity;
using exact::smaller;

constexpr double kNowhere = -1.0;

/// How far a product with a place is off by rounding: ends of legs are in planes through them. [u]
double slackOf(const Vector3 &place, double more, const Plane &plane) noexcept {
  constexpr double kRounding = 1e-12;
  return kRounding * (numeric::norm(place) + more + exact::fabs(plane.distance));
}

double lineInPlane(const Leg &leg, const Plane &plane) noexcept {
  const double slope = numeric::dot(plane.normal, leg.first);
  const double height = plane.distance - numeric::dot(plane.normal, leg.start);
  const double slack = slackOf(leg.start, leg.length, plane);
  if (exact::fabs(height) <= slack)
    return 0.0;
  if (slope == 0.0)
    return kNowhere;
  const double way = height / slope;
  if (way >= 0.0 && way <= leg.length)
    return way;
  return exact::fabs(height - slope * leg.length) <= slack ? leg.length : kNowhere;
}

/// a * cos + b * sin = height, solved for the first angle from 0 on.
double circleInPlane(const Leg &leg, const Plane &plane) noexcept {
  const double a = numeric::dot(plane.normal, leg.first);
  const double b = numeric::dot(plane.normal, leg.second);
  const double height = plane.distance - numeric::dot(plane.normal, leg.start);
  const double slack = slackOf(leg.start, leg.radius, plane);
  if (exact::fabs(height - a) <= slack)
    return 0.0;
  const double most = exact::sqrt(a * a + b * b);
  if (most == 0.0 || exact::fabs(height) > most + slack)
    return kNowhere;
  const double square = exact::larger(a * a + b * b - height * height, 0.0);
  constexpr double kTurn = 6.283185307179586;
  const double middle = kinematics::angleOf(b, a);
  const double beside = kinematics::angleOf(exact::sqrt(square), height);
  double best = kInfinity;
  for (const double angle : {middle - beside, middle + beside}) {
    const double way =
        leg.radius * (angle - kTurn * exact::floor(angle / kTurn)); // the first from 0 on
    best = smaller(best, way);
  }
  if (best <= leg.length)
    return best;
  const kinematics::TurnOf<double> end = kinematics::turnBy(leg.length / leg.radius);
  return exact::fabs(height - (a * end.c + b * end.s)) <= slack ? leg.length : kNowhere;
}

/// How far from the plane a place of a leg is, 0 also but for rounding; false: no axes bring the
/// tool there.
bool heightAt(const Arm &arm, const Leg &leg, const Plane &plane, double way,
              double &height) noexcept {
  PathPlace place;
  placeAt(leg, Series(way), place);
  Frame<double> tool;
  if (place.byTool) {
    for (int i = 0; i < 3; ++i)
      tool.place(i) = place.tool.place(i).c[0];
  } else {
    double axes[kAxes];
    for (int32_t k = 0; k < kAxes; ++k)
      axes[k] = place.axes[k].c[0];
    if (arm.kinematics.forward(axes, tool) != kinematics::Outcome::Done)
      return false;
  }
  height = numeric::dot(plane.normal, plain(tool.place)) - plane.distance;
  if (exact::fabs(height) <= slackOf(plain(tool.place), 0.0, plane))
    height = 0.0;
  return true;
}

double anyInPlane(const Arm &arm, const Leg &leg, const Plane &plane) noexcept {
  constexpr int32_t kPlaces = 256;
  constexpr int32_t kHalvings = 60;
  double low = 0.0;
  double before = 0.0;
  if (!heightAt(arm, leg, plane, low, before))
    return kNowhere;
  if (before == 0.0)
    return low;
  for (int32_t i = 1; i <= kPlaces; ++i) {
    double high = leg.length * i / kPlaces;
    double after = 0.0;
    if (!heightAt(arm, leg, plane, high, after))
      return kNowhere;
    if ((before < 0.0) == (after < 0.0) && after != 0.0) {
      low = high;
      continue;
    }
    for (int32_t n = 0; n < kHalvings && after != 0.0; ++n) {
      const double middle = 0.5 * (low + high);
      double height = 0.0;
      if (!heightAt(arm, leg, plane, middle, height))
        return kNowhere;
      const bool sameSide = (height < 0.0) == (before < 0.0) && height != 0.0;
      (sameSide ? low : high) = middle;
    }
    return high;
  }
  return kNowhere;
}

/// The number of a movement that has been appended and may still be looked at; -1: none.
int64_t numberOf(const GroupMotion &group, uint64_t id) noexcept {
  for (int64_t k = group.first; k < group.next; ++k)
    if (movementAt(group, k).id == id)
      return k;
  return -1;
}

} // namespace

double wayInPlane(const Arm &arm, const Leg &leg, const Plane &plane) noexcept {
  if (leg.kind == LegKind::Line)
    return lineInPlane(leg, plane);
  if (leg.kind == LegKind::Circle)
    return circleInPlane(leg, plane);
  return leg.length > 0.0 ? anyInPlane(arm, leg, plane) : kNowhere;
}

double wayOf(const GroupMotion &group, uint64_t movement, double along) noexcept {
  const int64_t number = numberOf(group, movement);
  if (number < 0 || number > group.looked)
    return kNowhere; // where it begins is not known yet
  const Movement &own = movementAt(group, number);
  if (along < own.entry) {
    const double half = 0.5 * own.corner.length;
    return own.begin + half + half * (along / own.entry);
  }
  const bool whole = own.endKnown || own.endChosen;
  if (along <= (whole ? own.exit : smaller(own.exit, group.lookedWay)))
    return legBegin(own) + (along - own.entry);
  if (!own.endKnown || number + 1 > group.looked)
    return kNowhere; // whether there is a corner is not known yet
  const double cut = own.leg.length - own.exit;
  const double half = 0.5 * movementAt(group, number + 1).corner.length;
  return own.end + half * ((along - own.exit) / cut);
}

double timeTo(const GroupMotion &group, double way) noexcept {
  return group.dwelling ? kInfinity : path::timeTo(group.motion, way);
}

double plannedTime(const GroupMotion &group) noexcept {
  return group.dwelling ? 0.0 : group.motion.promise;
}

GroupRest nextRest(const GroupMotion &group) noexcept {
  const path::NextRest rest = path::nextRest(group.motion);
  if (group.dwelling || !(rest.time < kInfinity))
    return {kInfinity, 0};
  uint64_t movement = 0;
  for (int64_t k = group.first; k < group.next && k <= group.looked; ++k)
    if (movementAt(group, k).endKnown && movementAt(group, k).end <= rest.way)
      movement = movementAt(group, k).id;
  return {rest.time, movement};
}

} // namespace stride::group
