#include "runtime/numeric/group/ride.hpp"

#include "runtime/numeric/profile/pursuit.hpp"

namespace stride::group {
namespace {

Matrix<double> crossOf(const Vector3 &v) noexcept {
  Matrix<double> matrix;
  matrix << 0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0;
  return matrix;
}

/// What crossOf makes the antisymmetric part of.
Vector3 axialOf(const Matrix<double> &matrix) noexcept {
  return {0.5 * (matrix(2, 1) - matrix(1, 2)), 0.5 * (matrix(0, 2) - matrix(2, 0)),
          0.5 * (matrix(1, 0) - matrix(0, 1))};
}

/// Where a tool is some time after it was at its origin, or before. It turns by the rotation whose
/// vector is half of what it turns by: the same up to the second derivative, and without an angle
/// that it cannot be at.
Frame<Series> toolAfter(const MovingSystem &system, const Series &time) noexcept {
  const ToolMotion &tool = system.tool;
  const Frame<Series> origin = seriesOf(frameOf(system.origin));
  const Series half = Series(0.5) * time * time;
  const auto along = [&](const Vector3 &first, const Vector3 &second) {
    return Vector<Series>(Series(first.x) * time + Series(second.x) * half,
                          Series(first.y) * time + Series(second.y) * half,
                          Series(first.z) * time + Series(second.z) * half);
  };
  Frame<Series> moved;
  moved.place = origin.place + along(tool.velocity, tool.acceleration);
  const Vector<Series> g = along(tool.spin, tool.spinChange) * Series(0.5);
  Matrix<Series> cross;
  cross << Series(0.0), -g(2), g(1), g(2), Series(0.0), -g(0), -g(1), g(0), Series(0.0);
  const Series share = Series(2.0) / (Series(1.0) + g(0) * g(0) + g(1) * g(1) + g(2) * g(2));
  const Matrix<Series> turned = cross * cross + cross;
  moved.turn = (Matrix<Series>::Identity() + turned * share) * origin.turn;
  return moved;
}

} // namespace

ToolMotion motionOf(const Frame<Series> &tool, double time, Pose &origin) noexcept {
  const Frame<double> now = valueOf(tool);
  origin = poseOf(now);
  Vector3 velocity;
  Vector3 acceleration;
  Matrix<double> first;
  Matrix<double> second;
  double v[3];
  double a[3];
  for (int row = 0; row < 3; ++row) {
    v[row] = tool.place(row).c[1];
    a[row] = 2.0 * tool.place(row).c[2];
    for (int column = 0; column < 3; ++column) {
      first(row, column) = tool.turn(row, column).c[1];
      second(row, column) = 2.0 * tool.turn(row, column).c[2];
    }
  }
  velocity = {v[0], v[1], v[2]};
  acceleration = {a[0], a[1], a[2]};
  const Vector3 spin = axialOf(first * now.turn.transpose());
  const Matrix<double> cross = crossOf(spin);
  return {time, velocity, acceleration, spin,
          axialOf(second * now.turn.transpose() - cross * cross)};
}

Frame<Series> systemAt(const MovingSystem &system, const Series &carrier) noexcept {
  constexpr double kRadians = 0.017453292519943295;
  const Frame<double> origin = frameOf(system.origin);
  const Frame<double> object = frameOf(system.object);
  if (system.kind == CarrierKind::Tool)
    return toolAfter(system, carrier - Series(system.tool.time)) * seriesOf(object);
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
