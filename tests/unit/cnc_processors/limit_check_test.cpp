// SMC_CheckForLimits: which axes leave a box, and where first.
#include "tests/unit/cnc_processors/sampled_path.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include "runtime/numeric/cnc/limit_check.hpp"

#include <gtest/gtest.h>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

constexpr uint32_t kNothing = UINT32_MAX;

struct Boxed {
  Position least{};
  Position most{};
  PlaceLimits box{&least, &most, 0x7FF, 0, 5, 100};
  OwnedQueue queue{20};
  uint32_t checked = kNothing;
  BoxFinding finding{0, -1};

  Boxed() {
    for (int axis = 0; axis < kAxes; ++axis) {
      least.coordinate[axis] = -10;
      most.coordinate[axis] = 10 + axis;
    }
  }
  void add(PathObject object, int32_t line) {
    object.sourceLine = line;
    ASSERT_NE(append(&queue.queue, &object), nullptr);
  }
  BoxError check() { return checkBox(&queue.queue, checked, box, finding); }
};

TEST(Box, NamesTheAxesAndTheFirstLine) {
  Boxed b;
  b.add(line({0, 0, 0}, {10, 11, 12}), 3); // on its border
  ASSERT_EQ(b.check(), BoxError::None);
  EXPECT_EQ(b.finding.axes, 0);
  EXPECT_EQ(b.finding.line, -1);
  b.add(line({10, 11, 12}, {9, 11.01, 12}), 4);
  b.add(line({9, 11.01, 12}, {9, 0, -10.5}), 5);
  ASSERT_EQ(b.check(), BoxError::None);
  EXPECT_EQ(b.finding.axes, 6);
  EXPECT_EQ(b.finding.line, 4);
  Boxed only;
  only.box.axes = 4;
  only.add(line({9, 11.01, 12}, {9, 0, -10.5}), 5);
  ASSERT_EQ(only.check(), BoxError::None);
  EXPECT_EQ(only.finding.axes, 4);
}

TEST(Box, LooksAtPlacesOfCurves) {
  const PathObject bow = arc({0, 4, 0}, 8, 0, 180); // up to 12; its ends are at 4
  for (const int places : {1, 2, 3}) {
    Boxed b;
    b.most.coordinate[1] = 11;
    b.box.fewest = b.box.mostPlaces = places;
    b.add(bow, 1);
    ASSERT_EQ(b.check(), BoxError::None);
    // with 2 places at 60 degrees only: 4 + 8 sin(60 degrees) < 11
    EXPECT_EQ(b.finding.axes, places == 2 ? 0 : 2);
  }
  // A length of 8 pi: 2 places at 60 degrees each with 10 u between them, 8 at 20 degrees with 3 u.
  for (const double distance : {0.0, 10.0, 3.0}) {
    Boxed b;
    b.most.coordinate[1] = 11.5;
    b.box.fewest = 0;
    b.box.distance = distance;
    b.add(bow, 1);
    ASSERT_EQ(b.check(), BoxError::None);
    EXPECT_EQ(b.finding.axes, distance == 3.0 ? 2 : 0) << distance;
  }
}

TEST(Box, LooksAtSlopes) {
  Boxed b;
  PathObject o = line({0, 0, 0}, {8, 0, 0});
  o.start.axes = o.end.axes = 7 | 1 << kAxisA;
  o.slopes = 1;
  o.startSlope[0] = 8; // 64 u (1 - u)^2, up to 9.48
  b.most.coordinate[kAxisA] = 9.4;
  b.box.fewest = 20;
  b.add(o, 1);
  ASSERT_EQ(b.check(), BoxError::None);
  EXPECT_EQ(b.finding.axes, 1 << kAxisA);
}

TEST(Box, RefusesObjectsWithoutAShape) {
  Boxed b;
  b.add(line({0, 0, 0}, {std::nan(""), 0, 0}), 1);
  EXPECT_EQ(b.check(), BoxError::Object);
  EXPECT_EQ(checkBox(nullptr, b.checked, b.box, b.finding), BoxError::NoQueue);
}

} // namespace
