// A thousand axes: each has its own parameters and its own place, and the program finds them.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::HasSubstr;

TEST(ManyAxes, MoveToTheirTargets) {
  const ScratchDirectory scratch;
  const auto command = [&](const std::vector<std::string> &arguments) {
    return runProcess(arguments, scratch.path(),
                      {{"XDG_CACHE_HOME", (scratch.path() / "cache").string()}});
  };
  const ProcessResult generated =
      command({"python3", STRIDE_SOURCE_DIR "/tests/bench/frontend/generate_axes.py", "1000", "."});
  ASSERT_EQ(generated.exitCode, 0) << generated.err;
  const ProcessResult result =
      command({STRIDE_BINARY_DIR "/stride", "sim", ".", "--for", "T#300ms", "--quiet", "--print",
               "Main.Arrived,Drive1,Drive100,Drive201,Drive500.fSetPosition,Drive999,Drive1000"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  for (const char *line :
       {"Main.Arrived = 11", "Drive1.fSetPosition = 1.0\n", "Drive1.wDriveId = 1\n",
        "Drive1.fSWLimitPositive = 20001.0\n", "Drive100.iMovementType = 0\n",
        "Drive100.wDriveId = 100\n", "Drive100.fPositionPeriod = 2000.0\n",
        "Drive100.fSetPosition = 100.0\n", "Drive201.iMovementType = 1\n",
        "Drive201.fSWLimitPositive = 20201.0\n", "Drive201.wDriveId = 201\n",
        "Drive500.fSetPosition = 500.0\n", "Drive999.fSetPosition = 0.0\n",
        "Drive999.fSWLimitPositive = 20999.0\n", "Drive1000.fSetPosition = 1000.0\n",
        "Drive1000.fPositionPeriod = 20000.0\n"})
    EXPECT_THAT(result.out, HasSubstr(line));
}

} // namespace
} // namespace stride::test
