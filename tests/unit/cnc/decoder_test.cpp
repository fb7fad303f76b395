// The decoder against the golden lines of the SoftMotion V2.3 manual, section 3.2: the numbers are
// worked out by hand from what the manual says.
#include "tests/unit/cnc/gcode_text.hpp"

#include <cmath>
#include <gtest/gtest.h>

using namespace stride::cnc;
using namespace stride::cnc::test;

namespace {

constexpr double kNear = 1e-7;

void expectPlace(const Position &position, double x, double y, double z = 0.0) {
  EXPECT_NEAR(position.coordinate[kAxisX], x, kNear);
  EXPECT_NEAR(position.coordinate[kAxisY], y, kNear);
  EXPECT_NEAR(position.coordinate[kAxisZ], z, kNear);
}

void expectHalfCircle(const PathObject &object) {
  EXPECT_EQ(object.moveType, MoveType::Clockwise);
  expectPlace(object.start, 100, 100);
  expectPlace(object.end, 200, 100);
  EXPECT_NEAR(object.shape[0], 150, kNear);
  EXPECT_NEAR(object.shape[1], 100, kNear);
  EXPECT_NEAR(object.shape[2], 50, kNear);
  EXPECT_NEAR(object.parameterRange[0], 180, kNear);
  EXPECT_NEAR(object.parameterRange[1], 180, kNear);
  EXPECT_NEAR(object.length, 157.0796327, kNear);
}

} // namespace

TEST(Decoder, G1LinesAndArcOfTheFirstExample) {
  const DecodedText text = decodeText("% example\n"
                                      "N10 G01 X100 Y100 E100 F100 E-200\n"
                                      "N20 G01 Z40 F20\n"
                                      "N30 G03 X-100 R200 F100\n");
  ASSERT_EQ(text.error, GCodeError::None);
  ASSERT_EQ(text.objects.size(), 3U);
  const PathObject &first = text.objects[0];
  EXPECT_EQ(first.moveType, MoveType::Line);
  EXPECT_EQ(first.number, 1);
  EXPECT_EQ(first.sourceLine, 10);
  expectPlace(first.start, 0, 0);
  expectPlace(first.end, 100, 100);
  EXPECT_EQ(first.velocity, 100);
  EXPECT_EQ(first.acceleration, 100);
  EXPECT_EQ(first.deceleration, 200);
  EXPECT_NEAR(first.length, 141.421356, 1e-6);
  const PathObject &second = text.objects[1];
  expectPlace(second.end, 100, 100, 40);
  EXPECT_EQ(second.velocity, 20);
  EXPECT_EQ(second.length, 40);
  EXPECT_EQ(second.deceleration, 200);
  const PathObject &third = text.objects[2];
  EXPECT_EQ(third.moveType, MoveType::Counterclockwise);
  EXPECT_EQ(third.sentence, 30);
  expectPlace(third.end, -100, 100, 40);
  EXPECT_NEAR(third.shape[0], 0, kNear);
  EXPECT_NEAR(third.shape[1], -73.2050808, kNear);
  EXPECT_NEAR(third.shape[2], 200, kNear);
  EXPECT_NEAR(third.shape[3], 40, kNear);
  EXPECT_NEAR(third.parameterRange[0], 60, kNear);
  EXPECT_NEAR(third.parameterRange[1], -60, kNear);
  EXPECT_NEAR(third.length, 209.4395102, kNear);
  EXPECT_EQ(third.acceleration, 100);
}

TEST(Decoder, G2PositionsAreSet) {
  const DecodedText text = decodeText("G92 X100 Y100\nG1 X100 Y100\nG92 X50 Y100\nG92 X60 Y90\n");
  ASSERT_EQ(text.error, GCodeError::None);
  ASSERT_EQ(text.objects.size(), 3U);
  EXPECT_EQ(text.objects[0].moveType, MoveType::Jump);
  expectPlace(text.objects[0].end, 100, 100);
  EXPECT_EQ(text.objects[1].moveType, MoveType::Line);
  expectPlace(text.objects[1].start, 100, 100);
  EXPECT_EQ(text.objects[1].length, 0);
  // The last one of a series wins.
  EXPECT_EQ(text.objects[2].moveType, MoveType::Jump);
  expectPlace(text.objects[2].end, 60, 90);
}

