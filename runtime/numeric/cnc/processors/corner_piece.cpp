#include "runtime/numeric/cnc/processors/corner_piece.hpp"

#include "runtime/iec/math.h"
#include "runtime/numeric/cnc/meeting.hpp"
#include "runtime/numeric/cnc/object_cut.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"
#include "runtime/numeric/path/blend.hpp"

namespace stride::cnc {
namespace {

using exact::larger;
using exact::smaller;
using numeric::cross;
using numeric::dot;
using numeric::norm;

constexpr double kDegrees = 57.29577951308232; ///< In a radian.
constexpr int kTrials = 16;                    ///< For a cut that leaves a good curve.
constexpr double kMostBend = 1.0; ///< By which an object may turn within its cut. [rad]
constexpr double kNothing = 1e-9; ///< What is left of an object, as a part of it, is none.
constexpr double kGap = 1e-6;     ///< How far ends that meet may be apart. [u]
constexpr double kFlat = 1e-12;   ///< How far a curve may leave a plane, as a part of its size.

/// What is cut off both objects, along them. [u]
struct Cuts {
  double before, after;
};

/// Both objects where they are cut.
struct Ends {
  double beforeAt; ///< The parameter of the first one's shape.
  double afterAt;  ///< That of the second one's.
  path::Derivatives before;
  path::Derivatives after; ///< In the plane of the first one.
  double sine;             ///< Of the angle from one to the other, and
  double cosine;           ///< its cosine.
  Cuts cuts;
};

double turnOf(const Ends &ends) noexcept { return ::stride::atan2(ends.sine, ends.cosine); }

/// tan(angle / 2).
double halfTangent(double sine, double cosine) noexcept { return sine / (1.0 + cosine); }

bool isLine(const path::Shape &shape) noexcept { return shape.kind == path::ShapeKind::Line; }

/// An arc that stays in its plane.
bool isCircle(const path::Shape &shape) noexcept {
  return shape.kind == path::ShapeKind::Arc && dot(shape.v[3], shape.v[3]) == 0.0;
}

/// The arc whose chord has a length; `most` if there is none. [u]
double arcOver(double chord, double radius, double most) noexcept {
  const double q = 0.5 * chord / radius;
  const double z = q * q;
  if (z < 0.01) // the arc sine; the next term is below 1e-17 of it
    return chord *
           (1.0 +
            z * (1.0 / 6 +
                 z * (3.0 / 40 +
                      z * (5.0 / 112 +
                           z * (35.0 / 1152 +
                                z * (63.0 / 2816 + z * (231.0 / 13312 + z * (143.0 / 10240))))))));
  return z < 1.0 ? 2.0 * radius * ::stride::atan2(q, exact::sqrt(1.0 - z)) : most;
}

/// How far along an object a circle around the corner meets it; `most` if it does not before.
double wayAt(const path::Shape &shape, bool atEnd, double distance, double most) noexcept {
  if (isLine(shape))
    return smaller(distance, most);
  if (isCircle(shape))
    return smaller(arcOver(distance, norm(shape.v[1]), most), most);
  const Vector3 corner = path::overParameter(shape, atEnd ? 1.0 : 0.0).p;
  double way = smaller(distance, most);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double at = path::parameterAt(shape, atEnd ? shape.length - way : way);
    const double away = norm(path::overParameter(shape, at).p - corner);
    const double next = smaller(way * distance / away, most);
    if (!(exact::fabs(next - way) > kFlat * way))
      break;
    way = next;
  }
  return way;
}

/// False: no good curve leads past the corner with these cuts; perhaps one with smaller ones does.
bool endsAt(const Meeting &meeting, const Cuts &cuts, Ends &ends) noexcept {
  ends.cuts = cuts;
  ends.beforeAt = path::parameterAt(meeting.before, meeting.before.length - cuts.before);
  ends.afterAt = path::parameterAt(meeting.after, cuts.after);
  ends.before = derivativesOver(meeting.before, ends.beforeAt);
  ends.after = derivativesOver(meeting.after, ends.afterAt);
  ends.after.p = ends.after.p + meeting.lift;
  ends.sine = norm(cross(ends.before.d1, ends.after.d1));
  ends.cosine = dot(ends.before.d1, ends.after.d1);
  const double bend = larger(norm(ends.before.d2) * cuts.before, norm(ends.after.d2) * cuts.after);
  return bend <= kMostBend && !isTurnAbove(ends.sine, ends.cosine, path::kMaxTurn);
}

bool chooseEnds(const Meeting &meeting, const PieceRules &rules, double roomBefore,
                double roomAfter, Ends &ends) noexcept {
  Cuts cuts{wayAt(meeting.before, true, rules.distance, roomBefore),
            wayAt(meeting.after, false, rules.distance, roomAfter)};
  if (rules.symmetrical || rules.kind == PieceKind::Arc)
    cuts.before = cuts.after = smaller(cuts.before, cuts.after);
  for (int trial = 0; trial < kTrials && cuts.before > 0.0 && cuts.after > 0.0; ++trial) {
    if (endsAt(meeting, cuts, ends))
      return true;
    cuts = {0.5 * cuts.before, 0.5 * cuts.after};
  }
  return false;
}

// ---- curves

/// Between equal cuts of two lines, the cubic that touches an arc of a circle in the middle; what
/// it is for others is an affine picture of that.
path::Shape cubicOf(const Ends &ends) noexcept {
  const double tangent = halfTangent(ends.sine, ends.cosine);
  const double t = tangent / (1.0 + exact::sqrt(1.0 + tangent * tangent)); // of a quarter
  const double stretch = 2.0 * (1.0 - t * t);
  const Vector3 first = ends.before.d1 * (stretch * ends.cuts.before);
  const Vector3 last = ends.after.d1 * (stretch * ends.cuts.after);
  const Vector3 way = ends.after.p - ends.before.p;
  return path::polynomialShape({ends.before.p, first, way * 3.0 - first * 2.0 - last,
                                first + last - way * 2.0, numeric::kZero, numeric::kZero});
}

/// The blend of numeric/path, drawn out where cuts are not equal.
path::Shape quinticOf(const Meeting &meeting, const Ends &ends) noexcept {
  const double turn = turnOf(ends);
  if (ends.cuts.before == ends.cuts.after)
    return path::blendShape(ends.before, ends.after, turn);
  const double mean = 0.5 * (ends.cuts.before + ends.cuts.after);
  const double chord = isLine(meeting.before) && isLine(meeting.after)
                           ? 2.0 * mean * ::stride::cos(0.5 * turn)
                           : norm(ends.after.p - ends.before.p);
  const double stretch = path::blendStretch(turn) * chord / mean;
  const auto over = [stretch](const path::Derivatives &end, double cut) {
    const double speed = stretch * cut;
    return path::Derivatives{end.p, end.d1 * speed, end.d2 * (speed * speed), numeric::kZero};
  };
  return path::quinticShape(over(ends.before, ends.cuts.before), over(ends.after, ends.cuts.after));
}

// ---- the piece

/// A cubic in its plane, if it lies in that.
void describeCubic(const path::Shape &curve, PathObject &piece) noexcept {
  double out = 0.0;
  for (int k = 1; k < 4; ++k)
    out = larger(out, exact::fabs(dot(curve.v[k], piece.normal)));
  if (out > kFlat * curve.length) {
    describePiece(curve, piece);
    return;
  }
  piece.moveType = MoveType::Spline;
  for (int k = 0; k < 4; ++k) {
    piece.shape[k] = dot(curve.v[k], piece.planeX);
    piece.shape[4 + k] = dot(curve.v[k], piece.planeY);
  }
  piece.parameterRange[0] = 0.0;
  piece.parameterRange[1] = 1.0;
  piece.length = curve.length;
}

double arcRadius(const Ends &ends) noexcept {
  return ends.cuts.before / halfTangent(ends.sine, ends.cosine);
}

void describeArc(const Ends &ends, PathObject &piece) noexcept {
  const Vector3 up = cross(ends.before.d1, ends.after.d1);
  const Vector3 normal = up * (1.0 / norm(up));
  const Vector3 inside = cross(normal, ends.before.d1);
  double side = dot(normal, piece.normal);
  if (exact::fabs(exact::fabs(side) - 1.0) > kFlat) {
    piece.planeX = ends.before.d1;
    piece.planeY = inside;
    piece.normal = normal;
    side = 1.0;
  }
  const double radius = arcRadius(ends);
  const Vector3 centre = ends.before.p + inside * radius;
  piece.moveType = side > 0.0 ? MoveType::Counterclockwise : MoveType::Clockwise;
  piece.shape[0] = dot(centre, piece.planeX);
  piece.shape[1] = dot(centre, piece.planeY);
  piece.shape[2] = radius;
  piece.shape[3] = dot(ends.before.p, piece.normal);
  piece.parameterRange[0] =
      ::stride::atan2(-dot(inside, piece.planeY), -dot(inside, piece.planeX)) * kDegrees;
  const double turn = turnOf(ends);
  piece.parameterRange[1] = (side > 0.0 ? -turn : turn) * kDegrees;
  piece.length = radius * turn;
}

/// The curve past the corner; that of an arc has only its length.
path::Shape curveOf(const Meeting &meeting, const Ends &ends, PieceKind kind) noexcept {
  switch (kind) {
  case PieceKind::Cubic:
    return cubicOf(ends);
  case PieceKind::Quintic:
    return quinticOf(meeting, ends);
  case PieceKind::Arc:
    break;
  }
  path::Shape curve{};
  curve.length = arcRadius(ends) * turnOf(ends);
  return curve;
}

void describe(const path::Shape &curve, const Ends &ends, PieceKind kind,
              PathObject &piece) noexcept {
  completePlane(piece);
  for (double &value : piece.shape)
    value = 0.0;
  for (double &value : piece.moreShape)
    value = 0.0;
  switch (kind) {
  case PieceKind::Cubic:
    describeCubic(curve, piece);
    break;
  case PieceKind::Quintic:
    describePiece(curve, piece);
    break;
  case PieceKind::Arc:
    describeArc(ends, piece);
    break;
  }
}

// ---- switch points

/// Puts a switch point into a free place. False: there is none.
bool putSwitch(PathObject &object, double position, int16_t id) noexcept {
  for (int32_t i = 0; i < kMostSwitches; ++i)
    if (object.switchId[i] == 0) {
      object.switchId[i] = id;
      object.switchPosition[i] = position;
      return true;
    }
  return false;
}

void clearSwitches(PathObject &object) noexcept {
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    object.switchId[i] = 0;
    object.switchPosition[i] = 0.0;
  }
}

