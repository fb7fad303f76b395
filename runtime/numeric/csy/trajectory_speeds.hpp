// How fast the master may go on each piece of a path.
// Source: TSX CSY 85 configuration manual 35010452, chapter 4.2. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_SPEEDS_HPP
#define STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_SPEEDS_HPP

#include "runtime/numeric/csy/trajectory.hpp"

namespace stride::csy {

/// What slave axes can do; 0: not limited.
struct SlaveLimits {
  Vector3 velocity;     ///< [mm/s]
  Vector3 acceleration; ///< [mm/s^2]
};

/// For each piece. [mm/s]
struct Speeds {
  double allowed[kMostPieces];  ///< by the slaves; infinite where nothing limits it
  double computed[kMostPieces]; ///< the lower one of that and ParF0 (0: that)
};

/// The greatest value of |d^k/du^k| of a coordinate (0 to 2) of a shape, 0 <= u <= 1; k = 1 or 2.
double greatestDerivative(const path::Shape &shape, uint32_t coordinate, uint32_t k) noexcept;

/// The speed at which no slave goes over its velocity, nor over its acceleration while the master's
/// speed is steady. The angle of a tool is not counted: it leaps where pieces meet.
void computeSpeeds(const TrajectoryTable &table, const Trajectory &trajectory,
                   const SlaveLimits &limits, Speeds &speeds) noexcept;

/// The same for one piece only, so that the work can be spread.
void computeSpeed(const TrajectoryTable &table, const Trajectory &trajectory,
                  const SlaveLimits &limits, uint32_t piece, Speeds &speeds) noexcept;

/// The speed that is allowed everywhere (GetMinimumConstantSpeed). [mm/s]
double constantSpeed(const Trajectory &trajectory, const Speeds &speeds) noexcept;

/// Which table GetTabResultF returns (PARAM_TRF_3).
enum class ResultTable : uint8_t { MasterPositions, AllowedSpeeds, ComputedSpeeds };

/// Two values for each point of the path's table: for the end of its straight part, and of its
/// blend. At the first point both are 0. Room for 2 * trajectory.points.
void fillResults(const Trajectory &trajectory, const Speeds &speeds, ResultTable which,
                 double *values) noexcept;

} // namespace stride::csy

#endif // STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_SPEEDS_HPP
