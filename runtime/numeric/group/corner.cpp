#include "runtime/numeric/group/corner.hpp"

#include "runtime/numeric/path/blend.hpp"

namespace stride::group {
namespace {

/// Value and first two derivatives at an end of a polynomial, over u.
struct End {
  double p, d1, d2;
};

Quintic quintic(const End &begin, const End &end) noexcept {
  const double p = end.p - (begin.p + begin.d1 + 0.5 * begin.d2);
  const double d1 = end.d1 - (begin.d1 + begin.d2);
  const double d2 = end.d2 - begin.d2;
  return {{begin.p, begin.d1, 0.5 * begin.d2, 10.0 * p - 4.0 * d1 + 0.5 * d2,
           -15.0 * p + 7.0 * d1 - d2, 6.0 * p - 3.0 * d1 + 0.5 * d2}};
}

/// An end over u, where a unit of u is `speed` units of the way.
End over(const Series &series, double speed) noexcept {
  return {series.c[0], series.c[1] * speed, 2.0 * series.c[2] * speed * speed};
}

/// The parameter along a corner, and what all series of polynomials in it have in common.
struct Parameter {
  Series u;
  double square, product, cube; ///< Of its derivatives' shares: see valueOf.
};

Parameter parameter(const Series &u) noexcept {
  return {u, u.c[1] * u.c[1], 2.0 * u.c[1] * u.c[2], u.c[1] * u.c[1] * u.c[1]};
}

/// A polynomial at the parameter: its own series there (Horner's scheme, again and again), and in
/// that the parameter's series.
Series valueOf(const Quintic &polynomial, const Parameter &parameter) noexcept {
  const double(&c)[6] = polynomial.c;
  if (c[5] == 0.0 && c[4] == 0.0 && c[3] == 0.0 && c[2] == 0.0 && c[1] == 0.0)
    return Series(c[0] + 0.0); // as of axes that there are not
  const Series &u = parameter.u;
  const double at = u.c[0];
  double p[6] = {c[0], c[1], c[2], c[3], c[4], c[5]};
  for (int order = 0; order < 4; ++order)
    for (int k = 4; k >= order; --k)
      p[k] += at * p[k + 1];
  Series series;
  series.c[0] = 0.0 + p[0];
  series.c[1] = 0.0 + p[1] * u.c[1];
  series.c[2] = 0.0 + p[1] * u.c[2] + p[2] * parameter.square;
  series.c[3] = 0.0 + p[1] * u.c[3] + p[2] * parameter.product + p[3] * parameter.cube;
  return series;
}

/// An orientation, given by rows, turned on twice; the products of both turns are four series.
Matrix<Series> turnedTwice(const Turning &first, const Turning &second,
                           const double (&rows)[9]) noexcept {
  const Matrix<double> start = matrixOf(rows);
  const Matrix<double> once = crossed(first.about, start);
  const Matrix<double> twice = crossed(first.about, once);
  const Matrix<double> then[3] = {crossed(second.about, start), crossed(second.about, once),
                                  crossed(second.about, twice)};
  return sumOf({first.sine, first.rest, second.sine, second.rest, first.sine * second.sine,
                first.sine * second.rest, first.rest * second.sine, first.rest * second.rest},
               {once, twice, then[0], crossed(second.about, then[0]), then[1],
                crossed(second.about, then[1]), then[2], crossed(second.about, then[2])},
               start);
}

/// 1 or -1 where two axes lie in one line, pointing the same way or not; else 0.
double sameAxis(const Vector3 &a, const Vector3 &b) noexcept {
  if (a.x == b.x && a.y == b.y && a.z == b.z)
    return 1.0;
  return a.x == -b.x && a.y == -b.y && a.z == -b.z ? -1.0 : 0.0;
}

/// How the tool is turned. One that does not turn on a leg need not be looked at further.
Matrix<Series> turnAt(const Corner &corner, const Parameter &u) noexcept {
  const bool leaves = corner.before.rate != 0.0;
  const bool enters = corner.after.rate != 0.0;
  if (!leaves && !enters)
    return seriesOf(corner.turn);
  const auto angleOf = [&u](const Spin &spin, const Quintic &way) {
    return valueOf(way, u) * spin.rate;
  };
  const Vector3 &first = corner.before.about;
  const Vector3 &second = corner.after.about;
  if (!enters)
    return turnedOn(first, angleOf(corner.before, corner.leaves), corner.turn);
  const Series entered = angleOf(corner.after, corner.enters);
  if (!leaves)
    return turnedOn(second, entered, corner.turn);
  const Series left = angleOf(corner.before, corner.leaves);
  const double same = sameAxis(first, second);
  return same != 0.0 ? turnedOn(first, left + entered * same, corner.turn)
                     : turnedTwice(turning(first, left), turning(second, entered), corner.turn);
}

Vector3 directionOf(const Vector<Series> &place) noexcept {
  return {place(0).c[1], place(1).c[1], place(2).c[1]};
}
Vector3 valueOf(const Vector<Series> &place) noexcept {
  return {place(0).c[0], place(1).c[0], place(2).c[0]};
}

Spin spinOf(const Leg &leg) noexcept { return {leg.about, leg.angle / leg.length}; }

/// How long the derivatives over u are at the ends of a corner between two lines, over its chord,
/// so that the tool is as fast in its middle: in between its velocity changes by 2 per thousand up
/// to a right angle. Where the path nearly turns round that is too little for its curvature.
double evenStretch(double turn) noexcept {
  const double even = 1.875 / (1.0 + 0.875 * ::stride::cos(0.5 * turn));
  return exact::larger(even, path::blendStretch(turn));
}

/// How much of the ways of both legs a unit of u is at the ends of the corner.
void setSpeeds(Corner &corner, double before, double after) noexcept {
  corner.first = 1.0 / before;
  corner.last = 1.0 / after;
  corner.length = 2.0 / (corner.first + corner.last);
}

} // namespace

Corner toolCorner(const Leg &before, double cutBefore, const Leg &after, double cutAfter) noexcept {
  Corner corner{};
  corner.byTool = true;
  PathPlace begin;
  PathPlace end;
  placeAt(before, growing(before.length - cutBefore, 1.0), begin);
  placeAt(after, growing(cutAfter, 1.0), end);
  double speedBefore = 2.0 * cutBefore;
  double speedAfter = 2.0 * cutAfter;
  const bool bothGo = before.kind != LegKind::Turn && after.kind != LegKind::Turn;
  if (bothGo) {
    const double turn =
        path::turnBetween(directionOf(begin.tool.place), directionOf(end.tool.place));
    const double chord = numeric::norm(valueOf(end.tool.place) - valueOf(begin.tool.place));
    speedBefore = speedAfter = evenStretch(turn) * chord;
  }
  setSpeeds(corner, speedBefore, speedAfter);
  for (int i = 0; i < 3; ++i)
    corner.place[i] =
        quintic(over(begin.tool.place(i), speedBefore), over(end.tool.place(i), speedAfter));
  for (int i = 0; i < 9; ++i)
    corner.turn[i] = after.turn[i];
  corner.before = spinOf(before);
  corner.after = spinOf(after);
  corner.leaves = quintic({-cutBefore, speedBefore, 0.0}, {0.0, 0.0, 0.0});
  corner.enters = quintic({0.0, 0.0, 0.0}, {cutAfter, speedAfter, 0.0});
  for (int32_t k = kArmAxes; k < kAxes; ++k)
    corner.axes[k] = quintic(over(begin.axes[k], speedBefore), over(end.axes[k], speedAfter));
  return corner;
}

Corner axesCorner(const AxesEnd &before, const AxesEnd &after) noexcept {
  Corner corner{};
  const double speedBefore = 2.0 * before.cut;
  const double speedAfter = 2.0 * after.cut;
  setSpeeds(corner, speedBefore, speedAfter);
  for (int32_t k = 0; k < kAxes; ++k)
    corner.axes[k] = quintic(over(before.axes[k], speedBefore), over(after.axes[k], speedAfter));
  return corner;
}

void placeAt(const Corner &corner, const Series &way, PathPlace &place) noexcept {
  const Series x = way * (1.0 / corner.length);
  const double change = corner.last - corner.first;
  const Series cube = x * x * x;
  const Parameter u =
      parameter(corner.length * (corner.first * x + change * (cube - 0.5 * cube * x)));
  place.byTool = corner.byTool;
  for (int32_t k = corner.byTool ? kArmAxes : 0; k < kAxes; ++k)
    place.axes[k] = valueOf(corner.axes[k], u);
  if (!corner.byTool)
    return;
  for (int i = 0; i < 3; ++i)
    place.tool.place(i) = valueOf(corner.place[i], u);
  place.tool.turn = turnAt(corner, u);
}

} // namespace stride::group
