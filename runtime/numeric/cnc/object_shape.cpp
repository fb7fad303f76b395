#include "runtime/numeric/cnc/object_shape.hpp"

#include "runtime/numeric/quarter_turns.hpp"

namespace stride::cnc {
namespace {

using numeric::cross;
using numeric::dot;
using numeric::kDegree;
using numeric::norm;

/// How far an end may lie beside the curve of the parameters, as a part of its size: more than what
/// the digits of a text leave, less than what anybody means.
constexpr double kSlack = 0.01;
/// The same where the curve has no size.
constexpr double kRounding = 1e-9;
/// How much further than the ends the centre may move.
constexpr double kMostShift = 20.0;
/// How far a closed curve may be open.
constexpr double kOpening = 1e-6;
/// How far a plane's vectors may be off.
constexpr double kFrameSlack = 1e-6;

/// A vector in the plane.
struct Flat {
  double x, y;
};

Flat operator+(const Flat &a, const Flat &b) noexcept { return {a.x + b.x, a.y + b.y}; }
Flat operator-(const Flat &a, const Flat &b) noexcept { return {a.x - b.x, a.y - b.y}; }
Flat operator*(const Flat &a, double factor) noexcept { return {a.x * factor, a.y * factor}; }
double along(const Flat &a, const Flat &b) noexcept { return a.x * b.x + a.y * b.y; }
double lengthOf(const Flat &a) noexcept { return norm({a.x, a.y, 0.0}); }

Flat direction(double degrees) noexcept {
  const numeric::Turn turn = numeric::turnOf(degrees);
  return {turn.c, turn.s};
}

/// The plane of arcs, ellipses and splines.
struct Frame {
  Vector3 x, y, n;

  Flat flat(const Vector3 &v) const noexcept { return {dot(v, x), dot(v, y)}; }
  Vector3 space(const Flat &v) const noexcept { return x * v.x + y * v.y; }
};

/// Of length 1. Its square is off by twice as much.
bool isUnit(const Vector3 &v) noexcept { return exact::fabs(dot(v, v) - 1.0) <= 2.0 * kFrameSlack; }

bool isZero(const Vector3 &v) noexcept { return v.x == 0.0 && v.y == 0.0 && v.z == 0.0; }

/// Memory that was only filled with zeros: the plane of X and Y.
bool saysNoPlane(const PathObject &object) noexcept {
  return isZero(object.planeX) && isZero(object.planeY) && isZero(object.normal);
}

ShapeError frameOf(const PathObject &object, Frame &frame) noexcept {
  frame = {object.planeX, object.planeY, object.normal};
  if (saysNoPlane(object))
    frame = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const Vector3 off = cross(frame.x, frame.y) - frame.n;
  return isUnit(frame.x) && isUnit(frame.y) && dot(off, off) <= kFrameSlack * kFrameSlack
             ? ShapeError::None
             : ShapeError::Frame;
}

/// The ends of an object in its plane, and out of it.
struct Ends {
  Flat start, end;
  Vector3 base;  ///< What leads from the plane through 0 to that of the start.
  Vector3 climb; ///< What leads from there to that of the end; 0 if the object is planar.
};

Ends endsOf(const PathObject &object, const Frame &frame) noexcept {
  const Vector3 start = placeOf(object.start);
  const Vector3 end = placeOf(object.end);
  const double rise = object.planar != 0 ? 0.0 : dot(end - start, frame.n);
  return {frame.flat(start), frame.flat(end), frame.n * dot(start, frame.n), frame.n * rise};
}

/// A circle or an ellipse in its plane: centre + main * cos + other * sin.
struct Round {
  Flat centre, main, other;
  double begin; ///< [degrees]
  double sweep; ///< [degrees], positive from main to other.

