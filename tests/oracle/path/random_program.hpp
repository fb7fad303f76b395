// Random programs for tests of paths: what real ones consist of, and what is hard in them.
#ifndef STRIDE_TESTS_ORACLE_PATH_RANDOM_PROGRAM_HPP
#define STRIDE_TESTS_ORACLE_PATH_RANDOM_PROGRAM_HPP

#include "tests/oracle/path/path_chain.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stride::oracle {

using Point = std::array<double, 3>;

enum class MoveKind : uint8_t { Line, Clockwise, Counterclockwise };

/// One move of a program. An arc whose end is not in the plane of its start is a helix.
struct ProgramMove {
  MoveKind kind;
  Point start, end;    ///< The start is the end of the move before, bit for bit.
  Point centre;        ///< Arcs: in the plane of the start.
  Point normal;        ///< Arcs: of the plane, of length 1; the direction is seen from its tip.
  double velocity;     ///< [u/s]
  double acceleration; ///< [u/s^2]
  double deceleration; ///< [u/s^2]
};

/// Parts of programs, each with its own difficulty.
enum class Passage : uint8_t {
  Wander,        ///< Lines with any corners.
  Stairs,        ///< Right angles.
  SlightCorners, ///< Corners of 1e-6 to 0.1 rad.
  Collinear,     ///< Many short lines in one direction.
  Neighbours,    ///< Very long and very short lines in turn.
  Cusps,         ///< Corners of almost 180 degrees.
  Reversal,      ///< There and back on the same line.
  TangentArcs,   ///< Arcs that leave in the direction in which the move before ends.
  AnyArcs,       ///< Arcs with corners.
  Sawtooth,      ///< Arcs to and fro.
  TinyArcs,      ///< Radii of 1e-5 to 1e-3 of the others.
  FullCircle,    ///< Start and end in one place.
  Helix,         ///< Some turns.
  Polygon,       ///< A circle as lines.
  Curve,         ///< A smooth curve as short lines, rounded as a text is.
};
inline constexpr int kPassages = static_cast<int>(Passage::Curve) + 1; ///< How many there are.

struct ProgramOptions {
  int passages = 4;         ///< At most.
  int mostMoves = 150;      ///< Of one passage.
  bool flat = false;        ///< In the plane of X and Y only, at Z = 0.
  bool anyPlane = false;    ///< Arcs in any plane instead of those of two axes.
  double leastScale = 1e-3; ///< The size of programs is between both. [u]
  double greatestScale = 1e2;
};

struct RandomProgram {
  std::vector<ProgramMove> moves;
  std::vector<Passage> passages;
  double scale; ///< The size of a usual move. [u]
  Point axisVelocity, axisAcceleration;
  double jerk;      ///< Along the path. [u/s^3]
  double tolerance; ///< For blends. [u]
};

/// The program of a seed; the same one everywhere. Velocity, acceleration and jerk are of all
/// proportions to each other and to the size: from moves that are too short for any limit but the
/// jerk's to such that hardly notice it.
RandomProgram randomProgram(uint64_t seed, const ProgramOptions &options = {});

/// Its moves as a reference.
PathChain chainOf(const std::vector<ProgramMove> &moves);

/// Its moves as G-code: N numbers, G1, G2 and G3 with I, J, K relative to the start, F, E and E- in
/// units and seconds; without exponents, which the language does not have. Arcs must lie in planes
/// of two axes; G17, G18 and G19 say in which.
std::string gcodeOf(const std::vector<ProgramMove> &moves, int decimals = 15);

/// The moves of a file in the language as gcodeOf and tests/bench/path write it, no more of it: G0
/// and G1 are lines, accelerations are left out. Throws std::runtime_error if it cannot be read.
std::vector<ProgramMove> movesOf(const std::string &file);

} // namespace stride::oracle

#endif // STRIDE_TESTS_ORACLE_PATH_RANDOM_PROGRAM_HPP
