// For the sources of group motions: what moving systems change of a group's path.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_CARRIED_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_CARRIED_HPP

#include "runtime/numeric/group/group_motion.hpp"

namespace stride::group {

/// The system of the path in the machine now, as a series in time.
Frame<Series> pathSystem(const GroupMotion &group) noexcept;

/// A track as the axes go along it: where the system of the path will be when they come there.
class CarriedTrack {
public:
  /// `ahead`: how far along the path it is [u], which is gone over within `path` at most.
  CarriedTrack(const GroupMotion &group, const Track &track, double ahead,
               const PathLimits &path) noexcept;
  CarriedTrack(const CarriedTrack &) = delete;
  CarriedTrack &operator=(const CarriedTrack &) = delete;
  ~CarriedTrack() = default;

  /// It lives as long as this object.
  [[nodiscard]] Track track() const noexcept;

  /// Takes away from limits of axes what they need to go along with the system at a way of the
  /// track. What is left of each is at least a tenth.
  void yield(const Arm &arm, double way, const double (&reference)[kAxes],
             AxisLimits (&limits)[kAxes]) const noexcept;

  /// How far limits may go that yield: until what moves the system has settled. [u]
  [[nodiscard]] double reach() const noexcept;

private:
  /// How far the ways grow that the axes depend on.
  struct Growth {
    double path, ride, left;
  };
  /// The axes at a way of the track, as a series of what these ways grow with.
  bool axesAlong(const Arm &arm, double way, const double (&reference)[kAxes], const Growth &growth,
                 Series (&axes)[kAxes]) const noexcept;

  /// Takes away what the axes need for one of both systems.
  void yieldTo(const Ride &ride, const Arm &arm, double way, const double (&reference)[kAxes],
               AxisLimits (&limits)[kAxes]) const noexcept;

  const GroupMotion &group_;
  Track track_;
  double time_;         ///< Until the path comes there, at least. [s]
  double carrier_;      ///< Where it will be. [u] or [°]
  Frame<double> frame_; ///< The path's system then.
  PathLimits path_;
};

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_CARRIED_HPP
