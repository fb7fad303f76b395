// Objects of a path as CNC programs make them and blocks hand them on: what SMC_GEOINFO and
// SMC_POSINFO are in ST, member by member and byte by byte. Decoders write them, path processors
// change them, interpolators drive them; numeric/path does not know them. Free of the C++ standard
// library: linked into every application.
// Source: SoftMotion V2.3 manual, section 6.6; SoftMotion 3's members after V2.3's.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PATH_OBJECT_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PATH_OBJECT_HPP

#include "runtime/numeric/vector3.hpp"

#include <stdint.h>

namespace stride::cnc {

using numeric::Vector3;

/// Bits of Position::axes and Position::sProfile, from 0 on. P, Q, U, V, W and the sixth additional
/// axis are SMC_POSINFO's dA1 to dA6.
enum AxisBit : uint16_t {
  kAxisX,
  kAxisY,
  kAxisZ,
  kAxisA,
  kAxisB,
  kAxisC,
  kAxisP,
  kAxisQ,
  kAxisU,
  kAxisV,
  kAxisW,
  kAxisSixth,
  kAxes ///< How many there are.
};

/// A place of a path: SMC_POSINFO.
struct Position {
  int16_t frame;     ///< Whatever the user wants to say.
  uint16_t axes;     ///< Which ones are interpolated, by AxisBit; X, Y and Z as a rule.
  uint16_t sProfile; ///< Of the start: which ones go by an S profile instead of evenly, by AxisBit.
  double coordinate[kAxes]; ///< By AxisBit. [u]
};

/// What an object is: MOVTYP (SMC_MOVTYP).
enum class MoveType : int16_t {
  Line = 1,                    ///< LIN
  Clockwise = 2,               ///< CLW
  Counterclockwise = 3,        ///< CCLW
  Spline = 5,                  ///< SPLINE: cubic, in the plane.
  EllipseClockwise = 8,        ///< ELLCLW
  EllipseCounterclockwise = 9, ///< ELLCCLW
  Spline3d = 11,               ///< SPLINE3D_5: of degree 5, in space.
  Positioning = 100,           ///< LINPOS
  Jump = 110,                  ///< INITPOS: from wherever the motion stands.
  Function = 120,              ///< MCOMMAND: an M function, a dwell, a synchronisation.
};

/// MAX_IPOSWITCHES: switch points of one object. The arrays in ST have one place more.
inline constexpr int32_t kMostSwitches = 3;
/// MAX_ADDITIONAL_PARAMS: parameters of an extended function (G38).
inline constexpr int32_t kAdditionalParameters = 3;

/// What PathObject::switchId[0] of a Function says when it is no M function. (M numbers are
/// positive; SoftMotion 3 keeps 65533 to 65535 for itself.)
inline constexpr int16_t kDwell = -1;       ///< G4: parameterRange[0] is its time. [s]
inline constexpr int16_t kSynchronise = -2; ///< G75: the decoder goes on when the path is done.

/// Bits of PathObject::marks.
enum Mark : uint8_t {
  kEndToolCorrection = 1 << 0,
  kToolLeft = 1 << 1,
  kToolRight = 1 << 2,
  kEndSmoothing = 1 << 3, ///< Of both kinds.
  kSmooth = 1 << 4,       ///< G51: with splines.
  kRound = 1 << 5,        ///< G52: with arcs.
  kEndAvoidLoops = 1 << 6,
  kAvoidLoops = 1 << 7,
};

/// Besides kToolLeft, kToolRight, kSmooth, kRound and kAvoidLoops, a bit of PathObject::modes.
inline constexpr uint8_t kInSpace = 1 << 0; ///< Not G15.

/// Axes of a program's coordinates: AxisBit, but for the sixth additional one.
inline constexpr int32_t kSystemAxes = kAxisSixth;

/// PathObject::smoothAxes says by bits which axes go smoothly over several objects (G71 to G70): A,
/// B, C, P, Q, U, V, W from 0 on, and from kRangeBegins on, in the same order, whose range begins
/// with the object.
inline constexpr int32_t kSmoothAxes = 8; ///< How many there are.
inline constexpr int32_t kRangeBegins = 8;

/// Limits of one axis that the program says (words F and E with the axis's letter); 0: none.
struct AxisLimits {
  float velocity;     ///< [u/s]
  float acceleration; ///< [u/s^2]
  float deceleration; ///< [u/s^2]
};

/// A piece of a path: SMC_GEOINFO.
///
/// What `shape` and `parameterRange` mean:
/// - arcs: centre (in the frame of planeX, planeY, normal), radius, place along the normal; start
///   angle and sweep [degrees], clockwise positive, counterclockwise negative. Who reads an arc
///   takes the direction from the type and the absolute value of the sweep.
/// - Spline: x = shape[0] + shape[1] t + shape[2] t^2 + shape[3] t^3, y alike from shape[4] on, in
///   the frame; t from parameterRange[0] to [1], both 0: from 0 to 1.
/// - ellipses: centre, the main axis as a vector of length 1, its half length, the half length of
///   the other, the main axis's direction [degrees], the ratio of both; start angle and sweep of
///   the parameter phi [degrees], where centre + main cos(phi) + other sin(phi); signs as for arcs.
/// - Spline3d: coefficients of t^0 to t^5 of X, then of Y, then of Z; t likewise.
/// - Function: shape[0] to [7] are the parameters (SMC_M_PARAMETERS), parameterRange K and L.
struct PathObject {
  int32_t number;     ///< iObjNo
  int32_t sourceLine; ///< iSourceLineNo: number of the sentence (N), as V2.3 has it.
  MoveType moveType;
  Position start;
  Position end;
  double shape[8];                          ///< dP1 to dP8; Spline3d goes on in moreShape.
  double parameterRange[2];                 ///< dT1, dT2
  double toolRadius;                        ///< dToolRadius [u]
  double velocity;                          ///< dVel, to be reached. [u/s]
  double velocityEnd;                       ///< dVelEnd, at the end. [u/s]
  double acceleration;                      ///< dAccel, > 0. [u/s^2]
  double deceleration;                      ///< dDecel, > 0. [u/s^2]
  double length;                            ///< dLength [u]
  uint8_t marks;                            ///< byInternMark, see Mark.
  double switchPosition[kMostSwitches + 1]; ///< dHelpPos, 0 to 1, as a part of the length.
  int16_t switchId[kMostSwitches +
                   1]; ///< iHelpID: > 0 on, < 0 off, 0 none; [0] of a Function: its number.
  // SoftMotion 3:
  int32_t sentence;     ///< diSentenceNo
  uint16_t smoothAxes;  ///< See kSmoothAxes; Stride's own, hidden in ST.
  uint8_t modes;        ///< What the program has switched on, by Mark and kInSpace; likewise.
  double moreShape[10]; ///< dP9 to dP18
  Vector3 planeX;       ///< vX: the frame of arcs, ellipses, splines; columns of length 1.
  Vector3 planeY;       ///< vY
  Vector3 normal;       ///< vN
  uint32_t features;    ///< dwFeatureFlags: extended functions that are on (G38).
  uint16_t program;     ///< Which subprogram it is of, as SMC_NCInterpreter counts; hidden.
  int16_t orientation;  ///< Of the program: Orientation; likewise.
  double additional[kAdditionalParameters]; ///< aAdditionalParams
  // Stride's own, hidden in ST:
  double cornerDistance; ///< Of smoothing and rounding (D), as SoftMotion 3 reads it. [u]
  double startSlope[3];  ///< Of A, B, C over the length, if bits 0 to 2 of slopes are set. [1/u]
  double endSlope[3];    ///< Likewise, at the end.
  AxisLimits limits[9];  ///< Of Z, A, B, C, P, Q, U, V, W.
  uint16_t probe;        ///< The input that ends the motion (G31); 0: none.
  uint8_t slopes;        ///< Which of A, B, C go by a polynomial between their slopes.
  uint8_t planar;        ///< Not 0: the length counts in the plane only; what leaves it goes along
                         ///< evenly.
  double system[kSystemAxes]; ///< Where the program's coordinates begin, for the machine; A, B, C
                              ///< are angles of their turn, unless `orientation` is Axes. [u]
  Vector3 tool;               ///< Of the program: G43. [u]
};

inline bool isCircle(MoveType type) noexcept {
  return type == MoveType::Clockwise || type == MoveType::Counterclockwise;
}
inline bool isEllipse(MoveType type) noexcept {
  return type == MoveType::EllipseClockwise || type == MoveType::EllipseCounterclockwise;
}
/// Whether PathObject::shape describes it.
inline bool isCurve(MoveType type) noexcept {
  return isCircle(type) || isEllipse(type) || type == MoveType::Spline ||
         type == MoveType::Spline3d;
}

/// Whether an object moves anything on a way: no jump (G92), no function.
inline bool isMotion(const PathObject &object) noexcept {
  return object.moveType != MoveType::Function && object.moveType != MoveType::Jump;
}

/// Copies an object. A plain assignment is a slow string instruction for so many bytes. Both may be
/// the same.
inline void copyObject(PathObject &to, const PathObject &from) noexcept {
  __builtin_memmove(&to, &from, sizeof to);
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PATH_OBJECT_HPP