TEST(Decoder, G3SwitchPoints) {
  const DecodedText text = decodeText("N90 G1 X20 Y20\nN100 G1 X100 Y40 H-2 O0.25\n"
                                      "G0 X200 H1 L10 H3 L-20 H-4 O1\n");
  ASSERT_EQ(text.objects.size(), 3U);
  const PathObject &second = text.objects[1];
  EXPECT_EQ(second.switchId[0], -2);
  EXPECT_EQ(second.switchPosition[0], 0.25);
  EXPECT_EQ(second.switchId[1], 0);
  const PathObject &third = text.objects[2];
  EXPECT_EQ(third.switchId[0], 1);
  EXPECT_NEAR(third.switchPosition[0], 0.1, kNear);
  EXPECT_EQ(third.switchId[1], 3);
  EXPECT_NEAR(third.switchPosition[1], 0.8, kNear);
  EXPECT_EQ(third.switchId[2], -4);
  EXPECT_EQ(third.switchPosition[2], 1);
  EXPECT_EQ(decodeText("G1 X1 H1 O0 H2 O0 H3 O0 H4 O0\n").error, GCodeError::TooManySwitches);
  EXPECT_EQ(decodeText("G1 X1 H1\n").error, GCodeError::MissingWord);
}

TEST(Decoder, G4AndG5MFunctions) {
  double parameters[8] = {1.5, 2, 3, 4, 5, 6, 7, 8.5};
  const DecodedText text =
      decodeText("N90 M10\nN150 M13 O$g_myMParams$ K2.5 L-3\nM40000\n",
                 {{"g_myMParams", {static_cast<void *>(parameters), VariableType::Structure}}});
  ASSERT_EQ(text.error, GCodeError::None);
  ASSERT_EQ(text.objects.size(), 3U);
  EXPECT_EQ(text.objects[0].moveType, MoveType::Function);
  EXPECT_EQ(text.objects[0].switchId[0], 10);
  EXPECT_EQ(text.objects[1].switchId[0], 13);
  for (int i = 0; i < 8; ++i)
    EXPECT_EQ(text.objects[1].shape[i], parameters[i]);
  EXPECT_EQ(text.objects[1].parameterRange[0], 2.5);
  EXPECT_EQ(text.objects[1].parameterRange[1], -3);
  EXPECT_EQ(static_cast<uint16_t>(text.objects[2].switchId[0]), 40000);
}

TEST(Decoder, G6AndG15VariablesAreReadWhenTheirSentenceIs) {
  float radius = 50;
  uint8_t command = 1;
  const Variables variables = {{"g_fVar", {&radius, VariableType::Real}},
                               {"g_byCommand", {&command, VariableType::Byte}}};
  Scanned scanned = scanText("N0 G$g_byCommand$ X100 Y100\nN20 G2 X200 R$g_fVar$\n");
  resolve(scanned, variables);
  const DecodedText text = decodeWords(scanned.words);
  ASSERT_EQ(text.objects.size(), 2U);
  EXPECT_EQ(text.objects[0].moveType, MoveType::Line);
  expectHalfCircle(text.objects[1]);
  command = 0;
  radius = 65;
  const DecodedText again = decodeWords(scanned.words);
  EXPECT_EQ(again.objects[0].moveType, MoveType::Positioning);
  EXPECT_EQ(again.objects[1].shape[2], 65);
  radius = NAN;
  EXPECT_EQ(decodeWords(scanned.words).error, GCodeError::NotANumber);
}

TEST(Decoder, G7ToG9HalfCircleInThreeWays) {
  for (const char *arc : {"N20 G2 X200 Y100 R50\n", "N15 G99\nN20 G2 X200 Y100 I50 J0\n",
                          "N15 G98\nN20 G2 X200 Y100 I150 J100\n"}) {
    const DecodedText text = decodeText("N10 G1 X100 Y100\n" + std::string(arc));
    ASSERT_EQ(text.objects.size(), 2U) << arc;
    expectHalfCircle(text.objects[1]);
  }
}

TEST(Decoder, G10HalfEllipse) {
  const DecodedText text =
      decodeText("N10 G0 X100 Y100\nN15 G98\nN20 G8 X200 Y100 I150 J100 K45 R0.5\n");
  ASSERT_EQ(text.objects.size(), 2U);
  const PathObject &object = text.objects[1];
  EXPECT_EQ(object.moveType, MoveType::EllipseClockwise);
  EXPECT_NEAR(object.shape[0], 150, kNear);
  EXPECT_NEAR(object.shape[1], 100, kNear);
  EXPECT_NEAR(object.shape[2] * object.shape[4], 55.9016994, kNear);
  EXPECT_NEAR(object.shape[3] * object.shape[4], 55.9016994, kNear);
  EXPECT_NEAR(object.shape[4], 79.0569415, kNear);
  EXPECT_NEAR(object.shape[5], 39.5284708, kNear);
  EXPECT_EQ(object.shape[6], 45);
  EXPECT_EQ(object.shape[7], 0.5);
  EXPECT_NEAR(object.parameterRange[1], 180, kNear);
  EXPECT_NEAR(object.length, 191.4847711, kNear);
}

