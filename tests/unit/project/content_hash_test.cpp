#include "compiler/source/content_hash.hpp"

#include <gtest/gtest.h>
#include <unordered_set>

namespace stc {
namespace {

// What `printf abc | b2sum -l 256` and `b2sum -l 256 </dev/null` print.
TEST(ContentHash, IsBlake2b256) {
  EXPECT_EQ(blake2b256("abc"), "bddd813c634239723171ef3fee98579b94964e3bb1cb3e427262c8c068d52319");
  EXPECT_EQ(blake2b256(""), "0e5751c026e543b2e8ab2eb06099daa1d1e5df47778f7787faab45cdf12fe3a8");
}

TEST(ContentHash, IsARepeatableFingerprint) {
  EXPECT_EQ(ContentHash().add("abc").hex(), ContentHash().add("abc").hex());
  EXPECT_EQ(ContentHash().add("abc").hex().size(), 64U);
  ContentHash hash;
  hash.add("abc");
  EXPECT_EQ(hash.hex(), hash.hex()); // asking changes nothing
}

TEST(ContentHash, BoundariesCount) {
  EXPECT_NE(ContentHash().add("ab").add("c").hex(), ContentHash().add("a").add("bc").hex());
  EXPECT_NE(ContentHash().add("").hex(), ContentHash().hex());
  EXPECT_NE(ContentHash().add(std::string_view("\0", 1)).hex(), ContentHash().add("").hex());
}

TEST(ContentHash, SmallChangesGiveOtherHashes) {
  std::unordered_set<std::string> seen;
  std::string text(64, 'x');
  for (size_t at = 0; at < text.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      text[at] = static_cast<char>(text[at] ^ (1 << bit));
      EXPECT_TRUE(seen.insert(ContentHash().add(text).hex()).second);
      text[at] = static_cast<char>(text[at] ^ (1 << bit));
    }
}

} // namespace
} // namespace stc
