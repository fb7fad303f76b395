// What `cmake --install` leaves behind is enough for a program that embeds applications.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stride::test {
namespace {

/// A project that knows nothing of Stride's sources, with both ways to find what is installed.
constexpr const char *kForeignProject = R"cmake(cmake_minimum_required(VERSION 3.25)
project(foreign LANGUAGES CXX)
find_package(Stride 0.1 REQUIRED)
add_executable(by_package main.cpp)
target_link_libraries(by_package PRIVATE stride::embed)

find_package(PkgConfig REQUIRED)
pkg_check_modules(EMBED REQUIRED IMPORTED_TARGET stride-embed)
add_executable(by_pkg_config main.cpp)
target_compile_features(by_pkg_config PRIVATE cxx_std_20)
target_link_libraries(by_pkg_config PRIVATE PkgConfig::EMBED)

add_custom_target(application ALL COMMAND stride::stride build ${TANK} -o Tank.so)
)cmake";

TEST(Install, AProgramOutsideOfTheBuildEmbedsApplications) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch.path() / "foreign");
  writeFile(scratch.path() / "foreign" / "CMakeLists.txt", kForeignProject);
  const ProcessResult result =
      runProcess({"sh", "-ec",
                  "cmake --install $BINARY --prefix here > /dev/null\n"
                  "mv here there\n" // it may be moved
                  "cp $SOURCE/examples/embed/main.cpp foreign\n"
                  "export PKG_CONFIG_PATH=$PWD/there/lib/pkgconfig\n"
                  "cmake -S foreign -B out -G Ninja -DCMAKE_PREFIX_PATH=$PWD/there "
                  "-DTANK=$SOURCE/examples/embed/Tank.st > log 2>&1 || { cat log; exit 1; }\n"
                  "cmake --build out > log 2>&1 || { cat log; exit 1; }\n"
                  "out/by_package out/Tank.so\n"
                  "out/by_pkg_config out/Tank.so\n"
                  // as a Makefile does it, in one call of the compiler
                  "g++ -std=c++20 foreign/main.cpp -o embed "
                  "$(pkg-config --cflags --libs stride-embed)\n"
                  "./embed out/Tank.so\n"},
                 scratch.path(),
                 {{"XDG_CACHE_HOME", (scratch.path() / "cache").string()},
                  {"BINARY", STRIDE_BINARY_DIR},
                  {"SOURCE", STRIDE_SOURCE_DIR}});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  const std::string run =
      "tank 1: filled 10 times up to 700, level 575\n"
      "tank 2: filled 99 times up to 450, level 425\n"
      "symbol 'Tank.levle': Tank has no member 'levle'; did you mean 'level'?\n";
  EXPECT_EQ(result.out, run + run + run);
}

} // namespace
} // namespace stride::test
