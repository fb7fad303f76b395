#include "compiler/assets/dxf/route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace stc::dxf {

namespace {

constexpr double kShorter = 1e-9; ///< What a change has to win, as a part of the way.

/// Beginnings by place, for the nearest one.
class Near {
public:
  explicit Near(const std::vector<Stop> &stops) : stops_(stops) {
    Point most{-kFar, -kFar};
    least_ = {kFar, kFar};
    size_t count = 0;
    for (const Stop &stop : stops)
      for (const Beginning &beginning : stop.beginnings) {
        least_ = {std::min(least_.x, beginning.from.x), std::min(least_.y, beginning.from.y)};
        most = {std::max(most.x, beginning.from.x), std::max(most.y, beginning.from.y)};
        ++count;
      }
    const double across = std::max({most.x - least_.x, most.y - least_.y, 1e-6});
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(count))), 1, 1024);
    size_ = across / side_ * (1 + 1e-9);
    cells_.resize(static_cast<size_t>(side_) * static_cast<size_t>(side_));
  }

  void add(size_t contour) {
    for (size_t i = 0; i < stops_[contour].beginnings.size(); ++i)
      cellAt(stops_[contour].beginnings[i].from).push_back({contour, i});
  }
  void remove(size_t contour) {
    for (const Beginning &beginning : stops_[contour].beginnings)
      std::erase_if(cellAt(beginning.from),
                    [contour](const Visit &visit) { return visit.contour == contour; });
  }

  /// The nearest one; of several that of the first contour.
  [[nodiscard]] Visit nearest(Point place) const {
    Visit best;
    double bestWay = kFar;
    const int x = cellOf(place.x - least_.x);
    const int y = cellOf(place.y - least_.y);
    for (int ring = 0; ring <= side_; ++ring) {
      // Further rings are so far away at least.
      if (bestWay < (ring - 1) * size_)
        break;
      for (int column = x - ring; column <= x + ring; ++column)
        for (int row = y - ring; row <= y + ring;
             row += column == x - ring || column == x + ring ? 1 : std::max(1, 2 * ring))
          look(column, row, place, best, bestWay);
    }
    return best;
  }

private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  void look(int column, int row, Point place, Visit &best, double &bestWay) const {
    if (column < 0 || row < 0 || column >= side_ || row >= side_)
      return;
    for (const Visit &visit : cells_[static_cast<size_t>(column) * static_cast<size_t>(side_) +
                                     static_cast<size_t>(row)]) {
      const double way = norm(stops_[visit.contour].beginnings[visit.beginning].from - place);
      if (way < bestWay || (way == bestWay && visit.contour < best.contour)) {
        best = visit;
        bestWay = way;
      }
    }
  }
  [[nodiscard]] int cellOf(double off) const {
    return static_cast<int>(std::clamp(off / size_, 0.0, static_cast<double>(side_ - 1)));
  }
  std::vector<Visit> &cellAt(Point place) {
    return cells_[static_cast<size_t>(cellOf(place.x - least_.x)) * static_cast<size_t>(side_) +
                  static_cast<size_t>(cellOf(place.y - least_.y))];
  }

  const std::vector<Stop> &stops_;
  Point least_;
  double size_ = 1;
  int side_ = 1;
  std::vector<std::vector<Visit>> cells_;
};

class Router {
public:
  Router(const std::vector<Stop> &stops, Point start)
      : stops_(stops), start_(start), inner_(stops.size()) {
    for (size_t i = 0; i < stops.size(); ++i)
      if (stops[i].within >= 0)
        inner_[static_cast<size_t>(stops[i].within)].push_back(i);
  }

  std::vector<Visit> run() {
    nearestFirst();
    chooseBeginnings();
    for (int round = 0; round < kRounds && turnParts(); ++round)
      chooseBeginnings();
    return std::move(route_);
  }

private:
  static constexpr int kRounds = 20;
  static constexpr int64_t kMostTries = 40'000'000;

  [[nodiscard]] const Beginning &of(const Visit &visit) const {
    return stops_[visit.contour].beginnings[visit.beginning];
  }
  [[nodiscard]] Point before(size_t i) const { return i == 0 ? start_ : of(route_[i - 1]).to; }
  /// From a place to what comes at i; 0 after the end.
  [[nodiscard]] double wayInto(Point place, size_t i) const {
    return i < route_.size() ? norm(of(route_[i]).from - place) : 0;
  }

