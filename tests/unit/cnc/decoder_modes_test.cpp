// What is modal, curves other than arcs, planes, and what is wrong with sentences.
#include "tests/unit/cnc/gcode_text.hpp"

#include "runtime/numeric/cnc/decoder_internal.hpp"

#include <cmath>
#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

using namespace stride::cnc;
using namespace stride::cnc::test;

namespace {

constexpr double kNear = 1e-9;

double at(const PathObject &object, int axis, double t) {
  const double *c = object.shape + 4 * axis;
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

GCodeError errorOf(const char *text) { return decodeText(text).error; }

uint16_t notesOf(const char *text) {
  const DecodedText decoded = decodeText(text);
  return decoded.notes.empty() ? 0 : decoded.notes.front();
}

} // namespace

TEST(DecoderModes, RelativeCoordinatesAndShifts) {
  const DecodedText text = decodeText("G54 X10 Y-5\nG1 X1 Y1\nG91\nX2 Z3\nG90\nX0\nG55 X1\nX0\n"
                                      "G56 X100\nX100\nG53\nX0 Y0\n");
  ASSERT_EQ(text.error, GCodeError::None);
  const double x[] = {11, 13, 10, 11, 11, 0};
  const double y[] = {-4, -4, -4, -4, -4, 0};
  ASSERT_EQ(text.objects.size(), 6U);
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(text.objects[i].end.coordinate[kAxisX], x[i]) << i;
    EXPECT_EQ(text.objects[i].end.coordinate[kAxisY], y[i]) << i;
  }
  EXPECT_EQ(text.objects[1].end.coordinate[kAxisZ], 3);
}

TEST(DecoderModes, AbsoluteCentresAreShiftedToo) {
  const DecodedText text = decodeText("G54 X10 Y20\nG98\nG2 X0 Y0 I-5 J-10\n");
  ASSERT_EQ(text.objects.size(), 1U);
  EXPECT_EQ(text.objects[0].moveType, MoveType::Clockwise);
  EXPECT_NEAR(text.objects[0].shape[0], 5, kNear);
  EXPECT_NEAR(text.objects[0].shape[1], 10, kNear);
}

TEST(DecoderModes, SmoothAxesBeginAndEnd) {
  const DecodedText text =
      decodeText("G1 X1\nG71 L8\nX2\nG71 L4\nX3\nX4\nG70 L4\nX5\nG70 L8\nG71 L8\n"
                 "X6\nG70 L8\nX7\nG71 L11\nG70 L11\nX8\n");
  ASSERT_EQ(text.error, GCodeError::None);
  const int expected[] = {0, 0x1010, 0x0111, 0x0011, 0x0010, 0x1010, 0, 0};
  ASSERT_EQ(text.objects.size(), 8U);
  for (size_t i = 0; i < 8; ++i)
    EXPECT_EQ(text.objects[i].smoothAxes, expected[i]) << i;
  for (const char *bad : {"G71 L3\n", "G71 L12\n", "G70 L4.5\n"})
    EXPECT_EQ(errorOf(bad), GCodeError::OutOfRange) << bad;
  EXPECT_EQ(errorOf("G71\n"), GCodeError::MissingWord);
  EXPECT_EQ(notesOf("G71 L4\n"), 0);
}

TEST(DecoderModes, VelocitiesOfG0) {
  const DecodedText text = decodeText(
      "F30 E200 E-300 FF90 EF400 EF-500\nG0 X1\nG1 X2\nFF0 EF0\nG0 X3 S3\nG1 X4 S-3 S7\n");
  ASSERT_EQ(text.objects.size(), 4U);
  const double expected[][4] = {
      {90, 0, 400, 500}, {30, 30, 200, 300}, {30, 0, 200, 300}, {30, 30, 200, 300}};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(text.objects[i].velocity, expected[i][0]);
    EXPECT_EQ(text.objects[i].velocityEnd, expected[i][1]);
    EXPECT_EQ(text.objects[i].acceleration, expected[i][2]);
    EXPECT_EQ(text.objects[i].deceleration, expected[i][3]);
  }
  EXPECT_EQ(text.objects[1].start.sProfile, 0);
  EXPECT_EQ(text.objects[2].start.sProfile, 1U << kAxisZ);
  EXPECT_EQ(text.objects[3].start.sProfile, 1U << kAxisP);
}

