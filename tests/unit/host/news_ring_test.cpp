#include "runtime/host/news_ring.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <string>

namespace stride::host {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(NewsRing, GivesTextsInTheirOrderOnce) {
  NewsRing ring;
  EXPECT_THAT(ring.take(), IsEmpty());
  ring.put("one");
  ring.put("two");
  EXPECT_THAT(ring.take(), ElementsAre("one", "two"));
  EXPECT_THAT(ring.take(), IsEmpty());
  for (int round = 0; round < 100; ++round) { // around the ring, at other places each time
    for (int i = 0; i < 7; ++i)
      ring.put(std::to_string(round * 7 + i));
    const std::vector<std::string> texts = ring.take();
    ASSERT_EQ(texts.size(), 7U);
    EXPECT_EQ(texts.front(), std::to_string(round * 7));
    EXPECT_EQ(texts.back(), std::to_string(round * 7 + 6));
  }
}

TEST(NewsRing, CountsWhatItHasNoRoomFor) {
  for (const size_t count : {NewsRing::kTexts - 1, NewsRing::kTexts, NewsRing::kTexts + 3}) {
    NewsRing ring;
    for (size_t i = 0; i < count; ++i)
      ring.put(std::to_string(i));
    std::vector<std::string> texts = ring.take();
    if (count > NewsRing::kTexts) {
      EXPECT_EQ(texts.back(), "3 more pieces of news are not shown");
      texts.pop_back();
    }
    EXPECT_EQ(texts.size(), std::min(count, NewsRing::kTexts));
    EXPECT_EQ(texts.back(), std::to_string(texts.size() - 1)) << "the first ones stay";
    ring.put("after");
    EXPECT_THAT(ring.take(), ElementsAre("after")) << "and the loss is told once";
  }
}

TEST(NewsRing, CutsLongTexts) {
  NewsRing ring;
  ring.put(std::string(NewsRing::kLongest, 'x'));
  ring.put(std::string(NewsRing::kLongest + 1, 'y'));
  EXPECT_THAT(ring.take(), ElementsAre(std::string(NewsRing::kLongest, 'x'),
                                       std::string(NewsRing::kLongest, 'y')));
}

} // namespace
} // namespace stride::host
