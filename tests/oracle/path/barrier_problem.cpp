#include "tests/oracle/path/barrier_problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stride::oracle {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// velocity^2 after a way out of rest with constant jerk.
double squareFromRest(double way, double jerk) {
  const double time = std::cbrt(6.0 * way / jerk);
  return 0.25 * jerk * jerk * time * time * time * time;
}

/// What the limit of the jerk at a node would show of motion with constant jerk out of a rest that
/// is `way` away, as a multiple of that jerk: 1.17 at the first of even nodes, soon 1.
double restCorrection(double way, double lengthTowards, double lengthAway) {
  if (way > 50.0 * std::max(lengthTowards, lengthAway))
    return 1.0;
  const double here = squareFromRest(way, 1.0);
  const double towards = (here - squareFromRest(std::max(0.0, way - lengthTowards), 1.0));
  const double away = squareFromRest(way + lengthAway, 1.0) - here;
  const double change = 0.5 * (away / lengthAway - towards / lengthTowards);
  return change * std::sqrt(here) / (0.5 * (lengthTowards + lengthAway));
}

/// The quickest motion out of rest over a cell, with limits of jerk and acceleration.
struct RestCell {
  double square; ///< velocity^2 at its end.
  double factor; ///< Its time as a multiple of length / velocity: 3 if the jerk alone limits it.
};

RestCell restCell(const Cell &cell, double jerk) {
  const double acceleration = 1.0 / cell.tangential;
  const double ramp = acceleration / jerk; // time
  const double rampWay = acceleration * ramp * ramp / 6.0;
  if (cell.length <= rampWay)
    return {squareFromRest(cell.length, jerk), 3.0};
  const double rampVelocity = 0.5 * acceleration * ramp;
  const double square = rampVelocity * rampVelocity + 2.0 * acceleration * (cell.length - rampWay);
  const double time = ramp + (std::sqrt(square) - rampVelocity) / acceleration;
  return {square, time * std::sqrt(square) / cell.length};
}

} // namespace

BarrierProblem::BarrierProblem(std::span<const Cell> cells, double jerk)
    : jerkLimited(std::isfinite(jerk)) {
  const size_t count = cells.size();
  ceiling.assign(count + 1, kInfinite);
  change.assign(count + 1, kInfinite);
  double all = 0;
  for (size_t i = 0; i < count; ++i) {
    const Cell &cell = cells[i];
    length.push_back(cell.length);
    slope.push_back(cell.tangential / (2.0 * cell.length));
    curvature.push_back(cell.curvature);
    for (const size_t node : {i, i + 1})
      ceiling[node] = std::min(ceiling[node], cell.ceiling);
    all += cell.length;
  }
  firstFactor = lastFactor = 2.0;
  if (!jerkLimited)
    return;
  const RestCell first = restCell(cells.front(), jerk);
  const RestCell last = restCell(cells.back(), jerk);
  firstFactor = first.factor;
  lastFactor = last.factor;
  ceiling[1] = std::min(ceiling[1], first.square);
  ceiling[count - 1] = std::min(ceiling[count - 1], last.square);
  double way = 0;
  for (size_t node = 1; node < count; ++node) {
    way += length[node - 1];
    const double before = length[node - 1];
    const double after = length[node];
    const double correction = way < all - way ? restCorrection(way, before, after)
                                              : restCorrection(all - way, after, before);
    change[node] = jerk * 0.5 * (before + after) * correction;
  }
}

double BarrierProblem::limits() const {
  double count = 2.0 * static_cast<double>(cells());
  for (size_t node = 1; node < cells(); ++node)
    count += (std::isfinite(ceiling[node]) ? 2.0 : 1.0) + (jerkLimited ? 2.0 : 0.0);
  return count;
}

double BarrierProblem::time(std::span<const double> squares) const {
  const size_t last = cells() - 1;
  double sum = firstFactor * length[0] / std::sqrt(squares[1]) +
               lastFactor * length[last] / std::sqrt(squares[last]);
  for (size_t i = 1; i < last; ++i)
    sum += 2.0 * length[i] / (std::sqrt(squares[i]) + std::sqrt(squares[i + 1]));
  return sum;
}

