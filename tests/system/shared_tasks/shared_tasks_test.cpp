// Generated code whose tasks share variables, under ThreadSanitizer with real threads.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

namespace {

using stride::test::ProcessResult;
using stride::test::runProcess;
using stride::test::ScratchDirectory;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char *kFolder = STRIDE_SOURCE_DIR "/tests/system/shared_tasks";

/// Translates the program and links it with threads.cpp. The pool belongs to what is tested, so
/// that it is built again; the rest of the runtime is taken as it is.
constexpr const char *kBuild = R"(set -e
"$STRIDE" build program.st --emit cpp -o generated
cp "$SOURCE/runtime/iec/pool.cpp" "$SOURCE/runtime/iec/pool_calls.cpp" generated
cp "$SOURCE/runtime/app/symbol_text.cpp" "$FOLDER/threads.cpp" generated
cd generated
find . -name '*.cpp' | xargs -P 2 -I{} sh -c 'o=$(echo {} | tr /. __).o
  $0 -std=c++20 -O1 -g -w -fsanitize=thread -fwrapv -fno-strict-aliasing \
     -fno-delete-null-pointer-checks -ffp-contract=off -I. -I"$SOURCE" -c {} -o $o' "$CXX"
"$CXX" -fsanitize=thread *.o "$IEC" -o ../threads
)";

TEST(SharedTasks, NothingIsTornAndNothingRaces) {
  const ScratchDirectory scratch;
  std::filesystem::copy_file(std::string(kFolder) + "/program.st", scratch.path() / "program.st");
  const ProcessResult built = runProcess({"sh", "-c", kBuild}, scratch.path(),
                                         {{"STRIDE", STRIDE_BINARY_DIR "/stride"},
                                          {"SOURCE", STRIDE_SOURCE_DIR},
                                          {"FOLDER", kFolder},
                                          {"CXX", STRIDE_CXX},
                                          {"IEC", STRIDE_IEC}});
  ASSERT_EQ(built.exitCode, 0) << built.out << built.err;
  EXPECT_THAT(built.err, Not(HasSubstr("warning"))); // nothing is used that is not safe

  const ProcessResult run = runProcess({(scratch.path() / "threads").string()}, scratch.path(),
                                       {{"TSAN_OPTIONS", "exitcode=66"}});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Write.errors = 0\n"));
  EXPECT_THAT(run.out, HasSubstr("Read.errors = 0\n"));
  EXPECT_THAT(run.out, HasSubstr("Watch.errors = 0\n"));
  // They did exchange something.
  std::smatch found;
  ASSERT_TRUE(std::regex_search(run.out, found, std::regex("Read.changes = ([0-9]+)")));
  EXPECT_GT(std::stoi(found[1]), 10) << run.out;
  ASSERT_TRUE(std::regex_search(run.out, found, std::regex("Watch.taken = ([0-9]+)")));
  EXPECT_GT(std::stoi(found[1]), 10) << run.out;
}

} // namespace
