// A motion that rests next to the end of what is known of its path, by a few units in the last
// place or by any small way: it comes to the end all the same.
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
      comeByRounding(*motion);
      think(*motion, 64);
      move(*motion, 0.001, true);
    }
    ASSERT_EQ(motion->way, strip.end);
    EXPECT_EQ(motion->gate, strip.gate);
  }
}
