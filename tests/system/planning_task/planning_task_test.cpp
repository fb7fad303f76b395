// The two tasks of a group that is planned aside, under ThreadSanitizer with real threads.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

namespace {

using stride::test::ProcessResult;
using stride::test::runProcess;
using stride::test::ScratchDirectory;
using ::testing::HasSubstr;

/// Both tasks and all that they share; kinematics and numbers are taken as they are.
constexpr const char *kBuild = R"(set -e
ls "$SOURCE"/runtime/numeric/group/*.cpp "$SOURCE"/runtime/numeric/path/*.cpp "$FOLDER/threads.cpp" |
  xargs -P 2 -I{} sh -c 'o=$(echo {} | tr /. __).o
  $0 -std=c++20 -O1 -g -w -fsanitize=thread -ffp-contract=off -DEIGEN_DONT_VECTORIZE -DEIGEN_NO_MALLOC \
     -DEIGEN_NO_DEBUG -DEIGEN_NO_IO -isystem "$EIGEN" -I"$SOURCE" -c {} -o $o' "$CXX"
"$CXX" -fsanitize=thread *.o $LIBRARIES -o threads
)";

TEST(PlanningTask, NothingRaces) {
  const ScratchDirectory scratch;
  const ProcessResult built =
      runProcess({"sh", "-c", kBuild}, scratch.path(),
                 {{"SOURCE", STRIDE_SOURCE_DIR},
                  {"FOLDER", STRIDE_SOURCE_DIR "/tests/system/planning_task"},
                  {"CXX", STRIDE_CXX},
                  {"EIGEN", STRIDE_EIGEN},
                  {"LIBRARIES", STRIDE_LIBRARIES}});
  ASSERT_EQ(built.exitCode, 0) << built.out << built.err;
  const ProcessResult run = runProcess({(scratch.path() / "threads").string()}, scratch.path(),
                                       {{"TSAN_OPTIONS", "exitcode=66"}});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("done = 60\n"));
  std::smatch found;
  ASSERT_TRUE(std::regex_search(run.out, found, std::regex("taken = ([0-9]+)")));
  EXPECT_GT(std::stoi(found[1]), 60) << run.out;
}

} // namespace
