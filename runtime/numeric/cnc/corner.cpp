#include "runtime/numeric/cnc/corner.hpp"

#include "runtime/numeric/cnc/meeting.hpp"
#include "runtime/numeric/cnc/object_cut.hpp"
#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/path/blend.hpp"

namespace stride::cnc {
namespace {

using exact::larger;
using exact::smaller;
using numeric::dot;
using numeric::norm;

constexpr int kTrials = 48;       ///< For a cut that keeps the tolerances.
constexpr int kSamples = 24;      ///< Of a curve, for its distance from something.
constexpr double kMostBend = 1.0; ///< By which an object may turn within its cut. [rad]
/// Of the acceleration, across the path; the rest is for changes of the velocity.
constexpr double kShare = 0.5;
/// No cut is smaller than this part of the room, whatever the feed needs.
constexpr double kLeastCut = 1e-3;

// ---- the curve for a cut

struct Joint {
  path::Derivatives before; ///< Over the arc length, where the first object is cut.
  path::Derivatives after;
  path::Shape curve;
};

/// False: there is no good curve for this cut; perhaps for a smaller one.
bool join(const Meeting &meeting, double cut, Joint &joint) noexcept {
  joint.before = derivativesAt(meeting.before, meeting.before.length - cut);
  joint.after = derivativesAt(meeting.after, cut);
  joint.after.p = joint.after.p + meeting.lift;
  const double bend = larger(norm(joint.before.d2), norm(joint.after.d2)) * cut;
  if (!(bend <= kMostBend) ||
      !(path::turnBetween(joint.before.d1, joint.after.d1) <= path::kMaxTurn))
    return false;
  joint.curve = path::blendShape(joint.before, joint.after);
  return exact::isPositive(joint.curve.length);
}

double distanceToLine(const path::Shape &line, double from, double to, const Vector3 &p) noexcept {
  const Vector3 off = p - line.v[0];
  const double part = dot(off, line.v[1]) / dot(line.v[1], line.v[1]);
  return norm(off - line.v[1] * smaller(larger(part, from), to));
}

/// The least distance of a place from the part of a curve between two parameters.
double distanceTo(const path::Shape &shape, double from, double to, const Vector3 &p) noexcept {
  if (shape.kind == path::ShapeKind::Line)
    return distanceToLine(shape, from, to, p);
  const auto distance = [&shape, &p](double u) {
    return norm(path::overParameter(shape, u).p - p);
  };
  const double step = (to - from) / kSamples;
  double best = from;
  double least = exact::kInfinity;
  for (int i = 0; i <= kSamples; ++i) {
    const double here = distance(from + step * i);
    if (here < least) {
      least = here;
      best = from + step * i;
    }
  }
  double low = larger(best - step, from);
  double high = smaller(best + step, to);
  for (int i = 0; i < 30; ++i) { // thirds: the distance has one minimum there
    const double first = low + (high - low) / 3.0;
    const double second = high - (high - low) / 3.0;
    (distance(first) < distance(second) ? high : low) =
        distance(first) < distance(second) ? second : first;
  }
  return smaller(least, distance(0.5 * (low + high)));
}

double distanceFromCorner(const Meeting &meeting, const Joint &joint) noexcept {
  return distanceTo(joint.curve, 0.0, 1.0, meeting.place);
}

/// The greatest distance of the curve from what it replaces.
double distanceFromPath(const Meeting &meeting, const Joint &joint, double cut) noexcept {
  const double from = path::parameterAt(meeting.before, meeting.before.length - cut);
  const double to = path::parameterAt(meeting.after, cut);
  double most = 0.0;
  for (int i = 1; i < kSamples; ++i) {
    const Vector3 p = path::overParameter(joint.curve, static_cast<double>(i) / kSamples).p;
    const double before = distanceTo(meeting.before, from, 1.0, p);
    const double after = distanceTo(meeting.after, 0.0, to, p - meeting.lift);
    most = larger(most, smaller(before, after));
  }
  return most;
}

/// By how much the curve exceeds its tolerances; at most 1 if it keeps them.
double excess(const Meeting &meeting, const Joint &joint, double cut,
              const BlendRules &rules) noexcept {
  double most = 0.0;
  if (exact::isfinite(rules.cornerTolerance))
    most = distanceFromCorner(meeting, joint) / rules.cornerTolerance;
  if (exact::isfinite(rules.pathTolerance))
    most = larger(most, distanceFromPath(meeting, joint, cut) / rules.pathTolerance);
  return most;
}

bool isLine(const path::Shape &shape) noexcept { return shape.kind == path::ShapeKind::Line; }

/// The greatest cut that the rules allow, its tolerances left aside: what is a multiple of the cut
/// between lines is so of curves nearly.
double firstCut(const Meeting &meeting, const BlendRules &rules, double room) noexcept {
  const double turn = turnOf(meeting);
  double cut = smaller(rules.cut, room);
  const double needed =
      path::curvatureTimesCut(turn) * meeting.feed * meeting.feed / (kShare * rules.acceleration);
  if (exact::isfinite(rules.acceleration))
    cut = smaller(cut, larger(needed, kLeastCut * room));
  if (isLine(meeting.before) && isLine(meeting.after))
    cut = smaller(cut, rules.cornerTolerance / path::deviationPerCut(turn));
  return cut;
}

/// Finds the curve. The cut, or 0: there is none.
double search(const Meeting &meeting, const BlendRules &rules, double room, Joint &joint) noexcept {
  double cut = firstCut(meeting, rules, room);
  BlendRules tolerances = rules;
  if (isLine(meeting.before) && isLine(meeting.after))
    tolerances.cornerTolerance = exact::kInfinity; // it is kept already
  for (int trial = 0; trial < kTrials && cut > 0.0; ++trial) {
    if (!join(meeting, cut, joint)) {
      cut *= 0.5;
      continue;
    }
    const double over = excess(meeting, joint, cut, tolerances);
    if (over <= 1.0)
      return cut;
    // Between proportional to the cut, as at corners, and to its square, as where curves touch.
    cut *= larger(0.1, 0.99 / exact::sqrt(over));
  }
  return 0.0;
}

// ---- the objects

/// Where switch points are, from the start, when `start` and `end` are cut off.
void keepSwitches(const PathObject &before, double length, double start, double end,
                  PathObject &object) noexcept {
  const double left = length - start - end;
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    object.switchId[i] = before.switchId[i];
    object.switchPosition[i] = before.switchPosition[i];
    if (before.switchId[i] == 0)
      continue;
    const double way = before.switchPosition[i] * length;
    object.switchPosition[i] =
        way <= 0.5 * length ? smaller(way / left, 0.5) : larger(1.0 - (length - way) / left, 0.5);
  }
}

} // namespace

