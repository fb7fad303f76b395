// A coordinate system that something else moves, a belt, a table or another group's tool, and how a
// group follows it: at
// first the group's own copy of the system is at rest; it pursues the system within limits until it
// is where the system is, and goes with it from then on; when it is left, it comes to rest. The
// group's path is in the copy, so that the group never jumps. Of a tool, whose way nobody knows,
// the copy lacks what it would have gone if it had come to rest and back where it was: a known
// polynomial in time, so that velocity and acceleration of the copy are known, too.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_RIDE_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_RIDE_HPP

#include "runtime/numeric/group/place.hpp"
#include "runtime/numeric/profile/planner.hpp"

namespace stride::group {

/// What moves a system.
enum class CarrierKind : uint8_t {
  Belt,  ///< Runs along the X axis of its origin. [u]
  Table, ///< Turns about the Z axis of its origin. [°]
  Tool   ///< Goes as it does: what counts is the time. [s]
};

/// How a tool goes now, about the machine's axes. Trivially copyable.
struct ToolMotion {
  double time;          ///< When that is. [s]
  Vector3 velocity;     ///< Of its origin. [u/s]
  Vector3 acceleration; ///< [u/s^2]
  Vector3 spin;         ///< How fast it turns. [rad/s]
  Vector3 spinChange;   ///< [rad/s^2]
};

/// A system on a carrier. Trivially copyable.
struct MovingSystem {
  Pose origin; ///< Of the carrier, in the machine; of a tool: where it is now.
  Pose object; ///< Of the system on the carrier, where that is at 0.
  CarrierKind kind;
  ToolMotion tool; ///< Tool.
};

/// The motion of a tool that is given as a series in time; its origin is `origin`.
ToolMotion motionOf(const Frame<Series> &tool, double time, Pose &origin) noexcept;

/// Where the system is in the machine when its carrier is at a place [u] or [°], as a series of
/// what `carrier` is one of.
Frame<Series> systemAt(const MovingSystem &system, const Series &carrier) noexcept;

/// Position, velocity and acceleration at one instant, as a series in time after it.
Series inTime(const motion::State &state) noexcept;

/// Trivially copyable.
struct Ride {
  MovingSystem system;
  motion::State follower; ///< Of the group's copy of the system. [u] or [°]
  motion::State carrier;  ///< In the last cycle.
  motion::Dynamics most;  ///< What the follower may; its velocity: beside the carrier's.
  motion::Profile brake;  ///< How it comes to rest; of a tool its duration and end only.
  double braked;          ///< For how long. [s]
  bool follows;           ///< It pursues the carrier, or is where that is.
  bool brakes;            ///< It comes to rest, or has.
  bool inSync;            ///< It is where the carrier is, and moves with it.
  ToolMotion begin;       ///< Tool: how it went when it was begun to be followed, or left.
  double settling;        ///< Tool: for how long after that the copy does not go with it. [s]
};

/// Whether there is a system that is followed, or has been until the group rests.
inline bool isUsed(const Ride &ride) noexcept { return ride.follows || ride.brakes; }

/// Whether nothing moves.
inline bool isStill(const Ride &ride) noexcept {
  return !ride.follows && (!ride.brakes || ride.braked >= ride.brake.duration);
}

/// Begins to follow a system from rest; the group's copy is where the system is now. `settling`:
/// within which it gets to a tool. [s]
void beginRide(Ride &ride, const MovingSystem &system, const motion::State &carrier,
               const motion::Dynamics &most, double settling = 0.0) noexcept;

/// The group's copy of the system comes to rest within what the follower may.
void brakeRide(Ride &ride) noexcept;

/// A tool is left: the group's copy goes on as it does now, with another `begin`. How it comes to
/// rest is to be said by brakeWithin.
void leaveTool(Ride &ride) noexcept;
/// After leaveTool: the copy rests after a time. [s]
void brakeWithin(Ride &ride, double settling) noexcept;

/// One cycle. `carrier` is where it is at the end of the cycle [u] or [°]. [s]
void goOn(Ride &ride, const motion::State &carrier, double cycle) noexcept;

/// The group's copy of the system in the machine when its follower is at a place [u], [°] or, of a
/// tool, at a time [s], as a series of what `follower` is one of.
Frame<Series> copyAt(const Ride &ride, const Series &follower) noexcept;

/// The same now, as a series in time.
inline Frame<Series> copyOf(const Ride &ride) noexcept {
  return copyAt(ride, inTime(ride.follower));
}

/// Where the copy is at rest after braking.
Frame<double> restOf(const Ride &ride) noexcept;

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_RIDE_HPP
