// What a CNC program amounts to.

#include "compiler/assets/cnc/cnc_source.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

#include <algorithm>

namespace stc {

namespace {

using namespace stride::cnc;

/// Places of a curve that its bounds are taken from; to about 1e-3 of its size.
constexpr int kPlaces = 64;

void widen(CncInfo &info, const double (&coordinate)[kAxes]) {
  for (int axis = 0; axis < kAxes; ++axis) {
    info.least[axis] = std::min(info.least[axis], coordinate[axis]);
    info.most[axis] = std::max(info.most[axis], coordinate[axis]);
  }
}

void widenByCurve(CncInfo &info, const PathObject &object) {
  ObjectShape described;
  const ShapeError error = outlineOf(object, described);
  if (error != ShapeError::None && error != ShapeError::Ends)
    return;
  for (int i = 1; i < kPlaces; ++i) {
    const double part = static_cast<double>(i) / kPlaces;
    const Vector3 place = stride::path::overParameter(described.shape, part).p;
    double coordinate[kAxes];
    std::copy(std::begin(object.start.coordinate), std::end(object.start.coordinate), coordinate);
    coordinate[kAxisX] = place.x;
    coordinate[kAxisY] = place.y;
    coordinate[kAxisZ] = place.z;
    widen(info, coordinate);
  }
}

void measure(CncInfo &info, const PathObject &object) {
  ++info.objects;
  info.axes = static_cast<uint16_t>(info.axes | object.end.axes);
  widen(info, object.end.coordinate);
  if (object.moveType == MoveType::Function) {
    ++info.functions;
    return;
  }
  if (object.moveType == MoveType::Jump)
    return;
  if (isCurve(object.moveType))
    widenByCurve(info, object);
  (object.moveType == MoveType::Positioning ? info.rapidLength : info.length) += object.length;
  const bool first = info.mostVelocity == 0 && info.leastVelocity == 0;
  info.leastVelocity = first ? object.velocity : std::min(info.leastVelocity, object.velocity);
  info.mostVelocity = std::max(info.mostVelocity, object.velocity);
}

} // namespace

CncInfo infoOf(const CncProgram &program, Diagnostics &diagnostics) {
  CncInfo info;
  info.sentences = static_cast<size_t>(
      std::count_if(program.words.begin(), program.words.end(),
                    [](const CncWord &word) { return word.word.letter == kEndOfSentence; }));
  std::copy(std::begin(program.settings.start.coordinate),
            std::end(program.settings.start.coordinate), info.least);
  std::copy(std::begin(info.least), std::end(info.least), info.most);
  const bool processed = !program.settings.preprocess.empty();
  std::vector<PathObject> objects;
  CncOrigins origins;
  const CncDecoded decoded = decodeCnc(
      program,
      [&](const PathObject &object) {
        if (!processed) {
          measure(info, object);
          return true;
        }
        if (objects.size() == kMostCncObjects)
          return false;
        objects.push_back(object);
        return true;
      },
      processed ? &origins : nullptr);
  info.endless = decoded.end == CncEnd::Endless || decoded.end == CncEnd::Refused;
  info.complete = decoded.end == CncEnd::Complete;
  if (const auto path = preprocessCnc(program, std::move(objects), origins, diagnostics))
    for (const PathObject &object : *path)
      measure(info, object);
  return info;
}

} // namespace stc
