// Coordinates that are turned and scaled: G54 to G56. What is expected is computed here with
// matrices of the formulas, by rows.
#include "tests/unit/cnc/gcode_text.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace stride::cnc;
using namespace stride::cnc::test;

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;
using Place = std::array<double, 3>;

constexpr double kNear = 1e-9;

DecodedText decodeIn(std::string_view text, Orientation orientation) {
  const Scanned scanned = scanText(text);
  return decodeWords(scanned.words, {}, false, 100000, true, orientation);
}

Matrix times(const Matrix &a, const Matrix &b) {
  Matrix c{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      for (size_t k = 0; k < 3; ++k)
        c[i][j] += a[i][k] * b[k][j];
  return c;
}

Matrix aboutX(double degrees) {
  const double a = degrees * M_PI / 180;
  return {{{1, 0, 0}, {0, std::cos(a), -std::sin(a)}, {0, std::sin(a), std::cos(a)}}};
}
Matrix aboutY(double degrees) {
  const double a = degrees * M_PI / 180;
  return {{{std::cos(a), 0, std::sin(a)}, {0, 1, 0}, {-std::sin(a), 0, std::cos(a)}}};
}
Matrix aboutZ(double degrees) {
  const double a = degrees * M_PI / 180;
  return {{{std::cos(a), -std::sin(a), 0}, {std::sin(a), std::cos(a), 0}, {0, 0, 1}}};
}

Matrix turnOf(Orientation orientation, const Place &angle) {
  if (orientation == Orientation::Xyz)
    return times(times(aboutX(angle[0]), aboutY(angle[1])), aboutZ(angle[2]));
  const Matrix last = orientation == Orientation::Zyz ? aboutZ(angle[2]) : aboutX(angle[2]);
  return times(times(aboutZ(angle[0]), aboutY(angle[1])), last);
}

Place apply(const Matrix &m, const Place &p) {
  Place out{};
  for (size_t i = 0; i < 3; ++i)
    out[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2];
  return out;
}

Place endOf(const PathObject &o) {
  return {o.end.coordinate[kAxisX], o.end.coordinate[kAxisY], o.end.coordinate[kAxisZ]};
}
Place anglesOf(const PathObject &o) {
  return {o.end.coordinate[kAxisA], o.end.coordinate[kAxisB], o.end.coordinate[kAxisC]};
}

void expectNear(const Place &found, const Place &expected, const char *what) {
  for (size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(found[i], expected[i], kNear) << what << ' ' << i;
}

void expectSame(const Matrix &found, const Matrix &expected, const char *what) {
  for (size_t i = 0; i < 3; ++i)
    expectNear(found[i], expected[i], what);
}

GCodeError errorIn(std::string_view text, Orientation orientation = Orientation::Zyx) {
  return decodeIn(text, orientation).error;
}

} // namespace

TEST(DecoderSystem, TurnsAboutZ) {
  const DecodedText text =
      decodeIn("G54 X10 Y-5 A90 B0 C0\nG1 X3 Y1\nG91\nX2\nG90\nG3 X4 Y2 I-1\nG53\nG1 X0 Y0\n",
               Orientation::Zyx);
  ASSERT_EQ(text.error, GCodeError::None);
  ASSERT_EQ(text.objects.size(), 4U);
  expectNear(endOf(text.objects[0]), {9, -2, 0}, "absolute");
  expectNear(endOf(text.objects[1]), {9, 0, 0}, "relative");
  // (5, 1) to (4, 2) about (4, 1), as the program sees it: a quarter.
  const PathObject &arc = text.objects[2];
  EXPECT_EQ(arc.moveType, MoveType::Counterclockwise);
  expectNear(endOf(arc), {8, -1, 0}, "arc");
  EXPECT_NEAR(arc.shape[0], 9, kNear);
  EXPECT_NEAR(arc.shape[1], -1, kNear);
  EXPECT_NEAR(arc.parameterRange[1], -90, kNear);
  EXPECT_EQ(arc.planeX.x, 1.0);
  expectNear(endOf(text.objects[3]), {0, 0, 0}, "G53");
}

TEST(DecoderSystem, TiltsPlanes) {
  // Z of the program is X of the machine: B turns by 90 degrees about Y.
  const DecodedText text =
      decodeIn("G54 X1 A0 B90 C0\nG1 X3 Z0\nG2 X3 Y0 I-2\nG18\nG3 X1 Z2 R2\n", Orientation::Zyz);
  ASSERT_EQ(text.error, GCodeError::None);
  ASSERT_EQ(text.objects.size(), 3U);
  expectNear(endOf(text.objects[0]), {1, 0, -3}, "line");
  const PathObject &circle = text.objects[1];
  EXPECT_EQ(circle.moveType, MoveType::Clockwise);
  EXPECT_NEAR(circle.shape[2], 2, kNear);
  EXPECT_NEAR(circle.length, 4 * M_PI, kNear);
  expectNear({circle.normal.x, circle.normal.y, circle.normal.z}, {1, 0, 0}, "normal");
  EXPECT_NEAR(circle.shape[0] * circle.planeX.z + circle.shape[1] * circle.planeY.z, -1, kNear);
  const PathObject &arc = text.objects[2];
  expectNear(endOf(arc), {3, 0, -1}, "arc in Z and X");
  EXPECT_NEAR(arc.parameterRange[1], -90, kNear);
  expectNear({arc.normal.x, arc.normal.y, arc.normal.z}, {0, 1, 0}, "normal");
}

TEST(DecoderSystem, Scales) {
  const DecodedText text =
      decodeIn("G54 X10 I2 J2 K3\nG1 X3 Y1 Z1 P7\nG2 X4 Y2 R1\nG98\nG3 X3 Y1 I4 J1\nG8 X3 Y1 I1 J1 "
               "R0.5\nG55 X1 I0.5 J0.5 K1\nG1 X1 Z2\n",
               Orientation::Axes);
  ASSERT_EQ(text.error, GCodeError::None);
  ASSERT_EQ(text.objects.size(), 5U);
  expectNear(endOf(text.objects[0]), {16, 2, 3}, "line");
  EXPECT_EQ(text.objects[0].end.coordinate[kAxisP], 7);
  EXPECT_NEAR(text.objects[1].shape[2], 2, kNear);
  EXPECT_NEAR(text.objects[2].shape[0], 18, kNear);
  EXPECT_NEAR(text.objects[2].shape[2], 2, kNear);
  EXPECT_NEAR(text.objects[3].shape[4], 4, kNear);
  // Begins at 10 + 2 * 1, and the factors are 1, 1, 3 now.
  expectNear(endOf(text.objects[4]), {13, 2, 6}, "after G55");
}

TEST(DecoderSystem, TurnsEllipsesAndCurvesInThePlane) {
  const DecodedText text =
      decodeIn("G54 A30 B0 C0\nG1 X4\nG8 X4 Y0 I-4 K10 R0.5\nG6 X6 Y2 I1 J0\n", Orientation::Xyz);
  EXPECT_EQ(text.error, GCodeError::NotInThisPlane); // About X.
  const DecodedText level = decodeIn(
      "G54 A0 B0 C30\nG1 X4\nG8 X4 Y0 I-4 K10 R0.5\nG6 X6 Y2 I1 J0\nG5 X8 Y1\n", Orientation::Xyz);
  ASSERT_EQ(level.error, GCodeError::None);
  ASSERT_EQ(level.objects.size(), 4U);
  EXPECT_NEAR(level.objects[1].shape[6], 40, kNear);
  // The parabola at half of its way: a quarter of start and end, half of the corner.
  const PathObject &parabola = level.objects[2];
  ASSERT_EQ(parabola.moveType, MoveType::Spline);
  const auto middle = [&parabola](int at) {
    const double *c = parabola.shape + at;
    return c[0] + 0.5 * (c[1] + 0.5 * c[2]);
  };
  const Place expected = apply(aboutZ(30), {4 * 0.25 + 5 * 0.5 + 6 * 0.25, 0.5, 0});
  EXPECT_NEAR(middle(0), expected[0], kNear);
  EXPECT_NEAR(middle(4), expected[1], kNear);
}

TEST(DecoderSystem, FitsWherePathIs) {
  // Only the place: the turn stays.
  const DecodedText place =
      decodeIn("G54 X5 A90 B0 C0\nG1 X2 Y1\nG56 X100\nG1 X101 Y3\n", Orientation::Zyx);
  ASSERT_EQ(place.objects.size(), 2U);
  expectNear(endOf(place.objects[0]), {4, 2, 0}, "before");
  expectNear(endOf(place.objects[1]), {2, 3, 0}, "after");
  // Angles, too: where the path is and looks, is (1, 2, 3) with the angles (5, 6, 7).
  const DecodedText pose =
      decodeIn("G1 X2 Y1 Z4 A10 B20 C30\nG56 X1 Y2 Z3 A5 B6 C7\nG1 X1 Y2 Z3 A5 "
               "B6 C7\nX2 Y4 Z8 A40 B50 C-20\n",
               Orientation::Zyx);
  ASSERT_EQ(pose.error, GCodeError::None);
  ASSERT_EQ(pose.objects.size(), 3U);
  expectNear(endOf(pose.objects[1]), {2, 1, 4}, "the same place");
  expectNear(anglesOf(pose.objects[1]), {10, 20, 30}, "the same angles");
}

TEST(DecoderSystem, ComposesAsMatricesDo) {
  std::mt19937 random(2611);
  const auto number = [&random](double most) {
    return std::uniform_real_distribution<double>(-most, most)(random);
  };
  const auto three = [&number](double most) {
    return Place{number(most), number(most), number(most)};
  };
  for (int round = 0; round < 300; ++round) {
    const auto orientation = static_cast<Orientation>(1 + round % 3);
    const Place origin = three(50);
    const Place angle = three(170);
    const Place further = three(20);
    const Place more = three(80);
    const Place place = three(30);
    const Place look = three(170);
    const double scale = 1.5 + number(1);
    const double second = 1.5 + number(1);
    char text[600];
    std::snprintf(text, sizeof text,
                  "G54 X%.17f Y%.17f Z%.17f A%.17f B%.17f C%.17f I%.17f J%.17f K%.17f\n"
                  "G55 X%.17f Y%.17f Z%.17f A%.17f B%.17f C%.17f I%.17f J%.17f K%.17f\n"
                  "G1 X%.17f Y%.17f Z%.17f A%.17f B%.17f C%.17f\n",
                  origin[0], origin[1], origin[2], angle[0], angle[1], angle[2], scale, scale,
                  scale, further[0], further[1], further[2], more[0], more[1], more[2], second,
                  second, second, place[0], place[1], place[2], look[0], look[1], look[2]);
    const DecodedText decoded = decodeIn(text, orientation);
    ASSERT_EQ(decoded.error, GCodeError::None) << text;
    ASSERT_EQ(decoded.objects.size(), 1U);
    const Matrix outer = turnOf(orientation, angle);
    const Matrix whole = times(outer, turnOf(orientation, more));
    const Place began = apply(outer, further);
    const Place turned = apply(whole, place);
    const Place found = endOf(decoded.objects[0]);
    for (size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(found[i], origin[i] + scale * (began[i] + second * turned[i]), 1e-7) << text;
    // The angles for the machine mean the same turn.
    const Place angles = anglesOf(decoded.objects[0]);
    expectSame(turnOf(orientation, angles), times(whole, turnOf(orientation, look)), text);
  }
}

TEST(DecoderSystem, TakesTheNearAnglesAndKnowsWhereTheyAreNotUnique) {
  // A is 350 and goes on to 370, not back to 10; with B = 0 A and C turn about the same axis.
  const DecodedText near = decodeIn(
      "G1 A340 B0 C0\nG54 A20 B0 C0\nG1 A335 B10 C0\nA350 B10\nG1 A10 B0 C0\n", Orientation::Zyz);
  ASSERT_EQ(near.objects.size(), 4U);
  expectNear(anglesOf(near.objects[1]), {355, 10, 0}, "on");
  expectNear(anglesOf(near.objects[2]), {370, 10, 0}, "further");
  EXPECT_NEAR(anglesOf(near.objects[3])[0] + anglesOf(near.objects[3])[2], 390, kNear);
  for (const Orientation orientation : {Orientation::Zyx, Orientation::Xyz, Orientation::Zyz})
    for (const double middle : {90.0, -90.0, 180.0, 0.0}) {
      char text[200];
      std::snprintf(text, sizeof text, "G54 A30 B%g C0\nG1 A0 B0 C15\n", middle);
      const DecodedText decoded = decodeIn(text, orientation);
      ASSERT_EQ(decoded.objects.size(), 1U);
      expectSame(turnOf(orientation, anglesOf(decoded.objects[0])),
                 times(turnOf(orientation, {30, middle, 0}), turnOf(orientation, {0, 0, 15})),
                 text);
    }
}

TEST(DecoderSystem, RefusesWhatCannotBe) {
  EXPECT_EQ(errorIn("G54 A10 B5\n"), GCodeError::PartOfTurn);
  EXPECT_EQ(errorIn("G56 C10\n"), GCodeError::PartOfTurn);
  EXPECT_EQ(errorIn("G54 A10\n", Orientation::Axes), GCodeError::None);
  EXPECT_EQ(errorIn("G54 I2 J2\n"), GCodeError::PartOfScale);
  EXPECT_EQ(errorIn("G55 I2 J2 K0\n"), GCodeError::BadScale);
  EXPECT_EQ(errorIn("G54 I2 J-2 K2\n"), GCodeError::BadScale);
  EXPECT_EQ(errorIn("G15\nG54 A0 B10 C0\n"), GCodeError::Tilted);
  EXPECT_EQ(errorIn("G15\nG54 A10 B0 C0\n"), GCodeError::None);
  EXPECT_EQ(errorIn("G54 A0 B10 C0\nG15\n"), GCodeError::Tilted);
  EXPECT_EQ(errorIn("G54 A0 B10 C0\nG53\nG15\n"), GCodeError::None);
  EXPECT_EQ(errorIn("G54 I2 J3 K2\nG2 X10 R8\n"), GCodeError::Distorted);
  EXPECT_EQ(errorIn("G54 I2 J3 K2\nG18\nG2 X10 R8\n"), GCodeError::None);
  EXPECT_EQ(errorIn("G54 I2 J3 K2\nG8 X10 I5 R1\n"), GCodeError::Distorted);
  EXPECT_EQ(errorIn("G54 I2 J3 K2\nG1 X10 Y3\n"), GCodeError::None);
  EXPECT_EQ(errorIn("G54 I2 J3 K2\nG55 A10 B0 C0\n"), GCodeError::TurnOfScale);
  EXPECT_EQ(errorIn("G54 I2 J2 K3\nG55 A10 B0 C0\n"), GCodeError::None);
  EXPECT_EQ(errorIn("G54 I2 J2 K3\nG55 A0 B90 C0\n"), GCodeError::TurnOfScale);
}

TEST(DecoderSystem, V23OnlyShifts) {
  const Scanned scanned = scanText("G54 X10 I2 J2\nG1 X1\n");
  const DecodedText text = decodeWords(scanned.words);
  ASSERT_EQ(text.objects.size(), 1U);
  EXPECT_EQ(text.objects[0].end.coordinate[kAxisX], 11);
  ASSERT_FALSE(text.notes.empty());
  EXPECT_EQ(text.notes[0], kNoteNoProcessor);
}
