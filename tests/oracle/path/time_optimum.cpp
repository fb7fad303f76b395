#include "tests/oracle/path/time_optimum.hpp"

#include "tests/oracle/path/barrier_problem.hpp"
#include "tests/oracle/path/cell_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace stride::oracle {

namespace {

/// Squares that keep all limits strictly: what the acceleration allows, scaled down until the jerk
/// is small enough. The less the velocity, the less the jerk.
std::vector<double> insideOf(const BarrierProblem &problem) {
  std::vector<double> squares = problem.accelerationPasses();
  double greatest = 0;
  for (const double square : squares)
    greatest = std::max(greatest, square);
  for (int i = 0; i < 400; ++i) {
    for (double &square : squares)
      square *= 0.7;
    if (std::isfinite(problem.barrier(squares, 1.0)))
      break;
  }
  return squares;
}

class InteriorPoint {
public:
  InteriorPoint(const BarrierProblem &problem, const OptimumOptions &options)
      : problem_(problem), options_(options), squares_(insideOf(problem)),
        system_(problem.cells() - 1), direction_(problem.cells() + 1), tried_(squares_) {}

  /// false: it does not converge.
  bool run() {
    const double limits = problem_.limits();
    double weight = problem_.time(squares_) / limits;
    while (steps_ < options_.mostSteps) {
      const double progress = step(weight);
      if (progress < 0.0)
        return false;
      if (progress > 0.5 * weight * kCentred)
        continue;
      if (weight * limits <= options_.gap * problem_.time(squares_))
        return true;
      weight *= kReduction;
    }
    return false;
  }
  [[nodiscard]] const std::vector<double> &squares() const { return squares_; }
  [[nodiscard]] int32_t steps() const { return steps_; }

private:
  static constexpr double kReduction = 0.2;
  static constexpr double kCentred = 0.5; ///< Newton's decrement squared, in weights.

  /// A step of Newton's method. What it promised to gain; negative: it cannot be computed.
  double step(double weight) {
    ++steps_;
    problem_.assemble(squares_, weight, system_);
    const std::vector<Exact> downhill = system_.rightSide;
    if (!system_.solve())
      return -1.0;
    Exact exactDecrement = 0;
    for (size_t i = 0; i < downhill.size(); ++i) {
      direction_[i + 1] = static_cast<double>(system_.rightSide[i]);
      exactDecrement += downhill[i] * system_.rightSide[i];
    }
    const auto decrement = static_cast<double>(exactDecrement);
    double length = std::min(1.0, 0.99 * problem_.reach(squares_, direction_));
    const double before = problem_.barrier(squares_, weight);
    for (int i = 0; i < 40; ++i, length *= 0.5) {
      for (size_t node = 1; node + 1 < squares_.size(); ++node)
        tried_[node] = squares_[node] + length * direction_[node];
      if (problem_.barrier(tried_, weight) <= before - 0.05 * length * decrement) {
        squares_.swap(tried_);
        return 0.5 * decrement;
      }
    }
    return 0.0; // nothing to be gained any more, by rounding
  }

  const BarrierProblem &problem_;
  const OptimumOptions &options_;
  std::vector<double> squares_;
  BandedSystem system_;
  std::vector<double> direction_, tried_;
  int32_t steps_ = 0;
};

} // namespace

std::vector<CellPart> partsBetweenStops(std::span<const Cell> cells) {
  std::vector<CellPart> parts;
  size_t first = 0;
  for (size_t i = 0; i <= cells.size(); ++i) {
    if (i < cells.size() && cells[i].ceiling > 0.0)
      continue;
    if (i > first)
      parts.push_back({first, i - first});
    first = i + 1;
  }
  return parts;
}

Optimum timeOptimum(std::span<const Cell> cells, double jerk, const OptimumOptions &options) {
  Optimum result{true, 0.0, std::vector<double>(cells.size() + 1, 0.0), 0};
  for (const CellPart &part : partsBetweenStops(cells)) {
    if (part.count < 3) {
      result.solved = false;
      return result;
    }
    const BarrierProblem problem(cells.subspan(part.first, part.count), jerk);
    InteriorPoint method(problem, options);
    result.solved = method.run() && result.solved;
    result.time += problem.time(method.squares());
    result.steps = std::max(result.steps, method.steps());
    std::copy(method.squares().begin(), method.squares().end(),
              result.squares.begin() + static_cast<ptrdiff_t>(part.first));
  }
  return result;
}

Optimum accelerationOptimum(std::span<const Cell> cells) {
  Optimum result{true, 0.0, std::vector<double>(cells.size() + 1, 0.0), 0};
  for (const CellPart &part : partsBetweenStops(cells)) {
    if (part.count < 3) {
      result.solved = false;
      return result;
    }
    const BarrierProblem problem(cells.subspan(part.first, part.count),
                                 std::numeric_limits<double>::infinity());
    const std::vector<double> squares = problem.accelerationPasses();
    result.time += problem.time(squares);
    std::copy(squares.begin(), squares.end(),
              result.squares.begin() + static_cast<ptrdiff_t>(part.first));
  }
  return result;
}

Excess excessOf(std::span<const Cell> cells, double jerk, std::span<const double> squares) {
  Excess worst{-1, -1, -1};
  for (const CellPart &part : partsBetweenStops(cells)) {
    const Excess one = BarrierProblem(cells.subspan(part.first, part.count), jerk)
                           .excess(squares.subspan(part.first, part.count + 1));
    worst = {std::max(worst.ceiling, one.ceiling), std::max(worst.acceleration, one.acceleration),
             std::max(worst.jerk, one.jerk)};
  }
  return worst;
}

double timeOf(std::span<const Cell> cells, double jerk, std::span<const double> squares) {
  double sum = 0;
  for (const CellPart &part : partsBetweenStops(cells))
    sum += BarrierProblem(cells.subspan(part.first, part.count), jerk)
               .time(squares.subspan(part.first, part.count + 1));
  return sum;
}

} // namespace stride::oracle
