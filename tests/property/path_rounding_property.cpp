// A motion that rests anywhere on its path, next to the end of what is known of it by a few units
// in the last place, before strips of any lengths and limits: it comes to the end all the same.
#include "runtime/numeric/path/motion.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

namespace {

using namespace stride::path;
using stride::test::casesOf;
using stride::test::Random;

Strip randomStrip(Random &random) {
  Strip strip{};
  strip.feed = strip.endFeed = random.magnitude(0, 3);
  strip.ceiling = strip.endCeiling = stride::exact::kInfinity;
  strip.acceleration = random.magnitude(-2, 4);
  strip.deceleration = random.magnitude(-2, 4);
  if (random.chance(0.5)) {
    strip.along = 1 / (strip.acceleration * random.magnitude(0, 5));
    strip.across = 0.5 / (strip.feed * strip.feed);
    if (random.chance(0.5)) // an arc of any radius, down to that of the shortest way
      strip.across = strip.along * random.magnitude(-3, 9);
    if (random.chance(0.5)) // what the axes of a group allow
      strip.jerk = static_cast<float>(random.magnitude(2, 6));
    strip.ceiling = 0.9 / strip.across;
  }
  strip.stop = random.chance(0.5);
  strip.gate = strip.stop && random.chance(0.3);
  return strip;
}

} // namespace

TEST(PathRounding, IsAtTheGateWhenItIsAtItsWay) {
  auto motion = std::make_unique<Motion>();
  reset(*motion, {LawKind::Jerk, 1e30, 1, false});
  motion->way = motion->course.begin = 45101.127919830367;
  Strip strip{};
  strip.feed = strip.endFeed = 135.967;
  strip.ceiling = strip.endCeiling = stride::exact::kInfinity;
  strip.acceleration = 4992.41;
  strip.deceleration = 0.0219427; // it rounds the last piece away
  strip.stop = strip.gate = true;
  strip.end = 45101.127919929197;
  ASSERT_TRUE(extend(*motion, strip));
  for (int calls = 0; calls < 100 && motion->way < strip.end; ++calls) {
    think(*motion, 64);
    move(*motion, 0.001, true);
  }
  EXPECT_EQ(motion->way, strip.end);
  EXPECT_TRUE(motion->gate);
}

TEST(PathRounding, GoesNoFurtherThanTheEndOfItsRun) {
  auto motion = std::make_unique<Motion>();
  reset(*motion, {LawKind::Jerk, 31610.6, 1, false});
  motion->way = motion->course.begin = 28912.477476558855;
  Strip strip{};
  strip.feed = strip.endFeed = 756.355;
  strip.ceiling = strip.endCeiling = stride::exact::kInfinity;
  strip.acceleration = 438.701;
  strip.deceleration = 0.0334656;
  strip.end = 28912.477477145792;
  ASSERT_TRUE(extend(*motion, strip));
  for (int calls = 0; calls < 100 && motion->way < strip.end; ++calls) {
    think(*motion, 64);
    move(*motion, 0.001, true);
  }
  EXPECT_EQ(motion->way, strip.end);
}

TEST(PathRounding, ComesToTheEndFromWhereverItRests) {
  Random random(3);
  auto motion = std::make_unique<Motion>();
  for (int i = 0; i < casesOf(4000); ++i) {
    const auto kind = static_cast<LawKind>(random.below(3));
    const double jerk = random.chance(0.3) ? 1e30 : random.magnitude(2, 6);
    reset(*motion, {kind, jerk, 1, random.chance(0.5)});
    motion->way = motion->course.begin = random.magnitude(-3, 4.8);
    Strip strip = randomStrip(random);
    const double unit = std::nextafter(motion->way, 1e9) - motion->way;
    strip.end = motion->way + unit * std::floor(random.magnitude(0, 6.5));
    SCOPED_TRACE(testing::Message()
                 << "case " << i << " law " << static_cast<int>(kind) << " from " << motion->way
                 << " by " << (strip.end - motion->way) / unit << " units, stop " << strip.stop);
    ASSERT_TRUE(extend(*motion, strip));
    int calls = 0;
    while (motion->way < strip.end && ++calls < 20000) {
      think(*motion, 64);
      move(*motion, 0.001, true);
    }
    ASSERT_EQ(motion->way, strip.end);
    EXPECT_EQ(motion->gate, strip.gate);
  }
}

TEST(PathRounding, ComesToTheEndOfAnyStrips) {
  Random random(5);
  auto motion = std::make_unique<Motion>();
  for (int i = 0; i < casesOf(500); ++i) {
    const double jerk = random.chance(0.3) ? 1e30 : random.magnitude(2, 6);
    reset(*motion, {LawKind::Jerk, jerk, 1, random.chance(0.5)});
    motion->way = motion->course.begin = random.chance(0.5) ? 0.0 : random.magnitude(-3, 4.8);
    const auto count = 1 + static_cast<int>(random.below(6));
    SCOPED_TRACE(testing::Message() << "case " << i << " from " << motion->way);
    double end = motion->way;
    for (int k = 0; k < count; ++k) {
      Strip strip = randomStrip(random);
      strip.gate = false;
      end = std::nextafter(end + random.magnitude(-9, 1), 1e9);
      strip.end = end;
      ASSERT_TRUE(extend(*motion, strip));
    }
    // Many are slow by their limits, which is not judged here: only whether they rest.
    int calls = 0;
    int atRest = 0;
    while (motion->way < end && atRest < 5000 && ++calls < 20000) {
      think(*motion, 64);
      const double before = motion->way;
      const WayState state = move(*motion, 0.001, true);
      ASSERT_GE(motion->way, before);
      atRest = state.velocity > 0.0 || motion->way > before ? 0 : atRest + 1;
    }
    ASSERT_LT(atRest, 5000) << "at " << motion->way << " of " << end;
    ASSERT_LE(motion->way, end);
  }
}
