// The quickest motion along a path that limits of velocity, acceleration and jerk allow, found
// offline by an interior point method: what the planner of paths is measured by. It knows nothing
// of the planner: only cells, which say what limits the motion along a part of the path.
//
// Along the path, b is the square of the velocity. It is piecewise linear over the way, between
// nodes at the cells' ends; the acceleration of a cell is half of its slope. The method minimises
// the sum of the cells' times with a logarithmic barrier for each limit and Newton's method; all
// that it visits keeps the limits, strictly.
#ifndef STRIDE_TESTS_ORACLE_PATH_TIME_OPTIMUM_HPP
#define STRIDE_TESTS_ORACLE_PATH_TIME_OPTIMUM_HPP

#include <cstdint>
#include <span>
#include <vector>

namespace stride::oracle {

/// A part of a path, and what limits the motion there:
/// tangential * |acceleration| + curvature * velocity^2 <= 1 and velocity^2 <= ceiling.
struct Cell {
  double length;     ///< > 0 [u]
  double tangential; ///< What one unit of acceleration along the path takes of the limit. [s^2/u]
  double curvature;  ///< What one unit of velocity^2 takes of it. [s^2/u^2]
  double ceiling;    ///< Of velocity^2; infinite: none; 0: a stop at both ends. [u^2/s^2]
};

/// How far a plan exceeds the limits, as a part of each: 0.01 is one percent, below 0 nothing.
struct Excess {
  double ceiling;
  double acceleration;
  double jerk;
};

struct Optimum {
  bool solved;                 ///< false: too few cells between two stops, or no convergence.
  double time;                 ///< [s]
  std::vector<double> squares; ///< Of the velocity at the nodes, one more than cells. [u^2/s^2]
  int32_t steps;               ///< Of Newton's method, of the worst part between two stops.
};

struct OptimumOptions {
  double gap = 1e-4; ///< The time is at most that much, as a part, above the discrete optimum.
  int32_t mostSteps = 2000;
};

/// The quickest motion from rest to rest. A ceiling of 0 is a stop in between; the parts between
/// stops are independent of each other and need three cells at least. An infinite jerk is none.
///
/// The limit of the jerk at a node is v * (change of acceleration) / (half of both cells) <= jerk.
/// Close to a stop, where v is no smooth function of the way, it is corrected by what constant jerk
/// out of rest makes of it on the same cells, so that the law of constant jerk just keeps it.
/// Where cells side by side differ in length by more than a thousand times, numbers may not suffice
/// to solve it.
Optimum timeOptimum(std::span<const Cell> cells, double jerk, const OptimumOptions &options = {});

/// The same without a limit of the jerk, in two passes: exact for these cells.
Optimum accelerationOptimum(std::span<const Cell> cells);

/// How far squares of velocities at the nodes of cells exceed the limits.
Excess excessOf(std::span<const Cell> cells, double jerk, std::span<const double> squares);

/// The time that squares of velocities at the nodes of cells stand for. [s]
double timeOf(std::span<const Cell> cells, double jerk, std::span<const double> squares);

} // namespace stride::oracle

#endif // STRIDE_TESTS_ORACLE_PATH_TIME_OPTIMUM_HPP
