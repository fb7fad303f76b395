// SMC_SmoothPath and SMC_RoundPath as streams: where they begin and end, and what stays.
#include "tests/unit/cnc_processors/sampled_path.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include "runtime/numeric/cnc/processors/corner_path.hpp"
#include "runtime/numeric/cnc/processors/limit_circular.hpp"
#include "runtime/numeric/cnc/processors/transform.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <memory>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

using Path = std::vector<PathObject>;

SmoothPath smooth(double distance, DistanceRule rule = DistanceRule::ToolRadiusAdded) {
  SmoothPath p{};
  p.distance = distance;
  p.rule = rule;
  p.kind = PieceKind::Cubic;
  return p;
}
RoundPath round(double distance, DistanceRule rule = DistanceRule::ToolRadiusElse) {
  RoundPath p{};
  p.distance = distance;
  p.rule = rule;
  p.kind = PieceKind::Arc;
  return p;
}

PathObject function(int16_t id, const Point &at) {
  PathObject o = object(MoveType::Function, at, at);
  o.switchId[0] = id;
  return o;
}

/// A staircase of lines, numbered from 1 on; lengths differ.
Path stairs(int count) {
  Path path;
  Point here{1, 2, 0};
  for (int i = 0; i < count; ++i) {
    const double length = 4 + i % 3;
    const Point to = here + (i % 2 == 0 ? Point{length, 0, 0} : Point{0.5 * length, length, 0});
    path.push_back(line(here, to));
    path.back().number = i + 1;
    here = to;
  }
  return path;
}

std::string kinds(const Path &path) {
  std::string text;
  for (const PathObject &o : path) {
    switch (o.moveType) {
    case MoveType::Line:
      text += 'L';
      break;
    case MoveType::Spline:
    case MoveType::Spline3d:
      text += 'S';
      break;
    case MoveType::Clockwise:
    case MoveType::Counterclockwise:
      text += 'A';
      break;
    case MoveType::Function:
      text += o.switchId[0] == kSynchronise ? '|' : 'M';
      break;
    case MoveType::Jump:
      text += 'J';
      break;
    default:
      text += 'R';
    }
  }
  return text;
}

void expectSame(const Path &a, const Path &b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i)
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): to the byte
    EXPECT_EQ(std::memcmp(&a[i], &b[i], sizeof a[i]), 0) << i;
}

void expectInOnePiece(const Path &path) {
  for (size_t i = 1; i < path.size(); ++i)
    EXPECT_EQ(startOf(path[i]), endOf(path[i - 1])) << i;
}

TEST(CornerPath, OnlyBetweenTheMarks) {
  Path path = stairs(7);
  path[1].marks = kSmooth;
  path[4].marks = kEndSmoothing;
  SmoothPath p = smooth(0.5);
  const Outcome run = runPath(p, path);
  EXPECT_EQ(kinds(run.objects), "LLSLSLSLLL"); // corners after 1, 2 and 3
  expectInOnePiece(run.objects);
  EXPECT_EQ(run.objects[1].marks, kSmooth);
  EXPECT_EQ(run.objects[7].marks, kEndSmoothing);
  RoundPath other = round(0.5);
  EXPECT_EQ(kinds(runPath(other, path).objects), "LLLLLLL");
}

TEST(CornerPath, MarksMayStandAtFunctions) {
  Path path = stairs(5);
  path.insert(path.begin() + 1, function(3, startOf(path[1])));
  path[1].marks = kRound; // G52 before M3
  path.insert(path.begin() + 4, function(4, startOf(path[4])));
  path[4].marks = kEndSmoothing;
  for (const bool passes : {false, true}) {
    RoundPath p = round(0.5);
    p.passesFunctions = passes;
    EXPECT_EQ(kinds(runPath(p, path).objects), "LMLALMLL") << passes;
  }
}

TEST(CornerPath, DistanceOfBothLibraries) {
  Path path = stairs(2);
  path[0].marks = kSmooth | kRound;
  path[0].toolRadius = 0.25;
  path[0].cornerDistance = 0.5;
  path[1].toolRadius = 1.5;
  const auto cut = [&](auto p) {
    const Outcome run = runPath(p, path);
    return run.objects.size() == 3 ? sizeOf(endOf(run.objects[0]) - endOf(path[0])) : 0.0;
  };
  EXPECT_NEAR(cut(smooth(1)), 1.25, 1e-12);
  EXPECT_NEAR(cut(smooth(0)), 0.25, 1e-12);
  EXPECT_NEAR(cut(smooth(1, DistanceRule::CornerDistanceAdded)), 1.5, 1e-12);
  EXPECT_NEAR(cut(round(1)), 1, 1e-12); // dominant
  EXPECT_NEAR(cut(round(0)), 0.25, 1e-12);
  EXPECT_NEAR(cut(round(1, DistanceRule::CornerDistanceAdded)), 1.5, 1e-12);
  EXPECT_EQ(cut(smooth(-0.25)), 0);
  EXPECT_NEAR(cut(round(100)), 2, 1e-12); // half of the first
}

