// Lines, arcs and ellipses of the decoder.
#include "runtime/iec/math.h"
#include "runtime/numeric/cnc/decoder_internal.hpp"
#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/path/shape.hpp"

namespace stride::cnc {
namespace {

using numeric::dot;
using numeric::kZero;
using numeric::norm;

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
/// So far a centre may be off where ends are programmed with few decimals, as a part of the radius.
constexpr double kCentreTolerance = 0.01;
/// Ends as close as this are the same, as a part of what the numbers are.
constexpr double kSame = 1e-9;

/// The letters of axes in the order of AxisBit; the sixth additional one has none.
constexpr char kAxisLetters[kAxes] = {'X', 'Y', 'Z', 'A', 'B', 'C', 'P', 'Q', 'U', 'V', 'W', 0};

/// An axis's place in PathObject::limits: Z, A, B, C, P, Q, U, V, W.
int32_t limitIndex(int32_t axis) noexcept { return axis - kAxisZ; }

struct Place {
  double x, y;
};

Place operator-(const Place &a, const Place &b) noexcept { return {a.x - b.x, a.y - b.y}; }
double dotOf(const Place &a, const Place &b) noexcept { return a.x * b.x + a.y * b.y; }
double lengthOf(const Place &a) noexcept { return norm({a.x, a.y, 0.0}); }

/// An angle in degrees from 0 to 360.
double degreesOf(double y, double x) noexcept {
  double angle = ::stride::atan2(y, x) / kDegree;
  if (angle < 0.0)
    angle += 360.0;
  return angle < 360.0 ? angle : 0.0;
}

/// A circle through two places.
struct Circle {
  Place centre;
  double radius;
  double start; ///< Angle. [degrees]
  double sweep; ///< Clockwise positive. [degrees]
};

/// Start angle and sweep of a circle whose radius and centre are known.
void measure(const Place &start, const Place &end, bool full, bool clockwise,
             Circle &circle) noexcept {
  const Place from = start - circle.centre;
  const Place to = end - circle.centre;
  circle.start = degreesOf(from.y, from.x);
  double turn = 360.0;
  if (!full) {
    // Of the turn from one to the other, without the difference of two large angles.
    turn = degreesOf(from.x * to.y - from.y * to.x, dotOf(from, to));
    if (clockwise)
      turn = 360.0 - turn;
    if (turn == 0.0)
      turn = 360.0;
  }
  circle.sweep = clockwise ? turn : -turn;
}

/// The circle around a centre, which is put where both ends are equally far.
bool circleAround(const Place &start, const Place &end, const Place &centre, bool clockwise,
                  Circle &circle, Note &why) noexcept {
  const Place chord = end - start;
  const double chordLength = lengthOf(chord);
  const double radius = lengthOf(start - centre);
  why = kNoteEmptyArc;
  const double size = exact::larger(radius, exact::larger(lengthOf(start), lengthOf(end)));
  if (!(radius > kSame * size))
    return false;
  const bool full = chordLength <= kSame * size;
  circle.centre = centre;
  if (!full) {
    const Place middle{(start.x + end.x) / 2, (start.y + end.y) / 2};
    const Place off = centre - middle;
    const double along = dotOf(off, chord) / chordLength;
    why = kNoteCentreOff;
    if (!(exact::fabs(along) <= kCentreTolerance * radius))
      return false;
    circle.centre = {centre.x - chord.x * along / chordLength,
                     centre.y - chord.y * along / chordLength};
  }
  circle.radius = full ? radius : lengthOf(start - circle.centre);
  measure(start, end, full, clockwise, circle);
  return circle.radius > kSame * size;
}

/// The circle with a radius, of whose two arcs the shorter one.
bool circleOfRadius(const Place &start, const Place &end, double radius, bool clockwise,
                    Circle &circle, Note &why) noexcept {
  const Place chord = end - start;
  const double half = lengthOf(chord) / 2;
  why = kNoteEmptyArc;
  if (!(half > kSame * exact::larger(lengthOf(start), lengthOf(end))))
    return false;
  why = kNoteRadiusTooSmall;
  if (!(radius >= half * (1.0 - kCentreTolerance)))
    return false;
  const double used = exact::larger(radius, half);
  const double height = exact::sqrt((used - half) * (used + half));
  const double side = (clockwise ? 1.0 : -1.0) * height / (2 * half);
  circle.centre = {(start.x + end.x) / 2 + chord.y * side, (start.y + end.y) / 2 - chord.x * side};
  circle.radius = used;
  measure(start, end, false, clockwise, circle);
  return true;
}

/// A place in the frame of the object.
Place inPlane(const PathObject &object, const Vector3 &place) noexcept {
  return {dot(object.planeX, place), dot(object.planeY, place)};
}

/// What an arc is measured in: the plane, turned and stretched so that an ellipse is a circle.
struct Stretch {
  double cosine, sine; ///< Of the main axis's direction.
  double ratio;        ///< Other axis by main axis.
  [[nodiscard]] Place from(const Place &p) const noexcept {
    return {cosine * p.x + sine * p.y, (cosine * p.y - sine * p.x) / ratio};
  }
  [[nodiscard]] Place to(const Place &p) const noexcept {
    return {cosine * p.x - sine * p.y * ratio, sine * p.x + cosine * p.y * ratio};
  }
};

void storeCircle(const Circle &circle, bool clockwise, PathObject &object) noexcept {
  object.moveType = clockwise ? MoveType::Clockwise : MoveType::Counterclockwise;
  object.shape[0] = circle.centre.x;
  object.shape[1] = circle.centre.y;
  object.shape[2] = circle.radius;
  object.shape[3] = dot(object.normal, placeOf(object.start));
}

void storeEllipse(const Circle &circle, const Stretch &stretch, double direction, bool clockwise,
                  PathObject &object) noexcept {
  object.moveType = clockwise ? MoveType::EllipseClockwise : MoveType::EllipseCounterclockwise;
  const Place centre = stretch.to(circle.centre);
  object.shape[0] = centre.x;
  object.shape[1] = centre.y;
  object.shape[2] = stretch.cosine;
  object.shape[3] = stretch.sine;
  object.shape[4] = circle.radius;
  object.shape[5] = circle.radius * stretch.ratio;
  object.shape[6] = direction;
  object.shape[7] = stretch.ratio;
}

/// Length of an arc that is complete but for it.
double arcLength(const PathObject &object) noexcept {
  const bool ellipse = object.moveType == MoveType::EllipseClockwise ||
                       object.moveType == MoveType::EllipseCounterclockwise;
  const double angle = object.parameterRange[0] * kDegree;
  const double sweep = -object.parameterRange[1] * kDegree;
  const double climb =
      object.planar ? 0.0 : dot(object.normal, placeOf(object.end) - placeOf(object.start));
  if (!ellipse)
    return norm({object.shape[2] * sweep, climb, 0.0});
  const Vector3 first = {object.shape[2] * object.shape[4], object.shape[3] * object.shape[4], 0.0};
  const Vector3 second = {-object.shape[3] * object.shape[5], object.shape[2] * object.shape[5],
                          0.0};
  return path::ellipseShape(kZero, first, second, angle, sweep, {0.0, 0.0, climb}).length;
}

/// The direction of the curve of a spline at its start or end.
Vector3 splineDirection(const PathObject &object, bool atEnd) noexcept {
  const double u = object.parameterRange[atEnd ? 1 : 0];
  double d[3] = {0.0, 0.0, 0.0};
  if (object.moveType == MoveType::Spline) {
    for (int32_t axis = 0; axis < 2; ++axis)
      d[axis] = object.shape[4 * axis + 1] +
                u * (2 * object.shape[4 * axis + 2] + 3 * u * object.shape[4 * axis + 3]);
    return unit(object.planeX * d[0] + object.planeY * d[1]);
  }
  for (int32_t axis = 0; axis < 3; ++axis)
    for (int32_t k = 5; k >= 1; --k) {
      const int32_t at = 6 * axis + k;
      d[axis] = d[axis] * u + k * (at < 8 ? object.shape[at] : object.moreShape[at - 8]);
    }
  return unit({d[0], d[1], d[2]});
}

Vector3 arcDirection(const PathObject &object, bool atEnd) noexcept {
  const bool ellipse = object.moveType == MoveType::EllipseClockwise ||
                       object.moveType == MoveType::EllipseCounterclockwise;
  const double phi =
      (object.parameterRange[0] - (atEnd ? object.parameterRange[1] : 0.0)) * kDegree;
  const double sign = object.parameterRange[1] > 0.0 ? -1.0 : 1.0;
  const double a = -::stride::sin(phi) * sign * (ellipse ? object.shape[4] : 1.0);
  const double b = ::stride::cos(phi) * sign * (ellipse ? object.shape[5] : 1.0);
  const double cosine = ellipse ? object.shape[2] : 1.0;
  const double sine = ellipse ? object.shape[3] : 0.0;
  return unit(object.planeX * (a * cosine - b * sine) + object.planeY * (a * sine + b * cosine));
}

} // namespace

Vector3 unit(const Vector3 &vector) noexcept {
  const double length = norm(vector);
  return exact::isPositive(length) ? vector * (1.0 / length) : kZero;
}

Vector3 centreOf(const Decoder &decoder, const Sentence &sentence, const Vector3 &start,
                 bool inPlane) noexcept {
  const bool absolute = decoder.centreAbsolute;
  Vector3 said = absolute ? programPlace(decoder) : kZero;
  double *const parts[3] = {&said.x, &said.y, &said.z};
  bool named = false;
  for (int32_t i = 0; i < (inPlane ? 2 : 3); ++i)
    if (const auto letter = static_cast<char>('I' + i); has(sentence, letter)) {
      *parts[i] = get(sentence, letter);
      named = true;
    }
  if (!named)
    return start;
  return absolute ? machinePlace(decoder, said) : start + machineWay(decoder, said);
}

bool namesAxis(const Sentence &sentence) noexcept {
  for (const char letter : kAxisLetters)
    if (letter != 0 && has(sentence, letter))
      return true;
  return false;
}

/// X, Y and Z of a target in coordinates that are turned or scaled.
void placeInSystem(const Decoder &decoder, const Sentence &sentence, Position &target) noexcept {
  Vector3 said = decoder.relative ? kZero : programPlace(decoder);
  double *const parts[3] = {&said.x, &said.y, &said.z};
  bool named = false;
  for (int32_t axis = kAxisX; axis <= kAxisZ; ++axis)
    if (has(sentence, kAxisLetters[axis])) {
      *parts[axis] = get(sentence, kAxisLetters[axis]);
      named = true;
    }
  if (!named)
    return;
  const Vector3 to = decoder.relative ? placeOf(decoder.here) + machineWay(decoder, said)
                                      : machinePlace(decoder, said);
  target.coordinate[kAxisX] = to.x;
  target.coordinate[kAxisY] = to.y;
  target.coordinate[kAxisZ] = to.z;
}

/// A, B and C of a target, where they are angles in coordinates that are turned.
void turnInSystem(const Decoder &decoder, const Sentence &sentence, Position &target) noexcept {
  double value[3] = {};
  bool named[3] = {};
  for (int32_t i = 0; i < 3; ++i) {
    named[i] = has(sentence, kAxisLetters[kAxisA + i]);
    value[i] = named[i] ? get(sentence, kAxisLetters[kAxisA + i]) : 0.0;
  }
  if (named[0] || named[1] || named[2])
    turnOrientation(decoder, value, named, target);
}

Position targetOf(Decoder &decoder, const Sentence &sentence, bool periodic) noexcept {
  Position target = decoder.here;
  const bool placed = decoder.turned || decoder.scaled;
  const bool angles = decoder.turned && decoder.orientation != Orientation::Axes;
  if (placed)
    placeInSystem(decoder, sentence, target);
  if (angles)
    turnInSystem(decoder, sentence, target);
  for (int32_t axis = 0; axis < kAxes; ++axis) {
    const char letter = kAxisLetters[axis];
    if (letter == 0 || !has(sentence, letter))
      continue;
    decoder.axes = static_cast<uint16_t>(decoder.axes | (1U << axis));
    if ((placed && axis <= kAxisZ) || (angles && axis >= kAxisA && axis <= kAxisC))
      continue;
    const double here = decoder.here.coordinate[axis];
    const double value = get(sentence, letter);
    double &to = target.coordinate[axis];
    to = decoder.relative ? here + value : value + decoder.shift[axis];
    const bool turns = periodic && !decoder.relative && axis > kAxisZ && axis < kAxisSixth;
    const double period = turns ? decoder.period[limitIndex(axis)] : 0.0;
    if (period <= 0.0)
      continue;
    // Half a period goes upwards.
    double way = exact::fmod(to - here, period);
    if (way > period / 2)
      way -= period;
    else if (way <= -period / 2)
      way += period;
    to = here + way;
  }
  return target;
}

PathObject beginObject(Decoder &decoder, const Sentence &sentence, MoveType type,
                       const Position &end) noexcept {
  PathObject object;
  __builtin_memset(&object, 0, sizeof object);
  const bool rapid = type == MoveType::Positioning;
  const auto orOf = [rapid](double special, double usual) {
    return rapid && special > 0.0 ? special : usual;
  };
  object.number = ++decoder.objects;
  object.sourceLine = object.sentence = sentence.number;
  object.moveType = type;
  object.start = decoder.here;
  object.end = end;
  object.start.axes = object.end.axes = decoder.axes;
  object.start.sProfile = object.end.sProfile = decoder.profile;
  object.toolRadius = decoder.radius;
  object.cornerDistance = decoder.cornerDistance;
  object.velocity = orOf(decoder.rapidVelocity, decoder.velocity);
  object.velocityEnd = rapid ? 0.0 : object.velocity;
  object.acceleration = orOf(decoder.rapidAcceleration, decoder.acceleration);
  object.deceleration = orOf(decoder.rapidDeceleration, decoder.deceleration);
  object.marks = decoder.marks;
  decoder.marks = 0;
  object.smoothAxes = decoder.smoothAxes;
  decoder.smoothAxes &= static_cast<uint16_t>((1U << kRangeBegins) - 1U);
  object.parameterRange[1] = 1.0;
  const Frame frame = machineFrame(decoder);
  object.planeX = frame.x;
  object.planeY = frame.y;
  object.normal = frame.normal;
  object.features = decoder.features;
  object.program = decoder.program;
  for (int32_t i = 0; i < kAdditionalParameters; ++i)
    object.additional[i] = decoder.additional[i];
  for (int32_t i = 0; i < kLimitedAxes; ++i)
    object.limits[i] = decoder.limits[i];
  object.probe = static_cast<uint16_t>(sentence.probe);
  object.planar = decoder.planar;
  object.modes = static_cast<uint8_t>(decoder.modes | (decoder.planar ? 0U : kInSpace));
  putSystem(decoder, object);
  object.tool = decoder.tool;
  return object;
}

void makeLine(PathObject &object) noexcept {
  const Vector3 way = placeOf(object.end) - placeOf(object.start);
  const bool flat = object.planar && (way.x != 0.0 || way.y != 0.0);
  object.length = norm({way.x, way.y, flat ? 0.0 : way.z});
  object.planar = flat;
  if (object.length != 0.0)
    return;
  // Only additional axes: the length counts in theirs.
  for (int32_t axis = kAxisA; axis < kAxes; ++axis)
    object.length =
        norm({object.length, object.end.coordinate[axis] - object.start.coordinate[axis], 0.0});
}

void makeArc(const Decoder &decoder, const Sentence &sentence, bool ellipse, PathObject &object,
             Decoded &result) noexcept {
  const bool clockwise =
      object.moveType == MoveType::Clockwise || object.moveType == MoveType::EllipseClockwise;
  const double direction = (ellipse && has(sentence, 'K') ? get(sentence, 'K') : 0.0) +
                           (ellipse && decoder.turned ? turnAboutZ(decoder) : 0.0);
  const Stretch stretch{ellipse ? ::stride::cos(direction * kDegree) : 1.0,
                        ellipse ? ::stride::sin(direction * kDegree) : 0.0,
                        ellipse ? get(sentence, 'R') : 1.0};
  const Place start = stretch.from(inPlane(object, placeOf(object.start)));
  const Place end = stretch.from(inPlane(object, placeOf(object.end)));
  Circle circle{};
  Note why = kNoteCentreOff;
  bool good = false;
  if (!ellipse && has(sentence, 'R'))
    good = circleOfRadius(start, end, get(sentence, 'R') * scaleOfPlane(decoder), clockwise, circle,
                          why);
  else
    good = circleAround(
        start, end,
        stretch.from(inPlane(object, centreOf(decoder, sentence, placeOf(object.start), ellipse))),
        clockwise, circle, why);
  if (!good) {
    note(result, why, sentence.functionAt);
    object.moveType = MoveType::Line;
    makeLine(object);
    return;
  }
  if (ellipse)
    storeEllipse(circle, stretch, direction, clockwise, object);
  else
    storeCircle(circle, clockwise, object);
  object.parameterRange[0] = circle.start;
  object.parameterRange[1] = circle.sweep;
  object.length = arcLength(object);
}

void turnTarget(const Decoder &decoder, const Sentence &sentence, bool clockwise,
                Position &target) noexcept {
  const Vector3 start = placeOf(decoder.here);
  const Vector3 centre = centreOf(decoder, sentence, start, false);
  const Vector3 radial = start - centre;
  const Frame frame = machineFrame(decoder);
  const double x = dot(frame.x, radial);
  const double y = dot(frame.y, radial);
  const double angle = get(sentence, 'T') * kDegree * (clockwise ? -1.0 : 1.0);
  const double cosine = ::stride::cos(angle);
  const double sine = ::stride::sin(angle);
  const Vector3 way = frame.x * (x * cosine - y * sine - x) + frame.y * (x * sine + y * cosine - y);
  const double parts[3] = {way.x, way.y, way.z};
  for (int32_t axis = kAxisX; axis <= kAxisZ; ++axis)
    target.coordinate[axis] += parts[axis];
}

Vector3 directionOf(const PathObject &object, bool atEnd) noexcept {
  switch (object.moveType) {
  case MoveType::Line:
  case MoveType::Positioning:
    return unit(placeOf(object.end) - placeOf(object.start));
  case MoveType::Clockwise:
  case MoveType::Counterclockwise:
  case MoveType::EllipseClockwise:
  case MoveType::EllipseCounterclockwise:
    return arcDirection(object, atEnd);
  case MoveType::Spline:
  case MoveType::Spline3d:
    return splineDirection(object, atEnd);
  case MoveType::Jump:
  case MoveType::Function:
    break;
  }
  return kZero;
}

void placeSwitches(const Switch *switches, int32_t count, PathObject &object) noexcept {
  for (int32_t i = 0; i < count; ++i) {
    double part = switches[i].position;
    if (switches[i].way) {
      part = object.length > 0.0 ? part / object.length : 0.0;
      if (part < 0.0)
        part += 1.0;
    }
    object.switchPosition[i] = part < 0.0 ? 0.0 : part > 1.0 ? 1.0 : part;
    object.switchId[i] = switches[i].id;
  }
}

} // namespace stride::cnc
