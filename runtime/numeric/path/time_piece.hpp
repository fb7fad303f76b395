// Pieces of the law by which a path is gone over: where the motion is at a time, and when it is at
// a place, both in closed form. The law of a path is one piece after the other; position, velocity
// and acceleration of each are computed from its start, never summed up from cycle to cycle.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_TIME_PIECE_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_TIME_PIECE_HPP

#include <stdint.h>

namespace stride::path {

/// A motion along a path at one instant.
struct WayState {
  double way;          ///< Along the path. [u]
  double velocity;     ///< [u/s]
  double acceleration; ///< Tangential. [u/s^2]
  double jerk;         ///< Tangential. [u/s^3]
};

enum class PieceLaw : uint8_t {
  LinearInWay,  ///< The acceleration changes with the way: a = a0 + gradient * x.
  FromRest,     ///< Constant jerk out of rest, with no acceleration at first.
  ToRest,       ///< Constant jerk into rest, with no acceleration at last.
  ConstantJerk, ///< From any state.
  SineSquared,  ///< The velocity changes as sin^2 does over the time.
};

/// Motion over a part of a path, always forwards. Made by the functions below.
struct TimePiece {
  double start;        ///< Way at its start. [u]
  double length;       ///< > 0 [u]
  double velocity;     ///< At its start, >= 0. [u/s]
  double acceleration; ///< At its start; SineSquared: in the mean. [u/s^2]
  double gradient;     ///< LinearInWay: of the acceleration over the way [1/s^2]; SineSquared: how
                       ///< much the velocity changes [u/s]; else the jerk, > 0 but for
                       ///< ConstantJerk [u/s^3]
  double duration;     ///< [s]
  PieceLaw law;
};

/// A piece whose acceleration is linear in the way, from `acceleration` at its start on. The square
/// of the velocity, v^2 + 2 a x + gradient x^2, must be positive between its ends; at the ends
/// themselves it may be 0.
TimePiece linearPiece(double start, double length, double velocity, double acceleration,
                      double gradient) noexcept;

/// The way out of rest, and into it, with constant `jerk` > 0: the only pieces on which velocity
/// and acceleration vanish together. (With an acceleration that is linear in the way it would take
/// for ever.)
TimePiece pieceFromRest(double start, double length, double jerk) noexcept;
TimePiece pieceToRest(double start, double length, double jerk) noexcept;

/// The piece with constant `jerk` that lasts `duration`. The velocity must not become negative in
/// it. [s] in
TimePiece constantJerkPiece(double start, double velocity, double acceleration, double jerk,
                            double duration) noexcept;

/// The piece in which the velocity changes in the same time and over the same way as with constant
/// `acceleration` != 0, but with none at both ends; in between it is pi / 2 times as much.
TimePiece sineSquaredPiece(double start, double length, double velocity,
                           double acceleration) noexcept;

/// The time between rest and a velocity, without acceleration at both. [s]
double rampTime(double velocity, double acceleration, double jerk) noexcept;

/// Where the motion is `t` after the start of the piece, 0 <= t <= duration. [s]
WayState stateAt(const TimePiece &piece, double t) noexcept;

/// The velocity at a place of the piece. [u] in, [u/s] out
double velocityAt(const TimePiece &piece, double way) noexcept;

/// When the motion is at a place of the piece, start <= way <= start + length: after its start.
/// [u] in, [s] out
double timeAt(const TimePiece &piece, double way) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_TIME_PIECE_HPP