/// The switch points of an object.
struct Switches {
  double position[kMostSwitches + 1];
  int16_t id[kMostSwitches + 1];
};

Switches switchesOf(const PathObject &object) noexcept {
  Switches all;
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    all.position[i] = object.switchPosition[i];
    all.id[i] = object.switchId[i];
  }
  return all;
}

/// Gives those of the first object to what both objects have become.
void shareFirst(const Switches &was, const Meeting &meeting, const Cuts &cuts, bool replaced,
                PathObject &first, PathObject &piece, PathObject &second) noexcept {
  const double left = meeting.before.length - cuts.before;
  clearSwitches(first);
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    const double way = was.position[i] * meeting.before.length;
    if (was.id[i] == 0)
      continue;
    if (!replaced && way <= left)
      (void)putSwitch(first, way / left, was.id[i]);
    else if (!putSwitch(piece, smaller((way - left) / piece.length, 0.5), was.id[i]))
      (void)putSwitch(replaced ? second : first, replaced ? 0.0 : 1.0, was.id[i]);
  }
}

/// The same of the second one.
void shareSecond(const Switches &was, const Meeting &meeting, const Cuts &cuts, PathObject &piece,
                 PathObject &second) noexcept {
  const double rest = meeting.after.length - cuts.after;
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    const double way = was.position[i] * meeting.after.length;
    if (was.id[i] == 0)
      continue;
    if (way >= cuts.after)
      (void)putSwitch(second, (way - cuts.after) / rest, was.id[i]);
    else if (!putSwitch(piece, larger(1.0 - (cuts.after - way) / piece.length, 0.5), was.id[i]))
      (void)putSwitch(second, 0.0, was.id[i]);
  }
}

