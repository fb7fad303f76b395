// A move of the master along a path whose speed changes with the pieces (MoveImmedInterpo, action
// 905, modulated): on each piece the lower one of the speed asked for and the one allowed, within
// the master's own acceleration and deceleration. A ramp with a shape (ACCEL_TYPE) takes the time
// and the way of the ramp with the same steady acceleration. One that leads over several pieces is
// one ramp, unless it would be too fast on one of them: then each piece has its own.
// Source: TSX CSY 85 configuration manual 35010452, chapter 4.2. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_CSY_MODULATED_MOVE_HPP
#define STRIDE_RUNTIME_NUMERIC_CSY_MODULATED_MOVE_HPP

#include "runtime/numeric/csy/trajectory.hpp"

namespace stride::csy {

/// Limits of the master.
struct MasterLimits {
  double velocity;     ///< 0: not limited [mm/s]
  double acceleration; ///< above 0 [mm/s^2]
  double deceleration; ///< above 0 [mm/s^2]
  double shape =
      1.0; ///< the greatest acceleration of a ramp by its mean: 1 (a rectangle) to 2 (a triangle)
};

/// A move from rest to rest. Its members are its state: the functions below are for them.
struct ModulatedMove {
  /// A part of the way with one limit; with shaped ramps also one that leads over several pieces.
  struct Leg {
    double way;   ///< [mm]
    double limit; ///< [mm/s]
    double enter; ///< speed at its begin [mm/s]
  };
  Leg leg[kMostPieces];
  uint32_t legs;
  uint32_t at;      ///< the leg
  double since;     ///< time in it [s]
  double base;      ///< way over the legs before [mm]
  double from;      ///< position of the master where it began [mm]
  double to;        ///< where it ends [mm]
  double direction; ///< 1 or -1
  MasterLimits limits;
  double position; ///< of the master, after the last step [mm]
  double velocity; ///< [mm/s]
};

/// The master's motion.
struct MasterState {
  double position; ///< [mm]
  double velocity; ///< [mm/s]
  bool done;
};

/// Prepares a move between two positions on the path. `speed` of each piece [mm/s]: those above the
/// master's are cut. False if the move cannot be made: a position outside the path, a speed or a
/// limit that is not above 0.
bool beginMove(const Trajectory &trajectory, const double *speed, const MasterLimits &limits,
               double from, double to, ModulatedMove &move) noexcept;

/// Goes on by a time. [s] Ends at `to` to the last digit.
MasterState advance(ModulatedMove &move, double time) noexcept;

/// Brakes by a time instead, with a deceleration above 0. [s], [mm/s^2] Never goes past `to`. Done:
/// it has come to rest; the move is over then, and going on takes another one.
MasterState brake(ModulatedMove &move, double deceleration, double time) noexcept;

} // namespace stride::csy

#endif // STRIDE_RUNTIME_NUMERIC_CSY_MODULATED_MOVE_HPP
