#include "runtime/numeric/cnc/processors/limit_circular.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {
namespace {

using exact::smaller;
using numeric::norm;

bool isLimit(double value) noexcept { return exact::isfinite(value) && value >= 0.0; }

/// What counts of an object.
struct Bend {
  Vector3 start; ///< Curvature there. [1/u]
  Vector3 end;
  bool known; ///< A line or an arc of a circle.
  bool round; ///< An arc.
};

Vector3 curvatureAt(const path::Shape &shape, double u) noexcept {
  return path::overLength(path::overParameter(shape, u)).d2;
}

Bend bendOf(const PathObject &object) noexcept {
  Bend bend{numeric::kZero, numeric::kZero, false, false};
  bend.round =
      object.moveType == MoveType::Clockwise || object.moveType == MoveType::Counterclockwise;
  bend.known =
      bend.round || object.moveType == MoveType::Line || object.moveType == MoveType::Positioning;
  ObjectShape shape{};
  if (bend.round) {
    bend.known = bend.round = shapeOf(object, shape) == ShapeError::None && shape.length > 0.0;
    if (bend.round) {
      bend.start = curvatureAt(shape.shape, 0.0);
      bend.end = curvatureAt(shape.shape, 1.0);
    }
  }
  return bend;
}

double mostOn(const LimitCircular &limit, double curvature) noexcept {
  double most = exact::kInfinity;
  if (limit.acceleration > 0.0)
    most = exact::sqrt(limit.acceleration / curvature);
  if (limit.perRadius > 0.0)
    most = smaller(most, limit.perRadius / curvature);
  return most;
}

} // namespace

Step next(LimitCircular &limit, const Source &source, Output &output) noexcept {
  if (!isLimit(limit.acceleration) || !isLimit(limit.jump) || !isLimit(limit.perRadius)) {
    output.error = StreamError::InvalidParameter;
    return Step::Failed;
  }
  PathObject object = source.object;
  const Bend bend = bendOf(object);
  const double most = bend.round ? mostOn(limit, norm(bend.start)) : exact::kInfinity;
  if (bend.round) {
    object.velocity = smaller(object.velocity, most);
    object.velocityEnd = smaller(object.velocityEnd, most);
  }
  if (limit.holds) {
    PathObject &held = limit.held;
    held.velocityEnd = smaller(held.velocityEnd, most);
    const double change = norm(bend.start - limit.curvature);
    if (limit.known && bend.known && limit.jump > 0.0 && change > 0.0)
      held.velocityEnd = smaller(held.velocityEnd, exact::sqrt(limit.jump / change));
  }
  if (limit.holds && put(output, limit.held) == nullptr)
    return Step::Again;
  limit.holds = isMotion(object);
  if (!limit.holds)
    return put(output, object) != nullptr ? Step::Took : Step::Again;
  limit.held = object;
  limit.curvature = bend.end;
  limit.known = bend.known;
  return Step::Took;
}

Step finish(LimitCircular &limit, Ending /*ending*/, Output &output) noexcept {
  if (limit.holds && put(output, limit.held) == nullptr)
    return Step::Again;
  limit.holds = false;
  return Step::Took;
}

} // namespace stride::cnc
