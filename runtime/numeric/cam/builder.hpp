// Cams from pieces with boundaries of which some say little or nothing: what SMCB.CamBuilder does.
// Pure numerics; allocates nothing.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_BUILDER_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_BUILDER_HPP

#include "runtime/numeric/cam/curve.hpp"

#include <stdint.h>

namespace stride::cam {

/// What a piece is; the values are those of SMCB.CAM_SEGMENT_TYPE.
enum class PieceKind : int16_t {
  Line = 0,     ///< From place to place at one velocity.
  Poly5,        ///< The quintic that has position, velocity and acceleration of both ends.
  Poly7,        ///< The polynomial of degree 7 that has the jerk of both ends, too.
  Coefficients, ///< A polynomial that is given.
  InclinedSine, ///< From rest to rest.
  ModifiedSine, ///< Between two velocities; `inflexion`: 0 to 1, where the acceleration changes its
                ///< sign.
  ModifiedSineLimited, ///< The same; `parameter` is the peak of the acceleration after the
                       ///< inflexion.
  Law,                 ///< `law` as makeSegment has it, between velocities and accelerations.
};

/// One end of a piece. SMCB.Boundary says what the members mean.
struct Boundary {
  double x;      ///< [master u]
  double y;      ///< [slave u]
  double v;      ///< [slave u/master u]
  double a;      ///< [slave u/master u^2]
  double j;      ///< [slave u/master u^3]
  int16_t given; ///< How many of them count, from the first on: 0, 2 to 5.
};

/// A piece as the program describes it. SMCB.CAM_SEGMENT says what the members mean.
struct Piece {
  PieceKind kind;
  Boundary left;
  Boundary right;
  double coefficients[8]; ///< Of powers of the way since the left end.
  double parameter;
  double inflexion;
  Law law;
};

/// Why there is no cam.
enum class BuildError : uint8_t {
  None,
  NoPieces,
  BoundaryUnknown,  ///< Two implicit boundaries meet, or the last one is implicit.
  NotAdjacent,      ///< A piece does not begin where the one before ends.
  NoExtent,         ///< A piece ends where it begins, or before.
  InvalidValue,     ///< Not finite, or too large to compute with.
  InvalidParameter, ///< The law does not exist with this parameter, inflexion or acceleration.
};

/// Room for one joint while the derivatives that nobody gives are computed.
struct JointWork {
  double diagonal[6]; ///< Lower triangle, by rows; factorised later.
  double before[9];   ///< Coupling with the joint before.
  double around[9];   ///< Coupling with the last joint of a closed cam.
  double pivot[3];    ///< What the diagonal was.
  double value[3];    ///< v, a, j.
};

/// Whether the last of `count` pieces fits to those before it, and each has an extent as far as is
/// known.
BuildError checkLast(const Piece *pieces, int32_t count) noexcept;

/// The cam of a number of pieces.
///
/// At a joint an end takes what it does not know from its neighbour: from what is given there, or
/// from what the piece there does (a line's slope, say). Velocities, accelerations and, between
/// pieces of degree 7, jerks that nobody gives are the same on both sides, and all of them together
/// make the integral of the squared jerk, over the pieces of degree 5 and 7, as small as it can be.
/// A derivative that this leaves open is 0. Where only pieces of degree 5 meet, the result is the
/// natural quintic spline, whose first four derivatives are continuous. Source: a block-Cholesky
/// factorisation of the block-tridiagonal normal equations (G. H. Golub, C. F. Van Loan, Matrix
/// Computations, section 4.5); a closed cam has one more block column.
class Builder {
public:
  /// `work` has room for `count` + 1 joints. `closed`: the cam repeats itself, and if its first
  /// boundary is implicit, its end goes over into its start: the start has x = 0 and takes the
  /// position and the derivatives of the end. Else an implicit first boundary is 0 in all.
  Builder(const Piece *pieces, int32_t count, bool closed, JointWork *work) noexcept;

  /// First of all. Takes a time that grows with the number of pieces.
  BuildError solve() noexcept;

  /// Piece `index` as one or two segments.
  BuildError segments(int32_t index, Segment (&result)[2], int32_t &count) const noexcept;

private:
  struct Ends {
    double x[2];
    double y[2];
  };
  /// v, a or j at one end of a piece.
  struct Value {
    double value;
    bool open; ///< To be chosen; `value` is the choice once solve has been here.
  };

  [[nodiscard]] bool isFirst(int32_t piece, bool right) const noexcept;
  [[nodiscard]] int32_t jointOf(int32_t piece, bool right) const noexcept;
  [[nodiscard]] Ends ends(int32_t piece) const noexcept;
  [[nodiscard]] Value derivative(int32_t piece, bool right, int which) const noexcept;
  [[nodiscard]] Value ownValue(int32_t piece, bool right, int which) const noexcept;
  BuildError build(int32_t index, const double (&z)[7], Segment (&result)[2],
                   int32_t &count) const noexcept;
  void addEnergy(int32_t piece) noexcept;
  void factorise() noexcept;

  const Piece *pieces_;
  int32_t count_;
  bool closed_;
  JointWork *work_;
};

} // namespace stride::cam

#endif