TEST(DecoderModes, AxesAreThoseThatHaveBeenNamed) {
  Position start{};
  start.axes = 1U << kAxisV;
  start.coordinate[kAxisV] = 4;
  const DecodedText text = decodeWords(scanText("G1 X1\nQ3\nX2 W-1\n").words, start);
  ASSERT_EQ(text.objects.size(), 3U);
  EXPECT_EQ(text.objects[0].start.axes, 7U | 1U << kAxisV);
  EXPECT_EQ(text.objects[1].end.axes, 7U | 1U << kAxisV | 1U << kAxisQ);
  EXPECT_EQ(text.objects[1].length, 3);
  EXPECT_EQ(text.objects[2].length, 1);
  EXPECT_EQ(text.objects[2].end.coordinate[kAxisV], 4);
}

TEST(DecoderModes, PeriodsTakeTheShortestWay) {
  const DecodedText text =
      decodeText("PA360 PW10\nG92 A270\nG1 A45 W6\nA44 W-4\nA-316\nG91\nA720\nG90\nPA0\nA1\n");
  ASSERT_EQ(text.error, GCodeError::None);
  const double a[] = {270, 405, 404, 404, 1124, 1};
  const double w[] = {0, -4, -4, -4, -4, -4};
  ASSERT_EQ(text.objects.size(), 6U);
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(text.objects[i].end.coordinate[kAxisA], a[i], kNear) << i;
    EXPECT_NEAR(text.objects[i].end.coordinate[kAxisW], w[i], kNear) << i;
  }
  EXPECT_EQ(errorOf("PB-1"), GCodeError::NegativePeriod);
}

TEST(DecoderModes, LengthsInThePlaneAndInSpace) {
  const DecodedText text =
      decodeText("G15\nG1 X3 Z4\nZ9\nG17\nX6 Z13\nG3 I1 Z14\nG15\nG3 I1 Z13\n");
  ASSERT_EQ(text.objects.size(), 5U);
  EXPECT_EQ(decodeText("G1 X3 Z4\n").objects[0].length, 5); // in space, until G15
  EXPECT_EQ(text.objects[0].length, 3);
  EXPECT_TRUE(text.objects[0].planar);
  EXPECT_EQ(text.objects[1].length, 5);
  EXPECT_FALSE(text.objects[1].planar); // all of its way counts
  EXPECT_EQ(text.objects[2].length, 5);
  EXPECT_FALSE(text.objects[2].planar);
  EXPECT_NEAR(text.objects[3].length, std::hypot(2 * M_PI, 1), kNear);
  EXPECT_EQ(text.objects[3].parameterRange[1], -360);
  EXPECT_NEAR(text.objects[4].length, 2 * M_PI, kNear);
}

TEST(DecoderModes, ArcsInOtherPlanes) {
  // G18: Z is the first axis, X the second; G19: Y and Z; G16 across the diagonal.
  const DecodedText text = decodeText("G18\nG3 X10 Z-10 K-10\nG19\nG2 Y7 Z-17 J7\n"
                                      "G16 I1 J1\nG2 X17 Y0 K5 I3.5 J-3.5\n");
  ASSERT_EQ(text.error, GCodeError::None);
  ASSERT_EQ(text.objects.size(), 3U);
  const PathObject &first = text.objects[0];
  EXPECT_NEAR(first.shape[0], -10, kNear);
  EXPECT_NEAR(first.shape[1], 0, kNear);
  EXPECT_NEAR(first.parameterRange[0], 0, kNear);
  EXPECT_NEAR(first.parameterRange[1], -90, kNear);
  const PathObject &second = text.objects[1];
  EXPECT_NEAR(second.shape[0], 7, kNear);
  EXPECT_NEAR(second.shape[1], -10, kNear);
  EXPECT_NEAR(second.shape[3], 10, kNear);
  EXPECT_NEAR(second.parameterRange[0], 180, kNear);
  EXPECT_NEAR(second.parameterRange[1], 270, kNear);
  const PathObject &third = text.objects[2];
  EXPECT_NEAR(third.normal.x, std::sqrt(0.5), kNear);
  EXPECT_NEAR(third.shape[2], std::hypot(3.5 * std::sqrt(2.0), 5.0), kNear);
  EXPECT_EQ(errorOf("G18\nG8 X1 I1 R1\n"), GCodeError::NotInThisPlane);
  EXPECT_EQ(errorOf("G16\n"), GCodeError::OutOfRange);
}

