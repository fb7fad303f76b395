#include "tests/oracle/path/path_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stride::oracle {

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector &a, const Vector &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector sum(const Vector &a, const Vector &b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

Vector spatial(const Place &place) { return {place[0], place[1], place[2]}; }

Place driftOf(const ChainElement &element) {
  Place way{};
  for (size_t axis = 0; axis < kAxes; ++axis)
    way[axis] = element.end[axis] - element.start[axis];
  if (element.isArc)
    for (size_t axis = 0; axis < 3; ++axis)
      way[axis] -= element.radial[axis] * (std::cos(element.sweep) - 1.0) +
                   element.lateral[axis] * std::sin(element.sweep);
  return way;
}

double square(double x) { return x * x; }

double squaredDistance(const Place &a, const Place &b, size_t axes) {
  double all = 0;
  for (size_t axis = 0; axis < axes; ++axis)
    all += square(a[axis] - b[axis]);
  return all;
}

/// The part of a line that is nearest to a point.
double partOfLine(const ChainElement &line, const Place &point, size_t axes) {
  double along = 0;
  double all = 0;
  for (size_t axis = 0; axis < axes; ++axis) {
    along += line.drift[axis] * (point[axis] - line.start[axis]);
    all += square(line.drift[axis]);
  }
  return all > 0.0 ? along / all : 0.0;
}

/// The part of an arc without drift that is nearest to a point, if it is in [from, to]; else that
/// of the nearer end.
double partOfArc(const ChainElement &arc, const Place &point, double from, double to) {
  const Vector out = sum(spatial(point), arc.centre, -1.0);
  double angle = std::atan2(dot(out, arc.lateral), dot(out, arc.radial));
  const double middle = 0.5 * (from + to) * arc.sweep;
  // the turn of the angle that is nearest to the middle: out of the arc, the nearer end is next
  angle += 2 * std::numbers::pi * std::round((middle - angle) / (2 * std::numbers::pi));
  return angle / arc.sweep;
}

/// The same with drift: the best of many, made better by golden sections.
double partOfHelix(const ChainElement &helix, const Place &point, double from, double to,
                   size_t axes) {
  const int samples = 8 + static_cast<int>(16 * helix.sweep * (to - from));
  const double step = (to - from) / samples;
  const auto apart = [&](double part) { return squaredDistance(helix.at(part), point, axes); };
  double best = from;
  double least = apart(from);
  for (int i = 1; i <= samples; ++i) {
    const double here = apart(from + i * step);
    if (here < least) {
      least = here;
      best = from + i * step;
    }
  }
  double low = std::max(from, best - step);
  double high = std::min(to, best + step);
  constexpr double kGolden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double left = high - kGolden * (high - low);
    const double right = low + kGolden * (high - low);
    (apart(left) < apart(right) ? high : low) = apart(left) < apart(right) ? right : left;
  }
  return 0.5 * (low + high);
}

bool drifts(const ChainElement &arc, size_t axes) {
  double all = 0;
  for (size_t axis = 0; axis < axes; ++axis)
    all += square(arc.drift[axis]);
  return all > square(1e-9 * arc.length);
}

} // namespace

double distance(const Place &a, const Place &b, size_t axes) {
  return std::sqrt(squaredDistance(a, b, axes));
}

Place ChainElement::at(double part) const {
  if (part <= 0.0)
    return start;
  if (part >= 1.0)
    return end;
  Place place = start;
  for (size_t axis = 0; axis < kAxes; ++axis)
    place[axis] += part * drift[axis];
  if (isArc)
    for (size_t axis = 0; axis < 3; ++axis)
      place[axis] +=
          radial[axis] * (std::cos(part * sweep) - 1.0) + lateral[axis] * std::sin(part * sweep);
  return place;
}

PathChain::PathChain(const Place &start, size_t axes) : axes_(axes), end_(start) {}

void PathChain::add(ChainElement element) {
  element.drift = driftOf(element);
  double all = element.isArc ? dot(element.radial, element.radial) * square(element.sweep) : 0.0;
  for (size_t axis = 0; axis < axes_; ++axis)
    all += square(element.drift[axis]); // at a right angle to the turning
  element.length = std::sqrt(all);
  element.startWay = length_;
  length_ += element.length;
  end_ = element.end;
  elements_.push_back(element);
}

void PathChain::addLine(const Place &end) {
  add({end_, end, false, {}, {}, {}, 0.0, {}, 0.0, 0.0});
}

void PathChain::addArc(const Place &end, const std::array<double, 3> &centre,
                       const std::array<double, 3> &normal) {
  const Vector unit = sum({0, 0, 0}, normal, 1.0 / std::sqrt(dot(normal, normal)));
  const auto flat = [&](const Vector &v) { return sum(v, unit, -dot(v, unit)); };
  const Vector start = spatial(end_);
  const Vector chord = flat(sum(spatial(end), start, -1.0));
  Vector middle = sum(start, flat(sum(centre, start, -1.0)), 1.0);
  if (dot(chord, chord) > 0.0) { // onto the bisector of the chord
    const double off = dot(sum(sum(middle, start, -1.0), chord, -0.5), chord);
    middle = sum(middle, chord, -off / dot(chord, chord));
  }
  const Vector radial = sum(start, middle, -1.0);
  const Vector lateral = cross(unit, radial);
  const Vector to = sum(radial, chord, 1.0);
  double sweep = 2 * std::numbers::pi;
  if (dot(chord, chord) > 0.0) {
    sweep = std::atan2(dot(to, lateral), dot(to, radial));
    if (sweep <= 0.0)
      sweep += 2 * std::numbers::pi;
  }
  add({end_, end, true, middle, radial, lateral, sweep, {}, 0.0, 0.0});
}

Place PathChain::at(double way) const {
  const auto next =
      std::partition_point(elements_.begin(), elements_.end(),
                           [&](const ChainElement &element) { return element.startWay <= way; });
  if (next == elements_.begin())
    return elements_.front().start;
  const ChainElement &element = *(next - 1);
  return element.at(way < length_ ? (way - element.startWay) / element.length : 1.0);
}

Foot PathChain::nearest(const Place &point, double fromWay, double toWay) const {
  Foot foot{std::numeric_limits<double>::infinity(), fromWay, 0};
  auto first =
      std::partition_point(elements_.begin(), elements_.end(), [&](const ChainElement &element) {
        return element.startWay + element.length < fromWay;
      });
  for (; first != elements_.end() && first->startWay <= toWay; ++first) {
    const ChainElement &element = *first;
    const double size = std::max(element.length, std::numeric_limits<double>::min());
    const double from = std::clamp((fromWay - element.startWay) / size, 0.0, 1.0);
    const double to = std::clamp((toWay - element.startWay) / size, 0.0, 1.0);
    double part = 0;
    if (!element.isArc)
      part = partOfLine(element, point, axes_);
    else if (drifts(element, axes_))
      part = partOfHelix(element, point, from, to, axes_);
    else
      part = partOfArc(element, point, from, to);
    part = std::clamp(part, from, to);
    const double apart = distance(element.at(part), point, axes_);
    if (apart < foot.distance)
      foot = {apart, element.startWay + part * element.length,
              static_cast<size_t>(first - elements_.begin())};
  }
  return foot;
}

} // namespace stride::oracle
