// Merged lines: by an independent measure of distances every programmed place is near the result in
// the order of the program, and the result near the program; what must not be merged is there
// still.
#include "runtime/numeric/cnc/chord_merge.hpp"

#include "tests/oracle/path/path_chain.hpp"

#include "motion_problems.hpp"
#include "random_objects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace stride::test;
using stride::oracle::PathChain;

using Path = std::vector<PathObject>;

PathObject lineTo(const Position &start, const Place &end) {
  PathObject o{};
  o.moveType = MoveType::Line;
  o.start = o.end = start;
  o.start.axes = o.end.axes = 0x000F;
  put(o.end, end);
  o.velocity = o.velocityEnd = 5;
  o.acceleration = o.deceleration = 100;
  o.length = distance(placeAt(o.start), end);
  return o;
}

Path merged(const Path &path, double tolerance) {
  Merger merger{};
  merger.tolerance = tolerance;
  Path result;
  PathObject ready[2];
  for (const PathObject &object : path)
    for (int n = mergeNext(merger, object, ready), j = 0; j < n; ++j)
      result.push_back(ready[j]);
  for (int n = mergeEnd(merger, ready[0]), j = 0; j < n; ++j)
    result.push_back(ready[j]);
  EXPECT_EQ(mergeEnd(merger, ready[0]), 0);
  return result;
}

/// Curves as short lines, with noise, turns back and corners; A goes along.
Path randomPath(Random &random, double scale) {
  Path path;
  Position here{};
  double direction = 0;
  const double noise = scale * random.magnitude(-4, -0.5);
  const double bend = random.uniform(-0.1, 0.1);
  const int count = 2 + random.below(400);
  for (int i = 0; i < count; ++i) {
    direction += random.chance(0.02) ? random.uniform(-3, 3) : bend;
    const double step = scale * random.magnitude(-1, 0);
    const auto rough = [&] { return noise * random.uniform(-1, 1); };
    const Place end = {here.coordinate[0] + step * std::cos(direction) + rough(),
                       here.coordinate[1] + step * std::sin(direction) + rough(),
                       here.coordinate[2] + rough()};
    path.push_back(lineTo(here, end));
    path.back().sourceLine = i;
    path.back().end.coordinate[kAxisA] += scale * random.uniform(-0.1, 0.3);
    here = path.back().end;
  }
  return path;
}

stride::oracle::Place chainPlace(const Position &p) {
  return {p.coordinate[0], p.coordinate[1], p.coordinate[2], p.coordinate[kAxisA]};
}
PathChain chainOf(const Path &path) {
  PathChain chain(chainPlace(path.front().start));
  for (const PathObject &object : path)
    chain.addLine(chainPlace(object.end));
  return chain;
}

/// `few` is what some of the lines of `many` have become.
void expectNear(const Path &many, const Path &few, double tolerance) {
  ASSERT_EQ(placeAt(few.front().start), placeAt(many.front().start));
  ASSERT_EQ(placeAt(few.back().end), placeAt(many.back().end));
  const double most = tolerance * (1 + 1e-9) + 1e-12;
  size_t at = 0;
  for (const PathObject &line : few) {
    ASSERT_EQ(placeAt(line.start), placeAt(many[at].start));
    ASSERT_EQ(line.sourceLine, many[at].sourceLine);
    Path run;
    while (run.empty() || placeAt(run.back().end) != placeAt(line.end)) {
      ASSERT_LT(at, many.size());
      run.push_back(many[at]);
      ++at;
    }
    ASSERT_LE(run.size(), static_cast<size_t>(kMostMerged));
    const PathChain one = chainOf({line});
    const PathChain its = chainOf(run);
    // In order: how far along the line one may be grows with the program. A is at most as far away.
    double gone = 0;
    for (const PathObject &object : run) {
      double least = 1e300;
      double found = gone;
      for (int k = 0; k <= 400; ++k) { // the first place that is near enough
        const double way = gone + (one.length() - gone) * k / 400;
        const auto a = one.at(way);
        const auto b = chainPlace(object.end);
        const double away = std::max(stride::oracle::distance(a, b, 3), std::fabs(a[3] - b[3]));
        if (away < least)
          found = way;
        least = std::min(least, away);
        if (away <= tolerance)
          break;
      }
      ASSERT_LE(least, most + one.length() / 400);
      gone = found;
    }
    for (int k = 0; k <= 20; ++k) {
      const auto place = one.at(one.length() * k / 20);
      ASSERT_LE(its.nearest(place, 0, its.length()).distance, most);
    }
    for (const PathObject &object : run)
      ASSERT_LE(one.nearest(chainPlace(object.end), 0, one.length()).distance, most);
  }
  ASSERT_EQ(at, many.size());
}

