#include "runtime/numeric/group/carried.hpp"

#include "runtime/numeric/kinematics/orientation.hpp"

namespace stride::group {
namespace {

using exact::fabs;
using exact::larger;
using exact::smaller;

/// The system that was left, as it comes to rest: what is still to go until then, when it has come
/// to a place.
Frame<Series> stillToGo(const Ride &left, const Series &follower) noexcept {
  return copyAt(left, follower) * seriesOf(kinematics::inverted(restOf(left)));
}

/// The path's system where the one that is followed is somewhere, and the one that was left at a
/// place.
Frame<Series> systemWith(const GroupMotion &group, const Frame<Series> &followed,
                         const Series &left) noexcept {
  return isUsed(group.left) ? stillToGo(group.left, left) * followed : followed;
}

/// The system that is followed when its carrier is at a place, if it has been reached until then.
Frame<Series> followedAt(const Ride &ride, const Series &carrier) noexcept {
  if (!isUsed(ride))
    return seriesOf(kinematics::unturned(Vector<double>(0.0, 0.0, 0.0)));
  return ride.follows ? systemAt(ride.system, carrier) : copyAt(ride, carrier);
}

/// The path's system when its carrier, and that of the one that was left, are at places.
Frame<Series> systemWith(const GroupMotion &group, const Series &carrier,
                         const Series &left) noexcept {
  return systemWith(group, followedAt(group.ride, carrier), left);
}

/// Where the carrier will be, as far as that can be known: of a tool no more than where it is now.
double carrierAfter(const Ride &ride, double time) noexcept {
  if (ride.follows && ride.system.kind == CarrierKind::Tool)
    return ride.carrier.position;
  return ride.follows ? ride.follower.position + ride.carrier.velocity * time
                      : ride.follower.position;
}

/// What a carrier and the path do at most.
struct Share {
  double velocity, acceleration, jerk; ///< Of the carrier, as it is followed.
  double along;                        ///< Velocity along the path. [u/s]
  double change;                       ///< Acceleration along the path. [u/s^2]
};

/// How long the follower may still need until it is where the carrier is, or rests. [s]
double timeToSettle(const Ride &ride) noexcept {
  constexpr double kMargin = 2.0;
  if (!ride.follows)
    return ride.brake.duration - ride.braked;
  if (ride.inSync)
    return 0.0;
  if (ride.system.kind == CarrierKind::Tool)
    return larger(ride.begin.time + ride.settling - ride.follower.position, 0.0);
  const double change = fabs(ride.carrier.velocity - ride.follower.velocity);
  const double gap = fabs(ride.carrier.position - ride.follower.position);
  const motion::Dynamics &most = ride.most;
  return kMargin * (gap / most.velocity + 2.0 * ((change + most.velocity) / most.acceleration +
                                                 most.acceleration / most.jerk));
}

/// How fast the path can be gone over within a time from now on, at most. [u/s]
double velocityWithin(const GroupMotion &group, const PathLimits &path, double time) noexcept {
  if (!isAtRest(group))
    return path.velocity;
  return smaller(path.velocity, path.acceleration * time);
}

/// Until the carrier is reached, and to come to rest, the follower may need all that it has.
Share shareOf(const GroupMotion &group, const Ride &ride, const PathLimits &path,
              double time) noexcept {
  const double change = larger(path.acceleration, path.deceleration);
  const double velocity = larger(fabs(ride.follower.velocity), fabs(ride.carrier.velocity));
  const double settled = timeToSettle(ride);
  if (time >= settled)
    return {velocity, fabs(ride.carrier.acceleration), 0.0, path.velocity, change};
  return {ride.follows ? velocity + ride.most.velocity : fabs(ride.follower.velocity),
          ride.most.acceleration, ride.most.jerk, velocityWithin(group, path, settled), change};
}

/// Until a tool is reached, and while it is left, the copy may turn and move a little faster than
/// that does. See leaveHalf for how its own velocity changes.
Share shareOfSettling(const PathLimits &path) noexcept {
  constexpr double kMost = 1.52; // of the polynomial in ride.cpp
  return {kMost, 0.0, 0.0, path.velocity, larger(path.acceleration, path.deceleration)};
}

/// The other half is what settlingTime may take.
void leaveHalf(const AxisLimits &whole, AxisLimits &limits) noexcept {
  constexpr double kHalf = 0.5;
  limits.velocity = smaller(limits.velocity, kHalf * whole.velocity);
  limits.acceleration = smaller(limits.acceleration, kHalf * whole.acceleration);
  limits.jerk = smaller(limits.jerk, kHalf * whole.jerk);
}

/// Derivatives of an axis by the carrier's way (u) and the path's (s).
struct Mixed {
  double u, uu, uuu, su, ssu, suu;
};

/// A system that turns turns on until the path is gone over, by an angle that is not known yet.
constexpr double kTurningShare = 0.95;

/// What is left of an axis's limits.
void leave(const Mixed &mixed, const Share &share, AxisLimits &limit) noexcept {
  const double w = share.velocity;
  const double v = share.along;
  const double velocity = mixed.u * w;
  const double acceleration =
      mixed.u * share.acceleration + mixed.uu * w * w + 2.0 * mixed.su * v * w;
  const double jerk = mixed.u * share.jerk + 3.0 * mixed.uu * w * share.acceleration +
                      mixed.uuu * w * w * w + 3.0 * (mixed.ssu * v + mixed.suu * w) * v * w +
                      3.0 * mixed.su * (share.change * w + v * share.acceleration);
  constexpr double kLeast = 0.1;
  limit.velocity = larger(limit.velocity - velocity, kLeast * limit.velocity);
  limit.acceleration = larger(limit.acceleration - acceleration, kLeast * limit.acceleration);
  limit.jerk = larger(limit.jerk - jerk, kLeast * limit.jerk);
}

} // namespace

Frame<Series> pathSystem(const GroupMotion &group) noexcept {
  const Ride &ride = group.ride;
  return systemWith(group, isUsed(ride) ? copyOf(ride) : followedAt(ride, Series(0.0)),
                    inTime(group.left.follower));
}

CarriedTrack::CarriedTrack(const GroupMotion &group, const Track &track, double ahead,
                           const PathLimits &path) noexcept
    : group_(group), track_(track), time_(larger(ahead, 0.0) / path.velocity),
      carrier_(carrierAfter(group.ride, time_)),
      frame_(valueOf(systemWith(group, Series(carrier_), Series(group.left.follower.position)))),
      path_(path) {}

Track CarriedTrack::track() const noexcept {
  if (!isCarried(group_))
    return track_;
  return {this, [](const void *track, const Series &way, PathPlace &place) {
            const CarriedTrack &carried = *static_cast<const CarriedTrack *>(track);
            carried.track_.placeAt(carried.track_.track, way, place);
            if (place.byTool)
              place.tool = seriesOf(carried.frame_) * place.tool;
          }};
}

bool CarriedTrack::axesAlong(const Arm &arm, double way, const double (&reference)[kAxes],
                             const Growth &growth, Series (&axes)[kAxes]) const noexcept {
  PathPlace place;
  track_.placeAt(track_.track, growing(way, growth.path), place);
  if (!place.byTool)
    return false;
  place.tool = systemWith(group_, growing(carrier_, growth.ride),
                          growing(group_.left.follower.position, growth.left)) *
               place.tool;
  return axesAt(arm, place, reference, axes) == Obstacle::None;
}

void CarriedTrack::yieldTo(const Ride &ride, const Arm &arm, double way,
                           const double (&reference)[kAxes],
                           AxisLimits (&limits)[kAxes]) const noexcept {
  const double byRide = &ride == &group_.ride ? 1.0 : 0.0;
  const double byLeft = 1.0 - byRide;
  Series path[kAxes];
  Series carried[kAxes];
  Series forwards[kAxes];
  Series backwards[kAxes];
  if (!axesAlong(arm, way, reference, {1.0, 0.0, 0.0}, path) ||
      !axesAlong(arm, way, reference, {0.0, byRide, byLeft}, carried) ||
      !axesAlong(arm, way, reference, {1.0, byRide, byLeft}, forwards) ||
      !axesAlong(arm, way, reference, {1.0, -byRide, -byLeft}, backwards))
    return;
  const bool settles = ride.system.kind == CarrierKind::Tool && time_ < timeToSettle(ride);
  const Share share = settles ? shareOfSettling(path_) : shareOf(group_, ride, path_, time_);
  for (int32_t k = 0; k < arm.joints; ++k) {
    const AxisLimits whole = limits[k];
    const Series &f = forwards[k];
    const Series &b = backwards[k];
    const Series &u = carried[k];
    if (ride.system.kind != CarrierKind::Belt) {
      limits[k].velocity *= kTurningShare;
      limits[k].acceleration *= kTurningShare;
      limits[k].jerk *= kTurningShare;
    }
    leave({fabs(u.c[1]), 2.0 * fabs(u.c[2]), 6.0 * fabs(u.c[3]), 0.5 * fabs(f.c[2] - b.c[2]),
           fabs(f.c[3] - b.c[3] - 2.0 * u.c[3]), fabs(f.c[3] + b.c[3] - 2.0 * path[k].c[3])},
          share, limits[k]);
    if (settles)
      leaveHalf(whole, limits[k]);
  }
}

void CarriedTrack::yield(const Arm &arm, double way, const double (&reference)[kAxes],
                         AxisLimits (&limits)[kAxes]) const noexcept {
  if (!isStill(group_.ride))
    yieldTo(group_.ride, arm, way, reference, limits);
  if (!isStill(group_.left) && time_ <= timeToSettle(group_.left))
    yieldTo(group_.left, arm, way, reference, limits);
}

double CarriedTrack::reach() const noexcept {
  double time = 0.0;
  const Ride *const rides[] = {&group_.ride, &group_.left};
  for (const Ride *const ride : rides)
    if (!isStill(*ride))
      time = larger(time, timeToSettle(*ride) - time_);
  return time > 0.0 ? velocityWithin(group_, path_, time) * time : exact::kInfinity;
}

Pose poseInPath(const GroupMotion &group, const Arm &arm) noexcept {
  if (isCarried(group))
    return group.tool;
  Frame<double> tool;
  (void)arm.kinematics.forward(group.axes, tool);
  return poseOf(tool);
}

double lagOf(const GroupMotion &group) noexcept {
  const Ride &ride = group.ride;
  if (!ride.follows || ride.inSync)
    return 0.0;
  const auto toolIn = [&group](const Frame<Series> &system) {
    return plain((valueOf(system) * frameOf(group.tool)).place);
  };
  return numeric::norm(toolIn(systemAt(ride.system, Series(ride.carrier.position))) -
                       toolIn(copyOf(ride)));
}

Frame<double> inMachine(const GroupMotion &group, const Pose &pose) noexcept {
  return valueOf(pathSystem(group)) * frameOf(pose);
}

} // namespace stride::group