TEST(Decoder, G11ToG13VariablesAndJumps) {
  int16_t counter = -7;
  const Variables variables = {{"g_i", {&counter, VariableType::Int}}};
  EXPECT_EQ(decodeText("N1000 G36 O$g_i$ D5\n", variables).objects.size(), 0U);
  EXPECT_EQ(counter, 5);
  const DecodedText text = decodeText("N1000 G36 O$g_i$ D5\n"
                                      "N1010 G1 X100 F100 E100 E-100\n"
                                      "N1020 G1 X0\n"
                                      "N1030 G37 O$g_i$ D-1\n"
                                      "N1040 G20 L1010 K$g_i$\n",
                                      variables);
  EXPECT_EQ(text.objects.size(), 10U);
  EXPECT_EQ(counter, 0);
  const DecodedText implicit =
      decodeText("N1000 G36 D5\nN1010 G1 X100 F100 E100 E-100\nN1020 G1 X0\n"
                 "N1030 G37 D-1\nN1040 G20 L1010\n");
  EXPECT_EQ(implicit.objects.size(), 10U);
  EXPECT_EQ(implicit.decoder.counter, 0);
  // The implicit variable begins as -1: the jump is made.
  EXPECT_EQ(decodeText("N1 G20 L3\nN2 G1 X1\nN3 G1 X2\n").objects.size(), 1U);
  EXPECT_EQ(decodeText("N1 G20 L7\n").error, GCodeError::UnknownJump);
}

TEST(Decoder, G14NumbersMayRepeat) {
  const DecodedText text = decodeText("G92 X0 Y30\nN0 G01 X20.000000 Y40.000000\n"
                                      "N10 G01 X40.000000 Y50.000000\n"
                                      "N20 G01 X123.000000 Y73.550000\n");
  ASSERT_EQ(text.objects.size(), 4U);
  EXPECT_NEAR(text.objects[1].length, text.objects[2].length, kNear);
  expectPlace(text.objects[3].end, 123, 73.55);
}

TEST(Decoder, G17MarksStandAtTheRightObjects) {
  const DecodedText text = decodeText("G1 X1\nG51 D10\nG1 X2\nG1 X3\nG50\nG1 X4\n"
                                      "G42 D2\nG61\nG1 X5\nG40\nG60\nG1 X6\n");
  ASSERT_EQ(text.error, GCodeError::None);
  ASSERT_EQ(text.objects.size(), 6U);
  const int marks[] = {
      0, kSmooth, kEndSmoothing, 0, kToolRight | kAvoidLoops | kEndToolCorrection | kEndAvoidLoops,
      0};
  const double radii[] = {0, 10, 10, 10, 2, 2};
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(text.objects[i].marks, marks[i]) << i;
    EXPECT_EQ(text.objects[i].toolRadius, radii[i]) << i;
    EXPECT_EQ(text.objects[i].cornerDistance, radii[i]) << i;
  }
}

TEST(Decoder, DOfTheToolIsNoDistanceFromTheCornerInSoftMotion3) {
  const Scanned scanned = scanText("G1 X1\nG51 D10\nG41 D2\nG1 X2\nD3\nG1 X3\nG1 X4 D4\n"
                                   "G40 D5\nG1 X5\nG36 D6\nG1 X6\nG42 D7\nG50 D8\nG1 X7\n");
  const double radii[] = {0, 2, 2, 2, 2, 2, 7};
  const double distances[] = {0, 10, 3, 4, 4, 4, 8};
  const double both[] = {0, 2, 3, 4, 5, 5, 8};
  for (const bool separate : {false, true}) {
    const DecodedText text = decodeWords(scanned.words, {}, false, 1000, separate);
    ASSERT_EQ(text.error, GCodeError::None);
    ASSERT_EQ(text.objects.size(), 7U);
    for (size_t i = 0; i < 7; ++i) {
      EXPECT_EQ(text.objects[i].toolRadius, separate ? radii[i] : both[i]) << i;
      EXPECT_EQ(text.objects[i].cornerDistance, separate ? distances[i] : both[i]) << i;
    }
  }
}
