#include "runtime/numeric/group/carried.hpp"

#include "runtime/numeric/kinematics/orientation.hpp"

namespace stride::group {
namespace {

using exact::fabs;
using exact::larger;
using exact::smaller;

/// The system that was left, as it comes to rest: what is still to go until then, when it has come
/// to a place.
Frame<Series> stillToGo(const Ride &left, const Series &carrier) noexcept {
  return systemAt(left.system, carrier) * seriesOf(kinematics::inverted(restOf(left)));
}

/// The path's system when its carrier, and that of the one that was left, are at places.
Frame<Series> systemWith(const GroupMotion &group, const Series &carrier,
                         const Series &left) noexcept {
  Frame<Series> system = isUsed(group.ride)
                             ? systemAt(group.ride.system, carrier)
                             : seriesOf(kinematics::unturned(Vector<double>(0.0, 0.0, 0.0)));
  if (isUsed(group.left))
    system = stillToGo(group.left, left) * system;
  return system;
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

/// Lowers what a follower may to half of what the axes have left where the carrier is at a place.
void lower(motion::Dynamics &most, const Arm &arm, const Series (&axes)[kAxes],
           double carrierVelocity) noexcept {
  constexpr double kHalf = 0.5;
  constexpr double kLeast = 0.05; // of what the axes can do, beside a carrier that is too fast
  for (int32_t k = 0; k < arm.joints; ++k) {
    const double first = fabs(axes[k].c[1]);
    const AxisLimits &limits = arm.limits[k];
    if (!(first > 0.0))
      continue;
    const double free =
        larger(limits.velocity - first * fabs(carrierVelocity), kLeast * limits.velocity);
    most.velocity = smaller(most.velocity, kHalf * free / first);
    most.acceleration = smaller(most.acceleration, kHalf * limits.acceleration / first);
    most.jerk = smaller(most.jerk, kHalf * limits.jerk / first);
  }
}

/// Of the velocity of the path, what a tool that is followed is taken to have at least.
constexpr double kSlowest = 0.05;

/// How fast the tool's point is where the carrier goes by 1. [u]
double speedOf(const PathPlace &place) noexcept {
  return numeric::norm(
      {place.tool.place(0).c[1], place.tool.place(1).c[1], place.tool.place(2).c[1]});
}

} // namespace

Frame<Series> pathSystem(const GroupMotion &group) noexcept {
  return systemWith(group, inTime(group.ride.follower), inTime(group.left.follower));
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
  const Share share = shareOf(group_, ride, path_, time_);
  for (int32_t k = 0; k < arm.joints; ++k) {
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

motion::Dynamics boardingDynamics(const GroupMotion &group, const Arm &arm,
                                  const MovingSystem &system, const motion::State &carrier,
                                  const PathLimits &path) noexcept {
  const Frame<double> now = valueOf(systemAt(system, Series(carrier.position)));
  const Frame<Series> onCarrier =
      seriesOf(kinematics::inverted(now) * inMachine(group, poseInPath(group, arm)));
  const Arm standing{arm.kinematics, arm.joints, arm.more, arm.limits,
                     arm.kinematics.configurationOf(group.axes)};
  PathPlace place;
  place.byTool = true;
  place.tool = systemAt(system, growing(carrier.position, 1.0)) * onCarrier;
  for (int32_t k = kArmAxes; k < kAxes; ++k)
    place.axes[k] = Series(group.axes[k]);
  // A tool that hardly moves has been reached at once.
  const double slowest = system.kind == CarrierKind::Tool ? kSlowest * path.velocity : 0.0;
  const double speed = larger(speedOf(place), slowest);
  const double perPath = speed > 0.0 ? 1.0 / speed : exact::kInfinity;
  const double acceleration = smaller(path.acceleration, path.deceleration) * perPath;
  motion::Dynamics most{motion::RampType::Parabolic, path.velocity * perPath, acceleration,
                        acceleration, path.jerk * perPath};
  Series axes[kAxes];
  // Here and where the carrier will be about when it has been reached.
  constexpr int32_t kPlaces = 6;
  double time = 0.0;
  for (int32_t i = 0; i <= kPlaces; ++i) {
    const double position = carrier.position + carrier.velocity * time * i / kPlaces;
    place.tool = systemAt(system, growing(position, 1.0)) * onCarrier;
    if (axesAt(standing, place, group.axes, axes) == Obstacle::None)
      lower(most, arm, axes, carrier.velocity);
    if (i == 0)
      time = 3.0 * (fabs(carrier.velocity) / most.acceleration + most.acceleration / most.jerk);
  }
  most.deceleration = most.acceleration;
  return most;
}

void board(GroupMotion &group, const Arm &arm, const MovingSystem &system,
           const motion::State &carrier, const motion::Dynamics &most) noexcept {
  alight(group, arm);
  beginRide(group.ride, system, carrier, most);
  group.tool = poseOf(kinematics::inverted(restOf(group.ride)) * frameOf(group.tool));
}

void alight(GroupMotion &group, const Arm &arm) noexcept {
  Frame<double> tool = frameOf(poseInPath(group, arm));
  if (isStill(group.left))
    group.left = {};
  if (isUsed(group.ride)) {
    brakeRide(group.ride);
    tool = restOf(group.ride) * tool;
    group.left = group.ride;
  }
  group.ride = {};
  group.tool = poseOf(tool);
  if (isStill(group.left))
    group.left = {};
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
  const auto toolWhen = [&](double carrier) {
    return plain((valueOf(systemAt(ride.system, Series(carrier))) * frameOf(group.tool)).place);
  };
  return numeric::norm(toolWhen(ride.carrier.position) - toolWhen(ride.follower.position));
}

Frame<double> inMachine(const GroupMotion &group, const Pose &pose) noexcept {
  return valueOf(pathSystem(group)) * frameOf(pose);
}

} // namespace stride::group
