// Whether an edited CNC program makes the path that it should.

#include "compiler/assets/cnc_edit/path_match.hpp"

#include "compiler/assets/cnc_edit/trace.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

#include <algorithm>
#include <cmath>

namespace stc::gcode {

namespace {

using namespace stride::cnc;

constexpr double kSamePlace = 1e-8; ///< [u], or as a part of the number
constexpr double kSameCurve = 1e-7; ///< Between the ends, likewise.
constexpr double kSamePart = 1e-6;  ///< Of an object's length.

bool isNear(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance * std::max({1.0, std::abs(a), std::abs(b)});
}

bool samePlaces(const PathObject &a, const PathObject &b) {
  for (int axis = 0; axis < kAxes; ++axis)
    if (!isNear(a.start.coordinate[axis], b.start.coordinate[axis], kSamePlace) ||
        !isNear(a.end.coordinate[axis], b.end.coordinate[axis], kSamePlace))
      return false;
  return true;
}

/// Axes that move go by the same law.
bool sameProfiles(const PathObject &a, const PathObject &b) {
  const unsigned differ = a.start.sProfile ^ b.start.sProfile;
  for (unsigned axis = 0; axis < kAxes; ++axis)
    if ((differ >> axis & 1U) != 0 &&
        !isNear(a.start.coordinate[axis], a.end.coordinate[axis], kSamePlace))
      return false;
  return true;
}

bool sameCurve(const PathObject &a, const PathObject &b) {
  if (!isCurve(a.moveType))
    return true;
  ObjectShape first{};
  ObjectShape second{};
  if (shapeOf(a, first) != ShapeError::None || shapeOf(b, second) != ShapeError::None)
    return false;
  for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const auto at = [part](const ObjectShape &shape) {
      const double u = stride::path::parameterAt(shape.shape, part * shape.shape.length);
      return stride::path::overParameter(shape.shape, u).p;
    };
    const Vector3 p = at(first);
    const Vector3 q = at(second);
    if (!isNear(p.x, q.x, kSameCurve) || !isNear(p.y, q.y, kSameCurve) ||
        !isNear(p.z, q.z, kSameCurve))
      return false;
  }
  return true;
}

/// Switch points in the order of their places.
std::vector<std::pair<double, int16_t>> switchesOf(const PathObject &object) {
  std::vector<std::pair<double, int16_t>> switches;
  for (int i = 0; i <= kMostSwitches; ++i)
    if (object.switchId[i] != 0)
      switches.emplace_back(object.switchPosition[i], object.switchId[i]);
  std::sort(switches.begin(), switches.end());
  return switches;
}

bool sameSwitches(const PathObject &a, const PathObject &b) {
  const auto first = switchesOf(a);
  const auto second = switchesOf(b);
  return std::equal(first.begin(), first.end(), second.begin(), second.end(),
                    [](const auto &one, const auto &other) {
                      return one.second == other.second &&
                             std::abs(one.first - other.first) <= kSamePart;
                    });
}

bool sameLimits(const PathObject &a, const PathObject &b) {
  return std::equal(std::begin(a.limits), std::end(a.limits), std::begin(b.limits),
                    [](const AxisLimits &one, const AxisLimits &other) {
                      return one.velocity == other.velocity &&
                             one.acceleration == other.acceleration &&
                             one.deceleration == other.deceleration;
                    });
}

bool sameModes(const PathObject &a, const PathObject &b) {
  return a.velocity == b.velocity && a.acceleration == b.acceleration &&
         a.deceleration == b.deceleration && a.toolRadius == b.toolRadius &&
         a.cornerDistance == b.cornerDistance && a.marks == b.marks && a.features == b.features &&
         std::equal(std::begin(a.additional), std::end(a.additional), std::begin(b.additional)) &&
         a.smoothAxes == b.smoothAxes && a.probe == b.probe && a.planar == b.planar &&
         sameLimits(a, b) && sameProfiles(a, b);
}

bool sameFunction(const PathObject &a, const PathObject &b) {
  return a.switchId[0] == b.switchId[0] && a.parameterRange[0] == b.parameterRange[0] &&
         a.parameterRange[1] == b.parameterRange[1];
}

bool same(const PathObject &a, const PathObject &b) {
  if (a.moveType != b.moveType || !samePlaces(a, b))
    return false;
  if (a.moveType == MoveType::Function)
    return sameFunction(a, b);
  return a.moveType == MoveType::Jump || (sameModes(a, b) && sameCurve(a, b) && sameSwitches(a, b));
}

} // namespace

void noteWhatGoesOn(Path &path) {
  constexpr unsigned kTool = kToolLeft | kToolRight;
  constexpr unsigned kCorner = kSmooth | kRound;
  unsigned now = 0;
  const auto begins = [&now](unsigned marks, unsigned kinds) {
    if ((marks & kinds) != 0)
      now = (now & ~kinds) | (marks & kinds);
  };
  for (PathObject &object : path) {
    const unsigned marks = object.marks;
    begins(marks, kTool);
    begins(marks, kCorner);
    begins(marks, kAvoidLoops);
    object.marks = static_cast<uint8_t>(now);
    object.toolRadius = (now & kTool) != 0 ? object.toolRadius : 0;
    object.cornerDistance = (now & kCorner) != 0 ? object.cornerDistance : 0;
    object.smoothAxes &= static_cast<uint16_t>((1U << kRangeBegins) - 1U);
    now &= ~((marks & kEndToolCorrection) != 0 ? kTool : 0U);
    now &= ~((marks & kEndSmoothing) != 0 ? kCorner : 0U);
    now &= ~((marks & kEndAvoidLoops) != 0 ? unsigned{kAvoidLoops} : 0U);
  }
}

std::optional<size_t> firstDifference(const Path &path, const Path &other) {
  const size_t both = std::min(path.size(), other.size());
  for (size_t i = 0; i < both; ++i)
    if (!same(path[i], other[i]))
      return i;
  return path.size() == other.size() ? std::nullopt : std::optional(both);
}

std::optional<Path> pathOfText(const std::string &text, const CncSettings &settings) {
  Sources sources;
  Diagnostics unseen; // an edit that is wrong is another path
  auto program = readCnc(sources.file(sources.add("edited.cnc", text)), unseen);
  if (!program)
    return std::nullopt;
  assumeVariables(*program);
  program->settings.start = settings.start;
  program->settings.softMotion3 = settings.softMotion3;
  Path path;
  const CncDecoded decoded = decodeCnc(*program, [&path](const PathObject &object) {
    path.push_back(object);
    return path.size() < 4 * kMostCncObjects;
  });
  if (decoded.end != CncEnd::Complete && decoded.end != CncEnd::Endless)
    return std::nullopt;
  return path;
}

} // namespace stc::gcode
