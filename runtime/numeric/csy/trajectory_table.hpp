// The table of words that describes a path of two or three axes for TrjCompute (action 26900).
// Source: TSX CSY 85 configuration manual 35010452, chapter 4.1. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_TABLE_HPP
#define STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_TABLE_HPP

#include "runtime/numeric/vector3.hpp"

#include <stdint.h>

namespace stride::csy {

using numeric::Vector3;

/// Reference points of a path: with firmware 1.2 and later, and before.
inline constexpr uint32_t kMostPoints = 200;
inline constexpr uint32_t kMostPointsOfOldFirmware = 60;

/// Codes of the interpolation, as the manual's chapter of error codes lists them; those of cams,
/// groups and axes are for the module.
enum class PathError : int16_t {
  None = 0,
  BlendLength = 9501,      ///< A length of a blend is not above 0.
  TooManyCamPoints = 9502, ///< More than a cam, or the module, can hold.
  TooManyAxes = 9503,      ///< Not two or three.
  EqualPoints = 9504,      ///< Two points one after the other are the same, or not finite.
  CamTooSmall = 9505,      ///< A cam has fewer points than the path asks for.
  ArcWithThreeAxes = 9506, ///< Types 10, 11, 12 are for two axes.
  CamNotConfigured = 9507,
  ArcOfHalfTurn = 9508,  ///< Type 10 where the path turns back.
  ArcOfNoTurn = 9509,    ///< Type 10 where the path goes straight on.
  TooManyPoints = 9510,  ///< More reference points than the firmware takes.
  RadiusTooSmall = 9511, ///< Below half of the way between the points.
  NoCircle = 9512,       ///< Type 11 between equal points; type 12 with its centre there, too.
  RadiusZero = 9513,
  BlendTooLong = 9514,     ///< Nothing of a straight line is left for the blend.
  NoLinePoints = 9515,     ///< The straight part has no points.
  NoCubicPoints = 9516,    ///< The blend of type 1 has no points.
  NoBlendArcPoints = 9517, ///< The blend of type 10 has no points.
  NoArcPoints = 9518,      ///< An arc of type 11 or 12 has no points.
  CentreOff = 9519,        ///< The centre is off by more than half of the radius.
  GroupNotConfigured = 9520,
  AxisNotConfigured = 9521,
  NoQuinticPoints = 9522, ///< The blend of type 2 has no points.
  NoPoints = 9523,        ///< The table has no points, or no way between them.
  NoMemory = 9524,
  NextSegmentZero = 9525, ///< A blend into a segment without a length.
  NotComputed = 9526,     ///< Results are asked for before there are any.
  WordsPerPoint = 9527,   ///< Not 17 for two axes, 19 for three; or the table is cut off.
  UnknownType = 9528,
};

/// What is wrong, and at which point of the table, from 0.
struct Problem {
  PathError error = PathError::None;
  uint32_t point = 0;
};

/// Types of segments (ParW0). The last two only at the first point.
enum class SegmentType : int16_t {
  Line = 0,
  CubicBlend = 1,
  QuinticBlend = 2,
  ArcBlend = 10,
  ArcByRadius = 11,
  ArcByCentre = 12,
  Tool = 100,         ///< The third axis turns a tool.
  ToolOtherSide = 101 ///< The same, by half a turn.
};

/// A point and the segment that leads to it.
struct TablePoint {
  Vector3 position; ///< z: 0 with two axes; an angle for a tool. [mm], [deg]
  double speed;     ///< ParF0. [mm/s]
  double parF[3];   ///< ParF1 to ParF3
  int16_t type;     ///< ParW0
  int16_t parW[4];  ///< ParW1 to ParW4
};

struct TrajectoryTable {
  uint32_t points;
  uint32_t axes;      ///< 2 or 3
  int16_t axisIds[3]; ///< as GetAxisID (523) returns them
  TablePoint point[kMostPoints];
};

/// Words of a table: 6 + axes + (17 or 19) * points.
uint32_t lengthOfTable(uint32_t axes, uint32_t points) noexcept;

/// Reads the words of a table. A REAL takes two words, the lower one first. Errors: NoPoints,
/// TooManyPoints, TooManyAxes, WordsPerPoint. What the points hold is for computeTrajectory.
Problem readTable(const int16_t *words, uint32_t length, uint32_t mostPoints,
                  TrajectoryTable &table) noexcept;

} // namespace stride::csy

#endif // STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_TABLE_HPP