TEST(CncChordMerge, BothPathsAreNearEachOther) {
  size_t before = 0;
  size_t after = 0;
  for (int i = 0; i < casesOf(300) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const double scale = random.magnitude(-3, 3);
    const Path path = randomPath(random, scale);
    const double tolerance = random.chance(0.1) ? 0 : scale * random.magnitude(-3, 0.5);
    const Path result = merged(path, tolerance);
    ASSERT_NO_FATAL_FAILURE(expectNear(path, result, tolerance));
    before += path.size();
    after += result.size();
  }
  EXPECT_LT(after * 4, before * 3);
}

/// `count` lines of 1 along X, by (0, 0, 0).
Path straight(int count) {
  Path path;
  Position here{};
  for (int i = 1; i <= count; ++i) {
    path.push_back(lineTo(here, {i * 1.0, 0, 0}));
    here = path.back().end;
  }
  return path;
}

TEST(CncChordMerge, StraightRunsAreAsLongAsTheyMayBe) {
  EXPECT_EQ(merged(straight(kMostMerged), 0).size(), 1U);
  const Path result = merged(straight(kMostMerged + 1), 0);
  ASSERT_EQ(result.size(), 2U);
  EXPECT_EQ(result[0].length, kMostMerged);
  EXPECT_EQ(result[1].length, 1);
  EXPECT_TRUE(merged({}, 1).empty());
}

TEST(CncChordMerge, AMillionLinesOfAMicrometreBecomeFew) {
  constexpr int kLines = 1'000'000;
  Merger merger{};
  merger.tolerance = 1e-4;
  PathObject ready[2];
  Position here{};
  int count = 0;
  double length = 0;
  const auto take = [&](int n) {
    for (int j = 0; j < n; ++j) {
      ++count;
      length += ready[j].length;
    }
  };
  for (int i = 1; i <= kLines; ++i) {
    const PathObject line = lineTo(here, {0.0006 * i, 0.0008 * i, 0});
    here = line.end;
    take(mergeNext(merger, line, ready));
  }
  take(mergeEnd(merger, ready[0]));
  EXPECT_LE(count, kLines / kMostMerged + 1);
  EXPECT_NEAR(length, 0.001 * kLines, 1e-6);
}

TEST(CncChordMerge, ThereAndBackIsNotLost) {
  Path path = straight(2);
  path.push_back(lineTo(path.back().end, {1.5, 0, 0})); // back by 0.5
  path.push_back(lineTo(path.back().end, {4, 0, 0}));
  EXPECT_EQ(merged(path, 0.4).size(), 3U);
  EXPECT_EQ(merged(path, 0.6).size(), 1U); // who waits at 1.4 is near enough to both
}

TEST(CncChordMerge, WhatDiffersIsABorder) {
  using Change = void (*)(PathObject &);
  const Change changes[] = {
      [](PathObject &o) { o.moveType = MoveType::Positioning; },
      [](PathObject &o) { o.marks = kSmooth; },
      [](PathObject &o) { o.switchId[1] = 4; },
      [](PathObject &o) { o.velocity = 6; },
      [](PathObject &o) { o.acceleration = 101; },
      [](PathObject &o) { o.deceleration = 99; },
      [](PathObject &o) { o.probe = 1; },
      [](PathObject &o) { o.features = 2; },
      [](PathObject &o) { o.toolRadius = 3; },
      [](PathObject &o) { o.start.sProfile = 8; },
      [](PathObject &o) { o.limits[8].velocity = 1; },
      [](PathObject &o) { o.end.axes = 0x001F; },
      [](PathObject &o) { o.cornerDistance = 1; },
      [](PathObject &o) { o.planar = 1; },
  };
  for (const Change &change : changes) {
    SCOPED_TRACE(&change - changes);
    Path path = straight(7);
    change(path[3]);
    const Path result = merged(path, 10);
    ASSERT_EQ(result.size(), 3U);
    EXPECT_EQ(result[0].length, 3);
    EXPECT_EQ(result[1].length, 1);
    EXPECT_EQ(result[2].length, 3);
  }
  Path path = straight(7);
  path[3].velocityEnd = 0; // a stop
  const Path result = merged(path, 10);
  ASSERT_EQ(result.size(), 2U);
  EXPECT_EQ(result[0].length, 4);
  EXPECT_EQ(result[0].velocityEnd, 0);
}

TEST(CncChordMerge, OtherAxesKeepTheToleranceToo) {
  Path path = straight(2);
  path[0].end.coordinate[kAxisA] = path[1].start.coordinate[kAxisA] = 3;
  EXPECT_EQ(merged(path, 2.9).size(), 2U); // at 1 A would be 0 instead of 3
  EXPECT_EQ(merged(path, 3.1).size(), 1U);
}

} // namespace
