#ifndef STRIDE_TESTS_SYSTEM_HOSTILE_PROJECT_HPP
#define STRIDE_TESTS_SYSTEM_HOSTILE_PROJECT_HPP
// Projects that somebody gave away to do harm.

#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stride::test {

namespace fs = std::filesystem;

inline constexpr const char *kCounter =
    "PROGRAM PLC_PRG\nVAR\n  n : INT;\nEND_VAR\nn := n + 1;\nEND_PROGRAM\n";
#ifdef STRIDE_SANITIZED
inline constexpr bool kStatic = false; // sanitizers need shared libraries
#else
inline constexpr bool kStatic = true;
#endif
inline constexpr const char *kPhoto = "a photograph of somebody's cat";

/// A project, and next to it a home that is none of its business.
class HostileProject : public ::testing::Test {
protected:
  HostileProject() {
    write("p/a.st", kCounter);
    write("home/photo.cpp", kPhoto);
    write("home/cache/photo.o", kPhoto);
  }

  using Environment = std::vector<std::pair<std::string, std::string>>;

  ProcessResult stride(std::vector<std::string> arguments, Environment environment = {}) {
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    environment.emplace_back("XDG_CACHE_HOME", at("cache").string());
    return runProcess(arguments, scratch_.path(), environment);
  }
  void succeed(const std::vector<std::string> &arguments) {
    const ProcessResult result = stride(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  }
  void refuse(const std::vector<std::string> &arguments, const std::string &code) {
    const ProcessResult result = stride(arguments);
    EXPECT_EQ(result.exitCode, 1) << result.out;
    EXPECT_THAT(result.err, ::testing::HasSubstr("error[" + code + "]"));
  }

  fs::path at(const std::string &name) const { return scratch_.path() / name; }
  void write(const std::string &name, const std::string &text) {
    fs::create_directories(at(name).parent_path());
    writeFile(at(name), text);
  }
  std::string read(const std::string &name) { return readFile(at(name)); }
  void link(const std::string &target, const std::string &name) {
    fs::create_directories(at(name).parent_path());
    fs::create_symlink(target, at(name));
  }
  /// Nothing of what is not the project's was touched.
  void expectHomeUntouched() {
    std::vector<std::string> files;
    for (const fs::directory_entry &entry : fs::recursive_directory_iterator(at("home")))
      if (!entry.is_directory())
        files.push_back(entry.path().lexically_relative(at("home")).string());
    EXPECT_THAT(files, ::testing::UnorderedElementsAre("photo.cpp", "cache/photo.o"));
    EXPECT_EQ(read("home/photo.cpp"), kPhoto);
    EXPECT_EQ(read("home/cache/photo.o"), kPhoto);
  }

  ScratchDirectory scratch_;
};

} // namespace stride::test

#endif // STRIDE_TESTS_SYSTEM_HOSTILE_PROJECT_HPP