bool mayBe(const Meeting &meeting, const PathObject &before, const PathObject &after,
           const PieceRules &rules) noexcept {
  const Vector3 gap = placeOf(after.start) - placeOf(before.end);
  const bool lines = isLine(meeting.before) && isLine(meeting.after);
  return isTurnAbove(meeting.sine, meeting.cosine, larger(rules.leastTurn, kLeastAngle)) &&
         !isTurnAbove(meeting.sine, meeting.cosine, path::kMaxTurn) && rules.distance > 0.0 &&
         norm(gap) <= kGap && (lines || rules.kind != PieceKind::Arc);
}

} // namespace

CornerChange makeCorner(PathObject &before, PathObject &after, const PieceRules &rules,
                        BeforeCorner &known, PathObject &piece) noexcept {
  Meeting meeting;
  Ends ends;
  const double room = known.room;
  ObjectShape shape = known.shape;
  const bool isDescribed = known.isDescribed || describeAtCorner(before, shape);
  known.room = -1.0;
  known.isDescribed = isDescribed && describeAtCorner(after, known.shape);
  if (!known.isDescribed || !meet(before, shape, after, known.shape, meeting) ||
      !mayBe(meeting, before, after, rules))
    return CornerChange::Kept;
  const double length = meeting.before.length;
  const double roomBefore = room < 0.0 ? 0.5 * length : smaller(room, length);
  const double roomAfter = 0.5 * meeting.after.length;
  if (!chooseEnds(meeting, rules, roomBefore, roomAfter, ends))
    return CornerChange::Kept;
  const bool replaced = length - ends.cuts.before <= kNothing * length;
  ObjectCut cutBefore;
  ObjectCut cutAfter;
  if (!replaced && planCut(before, shape, shape.length - ends.cuts.before, ends.beforeAt,
                           ends.before.p, cutBefore) != CutError::None)
    return CornerChange::Kept;
  if (planCut(after, known.shape, ends.cuts.after, ends.afterAt, ends.after.p - meeting.lift,
              cutAfter) != CutError::None)
    return CornerChange::Kept;
  const path::Shape curve = curveOf(meeting, ends, rules.kind);
  if (!exact::isPositive(curve.length))
    return CornerChange::Kept;
  // From here on nothing fails.
  const Switches switchesBefore = switchesOf(before);
  const Switches switchesAfter = switchesOf(after);
  const double startSlope[] = {slopeAt(before, 0, false), slopeAt(before, 1, false),
                               slopeAt(before, 2, false)};
  if (replaced)
    before.end = before.start;
  else
    takeFirst(cutBefore, shape, before);
  known.isDescribed = takeSecond(cutAfter, known.shape, after);
  known.room = roomAfter;
  beginPiece(before, after, piece);
  if (replaced) {
    piece.marks = before.marks;
    for (int32_t i = 0; i < 3; ++i)
      piece.startSlope[i] = startSlope[i];
  }
  describe(curve, ends, rules.kind, piece);
  clearSwitches(after);
  shareFirst(switchesBefore, meeting, ends.cuts, replaced, before, piece, after);
  shareSecond(switchesAfter, meeting, ends.cuts, piece, after);
  before.velocityEnd = smaller(before.velocity, piece.velocity);
  return replaced ? CornerChange::Replaced : CornerChange::Cut;
}

} // namespace stride::cnc
