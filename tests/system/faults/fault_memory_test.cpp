// A run in which allocations fail: it ends with a message before anything moves, or goes on.
#include "moving.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

class NoMemory : public ::testing::Test {
protected:
  void SetUp() override {
    buildMoving(scratch_.path());
    writeFile(scratch_.path() / "a.script", "at T#100ms: force Main.go := TRUE\n");
  }
  /// With all services, one of them asked by a client while the axis moves.
  ProcessResult run(unsigned long nth, unsigned long count) {
    for (const char *name : {"t.csv", "s.json", "kept.a", "kept.b", "r.rec", "s", "count"})
      fs::remove(scratch_.path() / name);
    return runProcess(
        {"sh", "-c",
         "LD_PRELOAD=$PRELOAD $HOST run moving.so --for 500ms --trace "
         "Drive.fSetPosition --out t.csv --print Main.done --statistics s.json --retain kept "
         "--record r.rec --listen unix:s --script a.script & p=$!; "
         "i=0; while ! [ -e s ] && [ $i -lt 40 ] && kill -0 $p 2>/dev/null; do sleep 0.01; "
         "i=$((i+1)); done; "
         "[ -e s ] && { sleep 0.1; timeout -s KILL 15 $HOST ctl unix:s read Main.done >ctl 2>&1; "
         "}; "
         "( sleep 60; kill -KILL $p ) >/dev/null 2>&1 & w=$!; wait $p; c=$?; kill $w; exit $c"},
        scratch_.path(),
        {{"HOST", STRIDE_BINARY_DIR "/stride-host"},
         {"PRELOAD", STRIDE_BINARY_DIR "/tests/libfail_allocation.so"},
         {"STRIDE_FAIL_ALLOCATION", std::to_string(nth)},
         {"STRIDE_FAIL_ALLOCATIONS", std::to_string(count)},
         {"STRIDE_COUNT_ALLOCATIONS", (scratch_.path() / "count").string()}});
  }
  void expectSound(const ProcessResult &result) {
    EXPECT_THAT(result.err, Not(AnyOf(HasSubstr("terminate"), HasSubstr("nternal error"))));
    ASSERT_THAT(result.exitCode, AnyOf(0, 1, 4)) << result.err;
    EXPECT_FALSE(fs::exists(scratch_.path() / "s")) << "the socket's file is left";
    const bool printed = result.out.find("Main.done = TRUE") != std::string::npos;
    const bool traced = readTrace().find("\n0.4") != std::string::npos;
    // Not begun, or at its end: an axis that moves is served until it rests.
    if (result.exitCode == 1) {
      EXPECT_THAT(result.err, HasSubstr("error: "));
      EXPECT_EQ(readTrace().find("\n0.1"), std::string::npos);
    } else if (result.exitCode == 0) {
      EXPECT_TRUE(printed && traced) << result.out << result.err;
    } else {
      EXPECT_TRUE(printed || traced) << result.out << result.err;
      EXPECT_THAT(result.err, AnyOf(HasSubstr("warning: "), HasSubstr("error: ")));
    }
  }
  std::string readTrace() const {
    return fs::exists(scratch_.path() / "t.csv") ? readFile(scratch_.path() / "t.csv")
                                                 : std::string();
  }

  ScratchDirectory scratch_;
};

/// A sample, with a seed of its own; all of them with STRIDE_ALL_FAULTS.
TEST_F(NoMemory, EachAllocationFails) {
  const ProcessResult good = run(0, 0);
  ASSERT_EQ(good.exitCode, 0) << good.err;
  const unsigned long calls = std::stoul(readFile(scratch_.path() / "count"));
  ASSERT_GT(calls, 100U);
  std::vector<unsigned long> chosen;
  if (std::getenv("STRIDE_ALL_FAULTS") != nullptr) {
    for (unsigned long n = 1; n <= calls; ++n)
      chosen.push_back(n);
  } else {
    std::mt19937 random(14);
    for (unsigned long i = 0; i < 24; ++i)
      chosen.push_back(1 + (calls * i + random() % calls) / 24);
  }
  for (size_t i = 0; i < chosen.size(); ++i) {
    static constexpr unsigned long kCounts[] = {1, 20, 1'000'000'000};
    const unsigned long count = kCounts[i % 3];
    SCOPED_TRACE("allocation " + std::to_string(chosen[i]) + " of " + std::to_string(calls) +
                 ", so many fail: " + std::to_string(count));
    expectSound(run(chosen[i], count));
  }
}

} // namespace
} // namespace stride::test
