#include "compiler/project/content_hash.hpp"

#include <gtest/gtest.h>
#include <unordered_set>

namespace stc {
namespace {

TEST(ContentHash, IsARepeatableFingerprint) {
  EXPECT_EQ(ContentHash().add("abc").hex(), ContentHash().add("abc").hex());
  EXPECT_EQ(ContentHash().add("abc").hex().size(), 32U);
}

TEST(ContentHash, BoundariesCount) {
  EXPECT_NE(ContentHash().add("ab").add("c").hex(), ContentHash().add("a").add("bc").hex());
  EXPECT_NE(ContentHash().add("").hex(), ContentHash().hex());
  EXPECT_NE(ContentHash().add(std::string_view("\0", 1)).hex(), ContentHash().add("").hex());
}

TEST(ContentHash, SmallChangesGiveOtherHashes) {
  std::unordered_set<std::string> seen;
  std::string text(64, 'x');
  for (std::size_t at = 0; at < text.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      text[at] = static_cast<char>(text[at] ^ (1 << bit));
      EXPECT_TRUE(seen.insert(ContentHash().add(text).hex()).second);
      text[at] = static_cast<char>(text[at] ^ (1 << bit));
    }
}

} // namespace
} // namespace stc
