// Moves with their corners blended by polynomials of degree 5, by numeric integration: the geometry
// of a planner's path, made anew from the formulas, for optima that owe nothing to the product.
#ifndef STRIDE_TESTS_ORACLE_PATH_BLENDED_PATH_HPP
#define STRIDE_TESTS_ORACLE_PATH_BLENDED_PATH_HPP

#include "tests/oracle/path/curve_cells.hpp"
#include "tests/oracle/path/random_program.hpp"

#include <span>
#include <variant>
#include <vector>

namespace stride::oracle {

/// A part of a line or an arc.
struct TrimmedElement {
  ChainElement element;
  double from, to; ///< Ways on the element. [u]
};

/// A polynomial of degree 5 in each of X, Y, Z, over 0 to 1, with its arc length integrated.
struct QuinticElement {
  std::array<Point, 6> coefficients;
  std::vector<double> ways; ///< At even parameters, the first and the last included. [u]
};

/// A run of pieces between two stops.
class BlendedPath {
public:
  void add(const TrimmedElement &piece, double feed);
  void add(const QuinticElement &piece, double feed);

  [[nodiscard]] double length() const { return starts_.empty() ? 0.0 : starts_.back(); }
  [[nodiscard]] size_t pieces() const { return pieces_.size(); }
  /// Place at a way, and its derivatives there. [u] in
  [[nodiscard]] Point placeAt(double way) const;
  [[nodiscard]] CurvePoint pointAt(double way) const;
  /// The path as a curve; it must not outlive this object.
  [[nodiscard]] Curve curve() const;

private:
  using Piece = std::variant<TrimmedElement, QuinticElement>;
  [[nodiscard]] size_t pieceAt(double way) const;

  std::vector<Piece> pieces_;
  std::vector<double> feeds_;
  std::vector<double> starts_; ///< Ways where pieces start, and the end of the last one.
};

/// Blends leave the programmed corner by at most `tolerance` and take at most half of a move; none
/// is larger than its velocity needs, where limits say so. Corners of more than 170 degrees are
/// stops, and so are all others if the tolerance is 0; moves that go straight on need no blend.
std::vector<BlendedPath> blendedPaths(std::span<const ProgramMove> moves, double tolerance,
                                      const CurveLimits &limits);

/// The polynomial with given places, first and second derivatives at both ends.
QuinticElement quinticBetween(const std::array<Point, 3> &start, const std::array<Point, 3> &end);

} // namespace stride::oracle

#endif // STRIDE_TESTS_ORACLE_PATH_BLENDED_PATH_HPP
