// What the limits of axes and of the tool's path allow along a part of a group's path: strips for
// the planner of the law. The axes' velocities, accelerations and jerks along the path come from
// series, through the kinematics, so that they are those of the path and not of differences. Free
// of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_LIMITS_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_LIMITS_HPP

#include "runtime/numeric/group/place.hpp"
#include "runtime/numeric/kinematics/kinematics_ref.hpp"
#include "runtime/numeric/path/course.hpp"

namespace stride::group {

/// What an axis can do; all greater than 0, kInfinity: no limit. Trivially copyable.
struct AxisLimits {
  double velocity;     ///< [u/s]
  double acceleration; ///< [u/s^2]
  double jerk;         ///< [u/s^3]
  double low, high;    ///< Where it may be. [u]
};

/// Where an axis is, if rounding by the kinematics has not taken it a little beyond its range: who
/// supervises it knows no slack. What is further beyond stays there. [u]
inline double withoutRounding(const AxisLimits &limits, double axis) noexcept {
  constexpr double kSlack = 1e-9;
  const auto amount = [](double limit) {
    return exact::isfinite(limit) ? exact::fabs(limit) : 0.0;
  };
  const double slack = kSlack * (amount(limits.low) + amount(limits.high));
  const double within = exact::smaller(exact::larger(axis, limits.low), limits.high);
  return axis < limits.low - slack || axis > limits.high + slack ? axis : within;
}

/// What a command allows of the tool's motion along its path; the units are those of the way of its
/// leg. All greater than 0. Trivially copyable.
struct PathLimits {
  double velocity;     ///< [u/s]
  double acceleration; ///< [u/s^2]
  double deceleration; ///< [u/s^2]
  double jerk;         ///< [u/s^3]
};

/// The axes that a group moves, for the time of a call.
struct Arm {
  kinematics::KinematicsRef kinematics;
  int32_t joints;                          ///< Of the kinematics, at most kArmAxes.
  int32_t more;                            ///< Axes that go along, at most kMoreAxes.
  const AxisLimits (&limits)[kAxes];       ///< Of those that it has.
  kinematics::Configuration configuration; ///< Along what the tool leads; where tool axes are
                                           ///< given, that of the placing ones.
};

/// Why there is no motion along a part of the path.
enum class Obstacle : uint8_t {
  None,
  Unreachable, ///< The kinematics reaches nothing there.
  AxisLimit,   ///< An axis would leave its range.
  Singular,    ///< Axes would need an infinite velocity.
  TooFast      ///< An axis cannot go along with the system that is followed.
};

/// Something that is at a place for each way: a leg or a corner.
struct Track {
  const void *track;
  void (*placeAt)(const void *track, const Series &way, PathPlace &place);
};

/// The axes at a place of the path, as series. `reference`: where they are nearby. [u]
Obstacle axesAt(const Arm &arm, const PathPlace &place, const double (&reference)[kAxes],
                Series (&axes)[kAxes]) noexcept;

/// How fast something goes per unit of the way, and its first two derivatives: amounts.
struct Pace {
  double d[3];
};

/// What of the tool's motion its command limits.
inline constexpr int32_t kPaces = 3;

/// A place by its axes' derivatives over the way, d[n][k], n-th of axis k, and how fast the tool
/// is.
struct Sample {
  double way;
  double d[4][kAxes];
  Pace pace[kPaces]; ///< Of the tool's point, of its turn, of the way itself. All 0: it does not
                     ///< count.
};

inline constexpr int32_t kKeptSamples = 5;

/// A part of a track that is being looked at. All zero at first, but for what is asked for.
struct Look {
  double from;               ///< Way along the track. [u]
  double to;                 ///< It ends at most there. [u]
  double least;              ///< It need not be shorter, however the axes' velocities change. [u]
  double reference[kAxes];   ///< Axes at `from`; afterwards at its end. [u]
  int32_t samples;           ///< How many places have been looked at, so far.
  Sample end;                ///< At the end of the part before.
  bool goesOn;               ///< This part begins there.
  int32_t keptCount;         ///< Of places after it that have been looked at in vain,
  Sample kept[kKeptSamples]; ///< the nearest last: parts that follow may need them.
};

/// Puts what limits the motion from look.from on into a strip, but for its end and what is there.
/// `look.to` becomes the way up to which that is true. `path` counts where the tool leads.
Obstacle limitStrip(const Arm &arm, const Track &track, const PathLimits &path, Look &look,
                    path::Strip &strip) noexcept;

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_LIMITS_HPP
