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

/// A turn whose vector of rotation is twice `g`, or nearly so: the same up to the second derivative
/// where g is 0, and without an angle that it cannot be at.
Matrix<Series> turnedBy(const Vector<Series> &g) noexcept {
  Matrix<Series> cross;
  cross << Series(0.0), -g(2), g(1), g(2), Series(0.0), -g(0), -g(1), g(0), Series(0.0);
  const Series share = Series(2.0) / (Series(1.0) + g(0) * g(0) + g(1) * g(1) + g(2) * g(2));
  const Matrix<Series> turned = cross * cross + cross;
  return Matrix<Series>::Identity() + turned * share;
}

/// What a velocity and an acceleration make of ways.
struct Ways {
  Series byVelocity;     ///< [s]
  Series byAcceleration; ///< [s^2]
};

Vector<Series> along(const Ways &ways, const Vector3 &velocity, const Vector3 &change) noexcept {
  const auto sum = [&ways](double v, double a) {
    return Series(v) * ways.byVelocity + Series(a) * ways.byAcceleration;
  };
  return {sum(velocity.x, change.x), sum(velocity.y, change.y), sum(velocity.z, change.z)};
}

/// Moves a frame as a tool does that goes on by such ways, or back by them.
Frame<Series> movedBy(const Ways &ways, const ToolMotion &tool, double side,
                      const Frame<Series> &frame) noexcept {
  const Series half(0.5 * side);
  Frame<Series> moved;
  moved.place = frame.place + along(ways, tool.velocity, tool.acceleration) * Series(side);
  moved.turn = turnedBy(along(ways, tool.spin, tool.spinChange) * half) * frame.turn;
  return moved;
}

/// Where a tool is some time after it was at its origin, or before.
Frame<Series> toolAfter(const MovingSystem &system, const Series &time) noexcept {
  return movedBy({time, Series(0.5) * time * time}, system.tool, 1.0,
                 seriesOf(frameOf(system.origin)));
}

/// A polynomial of a part of a time, by its coefficients from the first power on.
template <int kPowers>
Series polynomial(const Series &part, const double (&coefficients)[kPowers]) noexcept {
  Series sum(0.0);
  for (int i = kPowers - 1; i >= 0; --i)
    sum = (sum + Series(coefficients[i])) * part;
  return sum;
}

/// What has begun with a velocity and an acceleration comes back to where it began, and rests
/// there.
Ways waysThereAndBack(const Series &time, double duration) noexcept {
  const Series part = time * Series(1.0 / duration);
  return {polynomial(part, {1.0, 0.0, -6.0, 8.0, -3.0}) * Series(duration),
          polynomial(part, {0.0, 0.5, -1.5, 1.5, -0.5}) * Series(duration * duration)};
}

/// The same comes to rest, with a velocity that is a cubic.
Ways waysToRest(const Series &time, double duration) noexcept {
  const Series part = time * Series(1.0 / duration);
  return {polynomial(part, {1.0, 0.0, -1.0, 0.5}) * Series(duration),
          polynomial(part, {0.0, 0.5, -2.0 / 3.0, 0.25}) * Series(duration * duration)};
}

/// The group's copy of a tool.
Frame<Series> copyOfTool(const Ride &ride, const Series &time) noexcept {
  const ToolMotion &begin = ride.begin;
  const Series since = time - Series(begin.time);
  if (ride.brakes) {
    Frame<Series> origin = seriesOf(frameOf(ride.system.origin));
    if (!(ride.settling > 0.0))
      return origin;
    const bool rests = since.c[0] >= ride.settling;
    return movedBy(waysToRest(rests ? Series(ride.settling) : since, ride.settling), begin, 1.0,
                   origin);
  }
  Frame<Series> tool = toolAfter(ride.system, time - Series(ride.system.tool.time));
  if (since.c[0] >= ride.settling)
    return tool;
  return movedBy(waysThereAndBack(since, ride.settling), begin, -1.0, tool);
}

bool isTool(const Ride &ride) noexcept { return ride.system.kind == CarrierKind::Tool; }

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

Frame<Series> copyAt(const Ride &ride, const Series &follower) noexcept {
  if (!isTool(ride))
    return systemAt(ride.system, follower);
  return copyOfTool(ride, follower) * seriesOf(frameOf(ride.system.object));
}

void beginRide(Ride &ride, const MovingSystem &system, const motion::State &carrier,
               const motion::Dynamics &most, double settling) noexcept {
  ride = {};
  ride.system = system;
  ride.follower = {carrier.position, 0.0, 0.0};
  ride.carrier = carrier;
  ride.most = most;
  ride.follows = true;
  if (!isTool(ride))
    return;
  ride.follower = carrier;
  ride.begin = system.tool;
  ride.settling = settling;
  ride.inSync = !(settling > 0.0);
}

void leaveTool(Ride &ride) noexcept {
  Pose origin;
  ride.begin = motionOf(copyOfTool(ride, inTime(ride.follower)), ride.follower.position, origin);
  ride.system.origin = origin;
  ride.follows = false;
  ride.brakes = true;
  ride.inSync = false;
}

void brakeWithin(Ride &ride, double settling) noexcept {
  ride.settling = settling;
  ride.brake = {};
  ride.brake.duration = settling;
  ride.brake.end = {ride.begin.time + settling, 0.0, 0.0};
  ride.braked = 0.0;
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

namespace {

/// A tool that is followed, or has been.
void goOnWithTool(Ride &ride, const motion::State &carrier, double cycle) noexcept {
  constexpr double kRounding = 1e-9; // of a cycle
  if (ride.follows) {
    ride.follower = ride.carrier = carrier;
    ride.inSync = carrier.position - ride.begin.time >= ride.settling - kRounding * cycle;
    if (ride.inSync)
      ride.settling = 0.0;
    return;
  }
  ride.braked = exact::smaller(ride.braked + cycle, ride.brake.duration);
  ride.follower = ride.braked < ride.brake.duration
                      ? motion::State{ride.begin.time + ride.braked, 1.0, 0.0}
                      : ride.brake.end;
}

} // namespace

void goOn(Ride &ride, const motion::State &carrier, double cycle) noexcept {
  if (!isUsed(ride))
    return;
  if (isTool(ride)) {
    goOnWithTool(ride, carrier, cycle);
  } else if (ride.follows) {
    motion::Dynamics most = ride.most;
    most.velocity +=
        exact::larger(exact::fabs(carrier.velocity), exact::fabs(ride.carrier.velocity));
    const motion::Pursued next =
        motion::pursue({ride.follower, ride.carrier, carrier, cycle, most});
    ride.follower = next.axis;
    ride.inSync = next.reached;
    ride.carrier = carrier;
  } else {
    ride.braked = exact::smaller(ride.braked + cycle, ride.brake.duration);
    ride.follower = ride.braked < ride.brake.duration ? ride.brake.at(ride.braked) : ride.brake.end;
  }
}

Frame<double> restOf(const Ride &ride) noexcept {
  const double rest = ride.brakes ? ride.brake.end.position : ride.follower.position;
  return valueOf(copyAt(ride, Series(rest)));
}

} // namespace stride::group
