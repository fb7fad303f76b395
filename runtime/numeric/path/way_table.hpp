// The parameter of a shape at a way, where it is not proportional to that: found in little time by
// a table that is made once. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_WAY_TABLE_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_WAY_TABLE_HPP

#include "runtime/numeric/path/shape.hpp"

namespace stride::path {

/// Trivially copyable.
struct WayTable {
  double way[17];  ///< At parameters of 0, 1/16 ... 1. [u]
  uint32_t uneven; ///< Bits of the parts for which a rule of five points is not exact.
};

WayTable tableOf(const Shape &shape) noexcept;

/// The parameter at a way from the start, 0 <= way <= length. [u] in
double parameterAt(const Shape &shape, const WayTable &table, double way) noexcept;

/// The way at a parameter, 0 <= u <= 1. [u]
double wayAt(const Shape &shape, const WayTable &table, double u) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_WAY_TABLE_HPP