TEST(CornerPath, FunctionsStayAtTheirCorner) {
  Path path = stairs(4);
  path[0].marks = kSmooth;
  path.insert(path.begin() + 2, function(5, startOf(path[2])));
  SmoothPath p = smooth(0.5);
  const Outcome run = runPath(p, path);
  EXPECT_EQ(kinds(run.objects), "LSLMLSL");
  EXPECT_EQ(startOf(run.objects[3]), startOf(path[2]));
  EXPECT_EQ(endOf(run.objects[2]), startOf(path[2]));
}

TEST(CornerPath, FunctionsComeAfterThePieceInSoftMotion3) {
  Path path = stairs(4);
  path[0].marks = kSmooth;
  path.insert(path.begin() + 2, function(5, startOf(path[2])));
  path.insert(path.begin() + 3, function(6, startOf(path[2])));
  SmoothPath p = smooth(0.5);
  p.passesFunctions = true;
  const Outcome run = runPath(p, path);
  EXPECT_EQ(kinds(run.objects), "LSLSMMLSL");
  EXPECT_EQ(run.objects[4].switchId[0], 5);
  EXPECT_EQ(run.objects[5].switchId[0], 6);
  expectInOnePiece(run.objects);
  // More than can be held back: they stay, and so does the corner.
  path.insert(path.begin() + 2, kMostAtCorner - 1, function(7, startOf(path[2])));
  EXPECT_EQ(kinds(runPath(p, path).objects), "LSL" + std::string(9, 'M') + "LSL");
  path.erase(path.begin() + 2);
  EXPECT_EQ(kinds(runPath(p, path).objects), "LSLS" + std::string(8, 'M') + "LSL");
}

TEST(CornerPath, NothingIsHeldBackAtASynchronisation) {
  Path path = stairs(4);
  path[0].marks = kSmooth;
  path.insert(path.begin() + 2, function(kSynchronise, startOf(path[2])));
  for (const bool passes : {false, true}) {
    SmoothPath p = smooth(0.5);
    p.passesFunctions = passes;
    const Outcome run = runPath(p, path);
    EXPECT_TRUE(run.ended);
    EXPECT_EQ(kinds(run.objects), "LSL|LSL");
  }
}

TEST(CornerPath, JumpsAndRapidMotionsStay) {
  Path path = stairs(5);
  path[0].marks = kRound;
  path[2].moveType = MoveType::Positioning;
  path.push_back(object(MoveType::Jump, {0, 0, 0}, {50, 0, 0}));
  path.push_back(line({50, 0, 0}, {60, 0, 0}));
  path.push_back(line({60, 0, 0}, {60, 9, 0}));
  RoundPath p = round(0.5);
  EXPECT_EQ(kinds(runPath(p, path).objects), "LALRLALJLAL");
}

TEST(CornerPath, ASquareBecomesACircle) {
  Path path;
  const Point corners[] = {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 0}};
  for (int i = 0; i < 4; ++i)
    path.push_back(line(corners[i], corners[i + 1]));
  path[0].marks = kRound;
  path[2].marks = kEndAvoidLoops;
  RoundPath p = round(3);
  const Outcome run = runPath(p, path);
  EXPECT_EQ(kinds(run.objects), "LAAAL");
  EXPECT_EQ(run.objects[3].marks, kEndAvoidLoops);
  expectInOnePiece(run.objects);
  for (int i = 1; i < 4; ++i) {
    EXPECT_NEAR(run.objects[static_cast<size_t>(i)].shape[0], 3, 1e-12);
    EXPECT_NEAR(run.objects[static_cast<size_t>(i)].shape[2], 3, 1e-12);
  }
}

TEST(CornerPath, ALineOfSmallRestsIsLeftBetweenPieces) {
  Path path = stairs(3);
  path[0].marks = kRound;
  RoundPath p = round(100);
  const Outcome run = runPath(p, path);
  // Half of the shorter object: of the first corner's 4, of the second's 5 by root(1.25).
  EXPECT_EQ(kinds(run.objects), "LALAL");
  EXPECT_NEAR(run.objects[0].length, 2, 1e-12);
  expectInOnePiece(run.objects);
}

