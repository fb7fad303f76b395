// SMC_SmoothBSpline, against the definition of B-splines by Cox and de Boor.
#include "tests/unit/cnc_processors/sampled_path.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include "runtime/numeric/cnc/processors/smooth_bspline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

using Path = std::vector<PathObject>;

Path polyline(const std::vector<Point> &places) {
  Path path;
  for (size_t i = 1; i < places.size(); ++i) {
    PathObject o = line(places[i - 1], places[i]);
    o.sentence = static_cast<int32_t>(i);
    path.push_back(o);
  }
  return path;
}

std::vector<Point> randomPlaces(size_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(0.2, 3);
  std::vector<Point> places{{1, 2, 3}};
  while (places.size() < count)
    places.push_back(places.back() + Point{step(random), step(random) - 1.5, step(random) - 1});
  return places;
}

Outcome splined(const Path &path, KnotSpacing spacing = KnotSpacing::Uniform,
                const Rhythm &rhythm = {}) {
  SmoothBSpline spline{};
  spline.spacing = spacing;
  return runPath(spline, path, rhythm);
}

/// Basis function i of degree p over knots t, by its definition.
double basis(const std::vector<double> &t, size_t i, size_t p, double x) {
  if (p == 0)
    return t[i] <= x && x < t[i + 1] ? 1 : 0;
  const double first = t[i + p] > t[i] ? (x - t[i]) / (t[i + p] - t[i]) : 0;
  const double second =
      t[i + p + 1] > t[i + 1] ? (t[i + p + 1] - x) / (t[i + p + 1] - t[i + 1]) : 0;
  return first * basis(t, i, p - 1, x) + second * basis(t, i + 1, p - 1, x);
}

TEST(SmoothBSpline, IsTheClampedSplineOfTheEnds) {
  for (const KnotSpacing spacing :
       {KnotSpacing::Uniform, KnotSpacing::ChordLength, KnotSpacing::Centripetal})
    for (const size_t lines : {5U, 6U, 7U, 9U, 10U, 14U, 23U}) {
      const std::vector<Point> places = randomPlaces(lines + 1, static_cast<uint32_t>(lines));
      const Path out = splined(polyline(places), spacing).objects;
      ASSERT_EQ(out.size(), lines - 4);
      std::vector<double> knots(6, 0);
      for (size_t j = 0; j + 4 < lines; ++j) {
        const double chord = sizeOf(places[j + 3] - places[j + 2]);
        const double span = spacing == KnotSpacing::Uniform       ? 1
                            : spacing == KnotSpacing::ChordLength ? chord
                                                                  : std::sqrt(chord);
        knots.push_back(knots.back() + span);
      }
      knots.insert(knots.end(), 5, knots.back());
      for (size_t j = 0; j < out.size(); ++j) {
        ASSERT_EQ(out[j].moveType, MoveType::Spline3d);
        for (const double part : {0.0, 0.3, 0.71}) {
          const double x = knots[j + 5] + part * (knots[j + 6] - knots[j + 5]);
          Point expected{};
          for (size_t i = 0; i < places.size(); ++i)
            expected = expected + places[i] * basis(knots, i, 5, x);
          EXPECT_LT(sizeOf(placeAt(out[j], part) - expected), 1e-11) << lines << " " << j;
        }
        EXPECT_NEAR(out[j].length, lengthOf(out[j], 4000), 1e-5);
      }
      EXPECT_EQ(startOf(out.front()), places.front());
      EXPECT_EQ(endOf(out.back()), places.back());
    }
}

TEST(SmoothBSpline, PiecesMeetInPlaceDirectionAndCurvature) {
  const Path out = splined(polyline(randomPlaces(30, 7)), KnotSpacing::Centripetal).objects;
  for (size_t i = 1; i < out.size(); ++i) {
    EXPECT_EQ(endOf(out[i - 1]), startOf(out[i]));
    EXPECT_LT(sizeOf(tangentAt(out[i - 1], 1) - tangentAt(out[i], 0)), 1e-6);
    EXPECT_LT(sizeOf(curvatureAt(out[i - 1], 1) - curvatureAt(out[i], 0)), 1e-4);
  }
}

TEST(SmoothBSpline, PassesACornerOfEqualLinesAtAKnownDistance) {
  constexpr double kStep = 2;
  for (const double turn : {0.2, 1.0, 2.0}) {
    std::vector<Point> places;
    for (int i = -10; i <= 10; ++i)
      places.push_back(i <= 0 ? Point{kStep * i, 0, 0}
                              : Point{kStep * i * std::cos(turn), kStep * i * std::sin(turn), 0});
    double nearest = 1e9;
    double furthest = 0;
    for (const PathObject &o : splined(polyline(places)).objects)
      for (int k = 0; k <= 100; ++k) {
        const Point p = placeAt(o, k / 100.0);
        nearest = std::min(nearest, sizeOf(p));
        // distance from the nearer one of both rays
        const double along = p[0] * std::cos(turn) + p[1] * std::sin(turn);
        const double first = std::hypot(std::max(p[0], 0.0), p[1]);
        const double second =
            std::hypot(std::min(along, 0.0), p[1] * std::cos(turn) - p[0] * std::sin(turn));
        furthest = std::max(furthest, std::min(first, second));
      }
    // basis functions at a knot: 1, 26, 66, 26, 1 of 120
    EXPECT_NEAR(nearest, 28.0 / 60 * kStep * std::sin(turn / 2), 1e-9);
    EXPECT_LE(furthest, nearest * (1 + 1e-9));
  }
}

