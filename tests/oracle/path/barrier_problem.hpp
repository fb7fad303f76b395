// The optimisation problem of time_optimum.hpp between two stops: its limits as slacks, its barrier
// function with gradient and a positive definite matrix for Newton's method. Private to the oracle.
#ifndef STRIDE_TESTS_ORACLE_PATH_BARRIER_PROBLEM_HPP
#define STRIDE_TESTS_ORACLE_PATH_BARRIER_PROBLEM_HPP

#include "tests/oracle/path/time_optimum.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace stride::oracle {

/// What equations are made of: long and short cells side by side need more than a double.
using Exact = long double;

/// A symmetric positive definite system of equations with five diagonals.
struct BandedSystem {
  std::vector<Exact> diagonal, first, second; ///< first[i]: row i + 1, column i.
  std::vector<Exact> rightSide;

  explicit BandedSystem(size_t size);
  void clear();
  /// Solves it in place of the right side, by L D L^T. false: it is not positive definite.
  bool solve();
};

/// Cells between two stops. Vectors by node have one more element than those by cell; the first and
/// the last node are at rest.
struct BarrierProblem {
  std::vector<double> length;     ///< By cell.
  std::vector<double> slope;      ///< By cell: tangential / (2 length).
  std::vector<double> curvature;  ///< By cell.
  std::vector<double> ceiling;    ///< By node, or infinite.
  std::vector<double> change;     ///< By node: jerk * half of both cells, corrected near rest.
  double firstFactor, lastFactor; ///< Time of the first and last cell, in length / velocity.
  bool jerkLimited;

  BarrierProblem(std::span<const Cell> cells, double jerk);

  [[nodiscard]] size_t cells() const { return length.size(); }
  /// How many limits there are.
  [[nodiscard]] double limits() const;
  [[nodiscard]] double time(std::span<const double> squares) const;
  /// The greatest squares with limited acceleration, in two passes.
  [[nodiscard]] std::vector<double> accelerationPasses() const;
  /// time + weight * (- sum of logarithms of the slacks); infinite where a limit is not kept.
  [[nodiscard]] double barrier(std::span<const double> squares, double weight) const;
  /// Newton's equations for it: the right side is minus the gradient. What the limits of the jerk
  /// take off the second derivatives is left out, so that the matrix is positive definite.
  void assemble(std::span<const double> squares, double weight, BandedSystem &system) const;
  /// How far one can go along a direction without leaving the limits, at least.
  [[nodiscard]] double reach(std::span<const double> squares,
                             std::span<const double> direction) const;
  [[nodiscard]] Excess excess(std::span<const double> squares) const;
};

} // namespace stride::oracle

#endif // STRIDE_TESTS_ORACLE_PATH_BARRIER_PROBLEM_HPP
