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
  path::Derivatives before;
  path::Derivatives after;
  double turn; ///< From one to the other. [rad]
  Cuts cuts;
};

bool isLine(const path::Shape &shape) noexcept { return shape.kind == path::ShapeKind::Line; }

/// An arc that stays in its plane.
bool isCircle(const path::Shape &shape) noexcept {
  return shape.kind == path::ShapeKind::Arc && dot(shape.v[3], shape.v[3]) == 0.0;
}

/// How far along an object a circle around the corner meets it; `most` if it does not before.
double wayAt(const path::Shape &shape, bool atEnd, double distance, double most) noexcept {
  if (isLine(shape))
    return smaller(distance, most);
  if (isCircle(shape)) { // where the chord is as long
    const double radius = norm(shape.v[1]);
    const double rest = 4.0 * radius * radius - distance * distance;
    return rest > 0.0 ? smaller(2.0 * radius * ::stride::atan2(distance, exact::sqrt(rest)), most)
                      : most;
  }
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
  ends.before = derivativesAt(meeting.before, meeting.before.length - cuts.before);
  ends.after = derivativesAt(meeting.after, cuts.after);
  ends.after.p = ends.after.p + meeting.lift;
  ends.turn = path::turnBetween(ends.before.d1, ends.after.d1);
  const double bend = larger(norm(ends.before.d2) * cuts.before, norm(ends.after.d2) * cuts.after);
  return bend <= kMostBend && ends.turn <= path::kMaxTurn;
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
  const double t = ::stride::tan(0.25 * ends.turn);
  const double stretch = 2.0 * (1.0 - t * t);
  const Vector3 first = ends.before.d1 * (stretch * ends.cuts.before);
  const Vector3 last = ends.after.d1 * (stretch * ends.cuts.after);
  const Vector3 way = ends.after.p - ends.before.p;
  return path::polynomialShape({ends.before.p, first, way * 3.0 - first * 2.0 - last,
                                first + last - way * 2.0, numeric::kZero, numeric::kZero});
}

/// The blend of numeric/path, drawn out where cuts are not equal.
path::Shape quinticOf(const Meeting &meeting, const Ends &ends) noexcept {
  if (ends.cuts.before == ends.cuts.after)
    return path::blendShape(ends.before, ends.after);
  const double mean = 0.5 * (ends.cuts.before + ends.cuts.after);
  const double chord = isLine(meeting.before) && isLine(meeting.after)
                           ? 2.0 * mean * ::stride::cos(0.5 * ends.turn)
                           : norm(ends.after.p - ends.before.p);
  const double stretch = path::blendStretch(ends.turn) * chord / mean;
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
  const double radius = ends.cuts.before / ::stride::tan(0.5 * ends.turn);
  const Vector3 centre = ends.before.p + inside * radius;
  piece.moveType = side > 0.0 ? MoveType::Counterclockwise : MoveType::Clockwise;
  piece.shape[0] = dot(centre, piece.planeX);
  piece.shape[1] = dot(centre, piece.planeY);
  piece.shape[2] = radius;
  piece.shape[3] = dot(ends.before.p, piece.normal);
  piece.parameterRange[0] =
      ::stride::atan2(-dot(inside, piece.planeY), -dot(inside, piece.planeX)) * kDegrees;
  piece.parameterRange[1] = (side > 0.0 ? -ends.turn : ends.turn) * kDegrees;
  piece.length = radius * ends.turn;
}

void describe(const Meeting &meeting, const Ends &ends, PieceKind kind,
              PathObject &piece) noexcept {
  completePlane(piece);
  for (double &value : piece.shape)
    value = 0.0;
  for (double &value : piece.moreShape)
    value = 0.0;
  switch (kind) {
  case PieceKind::Cubic:
    describeCubic(cubicOf(ends), piece);
    break;
  case PieceKind::Quintic:
    describePiece(quinticOf(meeting, ends), piece);
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

/// Gives the switch points of both objects to what they have become.
void shareSwitches(const PathObject &before, const PathObject &after, const Meeting &meeting,
                   const Cuts &cuts, bool replaced, PathObject &first, PathObject &piece,
                   PathObject &second) noexcept {
  clearSwitches(first);
  clearSwitches(second);
  const double left = meeting.before.length - cuts.before;
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    const double way = before.switchPosition[i] * meeting.before.length;
    const bool stays = !replaced && way <= left;
    if (before.switchId[i] == 0)
      continue;
    if (stays)
      (void)putSwitch(first, way / left, before.switchId[i]);
    else if (!putSwitch(piece, smaller((way - left) / piece.length, 0.5), before.switchId[i]))
      (void)putSwitch(replaced ? second : first, replaced ? 0.0 : 1.0, before.switchId[i]);
  }
  const double rest = meeting.after.length - cuts.after;
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    const double way = after.switchPosition[i] * meeting.after.length;
    if (after.switchId[i] == 0)
      continue;
    if (way >= cuts.after)
      (void)putSwitch(second, (way - cuts.after) / rest, after.switchId[i]);
    else if (!putSwitch(piece, larger(1.0 - (cuts.after - way) / piece.length, 0.5),
                        after.switchId[i]))
      (void)putSwitch(second, 0.0, after.switchId[i]);
  }
}

bool mayBe(const Meeting &meeting, const PathObject &before, const PathObject &after,
           const PieceRules &rules) noexcept {
  const Vector3 gap = placeOf(after.start) - placeOf(before.end);
  const bool lines = isLine(meeting.before) && isLine(meeting.after);
  return meeting.turn > larger(rules.leastTurn, kLeastAngle) && meeting.turn <= path::kMaxTurn &&
         rules.distance > 0.0 && norm(gap) <= kGap && (lines || rules.kind != PieceKind::Arc);
}

} // namespace

CornerChange makeCorner(PathObject &before, PathObject &after, const PieceRules &rules,
                        BeforeCorner &known, PathObject &piece) noexcept {
  Meeting meeting{};
  Ends ends{};
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
  PathObject first = before;
  PathObject second = after;
  BeforeCorner rest{roomAfter, false, known.shape};
  const bool replaced = length - ends.cuts.before <= kNothing * length;
  if (replaced)
    first.end = first.start;
  else if (cutEnd(first, shape, ends.cuts.before) != CutError::None)
    return CornerChange::Kept;
  if (cutStart(second, rest.shape, ends.cuts.after, rest.isDescribed) != CutError::None)
    return CornerChange::Kept;
  beginPiece(first, second, piece);
  if (replaced) {
    piece.marks = first.marks;
    for (int32_t i = 0; i < 3; ++i)
      piece.startSlope[i] = slopeAt(before, i, false);
  }
  describe(meeting, ends, rules.kind, piece);
  if (!exact::isPositive(piece.length))
    return CornerChange::Kept;
  shareSwitches(before, after, meeting, ends.cuts, replaced, first, piece, second);
  first.velocityEnd = smaller(first.velocity, piece.velocity);
  before = first;
  after = second;
  known = rest;
  return replaced ? CornerChange::Replaced : CornerChange::Cut;
}

} // namespace stride::cnc
