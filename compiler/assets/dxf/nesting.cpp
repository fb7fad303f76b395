// Which contours lie in which.
#include "compiler/assets/dxf/contours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stc::dxf {

namespace {

struct Box {
  Point least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point most{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(Point place) {
    least = {std::min(least.x, place.x), std::min(least.y, place.y)};
    most = {std::max(most.x, place.x), std::max(most.y, place.y)};
  }
  [[nodiscard]] bool holds(Point place) const {
    return place.x >= least.x && place.x <= most.x && place.y >= least.y && place.y <= most.y;
  }
};

std::vector<Point> polygonOf(const Contour &contour) {
  std::vector<Point> places;
  for (const Piece &piece : contour.pieces)
    appendPlaces(piece, places);
  return places;
}

double areaOf(const std::vector<Point> &polygon) {
  double sum = 0;
  for (size_t i = 0; i < polygon.size(); ++i)
    sum += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return sum / 2;
}

/// By the edges that a ray to the right meets.
bool isInside(Point place, const std::vector<Point> &polygon) {
  bool inside = false;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i];
    const Point b = polygon[(i + 1) % polygon.size()];
    if ((a.y > place.y) != (b.y > place.y) &&
        place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y))
      inside = !inside;
  }
  return inside;
}

bool isMet(Point a, Point b, Point c, Point d) {
  return cross(b - a, c - a) * cross(b - a, d - a) <= 0 &&
         cross(d - c, a - c) * cross(d - c, b - c) <= 0;
}

} // namespace

std::vector<int32_t> nestingOf(const std::vector<Contour> &contours) {
  struct Closed {
    int32_t contour;
    std::vector<Point> polygon;
    double area;
    Box box;
  };
  std::vector<Closed> closed;
  for (size_t i = 0; i < contours.size(); ++i)
    if (contours[i].closed) {
      Closed one{static_cast<int32_t>(i), polygonOf(contours[i]), 0, {}};
      one.area = std::abs(areaOf(one.polygon));
      for (const Point place : one.polygon)
        one.box.add(place);
      closed.push_back(std::move(one));
    }
  std::stable_sort(closed.begin(), closed.end(),
                   [](const Closed &a, const Closed &b) { return a.area < b.area; });
  std::vector<int32_t> parents(contours.size(), -1);
  std::vector<double> areas(contours.size(), 0);
  for (const Closed &one : closed)
    areas[static_cast<size_t>(one.contour)] = one.area;
  for (size_t i = 0; i < contours.size(); ++i) {
    const Point place = placeAt(contours[i].pieces.front(), 0.5);
    const auto larger =
        std::upper_bound(closed.begin(), closed.end(), areas[i],
                         [](double area, const Closed &one) { return area < one.area; });
    for (auto one = larger; one != closed.end() && parents[i] < 0; ++one)
      if (one->box.holds(place) && isInside(place, one->polygon))
        parents[i] = one->contour;
  }
  return parents;
}

bool isCounterclockwise(const Contour &contour) { return areaOf(polygonOf(contour)) > 0; }

Outlines::Outlines(const std::vector<Contour> &contours) {
  for (const Contour &contour : contours) {
    Outline outline{polygonOf(contour), {}, {}};
    outline.places.push_back(contour.end());
    Box box;
    for (const Point place : outline.places)
      box.add(place);
    outline.least = box.least;
    outline.most = box.most;
    outlines_.push_back(std::move(outline));
  }
}

bool Outlines::areMet(Point from, Point to) const {
  for (const Outline &outline : outlines_) {
    if (std::max(from.x, to.x) < outline.least.x || std::min(from.x, to.x) > outline.most.x ||
        std::max(from.y, to.y) < outline.least.y || std::min(from.y, to.y) > outline.most.y)
      continue;
    for (size_t i = 1; i < outline.places.size(); ++i)
      if (isMet(from, to, outline.places[i - 1], outline.places[i]))
        return true;
  }
  return false;
}

} // namespace stc::dxf
