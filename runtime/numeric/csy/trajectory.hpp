// A path of the module TSX CSY 85: its pieces over the position of the master, and the cams made of
// it. The master's position is the way along the path, where a blend by a polynomial counts as long
// as the two lengths that it takes from the lines.
// Source: TSX CSY 85 configuration manual 35010452, chapter 4. What it shows in figures only
// follows from its printed numbers or is a judgement: blends are Hermite polynomials whose tangents
// are KF/100 of both lengths; type 10 takes its length from both lines; its arc above half a turn
// is the rest of the same circle; a blend next to an arc or at the end is 9514. Free of the C++
// standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_HPP
#define STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_HPP

#include "runtime/numeric/csy/trajectory_table.hpp"
#include "runtime/numeric/path/shape.hpp"

namespace stride::csy {

/// Points of a cam that a path can use, of 5000.
inline constexpr uint32_t kMostCamPoints = 4996;
/// Points that a cam has beyond those of the path.
inline constexpr uint32_t kSpareCamPoints = 5;
inline constexpr uint32_t kMostPieces = 2 * kMostPoints;

/// A line, an arc or a blend.
struct Piece {
  path::Shape shape; ///< [mm]; z stays 0 where the third axis turns a tool
  double start;      ///< position of the master [mm]
  double length;     ///< way of the master [mm]
  double angle;      ///< of the tool [deg]
  uint32_t point;    ///< of the table, from 1
  uint32_t samples;  ///< points of the cams on it, its end included
};

struct Trajectory {
  uint32_t pieces;
  uint32_t points;                ///< of the table
  uint32_t camPoints;             ///< with the first one
  bool hasTool;                   ///< the third axis turns a tool
  double length;                  ///< way of the master over all of it [mm]
  double endOfLine[kMostPoints];  ///< of the master, for each point of the table [mm]
  double endOfBlend[kMostPoints]; ///< the same as endOfLine where there is no blend [mm]
  Piece piece[kMostPieces];
};

/// Makes the pieces. Blends are shortened as chapter 4.1 says: to what the lines before and after
/// have, then to the greatest ratio of both lengths (2 for type 1, 1/0.66 for type 2).
Problem computeTrajectory(const TrajectoryTable &table, Trajectory &trajectory) noexcept;

/// The piece at a position of the master; where two meet, the first of them.
const Piece &pieceAt(const Trajectory &trajectory, double master) noexcept;

/// Where the axes are. Before the start and after the end: there. [mm] in
Vector3 positionAt(const Trajectory &trajectory, double master) noexcept;

/// A point of the cams.
struct CamPoint {
  double master; ///< [mm]
  Vector3 slave; ///< [mm]; z: [deg] of a tool
};

/// Where the filling of cams is: in a piece, or among the points of the way back.
struct CamCursor {
  uint32_t piece;
  uint32_t sample;
  uint32_t next; ///< number of the next point, from 0
};

/// Whether the path ends where it begins.
bool isClosed(const Trajectory &trajectory) noexcept;

/// How many points the cams get: those of the path, and, since a cam always loops, as many more as
/// are spare to bring the slaves back to the begin of a path that is not closed. The way back is a
/// line; the master goes as far as the slaves.
uint32_t loopPoints(const Trajectory &trajectory) noexcept;

/// The next one of them. To be called loopPoints times, with a cursor of zeros at first.
CamPoint nextCamPoint(const Trajectory &trajectory, CamCursor &cursor) noexcept;

/// Points of the cams, without the way back: `master` and `slaves` have room for
/// trajectory.camPoints of them.
void fillCams(const Trajectory &trajectory, double *master, Vector3 *slaves) noexcept;

} // namespace stride::csy

#endif // STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_HPP