TEST(DecoderModes, OpeningAngles) {
  const DecodedText text = decodeText("G1 X10\nG3 I-10 J0 T90\nG2 I0 J-10 T90\nG3 I-10 T360\n");
  ASSERT_EQ(text.objects.size(), 4U);
  EXPECT_NEAR(text.objects[1].end.coordinate[kAxisX], 0, kNear);
  EXPECT_NEAR(text.objects[1].end.coordinate[kAxisY], 10, kNear);
  EXPECT_NEAR(text.objects[1].parameterRange[1], -90, kNear);
  EXPECT_NEAR(text.objects[2].end.coordinate[kAxisX], 10, kNear);
  EXPECT_NEAR(text.objects[3].parameterRange[1], -360, kNear);
}

/// An arc leads to its end: it would be another one than T says.
TEST(DecoderModes, OpeningAnglesOfNoTurnOrMoreThanOneAreRefused) {
  for (const char *bad : {"G2 I1 T0\n", "G3 I1 T-90\n", "G3 I1 T360.001\n", "G2 J1 T720 Z3\n"})
    EXPECT_EQ(errorOf(bad), GCodeError::OutOfRange) << bad;
}

TEST(DecoderModes, ParabolaHasItsTangents) {
  const DecodedText text = decodeText("G1 X1 Y1\nG6 X9 Y1 I2 J4\nG98\nG6 X19 Y1 I9 J1\n"
                                      "G6 X21 Y1 I20 J1\nG6 X21 Y2 I21 J-9\n");
  ASSERT_EQ(text.objects.size(), 5U);
  const PathObject &parabola = text.objects[1];
  EXPECT_EQ(parabola.moveType, MoveType::Spline);
  EXPECT_NEAR(at(parabola, 0, 0.5), 0.25 * 1 + 0.5 * 3 + 0.25 * 9, kNear);
  EXPECT_NEAR(at(parabola, 1, 0.5), 0.5 * 1 + 0.5 * 5, kNear);
  EXPECT_NEAR(at(parabola, 0, 1), 9, kNear);
  const Vector3 begin = directionOf(parabola, false);
  EXPECT_NEAR(begin.x, 1 / std::sqrt(5.0), kNear);
  EXPECT_NEAR(begin.y, 2 / std::sqrt(5.0), kNear);
  const Vector3 end = directionOf(parabola, true);
  EXPECT_NEAR(end.x, 6 / std::sqrt(52.0), kNear);
  EXPECT_NEAR(end.y, -4 / std::sqrt(52.0), kNear);
  for (size_t i = 2; i < 5; ++i)
    EXPECT_EQ(text.objects[i].moveType, MoveType::Line) << i;
  // The corner at the start, and the one beyond the end, are not what a parabola has.
  EXPECT_THAT(text.notes, testing::ElementsAre(kNoteNoVelocity, kNoteNoVelocity,
                                               kNoteNoVelocity | kNoteCentreOff, kNoteNoVelocity,
                                               kNoteNoVelocity | kNoteCentreOff));
}

TEST(DecoderModes, SplinesGoOnFromWhatIsBeforeAndLeadIntoWhatComes) {
  const DecodedText text = decodeText("G1 X10\nG5 X20 Y5\nX30 Y-3\nX41 Y0\nG3 X51 Y10 J10\n");
  ASSERT_EQ(text.objects.size(), 5U);
  for (size_t i = 1; i < 5; ++i) {
    const Vector3 before = directionOf(text.objects[i - 1], true);
    const Vector3 behind = directionOf(text.objects[i], false);
    EXPECT_NEAR(before.x, behind.x, kNear) << i;
    EXPECT_NEAR(before.y, behind.y, kNear) << i;
  }
  // Between two points of a spline the direction is that of their neighbours' chord.
  const Vector3 between = directionOf(text.objects[1], true);
  EXPECT_NEAR(between.y / between.x, -3.0 / 20, kNear);
  for (size_t i = 1; i < 4; ++i)
    for (const int axis : {0, 1}) {
      EXPECT_NEAR(at(text.objects[i], axis, 0), text.objects[i].start.coordinate[axis], kNear);
      EXPECT_NEAR(at(text.objects[i], axis, 1), text.objects[i].end.coordinate[axis], kNear);
    }
  EXPECT_GT(text.objects[1].length, std::hypot(10, 5));
}

TEST(DecoderModes, SplinesWithFreeEndsAreMirrored) {
  const DecodedText text = decodeText("G1 X10\nG5 X20 Y10\nM3\nG5 X30 Y10\n");
  ASSERT_EQ(text.objects.size(), 4U);
  const Vector3 end = directionOf(text.objects[1], true);
  EXPECT_NEAR(end.x, 0, kNear);
  EXPECT_NEAR(end.y, 1, kNear);
  EXPECT_NEAR(directionOf(text.objects[3], false).y, 1, kNear);
  // Nothing says anything about its ends: a line.
  EXPECT_EQ(decodeText("G5 X1 Y1\n").objects[0].moveType, MoveType::Line);
  // After G92 the path begins anew.
  EXPECT_EQ(decodeText("G1 X5 Y1\nG92 X0\nG5 X1 Y1\n").objects[2].moveType, MoveType::Line);
}

