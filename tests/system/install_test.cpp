// What `cmake --install` leaves behind is enough for a program that embeds applications.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
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

/// Runs a script with an installation, which is a copy of its own, at `$PWD/usr`.
ProcessResult runInstalled(const ScratchDirectory &scratch, const std::string &script) {
  return runProcess({"bash", "-ec", "cmake --install $BINARY --prefix usr > /dev/null\n" + script},
                    scratch.path(),
                    {{"XDG_CACHE_HOME", (scratch.path() / "cache").string()},
                     {"XDG_DATA_HOME", (scratch.path() / "data").string()},
                     {"BINARY", STRIDE_BINARY_DIR},
                     {"SOURCE", STRIDE_SOURCE_DIR}});
}

TEST(Install, SaysWhichCommitItIs) {
  const ScratchDirectory scratch;
  const ProcessResult result = runInstalled(scratch, "usr/bin/stride --version\n");
  EXPECT_THAT(result.out, ::testing::MatchesRegex(
                              "stride [0-9]+\\.[0-9]+\\.[0-9]+( \\([0-9a-f]+, [-0-9]+(, changed "
                              "since)?\\))?\n"));
}

TEST(Install, BashCompletesCommandsAndOptions) {
  const ScratchDirectory scratch;
  const ProcessResult result = runInstalled(
      scratch, ". usr/share/bash-completion/completions/stride\n"
               "of() { COMP_WORDS=(stride \"$@\"); COMP_CWORD=$#; COMPREPLY=(); _stride;\n"
               "  echo \"${COMPREPLY[*]}\"; }\n"
               "of lib; of library in; of library install --rep; of check --col; of help pl\n"
               "of sim -; of check Main\n");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::StartsWith("library\ninstall\n--replace\n--color\nplot\n"));
  EXPECT_THAT(result.out, ::testing::HasSubstr(" --trace "));
  EXPECT_THAT(result.out, ::testing::EndsWith("\n\n")); // a file
}

TEST(Install, ZshAndTheManualPageKnowEveryCommand) {
  const ScratchDirectory scratch;
  const ProcessResult result = runInstalled(
      scratch, "groff -ww -man -Tutf8 -P-cbou usr/share/man/man1/stride.1 > page 2>&1\n"
               "usr/bin/stride help | sed -n 's/^  \\([a-z]*\\)  .*/\\1/p' > names\n"
               "while read -r name; do\n"
               "  grep -q \"stride $name\" page || echo \"no page: $name\"\n"
               "  grep -q \"^    '$name:\" usr/share/zsh/site-functions/_stride ||\n"
               "    echo \"zsh: $name\"\n"
               "done < names\n"
               "wc -l < names; grep -c ': warning: ' page || true\n");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  int commands = 0;
  int warnings = -1;
  ASSERT_EQ(std::sscanf(result.out.c_str(), "%d %d", &commands, &warnings), 2) << result.out;
  EXPECT_GT(commands, 10);
  EXPECT_EQ(warnings, 0) << readFile(scratch.path() / "page");
}

TEST(Install, LibrariesAreInstalledForTheUser) {
  const ScratchDirectory scratch;
  const ProcessResult result = runInstalled(
      scratch,
      "stride=$PWD/usr/bin/stride; mkdir -p pumps/src plant\n"
      "printf '[project]\\nsources = [\"src\"]\\n[library]\\nname = \"Pumps\"\\nversion = "
      "\"1.2\"\\n' "
      "> pumps/stride.toml\n"
      "printf 'FUNCTION Twice : INT\\nVAR_INPUT x : INT; END_VAR\\nTwice := 2 * "
      "x;\\nEND_FUNCTION\\n' "
      "> pumps/src/Twice.st\n"
      "echo text > pumps/README.md\n"
      "printf '[[library]]\\nname = \"Pumps\"\\nversion = \"1.1\"\\n' > plant/stride.toml\n"
      "printf 'PROGRAM Main\\nVAR n : INT; END_VAR\\nn := Twice(21);\\nEND_PROGRAM\\n' > "
      "plant/Main.st\n"
      "$stride check plant 2>&1 | grep -c 'SE0850.*not installed'\n"
      "(cd pumps/src && $stride library install) | sed \"s|$PWD||\"\n"
      "rm -r pumps\n"
      "$stride library list | sed \"s|$PWD||\"\n"
      "(cd data/stride/libraries && find . -type f | sort)\n"
      "$stride sim plant --for T#10ms --print Main.n\n"
      "$stride library install data/stride/libraries/Pumps/1.2 2>&1 | grep -c SE0834\n"
      "$stride library install --replace data/stride/libraries/Pumps/1.2 > /dev/null\n"
      "(cd data/stride/libraries && find . -type f | wc -l)\n");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, "1\n"
                        "Installed Pumps 1.2 in /data/stride/libraries/Pumps/1.2\n"
                        "Pumps 1.2  /data/stride/libraries/Pumps/1.2\n"
                        "./Pumps/1.2/README.md\n"
                        "./Pumps/1.2/src/Twice.st\n"
                        "./Pumps/1.2/stride.toml\n"
                        "Main.n = 42\n"
                        "1\n"
                        "3\n");
}

TEST(Install, DebianPackagesHoldWhatIsNeeded) {
  const ScratchDirectory scratch;
  const ProcessResult result = runProcess(
      {"sh", "-ec",
       "cpack --config $BINARY/CPackConfig.cmake -B packages -D CPACK_DEBIAN_COMPRESSION_TYPE=none "
       "> log 2>&1 || { cat log; exit 1; }\n"
       "mkdir -p root one\n"
       "for package in packages/*.deb; do\n"
       "  dpkg-deb -f $package Package Depends\n"
       "done\n"
       "dpkg-deb -x packages/stride_*.deb root\n"
       "dpkg-deb -x packages/stride-dev_*.deb one\n"
       "(cd one && find . -type f | sort)\n"
       "root/usr/bin/stride build $SOURCE/examples/embed/Tank.st -o Tank.so && ls Tank.so\n"},
      scratch.path(),
      {{"XDG_CACHE_HOME", (scratch.path() / "cache").string()},
       {"BINARY", STRIDE_BINARY_DIR},
       {"SOURCE", STRIDE_SOURCE_DIR}});
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  EXPECT_THAT(result.out, ::testing::ContainsRegex("Package: stride-dev\nDepends: .*libdw-dev"));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("Package: stride\nDepends: .*g\\+\\+"));
  EXPECT_THAT(result.out, ::testing::HasSubstr("libfmt9")); // found in the program itself
  EXPECT_THAT(result.out, ::testing::HasSubstr("./usr/include/stride/runtime/embed/stride.hpp\n"
                                               "./usr/lib/cmake/Stride/StrideConfig.cmake\n"
                                               "./usr/lib/cmake/Stride/StrideConfigVersion.cmake\n"
                                               "./usr/lib/pkgconfig/stride-embed.pc\n"
                                               "./usr/lib/stride/libstride-embed.a\n"
                                               "Tank.so\n"));
}

} // namespace
} // namespace stride::test
