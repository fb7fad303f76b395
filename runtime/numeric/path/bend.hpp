// How a coordinate goes along with a way by a cubic that has given slopes at its ends. Free of the
// C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_BEND_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_BEND_HPP

namespace stride::path {

/// Part of what a coordinate goes, and derivatives over the way.
struct Progress {
  double f, d1, d2, d3;
};

/// How the cubic whose slopes at the ends are steeper by `a` and `b` than a straight line differs
/// from that, at the part u of a way.
inline Progress bentBy(double a, double b, double u, double length) noexcept {
  const double v = 1.0 - u;
  const double r = 1.0 / length;
  return {length * u * v * (a * v - b * u), a * v * (1.0 - 3.0 * u) - b * u * (2.0 - 3.0 * u),
          (a * (6.0 * u - 4.0) + b * (6.0 * u - 2.0)) * r, 6.0 * (a + b) * r * r};
}

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_BEND_HPP