TEST(DecoderModes, SplinesInSpace) {
  const DecodedText text =
      decodeText("G17\nG1 Z5\nG10 X5 Y1 Z10 H1 O0.5 H2 L-1\nX9 Y9 Z10\nG1 X20\n");
  ASSERT_EQ(text.objects.size(), 4U);
  for (size_t i = 1; i < 4; ++i) {
    const Vector3 gap =
        directionOf(text.objects[i - 1], true) - directionOf(text.objects[i], false);
    EXPECT_NEAR(stride::numeric::norm(gap), 0, kNear) << i;
  }
  EXPECT_EQ(text.objects[1].moveType, MoveType::Spline3d);
  EXPECT_EQ(text.objects[1].switchPosition[0], 0.5);
  EXPECT_NEAR(text.objects[1].switchPosition[1], 1 - 1 / text.objects[1].length, kNear);
  EXPECT_NEAR(text.objects[1].moreShape[4], 5, kNear); // Z at t = 0
}

TEST(DecoderModes, WaitingAndSynchronising) {
  const DecodedText text = decodeText("G4 T1.5\nG1 X1\nG75\nG41\nG31 X2\nG1 X3 PROBE 7\nX4\n");
  ASSERT_EQ(text.error, GCodeError::None);
  EXPECT_EQ(text.synchronised, 3);
  ASSERT_EQ(text.objects.size(), 8U);
  EXPECT_EQ(text.objects[0].switchId[0], kDwell);
  EXPECT_EQ(text.objects[0].parameterRange[0], 1.5);
  EXPECT_EQ(text.objects[2].switchId[0], kSynchronise);
  EXPECT_EQ(text.objects[3].marks, kToolLeft);
  EXPECT_EQ(text.objects[3].probe, 1);
  EXPECT_EQ(text.objects[4].switchId[0], kSynchronise);
  EXPECT_EQ(text.objects[5].probe, 7);
  EXPECT_EQ(text.objects[7].probe, 0);
}

TEST(DecoderModes, FeaturesAndLimits) {
  const DecodedText text =
      decodeText("G38 O3 I1 K3\nFZ5 EW-7\nG1 X1\nG38 O31\nG39 O3\nX2 EW0 EW8\n");
  ASSERT_EQ(text.objects.size(), 2U);
  EXPECT_EQ(text.objects[0].features, 8U);
  EXPECT_EQ(text.objects[0].additional[0], 1);
  EXPECT_EQ(text.objects[0].additional[2], 3);
  EXPECT_EQ(text.objects[0].limits[0].velocity, 5);
  EXPECT_EQ(text.objects[0].limits[8].deceleration, 7);
  EXPECT_EQ(text.objects[1].features, 1U << 31);
  EXPECT_EQ(text.objects[1].limits[8].acceleration, 0);
}

