// The host knows the error numbers that the library declares.
#include "runtime/host/error_names.hpp"
#include "tests/support/text.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

namespace stride::host {
namespace {

TEST(ErrorNames, AreThoseOfTheLibrary) {
  const std::string text =
      test::readFile(std::filesystem::path(STRIDE_SOURCE_DIR) / "stdlib/SM_Error/SMC_ERROR.st");
  const std::regex enumerator("\\n  (SMC_\\w+) := (\\d+)");
  int count = 0;
  for (std::sregex_iterator at(text.begin(), text.end(), enumerator), end; at != end; ++at) {
    const std::string number = (*at)[2];
    const std::string expected = (*at)[1].str() + " (" + number + ")";
    EXPECT_EQ(motionErrorText(static_cast<uint32_t>(std::stoul(number))), expected);
    ++count;
  }
  EXPECT_GT(count, 100);
  EXPECT_EQ(motionErrorText(9999), "error 9999");
}

} // namespace
} // namespace stride::host
