// Several commands on one project at the same time, and builds that must be the same everywhere.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <future>
#include <random>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;

class ConcurrentBuilds : public ::testing::Test {
protected:
  ProcessResult stride(std::vector<std::string> arguments, const std::string &cache = "cache") {
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    return runProcess(arguments, scratch_.path(), {{"XDG_CACHE_HOME", at(cache).string()}});
  }
  fs::path at(const std::string &name) const { return scratch_.path() / name; }

  /// Its file appears complete, as editors write it.
  void write(const std::string &name, const std::string &text) {
    fs::create_directories(at(name).parent_path());
    writeFile(at("fresh"), text);
    fs::rename(at("fresh"), at(name));
  }

  /// A program whose values say which text and which options they were computed with.
  void edit(int value) {
    const std::string number = std::to_string(value);
    write("p/a.st", "VAR_GLOBAL CONSTANT\n  {IF defined (X)}\n  K : DINT := 1000 + " + number +
                        ";\n  {ELSE}\n  K : DINT := " + number +
                        ";\n  {END_IF}\n  SQUARE : DINT := K * K;\nEND_VAR\n"
                        "FUNCTION_BLOCK FB\nVAR_OUTPUT q : DINT; END_VAR\nq := q + K;\n"
                        "END_FUNCTION_BLOCK\n"
                        "PROGRAM PLC_PRG\nVAR fb1 : FB; n, s : DINT; END_VAR\nfb1();\nn := n + 1;\n"
                        "s := SQUARE;\nEND_PROGRAM\n"
                        "{test}\nFUNCTION_BLOCK T\nVAR b : BOOL; END_VAR\nb := K = K;\n"
                        "END_FUNCTION_BLOCK\n");
  }
  /// What 30 ms of it print.
  static std::string values(int value, bool defined) {
    const int k = value + (defined ? 1000 : 0);
    return "PLC_PRG.n = 3\nPLC_PRG.fb1.q = " + std::to_string(3 * k) +
           "\nPLC_PRG.s = " + std::to_string(k * k) + "\n";
  }

  ScratchDirectory scratch_;
};

const std::vector<std::string> kSimulate = {
    "sim", "p", "--for", "T#30ms", "--print", "PLC_PRG.n,PLC_PRG.fb1.q,PLC_PRG.s"};

/// Rounds, more of them where the environment says so.
int rounds(int usual) {
  const char *text = std::getenv("STRIDE_BUILD_ROUNDS");
  return text != nullptr ? std::atoi(text) : usual;
}

// What an editor, a CI job and a user at the shell do to one project.
TEST_F(ConcurrentBuilds, EachComputesWithItsOwnTextAndOptions) {
  std::mt19937 random(20261122);
  int value = 1;
  edit(value);
  const int count = rounds(6);
  for (int round = 0; round < count; ++round) {
    const int before = value;
    const bool edits = random() % 2 == 0;
    const int next = static_cast<int>(random() % 900);
    std::vector<bool> defined;
    std::vector<std::future<ProcessResult>> runs;
    for (int i = 0; i < 4; ++i) {
      std::vector<std::string> command = kSimulate;
      defined.push_back(random() % 2 == 0);
      if (defined.back())
        command.insert(command.end(), {"-D", "X"});
      if (random() % 3 == 0)
        command.emplace_back("--unchecked");
      if (random() % 3 == 0)
        command.emplace_back("--debug");
      runs.push_back(std::async(std::launch::async, [this, command] { return stride(command); }));
    }
    std::future<ProcessResult> other = std::async(std::launch::async, [this, round] {
      return round % 2 == 0 ? stride({"test", "p"}) : stride({"build", "p"});
    });
    if (edits) {
      value = next;
      edit(value);
    }
    for (size_t i = 0; i < runs.size(); ++i) {
      const ProcessResult result = runs[i].get();
      ASSERT_THAT(result.out, AnyOf(values(before, defined[i]), values(value, defined[i])))
          << "round " << round << ", run " << i << "\n"
          << result.err;
    }
    const ProcessResult result = other.get();
    ASSERT_EQ(result.exitCode, 0) << "round " << round << "\n" << result.out << result.err;
    // Alone, afterwards: nothing was poisoned.
    ASSERT_EQ(stride(kSimulate).out, values(value, false)) << "round " << round;
  }
}

#ifndef STRIDE_SANITIZED // AddressSanitizer keeps the names of sources in what it checks

TEST_F(ConcurrentBuilds, EachWritesWhatACleanBuildWrites) {
  edit(7);
  const std::vector<std::vector<std::string>> variants = {
      {}, {"-D", "X"}, {"--unchecked"}, {"--debug", "-D", "X"}};
  std::vector<std::string> clean;
  for (size_t i = 0; i < variants.size(); ++i) {
    std::vector<std::string> command = {"build", "p", "-o", "clean.so"};
    command.insert(command.end(), variants[i].begin(), variants[i].end());
    ASSERT_EQ(stride(command, "clean" + std::to_string(i)).exitCode, 0);
    clean.push_back(readFile(at("clean.so")));
  }
  const int count = rounds(1);
  for (int round = 0; round < count; ++round) {
    fs::remove_all(at("cache"));
    std::vector<std::future<ProcessResult>> builds;
    for (size_t i = 0; i < 2 * variants.size(); ++i) {
      std::vector<std::string> command = {"build", "p", "-o", std::to_string(i) + ".so"};
      command.insert(command.end(), variants[i / 2].begin(), variants[i / 2].end());
      builds.push_back(std::async(std::launch::async, [this, command] { return stride(command); }));
    }
    for (size_t i = 0; i < builds.size(); ++i) {
      ASSERT_EQ(builds[i].get().exitCode, 0);
      ASSERT_EQ(readFile(at(std::to_string(i) + ".so")), clean[i / 2]) << round << " " << i;
    }
  }
}

// Two folders of other names, two users' caches, two times: the same bytes.
TEST_F(ConcurrentBuilds, TheSameSourcesGiveTheSameBytes) {
  edit(3);
  fs::create_directories(at("elsewhere/below"));
  fs::copy(at("p"), at("elsewhere/below/other name"), fs::copy_options::recursive);
  const std::vector<std::vector<std::string>> kinds = {{}, {"--debug"}, {"--static"}};
  for (const std::vector<std::string> &kind : kinds) {
    std::vector<std::string> one = {"build", "p", "-o", "one"};
    std::vector<std::string> two = {"build", at("elsewhere/below/other name").string(), "-o",
                                    "two"};
    one.insert(one.end(), kind.begin(), kind.end());
    two.insert(two.end(), kind.begin(), kind.end());
    ASSERT_EQ(stride(one, "cache-one").exitCode, 0);
    fs::last_write_time(at("elsewhere/below/other name/a.st"),
                        fs::file_time_type::clock::now() - std::chrono::hours(1000));
    ASSERT_EQ(stride(two, "other-cache/of/another user").exitCode, 0);
    EXPECT_EQ(readFile(at("one")), readFile(at("two"))) << ::testing::PrintToString(kind);
  }
  // A single file as well.
  fs::copy(at("p/a.st"), at("elsewhere/a.st"));
  ASSERT_EQ(stride({"build", "p/a.st", "-o", "one"}).exitCode, 0);
  ASSERT_EQ(stride({"build", "elsewhere/a.st", "-o", "two"}, "c2").exitCode, 0);
  EXPECT_EQ(readFile(at("one")), readFile(at("two")));
  EXPECT_THAT(readFile(at("one")), ::testing::Not(HasSubstr(scratch_.path().string())));
}

#endif

} // namespace
} // namespace stride::test
