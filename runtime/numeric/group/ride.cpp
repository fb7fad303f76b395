#include "runtime/numeric/group/ride.hpp"

#include "runtime/numeric/profile/pursuit.hpp"

namespace stride::group {

Frame<Series> systemAt(const MovingSystem &system, const Series &carrier) noexcept {
  constexpr double kRadians = 0.017453292519943295;
  const Frame<double> origin = frameOf(system.origin);
  const Frame<double> object = frameOf(system.object);
  Frame<Series> moved;
  if (system.kind == CarrierKind::Belt) {
    moved = kinematics::unturned(Vector<Series>(carrier, Series(0.0), Series(0.0)));
  } else {
    moved = kinematics::unturned(Vector<Series>(Series(0.0), Series(0.0), Series(0.0)));
    moved.turn = kinematics::aboutZ(carrier * Series(kRadians));
  }
  return seriesOf(origin) * moved * seriesOf(object);
}

Series inTime(const motion::State &state) noexcept {
  Series series(state.position);
  series.c[1] = state.velocity;
  series.c[2] = 0.5 * state.acceleration;
  return series;
}

void beginRide(Ride &ride, const MovingSystem &system, const motion::State &carrier,
               const motion::Dynamics &most) noexcept {
  ride = {};
  ride.system = system;
  ride.follower = {carrier.position, 0.0, 0.0};
  ride.carrier = carrier;
  ride.most = most;
  ride.follows = true;
}

void brakeRide(Ride &ride) noexcept {
  if (!ride.follows)
    return;
  motion::Dynamics most = ride.most;
  most.velocity += exact::fabs(ride.carrier.velocity);
  if (motion::planStop(ride.brake, ride.follower, most) != motion::PlanError::None) {
    ride.brake = {};
    ride.brake.end = {ride.follower.position, 0.0, 0.0};
  }
  ride.braked = 0.0;
  ride.follows = false;
  ride.brakes = true;
  ride.inSync = false;
}

void goOn(Ride &ride, const motion::State &carrier, double cycle) noexcept {
  if (ride.follows) {
    motion::Dynamics most = ride.most;
    most.velocity +=
        exact::larger(exact::fabs(carrier.velocity), exact::fabs(ride.carrier.velocity));
    const motion::Pursued next =
        motion::pursue({ride.follower, ride.carrier, carrier, cycle, most});
    ride.follower = next.axis;
    ride.inSync = next.reached;
    ride.carrier = carrier;
  } else if (ride.brakes) {
    ride.braked = exact::smaller(ride.braked + cycle, ride.brake.duration);
    ride.follower = ride.braked < ride.brake.duration ? ride.brake.at(ride.braked) : ride.brake.end;
  }
}

Frame<Series> copyOf(const Ride &ride) noexcept {
  return systemAt(ride.system, inTime(ride.follower));
}

Frame<double> restOf(const Ride &ride) noexcept {
  const double rest = ride.brakes ? ride.brake.end.position : ride.follower.position;
  return valueOf(systemAt(ride.system, Series(rest)));
}

} // namespace stride::group
