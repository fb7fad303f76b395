#ifndef STRIDE_COMPILER_ASSETS_DXF_CONTOURS_HPP
#define STRIDE_COMPILER_ASSETS_DXF_CONTOURS_HPP
// Pieces that follow each other without a gap.

#include "compiler/assets/dxf/drawing.hpp"

namespace stc::dxf {

struct Contour {
  std::vector<Piece> pieces; ///< Each begins exactly where the one before ends.
  std::string layer;
  bool closed = false;

  [[nodiscard]] Point start() const { return pieces.front().start; }
  [[nodiscard]] Point end() const { return pieces.back().end; }
};

/// Joins chains of one layer whose ends are at most `epsilon` apart [u], turned round where that is
/// needed; where more than two meet, those that go on straightest. In the order in which the chains
/// came.
[[nodiscard]] std::vector<Contour> contoursOf(std::vector<Chain> chains, double epsilon);

[[nodiscard]] Contour reversed(const Contour &contour);
/// A closed contour from another place on: the beginning of a piece, or where half of it is over.
[[nodiscard]] Contour startingAt(const Contour &contour, size_t piece, double part);

/// Of each contour the closed one that it lies in, the smallest of several; -1: in none. Contours
/// that cross each other lie in none or one of both.
[[nodiscard]] std::vector<int32_t> nestingOf(const std::vector<Contour> &contours);
/// Whether a closed contour goes round counterclockwise.
[[nodiscard]] bool isCounterclockwise(const Contour &contour);

/// Places of contours, to see whether lines meet them.
class Outlines {
public:
  explicit Outlines(const std::vector<Contour> &contours);
  /// Whether a line from place to place meets any of the contours; exact to a thousandth of their
  /// radii.
  [[nodiscard]] bool areMet(Point from, Point to) const;

private:
  struct Outline {
    std::vector<Point> places;
    Point least;
    Point most;
  };
  std::vector<Outline> outlines_;
};

} // namespace stc::dxf

#endif // STRIDE_COMPILER_ASSETS_DXF_CONTOURS_HPP
