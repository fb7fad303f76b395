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

path::Derivatives over(const Vector<Series> &place, double speed) noexcept {
  const auto vectorAt = [&place](int n, double factor) {
    return Vector3{place(0).c[n], place(1).c[n], place(2).c[n]} * factor;
  };
  return {vectorAt(0, 1.0), vectorAt(1, speed), vectorAt(2, 2.0 * speed * speed), numeric::kZero};
}

/// The parameter along a corner, and what all series of polynomials in it have in common.
struct Parameter {
  Series u;
  double square, product, cube; ///< Of its derivatives' shares: see through.
};

Parameter parameter(const Series &u) noexcept {
  return {u, u.c[1] * u.c[1], 2.0 * u.c[1] * u.c[2], u.c[1] * u.c[1] * u.c[1]};
}

/// A series in the parameter, in which the parameter's own is put.
Series through(const double (&p)[4], const Parameter &parameter) noexcept {
  const Series &u = parameter.u;
  Series series;
  series.c[0] = 0.0 + p[0];
  series.c[1] = 0.0 + p[1] * u.c[1];
  series.c[2] = 0.0 + p[1] * u.c[2] + p[2] * parameter.square;
  series.c[3] = 0.0 + p[1] * u.c[3] + p[2] * parameter.product + p[3] * parameter.cube;
  return series;
}

/// A polynomial at the parameter: its own series there (Horner's scheme, again and again), and in
/// that the parameter's series.
Series valueOf(const Quintic &polynomial, const Parameter &parameter) noexcept {
  const double(&c)[6] = polynomial.c;
  if (c[5] == 0.0 && c[4] == 0.0 && c[3] == 0.0 && c[2] == 0.0 && c[1] == 0.0)
    return Series(c[0] + 0.0); // as of axes that there are not
  const double at = parameter.u.c[0];
  double p[6] = {c[0], c[1], c[2], c[3], c[4], c[5]};
  for (int order = 0; order < 4; ++order)
    for (int k = 4; k >= order; --k)
      p[k] += at * p[k + 1];
  return through({p[0], p[1], p[2], p[3]}, parameter);
}

/// The parameter over the length of a curve, where its derivatives are known over the parameter.
Series parameterOverLength(double u, const path::Derivatives &d) noexcept {
  // u' = w^(-1/2) with w = d1 d1; that is derived twice.
  const double w = numeric::dot(d.d1, d.d1);
  const double along = numeric::dot(d.d1, d.d2);
  const double next = numeric::dot(d.d2, d.d2) + numeric::dot(d.d1, d.d3);
  const double first = 1.0 / exact::sqrt(w);
  Series series(u);
  series.c[1] = first;
  series.c[2] = -0.5 * along / (w * w);
  series.c[3] = first * (4.0 * along * along / w - next) / (6.0 * w * w);
  return series;
}

void putPoint(const path::Derivatives &d, const Parameter &u, Vector<Series> &place) noexcept {
  place(0) = through({d.p.x, d.d1.x, 0.5 * d.d2.x, d.d3.x / 6.0}, u);
  place(1) = through({d.p.y, d.d1.y, 0.5 * d.d2.y, d.d3.y / 6.0}, u);
  place(2) = through({d.p.z, d.d1.z, 0.5 * d.d2.z, d.d3.z / 6.0}, u);
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
/// so that the curve bends nearly evenly. Where the path nearly turns round that is too little for
/// its curvature.
double evenStretch(double turn) noexcept {
  const double even = 1.875 / (1.0 + 0.875 * ::stride::cos(0.5 * turn));
  return exact::larger(even, path::blendStretch(turn));
}

/// With more, in cuts, a corner between two lines would leave their triangle: its curve is in the
/// hull of its control points, of which three lie on each line, the third one 2/5 of that from the
/// end.
constexpr double kMostSpeed = 2.5;

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
    const double even = evenStretch(turn) * chord;
    speedBefore = exact::smaller(even, kMostSpeed * cutBefore);
    speedAfter = exact::smaller(even, kMostSpeed * cutAfter);
  }
  setSpeeds(corner, speedBefore, speedAfter);
  corner.place =
      path::quinticShape(over(begin.tool.place, speedBefore), over(end.tool.place, speedAfter));
  corner.byLength = bothGo;
  if (bothGo) {
    corner.ways = path::tableOf(corner.place);
    corner.length = corner.place.length;
  }
  for (int i = 0; i < 9; ++i)
    corner.turn[i] = after.turn[i];
  corner.before = spinOf(before);
  corner.after = spinOf(after);
  corner.leaves = quintic({-cutBefore, speedBefore, 0.0}, {0.0, 0.0, 0.0});
  corner.enters = quintic({0.0, 0.0, 0.0}, {cutAfter, speedAfter, 0.0});
  corner.given = before.given;
  for (int32_t k = 0; k < kAxes; ++k)
    if (k >= kArmAxes || isGiven(corner.given, k))
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
  path::Derivatives point{};
  Parameter u;
  if (corner.byLength) {
    const double at = way.c[0] < corner.length
                          ? path::parameterAt(corner.place, corner.ways, way.c[0])
                          : 1.0; // exactly
    point = path::overParameter(corner.place, at);
    const Series series = parameterOverLength(at, point);
    u = parameter(through({series.c[0], series.c[1], series.c[2], series.c[3]}, parameter(way)));
  } else {
    const Series x = way * (1.0 / corner.length);
    const double change = corner.last - corner.first;
    const Series cube = x * x * x;
    u = parameter(corner.length * (corner.first * x + change * (cube - 0.5 * cube * x)));
    if (corner.byTool)
      point = path::overParameter(corner.place, u.u.c[0]);
  }
  place.byTool = corner.byTool;
  place.alsoTurns = corner.byTool && !corner.byLength;
  for (int32_t k = corner.byTool ? kArmAxes : 0; k < kAxes; ++k)
    place.axes[k] = valueOf(corner.axes[k], u);
  if (!corner.byTool)
    return;
  place.given = corner.given;
  for (int32_t k = 0; k < kArmAxes && corner.given != 0; ++k)
    if (isGiven(corner.given, k))
      place.axes[k] = valueOf(corner.axes[k], u);
  putPoint(point, u, place.tool.place);
  place.tool.turn = turnAt(corner, u);
}

} // namespace stride::group
