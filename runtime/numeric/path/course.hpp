// What limits the motion along a path, place by place: strips of the way, each with its limits. The
// planner of the law knows nothing else of a path; neither shapes nor who made them.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_COURSE_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_COURSE_HPP

#include "runtime/numeric/exact_math.hpp"

#include <stdint.h>

namespace stride::path {

/// A part of the way whose limits are the same everywhere. All are positive; kInfinity: none.
struct Strip {
  double end;          ///< Way at its end. [u]
  double feed;         ///< Velocity that the program wants; scaled by the override. [u/s]
  double endFeed;      ///< At its end; scaled as well. [u/s]
  double ceiling;      ///< Of the square of the velocity, by axes and curves. [u^2/s^2]
  double endCeiling;   ///< Likewise, at its end only: a kink. [u^2/s^2]
  double acceleration; ///< Tangential. [u/s^2]
  double deceleration; ///< Tangential. [u/s^2]
  double along;        ///< Axes allow along * |a| + across * v^2 <= 1; 0: no limit. [s^2/u]
  double across;       ///< See `along`; times `ceiling` at most 0.95. [s^2/u^2]
  float jerk;          ///< Tangential, if that is less than the law's; 0: no limit. [u/s^3]
  uint32_t spare : 30; ///< See spareJerk.
  bool stop : 1;       ///< The motion rests at its end.
  bool gate : 1;       ///< It goes on from there only when it is told to.
};
static_assert(sizeof(Strip) == 80); // there are many of them

/// The jerk up to which a stop may ask for more than `jerk`. [u/s^3]
inline double spareJerk(const Strip &strip) noexcept {
  return static_cast<double>(__builtin_bit_cast(float, static_cast<uint32_t>(strip.spare) << 1U));
}

/// Keeps what 30 bits hold of it, with the last bit of a float cut off. `jerk` is not negative.
inline void setSpareJerk(Strip &strip, double jerk) noexcept {
  const auto bits = __builtin_bit_cast(uint32_t, static_cast<float>(jerk));
  strip.spare = (bits >> 1U) & 0x3FFFFFFFU;
}

inline constexpr int32_t kStrips = 256;

/// The strips from where the motion is to the end of what is known, a ring. Trivially copyable.
struct Course {
  Strip strip[kStrips];
  int64_t first; ///< Number of the one where the motion is; they are counted from 0 on.
  int64_t next;  ///< The number that the next one gets.
  double begin;  ///< Way at the start of the first. [u]
};

/// The strip with a number, first <= number < next.
inline Strip &stripAt(Course &course, int64_t number) noexcept {
  return course.strip[static_cast<uint64_t>(number) % kStrips];
}
inline const Strip &stripAt(const Course &course, int64_t number) noexcept {
  return course.strip[static_cast<uint64_t>(number) % kStrips];
}

/// Way at the start of a strip. [u]
inline double beginOf(const Course &course, int64_t number) noexcept {
  return number == course.first ? course.begin : stripAt(course, number - 1).end;
}

/// Way at the end of all of it. [u]
inline double endOf(const Course &course) noexcept { return beginOf(course, course.next); }

/// What a stop asks for besides what strips say.
struct Braking {
  double deceleration;     ///< It may brake with that at least. [u/s^2]
  double jerk;             ///< Likewise, as far as there is to spare. [u/s^3]
  double accelerationPart; ///< Of what the axes allow along the path, up to 1; 0: all of it.
  double jerkPart;         ///< Likewise.
};

/// The greatest deceleration in a strip, without regard to bends. [u/s^2]
inline double decelerationIn(const Strip &strip, const Braking &braking) noexcept {
  const double most = exact::larger(strip.deceleration, braking.deceleration);
  const double part = braking.accelerationPart;
  return part > 0.0 && part < 1.0 ? exact::smaller(most, part / strip.along) : most;
}

/// The greatest tangential jerk in a strip for a law with `most`. [u/s^3]
inline double jerkIn(const Strip &strip, double most, const Braking &braking = {}) noexcept {
  if (!(strip.jerk > 0.0F))
    return most;
  const auto own = static_cast<double>(strip.jerk);
  const double more = exact::smaller(braking.jerk, spareJerk(strip));
  double jerk = exact::larger(own, more);
  if (braking.jerkPart > 0.0 && braking.jerkPart < 1.0)
    jerk = exact::smaller(jerk, braking.jerkPart * exact::larger(own, spareJerk(strip)));
  return exact::smaller(jerk, most);
}

/// The greatest square of the velocity in a strip, and at its end. `override` is 1 for what the
/// program wants. [u^2/s^2]
inline double squareIn(const Strip &strip, double override) noexcept {
  const double feed = strip.feed * override;
  return exact::smaller(feed * feed, strip.ceiling);
}
inline double squareAtEnd(const Strip &strip, double override) noexcept {
  if (strip.stop)
    return 0.0;
  const double feed = strip.endFeed * override;
  return exact::smaller(exact::smaller(feed * feed, strip.endCeiling), squareIn(strip, override));
}

/// Puts a strip after the last one; those that would be gone over within `time` [s] become one with
/// the worst limits of both. `strip.end` must be greater than endOf(course). False: it is full.
bool append(Course &course, const Strip &strip, double time) noexcept;

/// The number of the strip that holds a way: the first one that ends after it, or the last one.
int64_t stripOf(const Course &course, double way) noexcept;

/// The strip at whose end a motion is that rests just before it by rounding; null: none. [u] in
const Strip *endedByRounding(const Course &course, double way) noexcept;

/// Forgets the strips that end at or before a way, which must not be greater than endOf. [u]
void forgetBefore(Course &course, double way) noexcept;

/// How many strips can be appended at least.
inline int64_t roomIn(const Course &course) noexcept {
  return kStrips - (course.next - course.first);
}

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_COURSE_HPP