std::vector<double> BarrierProblem::accelerationPasses() const {
  std::vector<double> squares = ceiling;
  squares.front() = squares.back() = 0.0;
  const auto lower = [&](size_t cell, double from, double &to) {
    to = std::min(to, (1.0 + slope[cell] * from) / (slope[cell] + curvature[cell]));
  };
  for (size_t i = 0; i < cells(); ++i)
    lower(i, squares[i], squares[i + 1]);
  for (size_t i = cells(); i-- > 0;)
    lower(i, squares[i + 1], squares[i]);
  return squares;
}

double BarrierProblem::barrier(std::span<const double> squares, double weight) const {
  double logarithms = 0;
  double product = 1; // of a few slacks: one logarithm for several
  bool kept = true;
  const auto add = [&](double slack) {
    kept = kept && slack > 0.0;
    product *= slack;
    if (product < 1e-200 || product > 1e200) {
      logarithms += std::log(product);
      product = 1;
    }
  };
  for (size_t i = 0; i < cells() && kept; ++i) {
    const double rise = slope[i] * (squares[i + 1] - squares[i]);
    add(1.0 - rise - curvature[i] * squares[i + 1]);
    add(1.0 + rise - curvature[i] * squares[i]);
  }
  double slopeBefore = (squares[1] - squares[0]) / (2.0 * length[0]);
  for (size_t node = 1; node < cells() && kept; ++node) {
    add(squares[node]);
    if (std::isfinite(ceiling[node]))
      add(1.0 - squares[node] / ceiling[node]);
    const double slopeAfter = (squares[node + 1] - squares[node]) / (2.0 * length[node]);
    if (jerkLimited) {
      const double most = change[node] / std::sqrt(squares[node]);
      add(most - (slopeAfter - slopeBefore));
      add(most + (slopeAfter - slopeBefore));
    }
    slopeBefore = slopeAfter;
  }
  if (!kept)
    return kInfinite;
  return time(squares) - weight * (logarithms + std::log(product));
}

namespace {

/// Adds the terms of one limit or cell to the equations: of nodes from `node` on, of which the
/// unknowns are 1 to size.
struct Scatter {
  BandedSystem &system;
  size_t size;

  /// - weight * log(slack), whose gradient over the nodes is given.
  template <size_t Nodes>
  void slack(size_t node, Exact weight, Exact slack, const std::array<Exact, Nodes> &gradient) {
    const Exact once = weight / slack;
    const Exact twice = once / slack;
    for (size_t i = 0; i < Nodes; ++i) {
      if (!unknown(node + i))
        continue;
      system.rightSide[node + i - 1] += once * gradient[i];
      for (size_t k = i; k < Nodes; ++k)
        if (unknown(node + k))
          band(k - i)[node + i - 1] += twice * gradient[i] * gradient[k];
    }
  }
  [[nodiscard]] bool unknown(size_t node) const { return node >= 1 && node <= size; }
  std::vector<Exact> &band(size_t distance) {
    return distance == 0 ? system.diagonal : distance == 1 ? system.first : system.second;
  }
};

/// The time of a cell that begins or ends at rest: factor * length / v.
void addRestTime(BandedSystem &system, size_t unknown, double time, double square) {
  system.rightSide[unknown] += 0.5 * time / square;
  system.diagonal[unknown] += 0.75 * time / (square * square);
}

void addTime(BandedSystem &system, size_t cell, double length, double before, double after) {
  const double p = std::sqrt(before);
  const double q = std::sqrt(after);
  const double sum = p + q;
  const double once = length / (sum * sum);
  const double twice = once / sum;
  const size_t unknown = cell - 1;
  system.rightSide[unknown] += once / p;
  system.rightSide[unknown + 1] += once / q;
  system.diagonal[unknown] += twice / before + 0.5 * once / (before * p);
  system.diagonal[unknown + 1] += twice / after + 0.5 * once / (after * q);
  system.first[unknown] += twice / (p * q);
}

} // namespace