TEST(CornerPath, AnyQueueAndAnyRhythmGiveTheSame) {
  Path path = stairs(60);
  path[3].marks = kSmooth;
  path[20].marks = kEndSmoothing;
  path[25].marks = kSmooth;
  for (const size_t at : {55U, 41U, 40U, 30U, 30U, 30U, 30U, 10U})
    path.insert(path.begin() + static_cast<int>(at), function(9, startOf(path[at])));
  path.insert(path.begin() + 33, function(kSynchronise, startOf(path[33])));
  for (const bool passes : {false, true}) {
    const auto run = [&](const Rhythm &rhythm) {
      SmoothPath p = smooth(0.7);
      p.passesFunctions = passes;
      const Outcome outcome = runPath(p, path, rhythm);
      EXPECT_TRUE(outcome.ended);
      EXPECT_LE(outcome.most, kMostPerStep);
      return outcome.objects;
    };
    const Path whole = run({200, 400, 0, 0});
    expectInOnePiece(whole);
    for (uint32_t places = 5; places < 12; ++places)
      for (uint32_t seed = 0; seed < 6; ++seed)
        expectSame(run({places, 16 - places, seed, 100000}), whole);
  }
}

TEST(CornerPath, WhatIsNoDistanceIsAnError) {
  Path path = stairs(3);
  const auto error = [&](double distance, double turn) {
    SmoothPath p = smooth(distance);
    p.leastTurn = turn;
    return runPath(p, path).stream.error;
  };
  EXPECT_EQ(error(std::nan(""), 0), StreamError::InvalidParameter);
  EXPECT_EQ(error(std::numeric_limits<double>::infinity(), 0), StreamError::InvalidParameter);
  EXPECT_EQ(error(1, std::nan("")), StreamError::InvalidParameter);
  EXPECT_EQ(error(1, 0), StreamError::None);
}

template <class First, class Second> Path chained(First first, Second second, const Path &path) {
  return runPath(second, runPath(first, path, {9, 6, 2, 0}).objects, {6, 8, 3, 0}).objects;
}

TEST(CornerPath, TurningAndLimitsMayComeBeforeOrAfter) {
  Path path = stairs(8);
  path[1].marks = kSmooth | kRound;
  path.insert(path.begin() + 5, function(9, startOf(path[5])));
  path.back().switchId[0] = 2;
  path.back().switchPosition[0] = 0.125;
  RotatePath turn{};
  turn.wanted = {TransformKind::Rotate, {37.5, 0, 0}};
  TranslatePath shift{};
  shift.wanted = {TransformKind::Translate, {-3, 4, 5}};
  const auto expectAlike = [](const Path &a, const Path &b) {
    ASSERT_EQ(a.size(), b.size());
    ASSERT_EQ(kinds(a), kinds(b));
    for (size_t i = 0; i < a.size(); ++i) {
      for (int k = 0; k <= 8; ++k)
        EXPECT_LT(sizeOf(placeAt(a[i], k / 8.0) - placeAt(b[i], k / 8.0)), 1e-11) << i;
      EXPECT_NEAR(a[i].length, b[i].length, 1e-11);
      EXPECT_NEAR(a[i].velocityEnd, b[i].velocityEnd, 1e-9);
      EXPECT_EQ(a[i].marks, b[i].marks);
      EXPECT_EQ(a[i].switchId[0], b[i].switchId[0]);
      EXPECT_NEAR(a[i].switchPosition[0], b[i].switchPosition[0], 1e-11);
    }
  };
  expectAlike(chained(smooth(0.75), turn, path), chained(turn, smooth(0.75), path));
  expectAlike(chained(round(1.25), shift, path), chained(shift, round(1.25), path));
  LimitCircular limit{};
  limit.acceleration = 30;
  limit.jump = 20;
  const Path rounded = runPath(*std::make_unique<RoundPath>(round(1.25)), path).objects;
  expectAlike(chained(limit, turn, rounded), chained(turn, limit, rounded));
}

TEST(CornerPath, TheSecondTimeNothingChanges) {
  Path path = stairs(9);
  path[0].marks = kSmooth;
  SmoothPath p = smooth(0.8);
  const Path once = runPath(p, path).objects;
  p.leastTurn = 1e-6;
  expectSame(runPath(p, once).objects, once);
}

} // namespace
