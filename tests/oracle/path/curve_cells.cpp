#include "tests/oracle/path/curve_cells.hpp"

#include "tests/oracle/path/cell_parts.hpp"
#include "tests/oracle/path/s_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stride::oracle {

namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

/// Makes the limits of a cell as strict as those of a place.
void tighten(Cell &cell, const CurvePoint &point, const CurveLimits &limits) {
  double velocity = std::min(limits.velocity, point.feed);
  double tangential = 1.0 / limits.acceleration;
  double curvature = 0;
  for (size_t axis = 0; axis < kAxes; ++axis) {
    const double part = std::fabs(point.tangent[axis]);
    if (part > 0.0) {
      velocity = std::min(velocity, limits.axisVelocity[axis] / part);
      tangential = std::max(tangential, part / limits.axisAcceleration[axis]);
    }
    curvature =
        std::max(curvature, std::fabs(point.curvature[axis]) / limits.axisAcceleration[axis]);
  }
  cell.tangential = std::max(cell.tangential, tangential);
  cell.curvature = std::max(cell.curvature, curvature);
  cell.ceiling = std::min(cell.ceiling, velocity * velocity);
  if (curvature > 0.0)
    cell.ceiling = std::min(cell.ceiling, limits.curveShare / curvature);
}

/// Spacings at places that do not change by more than a third from one knot to the next.
void smooth(std::vector<double> &spacings, double distance) {
  constexpr double kGrowth = 0.25;
  for (size_t i = 1; i < spacings.size(); ++i)
    spacings[i] = std::min(spacings[i], spacings[i - 1] + kGrowth * distance);
  for (size_t i = spacings.size() - 1; i-- > 0;)
    spacings[i] = std::min(spacings[i], spacings[i + 1] + kGrowth * distance);
}

} // namespace

CurveLimits::CurveLimits() : velocity(kAny), acceleration(kAny) {
  axisVelocity.fill(kAny);
  axisAcceleration.fill(kAny);
}

std::vector<Cell> cellsOf(const Curve &curve, std::span<const double> knots,
                          const CurveLimits &limits, int samples) {
  std::vector<Cell> cells;
  for (size_t i = 0; i + 1 < knots.size(); ++i) {
    const double length = knots[i + 1] - knots[i];
    Cell cell{length, 0.0, 0.0, kAny};
    // Inside of it: at its ends the curvature may jump.
    for (int k = 0; k < samples; ++k)
      tighten(cell, curve(knots[i] + length * (k + 0.5) / samples), limits);
    cells.push_back(cell);
  }
  return cells;
}

std::vector<double> timeKnots(const Curve &curve, double length, const CurveLimits &limits,
                              double step, size_t places) {
  const double distance = length / static_cast<double>(places);
  std::vector<double> even;
  for (size_t i = 0; i < places; ++i)
    even.push_back(distance * static_cast<double>(i));
  even.push_back(length);
  const std::vector<Cell> cells = cellsOf(curve, even, limits, 1);
  std::vector<double> spacings;
  const std::vector<double> squares = accelerationOptimum(cells).squares;
  for (size_t i = 0; i < squares.size(); ++i) {
    const double acceleration = 1.0 / cells[std::min(i, places - 1)].tangential;
    const double start = 0.5 * acceleration * step * step; // out of rest
    spacings.push_back(std::max(start, step * std::sqrt(squares[i])));
  }
  smooth(spacings, distance);
  std::vector<double> knots = {0.0};
  for (;;) {
    const double at = knots.back() / distance;
    const size_t i = std::min(static_cast<size_t>(at), places - 1);
    const double part = at - static_cast<double>(i);
    const double spacing = spacings[i] + part * (spacings[i + 1] - spacings[i]);
    if (knots.back() + 1.5 * spacing >= length)
      break;
    knots.push_back(knots.back() + spacing);
  }
  knots.push_back(length);
  return knots;
}

double lowerBound(std::span<const Cell> cells, double jerk) {
  std::vector<Cell> straight(cells.begin(), cells.end());
  for (Cell &cell : straight)
    cell.curvature = 0;
  double time = 0;
  for (const CellPart &part : partsBetweenStops(straight)) {
    double length = 0;
    double velocity = 0;
    double acceleration = 0;
    double even = 0; // at the ceilings all the way
    const std::span<const Cell> own = std::span(straight).subspan(part.first, part.count);
    for (const Cell &cell : own) {
      length += cell.length;
      velocity = std::max(velocity, std::sqrt(cell.ceiling));
      acceleration = std::max(acceleration, 1.0 / cell.tangential);
      even += cell.length / std::sqrt(cell.ceiling);
    }
    const Optimum passes = accelerationOptimum(own);
    time += std::max({even, passes.solved ? passes.time : 0.0,
                      restToRestTime(length, velocity, acceleration, jerk)});
  }
  return time;
}

} // namespace stride::oracle