void BarrierProblem::assemble(std::span<const double> squares, double weight,
                              BandedSystem &system) const {
  system.clear();
  const size_t last = cells() - 1;
  addRestTime(system, 0, firstFactor * length[0] / std::sqrt(squares[1]), squares[1]);
  addRestTime(system, last - 1, lastFactor * length[last] / std::sqrt(squares[last]),
              squares[last]);
  for (size_t i = 1; i < last; ++i)
    addTime(system, i, length[i], squares[i], squares[i + 1]);
  Scatter scatter{system, last};
  for (size_t i = 0; i <= last; ++i) {
    const Exact slant = slope[i];
    const Exact bend = curvature[i];
    const Exact rise = slant * (Exact(squares[i + 1]) - squares[i]);
    scatter.slack<2>(i, weight, 1 - rise - bend * squares[i + 1], {slant, -slant - bend});
    scatter.slack<2>(i, weight, 1 + rise - bend * squares[i], {-slant - bend, slant});
  }
  for (size_t node = 1; node <= last; ++node) {
    const Exact square = squares[node];
    scatter.slack<1>(node, weight, square, {1.0});
    if (std::isfinite(ceiling[node]))
      scatter.slack<1>(node, weight, 1.0 - square / ceiling[node], {-1.0 / ceiling[node]});
    if (!jerkLimited)
      continue;
    const Exact before = Exact(0.5) / length[node - 1];
    const Exact after = Exact(0.5) / length[node];
    const Exact difference =
        after * (squares[node + 1] - square) - before * (square - squares[node - 1]);
    const Exact most = change[node] / std::sqrt(square);
    const Exact fall = -0.5 * most / square;
    scatter.slack<3>(node - 1, weight, most - difference, {-before, fall + before + after, -after});
    scatter.slack<3>(node - 1, weight, most + difference, {before, fall - before - after, after});
  }
}

double BarrierProblem::reach(std::span<const double> squares,
                             std::span<const double> direction) const {
  double most = kInfinite;
  const auto bound = [&](double slack, double change) {
    if (change < 0.0)
      most = std::min(most, -slack / change);
  };
  for (size_t i = 0; i < cells(); ++i) {
    const double rise = slope[i] * (squares[i + 1] - squares[i]);
    const double turn = slope[i] * (direction[i + 1] - direction[i]);
    bound(1.0 - rise - curvature[i] * squares[i + 1], -turn - curvature[i] * direction[i + 1]);
    bound(1.0 + rise - curvature[i] * squares[i], turn - curvature[i] * direction[i]);
  }
  for (size_t node = 1; node < cells(); ++node) {
    const double square = squares[node];
    bound(square, direction[node]);
    if (std::isfinite(ceiling[node]))
      bound(1.0 - square / ceiling[node], -direction[node] / ceiling[node]);
    if (!jerkLimited)
      continue;
    const auto difference = [&](std::span<const double> of) {
      return 0.5 * ((of[node + 1] - of[node]) / length[node] -
                    (of[node] - of[node - 1]) / length[node - 1]);
    };
    // 1 / sqrt(square) is convex: its tangent is on the safe side.
    const double limit = change[node] / std::sqrt(square);
    const double fall = -0.5 * limit / square * direction[node];
    bound(limit - difference(squares), fall - difference(direction));
    bound(limit + difference(squares), fall + difference(direction));
  }
  return most;
}

Excess BarrierProblem::excess(std::span<const double> squares) const {
  Excess worst{-1, -1, -1};
  const auto raise = [](double &most, double use) { most = std::max(most, use - 1.0); };
  for (size_t i = 0; i < cells(); ++i) {
    const double rise = slope[i] * (squares[i + 1] - squares[i]);
    raise(worst.acceleration, rise + curvature[i] * squares[i + 1]);
    raise(worst.acceleration, -rise + curvature[i] * squares[i]);
  }
  for (size_t node = 1; node < cells(); ++node) {
    raise(worst.ceiling, squares[node] / ceiling[node]);
    if (jerkLimited) {
      const double difference = 0.5 * ((squares[node + 1] - squares[node]) / length[node] -
                                       (squares[node] - squares[node - 1]) / length[node - 1]);
      raise(worst.jerk, std::fabs(difference) * std::sqrt(squares[node]) / change[node]);
    }
  }
  return worst;
}

} // namespace stride::oracle
