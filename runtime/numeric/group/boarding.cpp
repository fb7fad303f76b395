// How a group gets to a system that moves, and leaves it.
#include "runtime/numeric/group/carried.hpp"

#include "runtime/numeric/kinematics/orientation.hpp"

namespace stride::group {
namespace {

using exact::fabs;
using exact::larger;
using exact::smaller;

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

/// How fast the tool's point is where the carrier goes by 1. [u]
double speedOf(const PathPlace &place) noexcept {
  return numeric::norm(
      {place.tool.place(0).c[1], place.tool.place(1).c[1], place.tool.place(2).c[1]});
}

/// The arm as it stands.
Arm standingOf(const GroupMotion &group, const Arm &arm) noexcept {
  return {arm.kinematics, arm.joints, arm.more, arm.limits,
          arm.kinematics.configurationOf(group.axes)};
}

/// A place of the path that only the tool leads.
PathPlace placeOf(const GroupMotion &group, const Frame<Series> &tool) noexcept {
  PathPlace place;
  place.byTool = true;
  place.alsoTurns = false;
  place.tool = tool;
  for (int32_t k = kArmAxes; k < kAxes; ++k)
    place.axes[k] = Series(group.axes[k]);
  return place;
}

/// What moves at an instant: amounts of velocity, acceleration and jerk.
struct Rates {
  double velocity, acceleration, jerk;
};

Rates ratesOf(const Series &series) noexcept {
  return {fabs(series.c[1]), 2.0 * fabs(series.c[2]), 6.0 * fabs(series.c[3])};
}

Rates ratesOf(const Vector<Series> &place) noexcept {
  const auto amount = [&place](int n) {
    return numeric::norm({place(0).c[n], place(1).c[n], place(2).c[n]});
  };
  return {amount(1), 2.0 * amount(2), 6.0 * amount(3)};
}

/// How the group gets to a tool, or leaves one, within some time.
class Settling {
public:
  /// `ride` has begun to follow, or has left the tool; `onTool` is the group's tool in the system.
  Settling(const GroupMotion &group, const Arm &arm, const Ride &ride, const Frame<Series> &onTool)
      : group_(group), arm_(standingOf(group, arm)), ride_(ride), onTool_(onTool),
        own_(at(inTool(ride.begin.time))) {}

  /// The shortest time in which axes need no more than half of what they can do, and the tool's
  /// point no more than the path allows, of a few that become longer; the longest one if nothing
  /// helps, since the tool that is followed is too fast. [s]
  [[nodiscard]] double time() const noexcept {
    constexpr double kLonger = 1.2;
    constexpr double kLongest = 3.0; // [s]
    double time = smaller(leastTime(), kLongest);
    while (time < kLongest && !fits(time))
      time *= kLonger;
    return time;
  }

private:
  /// The group's tool, and its axes.
  struct Rating {
    Rates tool;
    Rates axis[kAxes];
    bool reached;
  };

  /// If it went with the tool that is followed. Of one that is left: as it went then.
  [[nodiscard]] Frame<Series> inTool(double time) const noexcept {
    MovingSystem system = ride_.system;
    if (ride_.brakes)
      system.tool = ride_.begin;
    return systemAt(system, growing(time, 1.0)) * onTool_;
  }

  [[nodiscard]] Rating at(const Frame<Series> &tool) const noexcept {
    Rating rating{};
    rating.tool = ratesOf(tool.place);
    Series axes[kAxes];
    rating.reached = axesAt(arm_, placeOf(group_, tool), group_.axes, axes) == Obstacle::None;
    for (int32_t k = 0; k < arm_.joints && rating.reached; ++k)
      rating.axis[k] = ratesOf(axes[k]);
    return rating;
  }

  /// A first idea, from what the polynomials in ride.cpp have at most. [s]
  [[nodiscard]] double leastTime() const noexcept {
    const double v = own_.tool.velocity;
    const double a = own_.tool.acceleration;
    const motion::Dynamics &most = ride_.most;
    const bool turns = numeric::norm(ride_.begin.spin) > 0.0;
    if (!(v > 0.0) && !(a > 0.0) && !turns)
      return 0.0;
    constexpr double kLeast = 0.01; // [s]
    const double byAcceleration = (ride_.brakes ? 1.5 : 3.94) * v / most.acceleration;
    const double byJerk = exact::sqrt((ride_.brakes ? 6.0 : 36.0) * v / most.jerk);
    const double byChange = (ride_.brakes ? 4.0 : 9.0) * a / most.jerk;
    return larger(kLeast, larger(byAcceleration, larger(byJerk, byChange)));
  }