  void nearestFirst() {
    Near near(stops_);
    std::vector<size_t> waiting(stops_.size());
    for (size_t i = 0; i < stops_.size(); ++i) {
      waiting[i] = inner_[i].size();
      if (waiting[i] == 0)
        near.add(i);
    }
    Point here = start_;
    while (route_.size() < stops_.size()) {
      const Visit visit = near.nearest(here);
      near.remove(visit.contour);
      route_.push_back(visit);
      here = of(visit).to;
      const int32_t outer = stops_[visit.contour].within;
      if (outer >= 0 && --waiting[static_cast<size_t>(outer)] == 0)
        near.add(static_cast<size_t>(outer));
    }
  }

  void chooseBeginnings() {
    for (size_t i = 0; i < route_.size(); ++i) {
      const std::vector<Beginning> &all = stops_[route_[i].contour].beginnings;
      const auto wayOf = [&](size_t n) {
        return norm(all[n].from - before(i)) + wayInto(all[n].to, i + 1);
      };
      for (size_t n = 0; n < all.size(); ++n)
        if (wayOf(n) < wayOf(route_[i].beginning) * (1 - kShorter))
          route_[i].beginning = n;
    }
  }

  [[nodiscard]] Visit turned(const Visit &visit) const {
    return stops_[visit.contour].closed ? visit : Visit{visit.contour, 1 - visit.beginning};
  }

  /// Turns parts of the route round where that makes it shorter; false: nowhere.
  bool turnParts() {
    std::vector<size_t> places(stops_.size());
    for (size_t i = 0; i < route_.size(); ++i)
      places[route_[i].contour] = i;
    bool changed = false;
    for (size_t i = 0; i < route_.size(); ++i) {
      double inside = 0; // the way within i to j, and the same backwards
      double backwards = 0;
      for (size_t j = i; j < route_.size() && tries_ < kMostTries; ++j, ++tries_) {
        if (j > i) {
          inside += wayInto(of(route_[j - 1]).to, j);
          backwards += norm(of(turned(route_[j - 1])).from - of(turned(route_[j])).to);
        }
        // What lies within a contour has to come before it.
        const std::vector<size_t> &inner = inner_[route_[j].contour];
        if (std::any_of(inner.begin(), inner.end(),
                        [&](size_t contour) { return places[contour] >= i; }))
          break;
        const double now = wayInto(before(i), i) + inside + wayInto(of(route_[j]).to, j + 1);
        const double then = norm(of(turned(route_[j])).from - before(i)) + backwards +
                            wayInto(of(turned(route_[i])).to, j + 1);
        if (then < now * (1 - kShorter)) {
          turn(i, j, places);
          changed = true;
          std::swap(inside, backwards);
        }
      }
    }
    return changed;
  }

  void turn(size_t i, size_t j, std::vector<size_t> &places) {
    const auto begin = route_.begin() + static_cast<ptrdiff_t>(i);
    const auto end = route_.begin() + static_cast<ptrdiff_t>(j) + 1;
    std::reverse(begin, end);
    for (size_t n = i; n <= j; ++n) {
      route_[n] = turned(route_[n]);
      places[route_[n].contour] = n;
    }
  }

  const std::vector<Stop> &stops_;
  Point start_;
  std::vector<std::vector<size_t>> inner_; ///< By contour: which lie directly within it.
  std::vector<Visit> route_;
  int64_t tries_ = 0;
};

} // namespace

double travelOf(const std::vector<Stop> &stops, const std::vector<Visit> &route, Point start) {
  double sum = 0;
  for (const Visit &visit : route) {
    const Beginning &beginning = stops[visit.contour].beginnings[visit.beginning];
    sum += norm(beginning.from - start);
    start = beginning.to;
  }
  return sum;
}

std::vector<Visit> drawnRoute(const std::vector<Stop> &stops) {
  std::vector<std::vector<size_t>> inner(stops.size());
  for (size_t i = 0; i < stops.size(); ++i)
    if (stops[i].within >= 0)
      inner[static_cast<size_t>(stops[i].within)].push_back(i);
  // What lies within a contour goes before it: the contour waits on a stack.
  std::vector<Visit> route;
  std::vector<std::pair<size_t, size_t>> stack;
  for (size_t i = 0; i < stops.size(); ++i) {
    if (stops[i].within >= 0)
      continue;
    stack.emplace_back(i, 0);
    while (!stack.empty()) {
      auto &[contour, done] = stack.back();
      if (done < inner[contour].size()) {
        const size_t next = inner[contour][done++];
        stack.emplace_back(next, 0);
      } else {
        route.push_back({contour, 0});
        stack.pop_back();
      }
    }
  }
  return route;
}

std::vector<Visit> routeOf(const std::vector<Stop> &stops, Point start) {
  std::vector<Visit> route = Router(stops, start).run();
  std::vector<Visit> drawn = drawnRoute(stops);
  return travelOf(stops, drawn, start) < travelOf(stops, route, start) ? drawn : route;
}

} // namespace stc::dxf
