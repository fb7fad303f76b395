// Cam curves in all their forms behind one interface. Pure numerics: no AXIS_REF, no application.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_CURVE_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_CURVE_HPP

#include "runtime/numeric/cam/laws.hpp"

#include <stdint.h>

namespace stride::cam {

/// What a curve consists of; the values are those of SMC_CAM_TYPE.
enum class Form : uint8_t {
  EvenTable = 1, ///< Slave positions at even distances of the master.
  PairTable = 2, ///< Master and slave position by turns.
  Nodes = 3,     ///< Node: quintics between them.
  Segments = 4,  ///< Segment.
};

/// The type of a table's numbers; the values are those of MC_CAM_REF.byVarType.
enum class Element : uint8_t { Int = 1, Uint, Dint, Udint, Real, Lreal };

/// Bytes of one number; 0 for none of the six.
int32_t sizeOf(Element element) noexcept;

/// A place with its derivatives: SMC_CAMXYVA.
struct Node {
  double x; ///< [master u]
  double y; ///< [slave u]
  double v; ///< [slave u/master u]
  double a; ///< [slave u/master u^2]
};

/// A piece between two master positions: SMC_CAM_SEGMENT, which says what the members mean.
struct Segment {
  double start;
  double end;
  double coefficients[8];
  double stroke;
  double lawBegin;
  double lawEnd;
  double parameter;
  double inflexion;
  Law law;
};

/// From the numbers of a table to technical units: value = base + (number - zero) * factor.
struct Scale {
  double zero = 0.0;
  double base = 0.0;
  double factor = 1.0;

  double of(double number) const noexcept { return base + (number - zero) * factor; }
};

/// A cam as the numerics see it; owns nothing. Valid if checkCurve says so.
struct Curve {
  double start = 0.0; ///< [master u]
  double end = 0.0;   ///< [master u]
  Form form = Form::Nodes;
  Element element = Element::Lreal; ///< Of tables.
  bool cubic = false;               ///< Tables: cubic curves between the places, else lines.
  bool open = false;                ///< Even table: the last place is missing; it is the first one
                                    ///< again, `rise` higher.
  int32_t count = 0;                ///< Of slave positions, pairs, nodes or segments.
  const void *data = nullptr;
  double rise = 0.0; ///< Only for `open`. [slave u]
  Scale master;      ///< Of pair tables.
  Scale slave;       ///< Of tables.
};

/// What is wrong with a curve.
enum class CurveError : uint8_t {
  None,
  NoCurve, ///< No data, unknown form, too few places, not ascending, not finite.
  Scaling, ///< A scale without extent, or not finite.
};

/// Looks at all of the curve, in a time that grows with its size.
CurveError checkCurve(const Curve &curve) noexcept;

/// The same in portions: first what does not depend on the places …
CurveError checkForm(const Curve &curve) noexcept;

/// … then the pieces from `first` to the one before `end`, at most pieceCount(curve), of a curve
/// whose form is good.
bool areGoodPieces(const Curve &curve, uint32_t first, uint32_t end) noexcept;

/// How many pieces a curve whose form is good has.
uint32_t pieceCount(const Curve &curve) noexcept;

/// A piece of any curve as a segment: the same up to rounding. `periodic` as for evaluateCurve.
Segment pieceOf(const Curve &curve, uint32_t piece, bool periodic) noexcept;

/// The slave position at the end of a piece, as it is written there. [slave u]
double endOfPiece(const Curve &curve, uint32_t piece) noexcept;

/// The curve at `x` and its derivatives with respect to the master. Before the start and after the
/// end the first and the last piece go on. `periodic`: a cubic table looks around the corner at its
/// ends. `index` is where the last look was; any number is right, a good one saves the search.
/// Depends on nothing but the curve and `x`, so that the way back is the same. O(1) for a master
/// that moves on from look to look and for even tables, else O(log count).
Point evaluateCurve(const Curve &curve, double x, bool periodic, uint32_t &index) noexcept;

/// The slave position at the end minus the one at the start. [slave u]
double riseOf(const Curve &curve) noexcept;

/// The quintic through two nodes at `x`.
Point evaluateQuintic(const Node &left, const Node &right, double x) noexcept;

/// A segment between two places, whatever they are in VDI 2143: at rest (v = a = 0), with constant
/// velocity (a = 0), reversal (v = 0) or moving. Position, velocity and acceleration are those of
/// both places, except for Harmonic, whose accelerations at the ends are its own. Between places of
/// one velocity with a = 0 the motion is the law and a line; between others a polynomial of degree
/// 4 takes the velocity and acceleration from the one to the other and the law does the rest of the
/// way. Polynomial: the quintic (3-4-5 from rest to rest). Needs isUsable(shape), finite places and
/// right.x > left.x.
Segment makeSegment(const LawShape &shape, const Node &left, const Node &right) noexcept;

/// A segment at `x`.
Point evaluateSegment(const Segment &segment, double x) noexcept;

} // namespace stride::cam

#endif
