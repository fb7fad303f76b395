// What a path object looks like in space: a curve over a parameter u from 0 to 1, and over its own
// arc length. Lines and arcs (with a climb: helices) have their arc length in closed form; ellipses
// and polynomials get theirs by integration, once, when the path is prepared.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_SHAPE_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_SHAPE_HPP

#include "runtime/numeric/vector3.hpp"

#include <stdint.h>

namespace stride::path {

using numeric::Vector3;

enum class ShapeKind : uint8_t {
  Line,
  Arc,        ///< Of a circle; with a climb, of a helix.
  Ellipse,    ///< An arc of one.
  Polynomial, ///< Of degree up to 5.
};

/// A curve in space. Trivially copyable; made by the functions below. What its members are depends
/// on the kind:
struct Shape {
  /// Line: start, way. Arc and Ellipse: centre of the start's plane, two vectors from there (Arc:
  /// at right angles and of one length, the first to where the angle is 0), climb over the whole
  /// arc. Polynomial: coefficients of u^0 to u^5.
  Vector3 v[6];
  double angle;  ///< Arc, Ellipse: at the start. [rad]
  double sweep;  ///< Arc, Ellipse: from start to end, negative from the second vector to the
                 ///< first. [rad]
  double length; ///< Arc length of all of it. [u]
  ShapeKind kind;
};

/// A place and the derivatives there, over the parameter or over the arc length.
struct Derivatives {
  Vector3 p;  ///< Place. [u]
  Vector3 d1; ///< First derivative: over the arc length, the tangent.
  Vector3 d2; ///< Second: the vector of curvature. [1/u]
  Vector3 d3; ///< Third. [1/u^2]
};

Shape lineShape(const Vector3 &start, const Vector3 &end) noexcept;

/// From the angle `angle` over `sweep` around `centre`, where `radial` leads to the angle 0 and
/// `lateral`, at a right angle and of the same length, to a quarter turn. `climb` is the way of the
/// end out of the plane of the start; 0 for a circle.
Shape arcShape(const Vector3 &centre, const Vector3 &radial, const Vector3 &lateral, double angle,
               double sweep, const Vector3 &climb) noexcept;

/// centre + first * cos(phi) + second * sin(phi), phi from `angle` over `sweep`. The vectors may be
/// of any length and stand at any angle but 0 to each other.
Shape ellipseShape(const Vector3 &centre, const Vector3 &first, const Vector3 &second, double angle,
                   double sweep, const Vector3 &climb) noexcept;

/// The sum of coefficients[k] * u^k.
Shape polynomialShape(const Vector3 (&coefficients)[6]) noexcept;

/// The polynomial of degree 5 between two places, with the derivatives over u that both ends say.
Shape quinticShape(const Derivatives &begin, const Derivatives &end) noexcept;

/// Leaves a line or an arc from u on, and its length. FALSE for other shapes, which stay.
bool cutStart(Shape &shape, double u) noexcept;

/// Place and derivatives over u, 0 <= u <= 1.
Derivatives overParameter(const Shape &shape, double u) noexcept;

/// The same over the arc length, there. The curve must not stand still there (d1 = 0).
Derivatives overLength(const Derivatives &overParameter) noexcept;

/// How the arc length grows with the parameter. [u]
double speedAt(const Shape &shape, double u) noexcept;

/// Arc length between two parameters by Gauss and Legendre's rule with five points. [u]
double quickLength(const Shape &shape, double from, double to) noexcept;

/// Arc length between two parameters, to about 1e-13 of the whole.
double lengthBetween(const Shape &shape, double from, double to) noexcept;

/// The parameter at a way from the start, 0 <= way <= length. [u] in
double parameterAt(const Shape &shape, double way) noexcept;

/// The parameter between two others at a way from the first of them; `first` is where the search
/// begins. [u] in
double parameterBetween(const Shape &shape, double from, double to, double way,
                        double first) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_SHAPE_HPP