Corner blendCorner(PathObject &before, PathObject &after, const BlendRules &rules,
                   double roomBefore, double roomAfter, PathObject &blend) noexcept {
  Meeting meeting{};
  if (!meet(before, after, meeting))
    return Corner::Kept;
  const double turn = turnOf(meeting);
  if (!(turn > rules.leastTurn))
    return Corner::Smooth;
  if (turn > path::kMaxTurn)
    return Corner::Kept;
  Joint joint{};
  const double cut = search(meeting, rules, smaller(roomBefore, roomAfter), joint);
  PathObject first = before;
  PathObject second = after;
  if (!(cut > 0.0) || cutEnd(first, cut) != CutError::None ||
      cutStart(second, cut) != CutError::None)
    return Corner::Kept;
  keepSwitches(before, meeting.before.length, 0.0, cut, first);
  keepSwitches(after, meeting.after.length, cut, 0.0, second);
  beginPiece(first, second, blend);
  describePiece(joint.curve, blend);
  before = first;
  after = second;
  return Corner::Blended;
}

int32_t blendNext(Blender &blender, const PathObject &object, PathObject (&ready)[2]) noexcept {
  PathObject after = object;
  const double room = kMostCut * object.length;
  int32_t count = 0;
  if (blender.holds) {
    const Corner corner =
        blendCorner(blender.held, after, blender.rules, blender.room, room, ready[1]);
    ready[0] = blender.held;
    count = corner == Corner::Blended ? 2 : 1;
  }
  blender.held = after;
  blender.room = room;
  blender.holds = true;
  return count;
}

int32_t blendEnd(Blender &blender, PathObject &ready) noexcept {
  const bool holds = blender.holds;
  if (holds)
    ready = blender.held;
  blender.holds = false;
  return holds ? 1 : 0;
}

} // namespace stride::cnc
