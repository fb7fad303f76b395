// A short sample of what path_processors_fuzz does, the same in each run, and what it has found.
#include "tests/fuzz/path_chain.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace {

using stride::fuzz::runPathChain;

TEST(PathChain, EndsWithAnyBytes) {
  std::mt19937 random(20261124);
  std::vector<uint8_t> bytes;
  constexpr int kRuns = 3000;
  for (int i = 0; i < kRuns; ++i) {
    bytes.resize(20 + random() % 400);
    for (uint8_t &byte : bytes)
      byte = static_cast<uint8_t>(random());
    ASSERT_EQ(runPathChain(bytes.data(), bytes.size()), "") << "run " << i;
  }
}

/// Inputs that have once ended otherwise, and some that reach far.
TEST(PathChain, EndsWithTheSeeds) {
  size_t count = 0;
  for (const auto &entry : std::filesystem::directory_iterator(STRIDE_SEEDS)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(runPathChain(reinterpret_cast<const uint8_t *>(text.data()), text.size()), "")
        << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0U);
}

} // namespace
