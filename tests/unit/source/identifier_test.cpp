#include "compiler/source/identifier.hpp"

#include <gtest/gtest.h>

#include <string>

namespace stc {
namespace {

TEST(Interner, IgnoresCase) {
  Interner interner;
  const Ident a = interner.intern("MC_Power");
  EXPECT_EQ(a, interner.intern("mc_POWER"));
  EXPECT_EQ(a->lower, "mc_power");
  EXPECT_NE(a, interner.intern("mc_power2"));
  EXPECT_EQ(interner.size(), 2U);
}

TEST(Interner, KeepsIndicesAndAddressesWhileItGrows) {
  Interner interner;
  const Ident first = interner.intern("x0");
  for (int i = 1; i < 5000; ++i)
    EXPECT_EQ(interner.intern("x" + std::to_string(i))->index, static_cast<uint32_t>(i));
  for (int i = 0; i < 5000; ++i)
    EXPECT_EQ(interner.intern("X" + std::to_string(i))->index, static_cast<uint32_t>(i));
  EXPECT_EQ(interner.intern("X0"), first);
  EXPECT_EQ(interner.size(), 5000U);
}

TEST(Interner, HashIsTheCallersHash) {
  Interner interner;
  EXPECT_EQ(interner.intern("Drive", hashIdent("drive")), interner.intern("DRIVE"));
}

} // namespace
} // namespace stc
