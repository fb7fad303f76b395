// What `cmake --install` leaves behind is enough for a program that embeds applications.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stride::test {
namespace {

TEST(Install, AProgramOutsideOfTheBuildEmbedsApplications) {
  const ScratchDirectory scratch;
  const ProcessResult result =
      runProcess({"sh", "-ec",
                  "cmake --install $BINARY --prefix here > /dev/null\n"
                  "mv here there\n" // it may be moved
                  "export PKG_CONFIG_PATH=there/lib/pkgconfig\n"
                  "g++ -std=c++20 $SOURCE/examples/embed/main.cpp -o embed "
                  "$(pkg-config --cflags --libs stride-embed)\n"
                  "there/bin/stride build $SOURCE/examples/embed/Tank.st -o Tank.so\n"
                  "./embed Tank.so"},
                 scratch.path(),
                 {{"XDG_CACHE_HOME", (scratch.path() / "cache").string()},
                  {"BINARY", STRIDE_BINARY_DIR},
                  {"SOURCE", STRIDE_SOURCE_DIR}});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::StartsWith("tank 1: filled 10 times up to 700, level 575\n"
                                                "tank 2: filled 99 times up to 450, level 425\n"));
}

} // namespace
} // namespace stride::test