  /// Whether rates are within a part of a limit, or not much more than what the tool has itself.
  static bool isWithin(const Rates &rates, const Rates &most, const Rates &own) noexcept {
    constexpr double kMore = 1.52; // of the polynomial in ride.cpp
    return rates.velocity <= larger(most.velocity, kMore * own.velocity) &&
           rates.acceleration <= larger(most.acceleration, kMore * own.acceleration) &&
           rates.jerk <= larger(most.jerk, kMore * own.jerk);
  }

  [[nodiscard]] bool fits(double time) const noexcept {
    constexpr int32_t kPlaces = 8;
    constexpr double kHalf = 0.5;
    Ride ride = ride_;
    ride.settling = time;
    for (int32_t i = 0; i <= kPlaces; ++i) {
      const double part = i < kPlaces ? static_cast<double>(i) / kPlaces : 1.0 - 1e-9;
      const Rating rating = at(copyAt(ride, growing(ride.begin.time + part * time, 1.0)) * onTool_);
      if (!rating.reached)
        continue;
      const motion::Dynamics &most = ride.most;
      bool good = isWithin(rating.tool, {most.velocity, most.acceleration, most.jerk}, own_.tool);
      for (int32_t k = 0; k < arm_.joints; ++k) {
        const AxisLimits &limits = arm_.limits[k];
        const Rates half{kHalf * limits.velocity, kHalf * limits.acceleration, kHalf * limits.jerk};
        good = good && isWithin(rating.axis[k], half, own_.axis[k]);
      }
      if (!good)
        return false;
    }
    return true;
  }

  const GroupMotion &group_;
  Arm arm_;
  const Ride &ride_;
  Frame<Series> onTool_;
  Rating own_; ///< As it goes when that begins, if it goes with the tool.
};

/// What a follower may to come to rest: axes may have less left here than where it has begun.
void lowerHere(const GroupMotion &group, const Arm &arm, const Frame<Series> &onCarrier,
               Ride &ride) noexcept {
  constexpr int32_t kPlaces = 3;
  const double velocity = ride.follower.velocity;
  const double time =
      fabs(velocity) / ride.most.deceleration + ride.most.deceleration / ride.most.jerk;
  const Arm standing = standingOf(group, arm);
  Series axes[kAxes];
  for (int32_t i = 0; i < kPlaces; ++i) {
    const double position = ride.follower.position + 0.5 * velocity * time * i / (kPlaces - 1);
    const PathPlace place =
        placeOf(group, systemAt(ride.system, growing(position, 1.0)) * onCarrier);
    if (axesAt(standing, place, group.axes, axes) == Obstacle::None)
      lower(ride.most, arm, axes, 0.0);
  }
  ride.most.deceleration = smaller(ride.most.deceleration, ride.most.acceleration);
}

} // namespace

motion::Dynamics boardingDynamics(const GroupMotion &group, const Arm &arm,
                                  const MovingSystem &system, const motion::State &carrier,
                                  const PathLimits &path) noexcept {
  const Frame<double> now = valueOf(systemAt(system, Series(carrier.position)));
  const Frame<Series> onCarrier =
      seriesOf(kinematics::inverted(now) * inMachine(group, poseInPath(group, arm)));
  if (system.kind == CarrierKind::Tool) {
    const double most = smaller(path.acceleration, path.deceleration);
    return {motion::RampType::Parabolic, path.velocity, most, most, path.jerk};
  }
  const Arm standing = standingOf(group, arm);
  PathPlace place = placeOf(group, systemAt(system, growing(carrier.position, 1.0)) * onCarrier);
  const double speed = speedOf(place);
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
  if (system.kind != CarrierKind::Tool)
    return;
  const Frame<Series> onTool = seriesOf(frameOf(group.tool));
  beginRide(group.ride, system, carrier, most, Settling(group, arm, group.ride, onTool).time());
}

void brake(GroupMotion &group, const Arm &arm) noexcept {
  Ride &ride = group.ride;
  if (!ride.follows)
    return;
  const Frame<Series> onCarrier = seriesOf(frameOf(group.tool));
  if (ride.system.kind != CarrierKind::Tool) {
    lowerHere(group, arm, onCarrier, ride);
    brakeRide(ride);
    return;
  }
  leaveTool(ride);
  brakeWithin(ride, Settling(group, arm, ride, onCarrier).time());
}

void alight(GroupMotion &group, const Arm &arm) noexcept {
  Frame<double> tool = frameOf(poseInPath(group, arm));
  if (isStill(group.left))
    group.left = {};
  if (isUsed(group.ride)) {
    brake(group, arm);
    tool = restOf(group.ride) * tool;
    group.left = group.ride;
  }
  group.ride = {};
  group.tool = poseOf(tool);
  if (isStill(group.left))
    group.left = {};
}

} // namespace stride::group
