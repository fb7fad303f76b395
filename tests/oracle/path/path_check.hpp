// Whether a motion that is given by samples keeps its limits and its path: by finite differences
// and distances, with nothing of the code that made it.
//
// A divided difference is a mean of the derivative over the samples that it is made of: it never
// exceeds a limit that the derivative keeps, but for rounding, which is estimated and taken off.
// Differences over few samples see short peaks, those over many are more exact; both are taken.
#ifndef STRIDE_TESTS_ORACLE_PATH_PATH_CHECK_HPP
#define STRIDE_TESTS_ORACLE_PATH_PATH_CHECK_HPP

#include "tests/oracle/path/path_chain.hpp"

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace stride::oracle {

inline constexpr double kNone = std::numeric_limits<double>::infinity();

struct Sample {
  double time; ///< After the sample before, or equal: then both must be in one place. [s]
  double way;  ///< Along the path; NaN: unknown, then nothing along the path is measured. [u]
  Place place;
};

/// kNone: no limit.
struct MotionLimits {
  double velocity = kNone;     ///< Along the path. [u/s]
  double acceleration = kNone; ///< Along the path, where the velocity rises. [u/s^2]
  double deceleration = kNone; ///< Along the path, where it falls. [u/s^2]
  double jerk = kNone;         ///< Along the path. [u/s^3]
  Place axisVelocity;          ///< [u/s]
  Place axisAcceleration;      ///< [u/s^2]
  double tolerance = kNone;    ///< Of the distance to the reference, both ways. [u]

  MotionLimits();
};

/// The worst of something, as a part of its limit: at most 1 if that is kept.
struct Worst {
  double use = 0;   ///< |value| / limit, without what may be rounding.
  double value = 0; ///< In its unit.
  double time = 0;  ///< Where. [s]
  size_t sample = 0;
  size_t axis = 0;   ///< If it is one of an axis.
  size_t stride = 0; ///< How many samples apart those of the difference are.
};

struct MotionReport {
  Worst velocity, acceleration, deceleration, jerk; ///< Along the path.
  Worst pathVelocity; ///< Of the places, over the axes of the reference, by the same limit.
  Worst axisVelocity, axisAcceleration;
  Worst distance; ///< Of samples from the reference.
  /// Of the ends and middles of the reference's elements from the motion, which is taken as
  /// straight between samples.
  Worst missed;
  Worst backwards;      ///< Way that is gone back; value in [u], use infinite if there is any.
  Worst jump;           ///< Between samples of one time; value in [u], use infinite if > 1e-9 u.
  bool exactEnd = true; ///< The last sample is the end of the reference, bit for bit.

  /// All uses are at most 1 + part, and the end is exact.
  [[nodiscard]] bool within(double part = 1e-6) const;
  /// What is worst of each, a line for each that has a limit.
  [[nodiscard]] std::string text() const;
};

struct CheckOptions {
  std::vector<size_t> strides = {1, 2, 4, 8, 16}; ///< In samples.
  double rounding = 4; ///< How exact samples are, in units of the last place.
  double reach = 0;    ///< How far along the reference the next foot is looked for, at least;
                       ///< it is 16 tolerances anyway. [u]
  double jump = 1e-9;  ///< What of a step at one time is none. [u]
};

/// Measures a motion; with a reference its distance and its end, too.
MotionReport checkMotion(std::span<const Sample> samples, const MotionLimits &limits,
                         const PathChain *reference = nullptr, const CheckOptions &options = {});

} // namespace stride::oracle

#endif // STRIDE_TESTS_ORACLE_PATH_PATH_CHECK_HPP
