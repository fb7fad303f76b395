#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace stc {
namespace {

/// One token of lookahead decides everywhere: the generated parser does not contain ANTLR's
/// adaptive prediction, so that there are neither ambiguities nor its cost.
TEST(Grammar, NeedsNoAdaptivePrediction) {
  std::ifstream in(std::string(STRIDE_BINARY_DIR) + "/grammar/StParser.cpp");
  ASSERT_TRUE(in.is_open());
  const std::string text(std::istreambuf_iterator<char>(in), {});
  EXPECT_GT(text.size(), 10'000U);
  EXPECT_EQ(text.find("adaptivePredict"), std::string::npos);
}

} // namespace
} // namespace stc
