// The host knows the error numbers that the library declares.
#include "runtime/host/error_names.hpp"
#include "tests/support/text.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>
#include <string>

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

/// `stride explain` prints what stands before an enumerator: a line that says what it is, and below
/// it what to do.
TEST(ErrorNames, EachErrorSaysWhatToDo) {
  std::istringstream text(
      test::readFile(std::filesystem::path(STRIDE_SOURCE_DIR) / "stdlib/SM_Error/SMC_ERROR.st"));
  const std::regex enumerator("  (SMC_\\w+) := (\\d+),?");
  bool hasLine = false;
  bool hasMore = false;
  int count = 0;
  for (std::string line; std::getline(text, line);) {
    std::smatch found;
    if (line.starts_with("  ///")) {
      hasMore = hasMore || line == "  ///";
      hasLine = true;
      continue;
    }
    if (std::regex_match(line, found, enumerator) && found[2] != "0") {
      EXPECT_TRUE(hasLine && hasMore) << found[1];
      ++count;
    }
    hasLine = hasMore = false;
  }
  EXPECT_GT(count, 100);
}

} // namespace
} // namespace stride::host
