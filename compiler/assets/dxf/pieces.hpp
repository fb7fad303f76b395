#ifndef STRIDE_COMPILER_ASSETS_DXF_PIECES_HPP
#define STRIDE_COMPILER_ASSETS_DXF_PIECES_HPP
// What drawings and programs both can say: lines, arcs of circles and ellipses, parabolas, in the
// plane of X and Y. Lengths in units of the program [u], angles in radians.

#include <cstdint>
#include <vector>

namespace stc::dxf {

struct Point {
  double x = 0;
  double y = 0;
};
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(Point a, double f) { return {a.x * f, a.y * f}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
/// Positive where b is on the left of a.
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] double norm(Point a);
/// Of length 1; 0 of nothing.
[[nodiscard]] Point unit(Point a);

/// x = x.x * place.x + y.x * place.y + shift.x, and y alike.
struct Affine {
  Point x{1, 0}; ///< What (1, 0) becomes, without the shift.
  Point y{0, 1}; ///< What (0, 1) becomes.
  Point shift{};

  [[nodiscard]] Point turned(Point way) const { return x * way.x + y * way.y; }
  [[nodiscard]] Point operator()(Point place) const { return turned(place) + shift; }
  /// First `inner`, then this one.
  [[nodiscard]] Affine after(const Affine &inner) const {
    return {turned(inner.x), turned(inner.y), (*this)(inner.shift)};
  }
};

/// A piece of a contour, from start to end.
struct Piece {
  enum class Kind : uint8_t {
    Line,
    Arc,      ///< centre + first cos(a) + second sin(a), a from `from` to from + sweep.
    Parabola, ///< The tangents of both ends meet in `centre`.
  };
  Kind kind = Kind::Line;
  Point start;
  Point end;
  Point centre;
  /// Half axes at right angles, `second` on the left of `first` and not longer; as long: a circle.
  Point first;
  Point second;
  double from = 0;
  double sweep = 0; ///< Counterclockwise; -2 pi to 2 pi.
};

[[nodiscard]] Piece lineOf(Point start, Point end);
/// The arc centre + first cos(a) + second sin(a) for any two half axes that are not parallel.
[[nodiscard]] Piece arcOf(Point centre, Point first, Point second, double from, double sweep);
[[nodiscard]] Piece parabolaOf(Point start, Point control, Point end);

[[nodiscard]] bool isFull(const Piece &piece);
[[nodiscard]] bool isCircular(const Piece &piece);

/// The place at a part of the parameter, 0 to 1.
[[nodiscard]] Point placeAt(const Piece &piece, double part);
/// The direction of the motion there, of length 1.
[[nodiscard]] Point directionAt(const Piece &piece, double part);
/// [u], exact to some parts in a thousand.
[[nodiscard]] double lengthOf(const Piece &piece);
/// The other way round.
[[nodiscard]] Piece reversed(const Piece &piece);
/// Between two parts of the parameter, of a line or an arc.
[[nodiscard]] Piece between(const Piece &piece, double from, double to);

/// Appends places of a piece without its end, so close that lines between them turn by a few
/// degrees.
void appendPlaces(const Piece &piece, std::vector<Point> &places);

} // namespace stc::dxf

#endif // STRIDE_COMPILER_ASSETS_DXF_PIECES_HPP
