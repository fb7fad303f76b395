// What a CNC program amounts to.

#include "compiler/assets/cnc/cnc_source.hpp"

#include <algorithm>
#include <cmath>

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

/// The place of a curve in its frame, `part` from 0 to 1 of its parameter.
void placeOf(const PathObject &o, double part, double &x, double &y) {
  if (o.moveType == MoveType::Spline) {
    const auto value = [&o, part](int at) {
      const double *c = o.shape + at;
      return c[0] + part * (c[1] + part * (c[2] + part * c[3]));
    };
    x = value(0);
    y = value(4);
    return;
  }
  const double phi = (o.parameterRange[0] - part * o.parameterRange[1]) * M_PI / 180;
  if (o.moveType == MoveType::Clockwise || o.moveType == MoveType::Counterclockwise) {
    x = o.shape[0] + o.shape[2] * std::cos(phi);
    y = o.shape[1] + o.shape[2] * std::sin(phi);
    return;
  }
  const double a = o.shape[4] * std::cos(phi);
  const double b = o.shape[5] * std::sin(phi);
  x = o.shape[0] + o.shape[2] * a - o.shape[3] * b;
  y = o.shape[1] + o.shape[3] * a + o.shape[2] * b;
}

void widenByCurve(CncInfo &info, const PathObject &o) {
  for (int i = 1; i < kPlaces; ++i) {
    const double part = static_cast<double>(i) / kPlaces;
    double x = 0;
    double y = 0;
    placeOf(o, part, x, y);
    const double *start = o.start.coordinate;
    const double height = o.normal.x * start[0] + o.normal.y * start[1] + o.normal.z * start[2];
    const double way[3] = {o.end.coordinate[0] - start[0], o.end.coordinate[1] - start[1],
                           o.end.coordinate[2] - start[2]};
    const double climb = o.normal.x * way[0] + o.normal.y * way[1] + o.normal.z * way[2];
    const Vector3 place = o.planeX * x + o.planeY * y + o.normal * (height + part * climb);
    double coordinate[kAxes];
    std::copy(std::begin(o.start.coordinate), std::end(o.start.coordinate), coordinate);
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

CncInfo infoOf(const CncProgram &program) {
  CncInfo info;
  info.sentences = static_cast<size_t>(
      std::count_if(program.words.begin(), program.words.end(),
                    [](const CncWord &word) { return word.word.letter == kEndOfSentence; }));
  std::copy(std::begin(program.settings.start.coordinate),
            std::end(program.settings.start.coordinate), info.least);
  std::copy(std::begin(info.least), std::end(info.least), info.most);
  const CncDecoded decoded = decodeCnc(program, [&info](const PathObject &object) {
    measure(info, object);
    return true;
  });
  info.endless = decoded.end == CncEnd::Endless;
  info.complete = decoded.end == CncEnd::Complete;
  return info;
}

} // namespace stc