TEST(SmoothBSpline, AStraightRunStaysStraight) {
  std::vector<Point> places;
  for (int i = 0; i <= 12; ++i)
    places.push_back({1.5 * i * i, -0.5 * i * i, 0.25 * i * i});
  for (const PathObject &o : splined(polyline(places), KnotSpacing::ChordLength).objects)
    for (int k = 0; k <= 10; ++k) {
      const Point p = placeAt(o, k / 10.0);
      EXPECT_NEAR(p[1], -p[0] / 3, 1e-10);
      EXPECT_NEAR(p[2], p[0] / 6, 1e-10);
    }
}

TEST(SmoothBSpline, OtherAxesAreSplinesAtTheEndsOfPieces) {
  Path path = polyline(randomPlaces(12, 3));
  for (PathObject &o : path) {
    o.start.axes = o.end.axes = 7 | 1 << kAxisA | 1 << kAxisP;
    // A and P go as X and Y do.
    for (PathObject *const end : {&o})
      for (Position *const p : {&end->start, &end->end}) {
        p->coordinate[kAxisA] = 3 * p->coordinate[0];
        p->coordinate[kAxisP] = p->coordinate[1] - 5;
      }
  }
  for (const PathObject &o : splined(path).objects) {
    EXPECT_EQ(o.slopes, 1);
    EXPECT_NEAR(o.end.coordinate[kAxisA], 3 * o.end.coordinate[0], 1e-11);
    EXPECT_NEAR(o.end.coordinate[kAxisP], o.end.coordinate[1] - 5, 1e-11);
    EXPECT_NEAR(o.startSlope[0], 3 * tangentAt(o, 0)[0], 1e-6);
    EXPECT_NEAR(o.endSlope[0], 3 * tangentAt(o, 1)[0], 1e-6);
  }
}

TEST(SmoothBSpline, ShortRunsAndOtherObjectsStay) {
  const std::vector<Point> places = randomPlaces(5, 1);
  EXPECT_EQ(splined(polyline(places)).objects.size(), 4U);
  Path path = polyline(randomPlaces(12, 2));
  path[6].moveType = MoveType::Positioning;
  Path out = splined(path).objects; // 6 lines, the positioning, 4 lines
  ASSERT_EQ(out.size(), 2U + 1 + 4);
  EXPECT_EQ(out[2].moveType, MoveType::Positioning);
  EXPECT_EQ(out[3].moveType, MoveType::Line);
  path[6] = line(startOf(path[6]), endOf(path[6]));
  path[6].features = 4;
  SmoothBSpline spline{};
  spline.features = 4;
  EXPECT_EQ(runPath(spline, path).objects.size(), 11U);
  for (size_t i = 4; i < 10; ++i)
    path[i].features = 4;
  EXPECT_EQ(runPath(spline, path).objects.size(), 5U + 2);
}

TEST(SmoothBSpline, WhatPiecesHaveOfTheirLines) {
  Path path = polyline(randomPlaces(8, 4));
  path[0].marks = kToolLeft;
  path[0].toolRadius = 3;
  path[6].marks = kEndToolCorrection;
  path[3].velocity = 5;
  const Path out = splined(path).objects;
  ASSERT_EQ(out.size(), 3U);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(out[i].sentence, static_cast<int32_t>(i) + 3);
    EXPECT_EQ(out[i].toolRadius, 3);
    EXPECT_EQ(out[i].marks, i == 0 ? kToolLeft : 0);
    EXPECT_EQ(out[i].velocity, i == 1 ? 5 : 20);
  }
}

TEST(SmoothBSpline, TurningBackEndsARun) {
  std::vector<Point> places = randomPlaces(6, 5);
  const std::vector<Point> back(places.rbegin() + 1, places.rend());
  places.insert(places.end(), back.begin(), back.end());
  const Path out = splined(polyline(places)).objects;
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(endOf(out[0]), places[5]);
}

TEST(SmoothBSpline, AnyQueueAndRhythmGivesTheSame) {
  Path path = polyline(randomPlaces(40, 6));
  path[20].moveType = MoveType::Positioning;
  path[24].probe = 1;
  const Path expected = splined(path, KnotSpacing::ChordLength, {50, 50, 0, 0}).objects;
  for (uint32_t seed = 1; seed < 20; ++seed) {
    const Outcome run =
        splined(path, KnotSpacing::ChordLength, {5 + seed % 3, 5 + seed % 4, seed, 1000000});
    ASSERT_EQ(run.objects.size(), expected.size());
    EXPECT_LE(run.most, kMostPerStep);
    for (size_t i = 0; i < expected.size(); ++i)
      EXPECT_EQ(endOf(run.objects[i]), endOf(expected[i]));
  }
}

TEST(SmoothBSpline, Refuses) {
  const auto errorWith = [](auto change) {
    Path path = polyline(randomPlaces(12, 8));
    SmoothBSpline spline{};
    change(path, spline);
    return runPath(spline, path).stream.error;
  };
  EXPECT_EQ(errorWith([](Path &path, SmoothBSpline &) { path[10].planar = 1; }),
            StreamError::NotInSpace);
  EXPECT_EQ(errorWith([](Path &path, SmoothBSpline &) { path[3].switchId[2] = 5; }),
            StreamError::SwitchPoint);
  EXPECT_EQ(errorWith([](Path &, SmoothBSpline &s) { s.unknownFeature = true; }),
            StreamError::FeatureBit);
  EXPECT_EQ(errorWith([](Path &path, SmoothBSpline &) {
              path.resize(4);
              path[3].switchId[2] = 5; // too few to be smoothed
            }),
            StreamError::None);
}

} // namespace
