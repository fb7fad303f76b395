#include "compiler/source/identifier.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <string>
#include <vector>

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

TEST(Interner, KeepsAddressesWhileItGrows) {
  Interner interner;
  std::vector<Ident> all;
  for (int i = 0; i < 5000; ++i)
    all.push_back(interner.intern("x" + std::to_string(i)));
  for (int i = 0; i < 5000; ++i)
    EXPECT_EQ(interner.intern("X" + std::to_string(i)), all[static_cast<size_t>(i)]);
  EXPECT_EQ(interner.size(), 5000U);
}

TEST(Interner, OfAThreadGivesWhatTheSharedOneGives) {
  Interner shared;
  std::mutex mutex;
  const Ident early = shared.intern("early");
  Interner one(shared, mutex), other(shared, mutex);
  EXPECT_EQ(one.intern("Early"), early);
  for (int i = 0; i < 5000; ++i) // grows
    one.intern("x" + std::to_string(i));
  EXPECT_EQ(other.intern("X4999"), one.intern("x4999"));
  EXPECT_EQ(other.intern("X4999"), shared.intern("x4999"));
  EXPECT_EQ(shared.size(), 5001U);
  EXPECT_EQ(other.size(), 1U);
}

TEST(Interner, HashIsTheCallersHash) {
  Interner interner;
  EXPECT_EQ(interner.intern("Drive", hashIdent("drive")), interner.intern("DRIVE"));
}

} // namespace
} // namespace stc