  Flat at(const Flat &d) const noexcept { return centre + main * d.x + other * d.y; }
  /// Where the ellipse would be the circle of radius 1 around 0.
  Flat onUnitCircle(const Flat &place) const noexcept {
    const Flat away = place - centre;
    return {along(away, main) / along(main, main), along(away, other) / along(other, other)};
  }
};

/// Length and direction of the main axis, and length of the other one.
ShapeError axesOf(const PathObject &object, Round &round) noexcept {
  Flat main{object.shape[2], object.shape[3]};
  const double length = lengthOf(main);
  main = length > 0.0 ? main * (1.0 / length) : direction(object.shape[6]);
  const double half = object.shape[4];
  const double other = object.shape[5] != 0.0 ? object.shape[5] : half * object.shape[7];
  round.main = main * half;
  round.other = Flat{-main.y, main.x} * other;
  return exact::isPositive(half) && exact::isPositive(other) ? ShapeError::None : ShapeError::Axis;
}

ShapeError roundOf(const PathObject &object, Round &round) noexcept {
  round.centre = {object.shape[0], object.shape[1]};
  round.begin = object.parameterRange[0];
  const bool clockwise =
      object.moveType == MoveType::Clockwise || object.moveType == MoveType::EllipseClockwise;
  const double sweep = exact::fabs(object.parameterRange[1]);
  round.sweep = clockwise ? -sweep : sweep;
  if (!isCircle(object.moveType))
    return axesOf(object, round);
  const double radius = object.shape[2];
  round.main = {radius, 0.0};
  round.other = {0.0, radius};
  return exact::isPositive(radius) ? ShapeError::None : ShapeError::Radius;
}

/// The arc that leads exactly from start to end, on the circle of radius 1 that the parameters are.
struct Fitted {
  Flat centre;
  double radius;
  double begin; ///< [rad]
  double sweep; ///< [rad]
  Flat opening; ///< What is missing at the end.
};

/// The angle from a direction of length 1 to a place near it, seen from 0. [rad]
double turnTo(const Flat &direction, const Flat &place) noexcept {
  const double across = direction.x * place.y - direction.y * place.x;
  const double ahead = along(direction, place);
  const double t = across / ahead;
  if (!(ahead > 0.0 && exact::fabs(t) < 1e-3))
    return ::stride::atan2(across, ahead);
  const double z = t * t; // the next term is below 1e-18 of the angle
  return t - t * z * (1.0 / 3 - z * (1.0 / 5 - z * (1.0 / 7)));
}

/// Moves the centre onto the bisector of start and end. False if they lie beside the arc.
bool fit(const Flat &start, const Flat &end, const Round &round, Fitted &fitted) noexcept {
  const double sweep = round.sweep * kDegree;
  const double slack = kSlack * exact::smaller(1.0, exact::fabs(sweep)) + kRounding;
  const Flat first = direction(round.begin);
  const Flat last = direction(round.begin + round.sweep);
  const double off = exact::larger(lengthOf(start - first), lengthOf(end - last));
  if (!(off <= slack))
    return false;
  const Flat chord = end - start;
  const double chordLength = lengthOf(chord);
  const Flat to = chordLength > 0.0 ? chord * (1.0 / chordLength) : Flat{0.0, 0.0};
  fitted.centre = to * along((start + end) * 0.5, to);
  // Where the ends nearly meet, their bisector says nothing.
  const bool isClosed = !(lengthOf(fitted.centre) <= kMostShift * off);
  if (isClosed)
    fitted.centre = {0.0, 0.0};
  const Flat from = start - fitted.centre;
  const Flat until = end - fitted.centre;
  fitted.radius = lengthOf(from);
  const double atStart = turnTo(first, from);
  fitted.begin = round.begin * kDegree + atStart;
  fitted.sweep = sweep + (turnTo(last, until) - atStart);
  fitted.opening = isClosed ? until - until * (fitted.radius / lengthOf(until)) : Flat{0.0, 0.0};
  return lengthOf(fitted.opening) <= kOpening;
}

ShapeError roundShape(const PathObject &object, const Frame &frame, bool measured,
                      path::Shape &shape) noexcept {
  Round round{};
  const ShapeError error = roundOf(object, round);
  if (error != ShapeError::None)
    return error;
  const Ends ends = endsOf(object, frame);
  Fitted fitted{};
  const bool fits =
      fit(round.onUnitCircle(ends.start), round.onUnitCircle(ends.end), round, fitted);
  if (!fits)
    fitted = {{0.0, 0.0}, 1.0, round.begin * kDegree, round.sweep * kDegree, {0.0, 0.0}};
  const Vector3 centre = frame.space(round.at(fitted.centre)) + ends.base;
  const Vector3 main = frame.space(round.main);
  const Vector3 other = frame.space(round.other);
  const Vector3 climb = ends.climb + main * fitted.opening.x + other * fitted.opening.y;
  // Both are evaluated in one way.
  const auto make = isCircle(object.moveType) || !measured ? path::arcShape : path::ellipseShape;
  shape =
      make(centre, main * fitted.radius, other * fitted.radius, fitted.begin, fitted.sweep, climb);
  return fits ? ShapeError::None : ShapeError::Ends;
}

/// The range of a curve's parameter: from, and how far.
Flat rangeOf(const PathObject &object) noexcept {
  const double from = object.parameterRange[0];
  const double to = object.parameterRange[1];
  return from == 0.0 && to == 0.0 ? Flat{0.0, 1.0} : Flat{from, to - from};
}

/// The coefficients of the same polynomial over u, where t = from + way * u.
void overUnit(const Flat &range, double (&c)[6]) noexcept {
  for (int first = 0; first < 5; ++first)
    for (int k = 4; k >= first; --k)
      c[k] += range.x * c[k + 1];
  double power = 1.0;
  for (double &coefficient : c) {
    coefficient *= power;
    power *= range.y;
  }
}

/// The polynomial that the parameters describe. What a flat one does out of its plane is left out.
void polynomialOf(const PathObject &object, const Frame &frame, Vector3 (&result)[6]) noexcept {
  const bool flat = object.moveType == MoveType::Spline;
  const int places = flat ? 4 : 6;
  double c[3][6] = {};
  for (int axis = 0; axis < (flat ? 2 : 3); ++axis) {
    for (int k = 0; k < places; ++k) {
      const int at = axis * places + k;
      c[axis][k] = at < 8 ? object.shape[at] : object.moreShape[at - 8];
    }
    overUnit(rangeOf(object), c[axis]);
  }
  for (int k = 0; k < 6; ++k)
    result[k] = flat ? frame.space({c[0][k], c[1][k]}) : Vector3{c[0][k], c[1][k], c[2][k]};
}

Vector3 sumOf(const Vector3 (&c)[6]) noexcept { return c[0] + c[1] + c[2] + c[3] + c[4] + c[5]; }

/// The length of eight chords.
double roughLength(const Vector3 (&c)[6]) noexcept {
  double sum = 0.0;
  Vector3 before = c[0];
  for (int i = 1; i <= 8; ++i) {
    const double u = i / 8.0;
    Vector3 now = c[5];
    for (int k = 4; k >= 0; --k)
      now = now * u + c[k];
    sum += norm(now - before);
    before = now;
  }
  return sum;
}

path::Shape shapeOfPolynomial(const Vector3 (&c)[6], bool measured) noexcept {
  if (measured)
    return path::polynomialShape(c);
  path::Shape shape{};
  shape.kind = path::ShapeKind::Polynomial;
  for (int k = 0; k < 6; ++k)
    shape.v[k] = c[k];
  shape.length = roughLength(c);
  return shape;
}

ShapeError polynomialShape(const PathObject &object, const Frame &frame, bool measured,
                           path::Shape &shape) noexcept {
  Vector3 c[6];
  polynomialOf(object, frame, c);
  Vector3 start = placeOf(object.start);
  Vector3 end = placeOf(object.end);
  if (object.moveType == MoveType::Spline) {
    const Ends ends = endsOf(object, frame);
    c[0] = c[0] + ends.base;
    c[1] = c[1] + ends.climb;
    end = end - frame.n * dot(end - start, frame.n) + ends.climb;
  } else if (object.planar != 0) {
    // The curve in the plane of its start.
    for (int k = 1; k < 6; ++k)
      c[k] = c[k] - frame.n * dot(c[k], frame.n);
    end = end - frame.n * dot(end - start, frame.n);
  }
  const Vector3 atStart = start - c[0];
  const Vector3 atEnd = end - sumOf(c);
  const double slack = kSlack * roughLength(c);
  const bool fits = norm(atStart) <= slack && norm(atEnd) <= slack;
  if (fits) {
    c[0] = start;
    c[1] = c[1] + atEnd - atStart;
  }
  shape = shapeOfPolynomial(c, measured);
  return fits ? ShapeError::None : ShapeError::Ends;
}

path::Shape lineOf(const PathObject &object, const Frame &frame) noexcept {
  const Vector3 start = placeOf(object.start);
  const Vector3 end = placeOf(object.end);
  const Vector3 out = frame.n * dot(end - start, frame.n);
  return path::lineShape(start, object.planar != 0 ? end - out : end);
}

/// The length of a line that does not move in its space.
void measureOtherwise(const PathObject &object, const Frame &frame, ObjectShape &result) noexcept {
  const Vector3 way = placeOf(object.end) - placeOf(object.start);
  if (object.planar != 0 && norm(way) > 0.0) {
    result.measure = Measure::Normal;
    result.length = exact::fabs(dot(way, frame.n));
    return;
  }
  const unsigned axes = object.start.axes | object.end.axes;
  double sum = 0.0;
  for (int i = kAxisA; i < kAxes; ++i) {
    const double step = object.end.coordinate[i] - object.start.coordinate[i];
    if ((axes >> static_cast<unsigned>(i) & 1U) != 0)
      sum = norm({sum, step, 0.0});
  }
  result.measure = sum > 0.0 ? Measure::OtherAxes : Measure::Nothing;
  result.length = sum;
}

/// Not 0 if one of the numbers is not finite: the exponents of such overflow.
template <int Count> uint64_t notFinite(const double (&numbers)[Count]) noexcept {
  constexpr uint64_t kSign = uint64_t{1} << 63;
  uint64_t found = 0;
  for (const double number : numbers)
    found |= (__builtin_bit_cast(uint64_t, number) & ~kSign) + (uint64_t{1} << 52);
  return found & kSign;
}

/// Only those that mean something.
bool hasFiniteNumbers(const PathObject &object) noexcept {
  uint64_t found = notFinite(object.end.coordinate);
  if (object.moveType != MoveType::Jump)
    found |= notFinite(object.start.coordinate);
  if (isCurve(object.moveType))
    found |=
        notFinite(object.parameterRange) | notFinite(object.shape) | notFinite(object.moreShape);
  return found == 0;
}

/// The shape of an object that moves, with numbers that are finite.
ShapeError movingShape(const PathObject &object, bool measured, ObjectShape &result) noexcept {
  Frame frame{};
  ShapeError error = frameOf(object, frame);
  const MoveType type = object.moveType;
  const bool isLine = type == MoveType::Line || type == MoveType::Positioning;
  if (error != ShapeError::None && (!isLine || object.planar != 0))
    return error;
  error = ShapeError::None;
  if (isLine)
    result.shape = lineOf(object, frame);
  else if ((isCircle(type) || isEllipse(type)))
    error = roundShape(object, frame, measured, result.shape);
  else if (type == MoveType::Spline || type == MoveType::Spline3d)
    error = polynomialShape(object, frame, measured, result.shape);
  else
    error = ShapeError::Kind;
  if (error != ShapeError::None && error != ShapeError::Ends)
    return error;
  result.length = result.shape.length;
  result.measure = object.planar != 0 ? Measure::Plane : Measure::Space;
  if (result.length == 0.0)
    measureOtherwise(object, frame, result);
  return exact::isfinite(result.length) ? error : ShapeError::NotFinite;
}

/// The direction of the first derivative that is not 0; the second counts `second` times.
Vector3 firstDirection(const path::Derivatives &d, double second) noexcept {
  const Vector3 choices[] = {d.d1, d.d2 * second, d.d3};
  for (const Vector3 &choice : choices) {
    const double length = norm(choice);
    if (length > 0.0)
      return choice * (1.0 / length);
  }
  return numeric::kZero;
}

void setPlace(Position &position, const Vector3 &place) noexcept {
  position.coordinate[kAxisX] = place.x;
  position.coordinate[kAxisY] = place.y;
  position.coordinate[kAxisZ] = place.z;
}

/// Where the parameters say that the object starts (0) or ends (1).
ShapeError calculatePlace(PathObject &object, Position &position, double u) noexcept {
  if (!hasFiniteNumbers(object))
    return ShapeError::NotFinite;
  Frame frame{};
  if (!isCurve(object.moveType))
    return ShapeError::None;
  ShapeError error = frameOf(object, frame);
  if (error != ShapeError::None)
    return error;
  Vector3 place{};
  if ((isCircle(object.moveType) || isEllipse(object.moveType))) {
    Round round{};
    error = roundOf(object, round);
    place = frame.space(round.at(direction(round.begin + u * round.sweep)));
  } else {
    Vector3 c[6];
    polynomialOf(object, frame, c);
    place = u == 0.0 ? c[0] : sumOf(c);
  }
  if (error != ShapeError::None)
    return error;
  if (object.moveType != MoveType::Spline3d)
    place = place + frame.n * dot(placeOf(position), frame.n);
  setPlace(position, place);
  return ShapeError::None;
}

} // namespace

void completePlane(PathObject &object) noexcept {
  if (!saysNoPlane(object))
    return;
  object.planeX = {1.0, 0.0, 0.0};
  object.planeY = {0.0, 1.0, 0.0};
  object.normal = {0.0, 0.0, 1.0};
}

Vector3 normalOf(const PathObject &object) noexcept {
  return saysNoPlane(object) ? Vector3{0.0, 0.0, 1.0} : object.normal;
}

Vector3 placeOf(const Position &position) noexcept {
  return {position.coordinate[kAxisX], position.coordinate[kAxisY], position.coordinate[kAxisZ]};
}

static ShapeError describe(const PathObject &object, bool measured, ObjectShape &result) noexcept {
  result = {};
  result.measure = Measure::Nothing;
  if (!hasFiniteNumbers(object))
    return ShapeError::NotFinite;
  if (object.moveType == MoveType::Jump || object.moveType == MoveType::Function) {
    const Vector3 place = placeOf(object.moveType == MoveType::Jump ? object.end : object.start);
    result.shape = path::lineShape(place, place);
    return ShapeError::None;
  }
  return movingShape(object, measured, result);
}

ShapeError shapeOf(const PathObject &object, ObjectShape &result) noexcept {
  return describe(object, true, result);
}

ShapeError outlineOf(const PathObject &object, ObjectShape &result) noexcept {
  return describe(object, false, result);
}

Vector3 directionAtStart(const path::Derivatives &start) noexcept {
  return firstDirection(start, 1.0);
}

Vector3 directionAtEnd(const path::Derivatives &end) noexcept { return firstDirection(end, -1.0); }

Vector3 tangentAtStart(const ObjectShape &shape) noexcept {
  return shape.shape.length > 0.0 ? directionAtStart(path::overParameter(shape.shape, 0.0))
                                  : numeric::kZero;
}

Vector3 tangentAtEnd(const ObjectShape &shape) noexcept {
  return shape.shape.length > 0.0 ? directionAtEnd(path::overParameter(shape.shape, 1.0))
                                  : numeric::kZero;
}

ShapeError calculateEnd(PathObject &object) noexcept {
  return calculatePlace(object, object.end, 1.0);
}

ShapeError calculateStart(PathObject &object) noexcept {
  return calculatePlace(object, object.start, 0.0);
}

ShapeError calculateLength(PathObject &object) noexcept {
  ObjectShape shape{};
  const ShapeError error = shapeOf(object, shape);
  const bool measured = error == ShapeError::None || error == ShapeError::Ends;
  object.length = measured ? shape.length : 0.0;
  return measured ? ShapeError::None : error;
}

} // namespace stride::cnc
