// Vectors in space. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_VECTOR3_HPP
#define STRIDE_RUNTIME_NUMERIC_VECTOR3_HPP

#include "runtime/numeric/exact_math.hpp"

namespace stride::numeric {

/// A place or a direction; its unit is what the user says.
struct Vector3 {
  double x, y, z;
};

inline constexpr Vector3 kZero{0.0, 0.0, 0.0};

inline constexpr Vector3 operator+(const Vector3 &a, const Vector3 &b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline constexpr Vector3 operator-(const Vector3 &a, const Vector3 &b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline constexpr Vector3 operator-(const Vector3 &a) noexcept { return {-a.x, -a.y, -a.z}; }
inline constexpr Vector3 operator*(const Vector3 &a, double factor) noexcept {
  return {a.x * factor, a.y * factor, a.z * factor};
}
inline constexpr double dot(const Vector3 &a, const Vector3 &b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline constexpr Vector3 cross(const Vector3 &a, const Vector3 &b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Neither overflows nor vanishes where the result would not.
inline double norm(const Vector3 &a) noexcept {
  const double most =
      exact::larger(exact::fabs(a.x), exact::larger(exact::fabs(a.y), exact::fabs(a.z)));
  // Squares are far from the ends of what numbers can hold: the same without scaling, bit for bit.
  if (most > 1e-100 && most < 1e100)
    return exact::sqrt(dot(a, a));
  if (!exact::isPositive(most))
    return most;
  int exponent = 0;
  (void)exact::frexp(most, &exponent);
  const double scale = exact::ldexp(1.0, -exponent);
  const Vector3 b = a * scale;
  return exact::sqrt(dot(b, b)) * exact::ldexp(1.0, exponent);
}

} // namespace stride::numeric

#endif // STRIDE_RUNTIME_NUMERIC_VECTOR3_HPP
