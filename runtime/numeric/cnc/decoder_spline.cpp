// Splines and parabolas of the decoder.
#include "runtime/numeric/cnc/decoder_internal.hpp"
#include "runtime/numeric/exact_math.hpp"

#include <stddef.h>

namespace stride::cnc {
namespace {

using numeric::dot;
using numeric::kZero;
using numeric::norm;

/// Shorter than this part of the other is nothing.
constexpr double kNothing = 1e-9;

/// The vector mirrored at a direction of length 1.
Vector3 mirrored(const Vector3 &vector, const Vector3 &axis) noexcept {
  return axis * (2 * dot(axis, vector)) - vector;
}

bool is(const Vector3 &vector) noexcept { return dot(vector, vector) > 0.25; }

/// Only what lies in the plane, length 1.
Vector3 flattened(const PathObject &object, const Vector3 &vector) noexcept {
  return unit(object.planeX * dot(object.planeX, vector) +
              object.planeY * dot(object.planeY, vector));
}

/// Coefficients of t^0 to t^3 from place `a` to `b`, with the derivatives there.
void hermite(double a, double b, double fromA, double intoB, double *c) noexcept {
  c[0] = a;
  c[1] = fromA;
  c[2] = 3 * (b - a) - 2 * fromA - intoB;
  c[3] = -2 * (b - a) + fromA + intoB;
}

/// A curve of degree 3: four coefficients for X, Y and Z each.
struct Cubic {
  const double *c;
  int32_t axes; ///< Whose way counts: the first two, or all three.
};

double speedOf(const Cubic &curve, double t) noexcept {
  double sum = 0.0;
  for (int32_t axis = 0; axis < curve.axes; ++axis) {
    const double *c = curve.c + ptrdiff_t{4} * axis;
    const double d = c[1] + t * (2 * c[2] + t * 3 * c[3]);
    sum += d * d;
  }
  return exact::sqrt(sum);
}

/// Gauss and Legendre's rule with 8 places.
double gauss(const Cubic &curve, double from, double to) noexcept {
  constexpr double kPlaces[4] = {0.18343464249564980494, 0.52553240991632898582,
                                 0.79666647741362673959, 0.96028985649753623168};
  constexpr double kWeights[4] = {0.36268378337836198297, 0.31370664587788728734,
                                  0.22238103445337447054, 0.10122853629037625915};
  const double middle = (from + to) / 2;
  const double half = (to - from) / 2;
  double sum = 0.0;
  for (int32_t i = 0; i < 4; ++i)
    sum += kWeights[i] * (speedOf(curve, middle - half * kPlaces[i]) +
                          speedOf(curve, middle + half * kPlaces[i]));
  return sum * half;
}

/// Halves where the rule is not exact enough yet.
double integrate(const Cubic &curve, double from, double to, double whole, double tolerance,
                 int32_t depth) noexcept {
  const double middle = (from + to) / 2;
  const double left = gauss(curve, from, middle);
  const double right = gauss(curve, middle, to);
  if (depth == 0 || exact::fabs(left + right - whole) <= tolerance)
    return left + right;
  return integrate(curve, from, middle, left, tolerance / 2, depth - 1) +
         integrate(curve, middle, to, right, tolerance / 2, depth - 1);
}

double curveLength(const double *c, bool flat) noexcept {
  constexpr int32_t kDepth = 40;
  constexpr double kTolerance = 1e-12;
  const Cubic curve{c, flat ? 2 : 3};
  const double whole = gauss(curve, 0.0, 1.0);
  return integrate(curve, 0.0, 1.0, whole, kTolerance * whole, kDepth);
}

/// Writes the coefficients of X, Y and Z, four each, as those of a Spline3d.
void storeInSpace(const double *c, PathObject &object) noexcept {
  object.moveType = MoveType::Spline3d;
  object.planar = false;
  double all[18] = {};
  for (int32_t axis = 0; axis < 3; ++axis)
    for (int32_t k = 0; k < 4; ++k)
      all[6 * axis + k] = c[4 * axis + k];
  for (int32_t i = 0; i < 8; ++i)
    object.shape[i] = all[i];
  for (int32_t i = 0; i < 10; ++i)
    object.moreShape[i] = all[8 + i];
}

/// A curve whose four coefficients for X, Y and Z are known: in the plane where it lies in one.
void storeCurve(const double *c, PathObject &object) noexcept {
  object.parameterRange[0] = 0.0;
  object.parameterRange[1] = 1.0;
  const bool climbs = object.start.coordinate[kAxisZ] != object.end.coordinate[kAxisZ];
  if (!object.planar && climbs) {
    object.length = curveLength(c, false);
    storeInSpace(c, object);
    return;
  }
  object.moveType = MoveType::Spline;
  for (int32_t i = 0; i < 8; ++i)
    object.shape[i] = c[i];
  object.length = curveLength(c, true);
}

} // namespace

void makeParabola(const Decoder &decoder, const Sentence &sentence, PathObject &object,
                  Decoded &result) noexcept {
  const Vector3 start = placeOf(object.start);
  const Vector3 end = placeOf(object.end);
  const Vector3 corner = centreOf(decoder, sentence, start, true);
  const Vector3 in{corner.x - start.x, corner.y - start.y, 0.0};
  const Vector3 out{end.x - corner.x, end.y - corner.y, 0.0};
  const double inLength = norm(in);
  const double outLength = norm(out);
  // Where both legs lie in one line there is no parabola but a line; where they double back, none.
  const double side = in.x * out.y - in.y * out.x;
  if (!(exact::fabs(side) > kNothing * inLength * outLength)) {
    if (!(dot(in, out) > 0.0))
      note(result, kNoteCentreOff, sentence.functionAt);
    object.moveType = MoveType::Line;
    makeLine(object);
    return;
  }
  const double c[12] = {start.x, 2 * in.x,        out.x - in.x, 0.0, //
                        start.y, 2 * in.y,        out.y - in.y, 0.0, //
                        start.z, end.z - start.z, 0.0,          0.0};
  storeCurve(c, object);
}

void finishSpline(Decoder &decoder, const Vector3 *next) noexcept {
  PathObject &object = decoder.held;
  const bool inSpace = decoder.state == Held::Spline3d;
  decoder.state = Held::Ready;
  const Vector3 start = placeOf(object.start);
  const Vector3 end = placeOf(object.end);
  Vector3 way = end - start;
  if (!inSpace)
    way.z = 0.0;
  const double chord = norm(way);
  Vector3 from = decoder.directed ? decoder.direction : kZero;
  Vector3 into = next != nullptr ? unit(*next) : kZero;
  if (!inSpace) {
    from = flattened(object, from);
    into = flattened(object, into);
  }
  if (!is(from) && is(into))
    from = mirrored(into, unit(way));
  else if (is(from) && !is(into))
    into = mirrored(from, unit(way));
  if (chord == 0.0 || !is(from)) {
    object.moveType = MoveType::Line;
    makeLine(object);
    return;
  }
  double c[12];
  hermite(start.x, end.x, from.x * chord, into.x * chord, c);
  hermite(start.y, end.y, from.y * chord, into.y * chord, c + 4);
  if (inSpace)
    hermite(start.z, end.z, from.z * chord, into.z * chord, c + 8);
  else
    hermite(start.z, end.z, end.z - start.z, end.z - start.z, c + 8);
  if (inSpace) {
    object.parameterRange[1] = 1.0;
    object.length = curveLength(c, false);
    storeInSpace(c, object);
  } else {
    storeCurve(c, object);
  }
}

} // namespace stride::cnc