TEST(DecoderModes, ErrorsOfSentences) {
  EXPECT_EQ(errorOf("G7\n"), GCodeError::UnknownFunction);
  EXPECT_EQ(errorOf("G-1\n"), GCodeError::UnknownFunction);
  EXPECT_EQ(errorOf("X1\n"), GCodeError::NoFunction);
  EXPECT_EQ(errorOf("G1 X1 M3\n"), GCodeError::TwoInstructions);
  EXPECT_EQ(errorOf("G1 G2 X1\n"), GCodeError::TwoInstructions);
  EXPECT_EQ(errorOf("G2 X1\n"), GCodeError::MissingWord);
  EXPECT_EQ(errorOf("G8 X1 I1\n"), GCodeError::MissingWord);
  EXPECT_EQ(errorOf("G8 X2 I1 R0\n"), GCodeError::OutOfRange);
  EXPECT_EQ(errorOf("G6 X2\n"), GCodeError::MissingWord);
  EXPECT_EQ(errorOf("E0.99\n"), GCodeError::Acceleration);
  EXPECT_EQ(errorOf("E1\nE-1\n"), GCodeError::None);
  EXPECT_EQ(errorOf("E0\n"), GCodeError::Acceleration);
  EXPECT_EQ(errorOf("E-0.99\n"), GCodeError::Deceleration);
  EXPECT_EQ(errorOf("F-1\n"), GCodeError::OutOfRange);
  EXPECT_EQ(errorOf("M0\n"), GCodeError::OutOfRange);
  EXPECT_EQ(errorOf("M65533\n"), GCodeError::OutOfRange);
  EXPECT_EQ(errorOf("M65532\n"), GCodeError::None);
  EXPECT_EQ(errorOf("M5 O3\n"), GCodeError::NoVariable);
  EXPECT_EQ(errorOf("G4\n"), GCodeError::MissingWord);
  EXPECT_EQ(errorOf("G4 T-1\n"), GCodeError::OutOfRange);
  EXPECT_EQ(errorOf("G20\n"), GCodeError::MissingWord);
  EXPECT_EQ(errorOf("G20 L1.5\n"), GCodeError::NotWhole);
  EXPECT_EQ(errorOf("G36\n"), GCodeError::MissingWord);
  EXPECT_EQ(errorOf("G36 O5 D1\n"), GCodeError::NoVariable);
  EXPECT_EQ(errorOf("G38 O32\n"), GCodeError::OutOfRange);
  EXPECT_EQ(errorOf("H0 O1\n"), GCodeError::OutOfRange);
  EXPECT_EQ(errorOf("S2\n"), GCodeError::OutOfRange);
  EXPECT_EQ(errorOf("S12\n"), GCodeError::OutOfRange);
  EXPECT_EQ(errorOf("PROBE 0\n"), GCodeError::OutOfRange);
  double parameters[8] = {};
  const Variables variables = {{"m", {static_cast<void *>(parameters), VariableType::Structure}},
                               {"x", {static_cast<void *>(parameters), VariableType::Lreal}}};
  EXPECT_EQ(decodeText("M5 O$x$", variables).error, GCodeError::WrongVariable);
  EXPECT_EQ(decodeText("G36 O$m$ D1", variables).error, GCodeError::WrongVariable);
  EXPECT_EQ(decodeText("G1 X$m$", variables).error, GCodeError::NotANumber);
}

TEST(DecoderModes, ArcsThatAreLines) {
  EXPECT_EQ(notesOf("F1\nG2 X10 R5.06\n"), 0);
  EXPECT_EQ(notesOf("F1\nG2 X10 R4.96\n"), 0);
  EXPECT_EQ(notesOf("F1\nG2 X10 R4.94\n"), kNoteRadiusTooSmall);
  EXPECT_EQ(notesOf("F1\nG2 X10 R-7\n"), kNoteRadiusTooSmall);
  EXPECT_EQ(notesOf("F1\nG2 X10 I5.04\n"), 0);
  EXPECT_EQ(notesOf("F1\nG2 X10 I5.06\n"), kNoteCentreOff);
  EXPECT_EQ(notesOf("F1\nG2 X0 R5\n"), kNoteEmptyArc);
  EXPECT_EQ(notesOf("F1\nG2 X10 I0 J0\n"), kNoteEmptyArc);
  EXPECT_EQ(notesOf("F1\nG2 R5\n"), kNoteEmptyArc);
  EXPECT_EQ(notesOf("G1 X1\n"), kNoteNoVelocity);
  EXPECT_EQ(notesOf("F1\nG1 H1 O0\n"), kNoteLostSwitch);
  EXPECT_EQ(notesOf("G41 D1\nG61\n"), 0);
  EXPECT_EQ(notesOf("G43 K1\n"), kNoteNoProcessor);
  EXPECT_EQ(notesOf("G51 D1\nG52 D1\n"), 0);
  EXPECT_EQ(decodeText("G2 X10 I7\n").objects[0].moveType, MoveType::Line);
  EXPECT_EQ(decodeText("G2 X10 I7\n").objects[0].length, 10);
}

TEST(DecoderModes, SuppressedSentences) {
  const Scanned scanned = scanText("G1 X1\n/X2\n/ N4 X3\nX4\n");
  EXPECT_EQ(decodeWords(scanned.words).objects.size(), 4U);
  EXPECT_EQ(decodeWords(scanned.words, {}, true).objects.size(), 2U);
}

TEST(DecoderModes, AppendedProgramsGoOn) {
  DecodedText first = decodeText("G91\nF5 G1 X1\n");
  const Scanned next = scanText("X2\n");
  Decoded decoded;
  decodeSentence(first.decoder, next.words.data(), 1, 1, decoded);
  EXPECT_EQ(decoded.count, 0);
  decodeEnd(first.decoder, decoded);
  ASSERT_EQ(decoded.count, 1);
  EXPECT_EQ(decoded.objects[0].end.coordinate[kAxisX], 3);
  EXPECT_EQ(decoded.objects[0].velocity, 5);
}
