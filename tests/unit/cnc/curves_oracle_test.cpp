// Curves of G-code (G2, G3, G5, G6, G8, G9, G10) against an evaluation of what the manual says of
// them: rotations in space, conic sections, polynomials and sums of chords, without the decoder's
// arithmetic. Random programs in all planes and modes; limits at, below and above.
#include "runtime/numeric/cnc/object_shape.hpp"
#include "tests/support/cases.hpp"
#include "tests/support/random.hpp"
#include "tests/unit/cnc/gcode_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;
using stride::test::casesOf;
using stride::test::Random;

/// More cases by hand: STRIDE_PATH_CASES=10000.
int wanted(int cases) {
  const char *const more = std::getenv("STRIDE_PATH_CASES");
  return more != nullptr ? std::atoi(more) : casesOf(cases);
}

using Point3 = std::array<double, 3>;

Point3 plus(const Point3 &a, const Point3 &b, double f = 1) {
  return {a[0] + f * b[0], a[1] + f * b[1], a[2] + f * b[2]};
}
double scalar(const Point3 &a, const Point3 &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double sizeOfWay(const Point3 &a) { return std::sqrt(scalar(a, a)); }
Point3 oneLong(const Point3 &a) { return plus({}, a, 1 / sizeOfWay(a)); }
Point3 crossed(const Point3 &a, const Point3 &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Rodrigues: a turned about the unit vector n.
Point3 turned(const Point3 &a, const Point3 &n, double phi) {
  const Point3 along = plus({}, n, scalar(a, n) * (1 - std::cos(phi)));
  return plus(plus(plus({}, a, std::cos(phi)), crossed(n, a), std::sin(phi)), along);
}

/// A motion as the manual has it: its place over a parameter from 0 to 1.
struct Curve {
  MoveType type = MoveType::Line;
  std::function<Point3(double)> at;
  bool flat = false; ///< The length counts in X and Y (G15).
};

Point3 speedOfCurve(const Curve &c, double t) {
  // Of five places: exact for all polynomials here, to 1e-12 for the others.
  const double h = 2e-4;
  Point3 d{};
  d = plus(d, c.at(t + h), 8 / (12 * h));
  d = plus(d, c.at(t - h), -8 / (12 * h));
  d = plus(d, c.at(t + 2 * h), -1 / (12 * h));
  d = plus(d, c.at(t - 2 * h), 1 / (12 * h));
  if (c.flat)
    d[2] = 0;
  return d;
}

double simpson(const Curve &c, double from, double to) {
  const auto speed = [&c](double t) { return sizeOfWay(speedOfCurve(c, t)); };
  return (speed(from) + 4 * speed((from + to) / 2) + speed(to)) * (to - from) / 6;
}

/// Halved until it is exact enough: splines may turn very sharply.
double refined(const Curve &c, double from, double to, double whole, int depth) {
  const double middle = (from + to) / 2;
  const double left = simpson(c, from, middle);
  const double right = simpson(c, middle, to);
  if (depth > 2 && (depth > 22 || std::fabs(left + right - whole) < 1e-7 * (to - from)))
    return left + right + (left + right - whole) / 15;
  return refined(c, from, middle, left, depth + 1) + refined(c, middle, to, right, depth + 1);
}

/// The length from the parameter 0 on.
double lengthOfCurve(const Curve &c, double to) { return refined(c, 0, to, simpson(c, 0, to), 0); }

std::string wordFor(char letter, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%c%.17f ", letter, value);
  return text;
}

std::string wordsOf(const char *letters, const Point3 &p) {
  return wordFor(letters[0], p[0]) + wordFor(letters[1], p[1]) + wordFor(letters[2], p[2]);
}

/// A random program and what it means.
class Drawn {
public:
  explicit Drawn(Random &random) : random_(random) {
    text = "G1 F50 " + wordsOf("XYZ", lineTo(place())) + "\n";
  }

  void add() {
    switch (random_.below(7)) {
    case 0: {
      const Point3 from = here_;
      text += "G1 " + targetFrom(from, lineTo(place())) + "\n";
      break;
    }
    case 1:
      modes();
      break;
    case 2:
      ellipse();
      break;
    case 3:
      parabola();
      break;
    default:
      arc();
    }
  }

  std::string text;
  std::vector<Curve> curves;

private:
  double number() { return std::round(random_.uniform(-50, 50) * 1000) / 1000; }
  Point3 place() { return {number(), number(), number()}; }

  Point3 lineTo(const Point3 &to) {
    const Point3 from = here_;
    push({MoveType::Line, [from, to](double t) { return plus(plus({}, from, 1 - t), to, t); },
          planar_ && (from[0] != to[0] || from[1] != to[1])});
    return to;
  }
  void push(const Curve &curve) {
    curves.push_back(curve);
    here_ = curve.at(1);
  }
  std::string targetFrom(const Point3 &from, const Point3 &to) {
    return wordsOf("XYZ", relative_ ? plus(to, from, -1) : to);
  }
  std::string centre(const Point3 &from, const Point3 &c) {
    return wordsOf("IJK", absolute_ ? c : plus(c, from, -1));
  }

  void modes() {
    const int kind = random_.below(9);
    if (kind < 2)
      text += (relative_ = kind == 1) ? "G91\n" : "G90\n";
    else if (kind < 4)
      text += (absolute_ = kind == 3) ? "G98\n" : "G99\n";
    else if (kind == 8) {
      normal_ = oneLong({number() + 0.1, number(), number()});
      text += "G16 " + wordsOf("IJK", normal_) + "\n";
      planar_ = false;
    } else {
      const Point3 normals[] = {{0, 0, 1}, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
      const char *const names[] = {"G15\n", "G17\n", "G18\n", "G19\n"};
      normal_ = normals[kind - 4];
      planar_ = kind == 4;
      text += names[kind - 4];
    }
  }

  /// Of an arc; near its limits, too. [degrees]
  double sweep() {
    const double small = random_.magnitude(-4, 1);
    const int kind = random_.below(6);
    return kind == 0 ? small : kind == 1 ? 360 - small : random_.uniform(1, 359);
  }

  void arc() {
    const bool left = random_.chance(0.5);
    // A centre in the plane of the start.
    const Point3 any = place();
    const Point3 radial = plus(any, normal_, -scalar(any, normal_));
    if (sizeOfWay(radial) < 1)
      return;
    const Point3 centreAt = plus(here_, radial, -1);
    const bool whole = random_.chance(0.15);
    double degrees = whole ? 360 : sweep();
    const double climb = random_.chance(0.3) ? number() : 0;
    const bool byRadius = !whole && random_.chance(0.3);
    if (byRadius && degrees > 179)
      degrees = random_.uniform(1, 179);
    const double phi = degrees * M_PI / 180 * (left ? 1 : -1);
    const Point3 n = normal_;
    const Curve curve{
        left ? MoveType::Counterclockwise : MoveType::Clockwise,
        [=](double t) { return plus(plus(centreAt, turned(radial, n, phi * t)), n, climb * t); },
        planar_};
    const Point3 from = here_;
    const Point3 to = whole ? plus(from, n, climb) : curve.at(1);
    text += left ? "G3 " : "G2 ";
    const bool byAngle = !byRadius && n[0] + n[1] + n[2] == 1 && random_.chance(0.3);
    if (byRadius)
      text += wordFor('R', sizeOfWay(radial));
    else
      text += centre(from, centreAt);
    if (byAngle) {
      const size_t across = n[0] == 1 ? 0 : n[1] == 1 ? 1 : 2;
      text += wordFor('T', degrees);
      if (climb != 0)
        text += wordFor("XYZ"[across], relative_ ? climb : to[across]);
    } else if (!whole || climb != 0)
      text += targetFrom(from, to);
    text += "\n";
    push(curve);
  }

  bool inXY() const { return normal_[2] == 1; }

  void ellipse() {
    if (!inXY())
      return;
    const bool left = random_.chance(0.5);
    const double a = random_.uniform(2, 60);
    const double ratio = random_.chance(0.1) ? 1 : random_.uniform(0.1, 1);
    const double direction = random_.uniform(-400, 400);
    const double first = random_.uniform(0, 2 * M_PI);
    const bool whole = random_.chance(0.15);
    const double phi = (whole ? 360 : sweep()) * M_PI / 180 * (left ? 1 : -1);
    const double climb = random_.chance(0.3) ? number() : 0;
    const double c = std::cos(direction * M_PI / 180);
    const double s = std::sin(direction * M_PI / 180);
    const auto around = [=](double angle) {
      const double u = a * std::cos(angle);
      const double v = a * ratio * std::sin(angle);
      return Point3{c * u - s * v, s * u + c * v, 0};
    };
    const Point3 centreAt = plus(here_, around(first), -1);
    const Curve curve{left ? MoveType::EllipseCounterclockwise : MoveType::EllipseClockwise,
                      [=](double t) {
                        return plus(plus(centreAt, around(first + phi * t)), {0, 0, 1}, climb * t);
                      },
                      planar_};
    const Point3 from = here_;
    const Point3 said = absolute_ ? centreAt : plus(centreAt, from, -1);
    text += (left ? "G9 " : "G8 ") + wordFor('I', said[0]) + wordFor('J', said[1]) +
            wordFor('K', direction) + wordFor('R', ratio);
    if (!whole || climb != 0)
      text += targetFrom(from, whole ? plus(from, {0, 0, 1}, climb) : curve.at(1));
    text += "\n";
    push(curve);
  }

  void parabola() {
    if (!inXY())
      return;
    const Point3 from = here_;
    Point3 to = place();
    Point3 tip = place();
    if (random_.chance(0.7))
      to[2] = from[2];
    tip[2] = (from[2] + to[2]) / 2; // Z goes along evenly
    const Point3 said = absolute_ ? tip : plus(tip, from, -1);
    text += "G6 " + wordFor('I', said[0]) + wordFor('J', said[1]) + targetFrom(from, to) + "\n";
    push({!planar_ && from[2] != to[2] ? MoveType::Spline3d : MoveType::Spline,
          [=](double t) {
            const Point3 a = plus(plus({}, from, 1 - t), tip, t);
            const Point3 b = plus(plus({}, tip, 1 - t), to, t);
            return plus(plus({}, a, 1 - t), b, t);
          },
          planar_});
  }

  Random &random_;
  Point3 here_{}, normal_{0, 0, 1};
  bool relative_ = false, absolute_ = false, planar_ = false;
};

Point3 pointOf(const Vector3 &v) { return {v.x, v.y, v.z}; }
Point3 pointOf(const Position &p) { return {p.coordinate[0], p.coordinate[1], p.coordinate[2]}; }
double gapBetween(const Point3 &a, const Point3 &b) { return sizeOfWay(plus(a, b, -1)); }

/// Judges an object: ends, length, directions, and places at equal parts of the length.
void expectCurve(const PathObject &o, const Curve &c) {
  // A climb by rounding makes a curve in space of one in the plane.
  const bool rounded = o.moveType == MoveType::Spline3d && c.type == MoveType::Spline &&
                       std::fabs(c.at(1)[2] - c.at(0)[2]) < 1e-9;
  ASSERT_TRUE(o.moveType == c.type || rounded);
  EXPECT_LT(gapBetween(pointOf(o.start), c.at(0)), 1e-8);
  EXPECT_LT(gapBetween(pointOf(o.end), c.at(1)), 1e-8);
  const double whole = lengthOfCurve(c, 1);
  EXPECT_NEAR(o.length, whole, 1e-8 * (1 + whole));
  EXPECT_EQ(o.planar != 0, c.flat);
  ObjectShape shape{};
  ASSERT_EQ(shapeOf(o, shape), ShapeError::None);
  EXPECT_NEAR(shape.length, whole, 1e-8 * (1 + whole));
  if (whole < 1e-2 || shape.measure == Measure::Normal)
    return;
  const double sharp = 1e-7 * (1 + 50 / whole); // what digits of ends mean for a short one
  EXPECT_LT(gapBetween(pointOf(tangentAtStart(shape)), oneLong(speedOfCurve(c, 0))), sharp);
  EXPECT_LT(gapBetween(pointOf(tangentAtEnd(shape)), oneLong(speedOfCurve(c, 1))), sharp);
  for (int i = 1; i < 4; ++i) {
    const double t = i / 4.0;
    const double way = lengthOfCurve(c, t);
    const double u = stride::path::parameterAt(shape.shape, way);
    Point3 is = pointOf(stride::path::overParameter(shape.shape, u).p);
    Point3 wanted = c.at(t);
    if (c.flat)
      is[2] = wanted[2] = 0;
    EXPECT_LT(gapBetween(is, wanted), 2e-6) << "part " << t;
  }
}

void expectPath(const std::string &text, const std::vector<Curve> &curves) {
  const DecodedText decoded = decodeText(text);
  ASSERT_EQ(decoded.error, GCodeError::None) << decoded.line;
  EXPECT_TRUE(decoded.notes.empty());
  ASSERT_EQ(decoded.objects.size(), curves.size());
  for (size_t i = 0; i < curves.size() && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("object " + std::to_string(i));
    expectCurve(decoded.objects[i], curves[i]);
  }
}

TEST(CncCurvesOracle, MakesWhatTheManualSays) {
  const int cases = wanted(100);
  for (int i = 0; i < cases && !HasFailure(); ++i) {
    Random random(1000 + static_cast<uint64_t>(i));
    Drawn drawn(random);
    for (int k = 0; k < 12; ++k)
      drawn.add();
    SCOPED_TRACE("seed " + std::to_string(1000 + i) + "\n" + drawn.text);
    expectPath(drawn.text, drawn.curves);
  }
}

/// Points of splines between lines: by the rule for their directions.
void splineCase(uint64_t seed, bool inSpace) {
  Random random(seed);
  const auto number = [&] { return std::round(random.uniform(-50, 50) * 1000) / 1000; };
  const bool flat = !inSpace && random.chance(0.3);
  const auto projected = [&](Point3 p) { return inSpace ? p : Point3{p[0], p[1], 0}; };
  std::vector<Point3> points = {{0, 0, 0}};
  std::string text = flat ? "G15 F50\n" : "F50\n";
  const bool lineBefore = random.chance(0.5);
  const bool lineAfter = random.chance(0.5);
  const auto add = [&](const char *function) {
    points.push_back(
        {number(), number(), inSpace || random.chance(0.3) ? number() : points.back()[2]});
    text += function + wordsOf("XYZ", points.back()) + "\n";
  };
  if (lineBefore)
    add("G1 ");
  const size_t first = points.size() - 1;
  const int count = (lineBefore || lineAfter ? 1 : 2) + random.below(5);
  for (int i = 0; i < count; ++i)
    add(inSpace ? "G10 " : "G5 ");
  const size_t last = points.size() - 1;
  if (lineAfter)
    add("G1 ");
  SCOPED_TRACE(text);
  // The direction at each point, of length 1; zeros: none.
  std::vector<Point3> directions(points.size());
  for (size_t i = first; i <= last; ++i)
    if ((i > 0 && i < points.size() - 1))
      directions[i] = i == first  ? projected(plus(points[i], points[i - 1], -1))
                      : i == last ? projected(plus(points[i + 1], points[i], -1))
                                  : projected(plus(points[i + 1], points[i - 1], -1));
  const auto mirror = [&](size_t of, size_t a, size_t b) {
    const Point3 chord = oneLong(projected(plus(points[b], points[a], -1)));
    const Point3 d = oneLong(directions[of]);
    return plus(plus({}, chord, 2 * scalar(chord, d)), d, -1);
  };
  if (!lineBefore)
    directions[first] = mirror(first + 1, first, first + 1);
  if (!lineAfter)
    directions[last] = mirror(last - 1, last - 1, last);
  std::vector<Curve> curves;
  for (size_t i = 1; i < points.size(); ++i) {
    const Point3 a = points[i - 1];
    const Point3 b = points[i];
    Curve c;
    c.flat = flat;
    c.at = [=](double t) { return plus(plus({}, a, 1 - t), b, t); };
    if (i > first && i <= last) {
      const double chord = sizeOfWay(projected(plus(b, a, -1)));
      Point3 from = plus({}, oneLong(directions[i - 1]), chord / 3);
      Point3 into = plus({}, oneLong(directions[i]), chord / 3);
      if (!inSpace)
        from[2] = into[2] = (b[2] - a[2]) / 3;
      const Point3 p = plus(a, from);
      const Point3 q = plus(b, into, -1);
      const bool climbs = !flat && a[2] != b[2];
      c.type = inSpace || climbs ? MoveType::Spline3d : MoveType::Spline;
      // Bezier's form by de Casteljau.
      c.at = [=](double t) {
        const auto mix = [t](const Point3 &x, const Point3 &y) {
          return plus(plus({}, x, 1 - t), y, t);
        };
        const Point3 middle = mix(p, q);
        return mix(mix(mix(a, p), middle), mix(middle, mix(q, b)));
      };
    }
    curves.push_back(c);
  }
  expectPath(text, curves);
}

TEST(CncCurvesOracle, LaysSplinesThroughTheirPoints) {
  const int cases = wanted(60);
  for (int i = 0; i < cases && !HasFailure(); ++i)
    splineCase(5000 + static_cast<uint64_t>(i), i % 2 == 0);
}

DecodedText motionOf(const std::string &sentence) {
  return decodeText("G1 X10 Y5 F50\n" + sentence + "\n");
}

/// A radius that is too small by less than 1 % makes half a circle, by more a line.
TEST(CncCurvesOracle, TakesARadiusThatIsTooSmallByDigits) {
  for (const auto &[radius, good] :
       {std::pair(20.0, true), {19.81, true}, {19.79, false}, {0.0, false}, {-30.0, false}}) {
    const DecodedText made = motionOf("G2 X50 Y5 " + wordFor('R', radius));
    ASSERT_EQ(made.objects.size(), 2U);
    EXPECT_EQ(made.objects[1].moveType, good ? MoveType::Clockwise : MoveType::Line) << radius;
    EXPECT_NEAR(made.objects[1].length, good ? 20 * M_PI : 40, 1e-12);
    EXPECT_EQ(made.notes.size(), good ? 0U : 1U);
  }
  EXPECT_EQ(motionOf("G2 X10 Y5 R20").objects[1].moveType, MoveType::Line); // neither one nor other
}

/// The centre is put on the bisector: 1 % of the radius along the chord, no more.
TEST(CncCurvesOracle, TakesACentreThatIsOffByDigits) {
  for (const auto &[off, good] :
       {std::pair(0.0, true), {0.24, true}, {-0.24, true}, {0.26, false}}) {
    const DecodedText made = motionOf("G3 X50 Y5 J15 " + wordFor('I', 20 + off));
    ASSERT_EQ(made.objects.size(), 2U);
    EXPECT_EQ(made.objects[1].moveType, good ? MoveType::Counterclockwise : MoveType::Line) << off;
    if (good) {
      EXPECT_NEAR(made.objects[1].shape[0], 30, 1e-12);
      EXPECT_NEAR(made.objects[1].shape[2], 25, 1e-12);
    }
  }
}

TEST(CncCurvesOracle, TurnsByUpToACircle) {
  EXPECT_EQ(motionOf("G2 I20 T0").error, GCodeError::OutOfRange);
  EXPECT_EQ(motionOf("G2 I20 T-90").error, GCodeError::OutOfRange);
  EXPECT_EQ(motionOf("G2 I20 T360.001").error, GCodeError::OutOfRange);
  for (const double turn : {0.001, 90.0, 359.999, 360.0}) {
    const DecodedText made = motionOf("G2 I20 J15 " + wordFor('T', turn));
    ASSERT_EQ(made.objects.size(), 2U);
    EXPECT_NEAR(made.objects[1].parameterRange[1], turn, 1e-9);
    EXPECT_NEAR(made.objects[1].length, 25 * turn * M_PI / 180, 1e-9);
  }
}

/// An ellipse has a target, a centre, a direction and a ratio: an opening angle is no word of it.
TEST(CncCurvesOracle, RefusesTheOpeningAngleOfAnEllipse) {
  for (const char *const text : {"G8 I20 J0 K0 R0.5 T90", "G9 X50 I20 J0 K30 R0.5 T180"}) {
    const DecodedText made = motionOf(text);
    EXPECT_EQ(made.error, GCodeError::TurnOfEllipse) << text;
    EXPECT_EQ(made.objects.size(), 0U); // the line is held back
  }
  EXPECT_EQ(motionOf("G8 I20 J0 K0 R0.5").objects[1].parameterRange[1], 360);
  EXPECT_EQ(motionOf("G9 I20 J0 K0 R0").error, GCodeError::OutOfRange);
  EXPECT_EQ(motionOf("G9 I20 J0 K0 R1.001").error, GCodeError::OutOfRange);
}

} // namespace
