#include "runtime/numeric/cnc/processors/corner_path.hpp"

namespace stride::cnc {
namespace {

PathObject &held(CornerPath &path) noexcept { return path.objects[path.last]; }
PathObject &following(CornerPath &path) noexcept { return path.objects[1 - path.last]; }

/// Puts out what comes before `following`. False: there is more to put out.
bool flush(CornerPath &path, Output &output) noexcept {
  if (path.holds) {
    if (put(output, held(path)) == nullptr)
      return false;
    path.holds = false;
  }
  if (path.hasPiece) {
    if (put(output, path.piece) == nullptr)
      return false;
    path.hasPiece = false;
  }
  for (; path.done < path.count; ++path.done)
    if (put(output, path.functions[path.done]) == nullptr)
      return false;
  path.count = path.done = 0;
  return true;
}

double distanceOf(const CornerPath &path) noexcept {
  const PathObject &held = path.objects[path.last];
  switch (path.rule) {
  case DistanceRule::ToolRadiusElse:
    return path.distance != 0.0 ? path.distance : held.toolRadius;
  case DistanceRule::CornerDistanceAdded:
    return path.distance + held.cornerDistance;
  case DistanceRule::ToolRadiusAdded:
    break;
  }
  return path.distance + held.toolRadius;
}

/// Changes the corner between `held` and `following`, if it is one to be changed.
void changeCorner(CornerPath &path) noexcept {
  if (!path.holds || !path.heldActive || !path.active)
    return;
  const PieceRules rules{path.kind, distanceOf(path), path.symmetrical, path.leastTurn};
  PathObject &next = following(path);
  path.knownNext = path.knownHeld;
  const CornerChange change = makeCorner(held(path), next, rules, path.knownNext, path.piece);
  if (change == CornerChange::Kept)
    return;
  path.hasPiece = true;
  path.holds = change == CornerChange::Cut;
  for (int32_t i = 0; i < path.count; ++i) {
    path.functions[i].start = next.start;
    path.functions[i].end = next.start;
  }
}

/// An M function or a dwell: true if it waits for what the corner becomes.
bool waits(CornerPath &path, const PathObject &object) noexcept {
  if (!path.passesFunctions || !path.holds || !path.heldActive ||
      object.moveType != MoveType::Function || path.count >= kMostAtCorner || path.done != 0)
    return false;
  path.functions[path.count] = object;
  ++path.count;
  return true;
}

} // namespace

void startCorners(CornerPath &path) noexcept {
  path.last = path.count = path.done = 0;
  path.active = path.heldActive = path.holds = path.hasPiece = path.hasFollowing = false;
}

Step nextCorner(CornerPath &path, uint8_t beginMark, const PathObject &object,
                Output &output) noexcept {
  if (!exact::isfinite(path.distance) || !exact::isfinite(path.leastTurn)) {
    output.error = StreamError::InvalidParameter;
    return Step::Failed;
  }
  const bool ends = (object.marks & kEndSmoothing) != 0;
  if (!path.hasFollowing) {
    path.active = path.active || (object.marks & beginMark) != 0;
    if (waits(path, object)) {
      path.heldActive = path.heldActive && !ends;
      path.active = path.active && !ends;
      return Step::Took;
    }
    copyObject(following(path), object);
    path.knownNext.room = -1.0;
    path.knownNext.isDescribed = false;
    path.hasFollowing = true;
    changeCorner(path);
  }
  if (!flush(path, output))
    return Step::Again;
  path.hasFollowing = false;
  path.active = path.active && !ends;
  if (isMotion(object)) {
    path.last = 1 - path.last;
    path.knownHeld = path.knownNext;
    path.heldActive = path.active;
    path.holds = true;
    return Step::Took;
  }
  path.heldActive = false;
  // Nothing is kept: what cannot be put out now is asked for again.
  return put(output, object) != nullptr ? Step::Took : Step::Again;
}

Step finishCorners(CornerPath &path, Output &output) noexcept {
  path.hasFollowing = false;
  path.heldActive = false;
  return flush(path, output) ? Step::Took : Step::Again;
}

} // namespace stride::cnc
