// What is large: many axes, many variables, many mistakes, files at the limit.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stride::test {
namespace {

using ::testing::HasSubstr;

// A thousand axes: each has its own parameters and its own place, and the program finds them.
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

class LargeProject : public ::testing::Test {
protected:
  ProcessResult stride(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    return runProcess(arguments, scratch_.path(),
                      {{"XDG_CACHE_HOME", (scratch_.path() / "cache").string()}});
  }
  void write(const std::string &text) { writeFile(scratch_.path() / "a.st", text); }

  ScratchDirectory scratch_;
};

// They are initialised in parts of 200 (g++ takes long for long functions): none is left out, none
// gets another one's value, wherever a part ends.
TEST_F(LargeProject, ManyVariablesHaveTheirValues) {
  for (const int count : {199, 200, 201, 400, 401}) {
    std::string variables;
    std::string expected;
    for (int i = 0; i < count; ++i) {
      const std::string number = std::to_string(3 * i + 1);
      variables +=
          "  v" + std::to_string(i) + " : S := (a := " + number + ", s := 'x" + number + "');\n";
      expected += "V.v" + std::to_string(i) + ".a = " + number + "\nV.v" + std::to_string(i) +
                  ".s = 'x" + number + "'\n";
    }
    write("TYPE S : STRUCT a : INT; s : STRING(20); END_STRUCT END_TYPE\n"
          "FUNCTION_BLOCK B\nVAR_INPUT\n" +
          variables +
          "END_VAR\nEND_FUNCTION_BLOCK\n"
          "PROGRAM V\nVAR\n  b : B;\n" +
          variables + "END_VAR\nb();\nEND_PROGRAM\n");
    const ProcessResult result =
        stride({"sim", "a.st", "--for", "T#10ms", "--quiet", "-W", "off=lints", "--print", "V"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    std::string inBlock = expected;
    for (size_t i = 0; (i = inBlock.find("V.v", i)) != std::string::npos; i += 3)
      inBlock.replace(i, 3, "V.b.v");
    EXPECT_EQ(result.out, inBlock + expected) << count;
  }
}

TEST_F(LargeProject, AnExceptionInALaterPartHasItsPlace) {
  std::string text = "FUNCTION Zero : INT\nZero := 0;\nEND_FUNCTION\nPROGRAM V\nVAR\n";
  for (int i = 0; i < 300; ++i)
    text += "  v" + std::to_string(i) + " : INT := " + (i == 250 ? "7 / Zero()" : "1") + ";\n";
  write(text + "END_VAR\n;\nEND_PROGRAM\n");
  const ProcessResult result =
      stride({"sim", "a.st", "--for", "T#10ms", "--quiet", "-W", "off=lints"});
  EXPECT_EQ(result.exitCode, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr("division by zero at a.st:256:"));
}

TEST_F(LargeProject, AFileHasALimitedNumberOfWords) {
  const size_t limit = 4'000'000;
  const std::string program = "PROGRAM P\n;\nEND_PROGRAM\n"; // four of them
  for (const size_t count : {limit - 1, limit, limit + 1}) {
    write(program + std::string(count - 4, ';') + "  ");
    const ProcessResult result = stride({"check", "a.st"});
    EXPECT_EQ(result.exitCode, count <= limit ? 0 : 1) << count;
    EXPECT_EQ(result.err.find("error[SE0119]") != std::string::npos, count > limit);
    EXPECT_EQ(stride({"fmt", "--check", "a.st"}).err.find("SE0119") != std::string::npos,
              count > limit);
  }
}

/// Compiled units in the cache.
size_t unitsIn(const std::filesystem::path &cache) {
  size_t count = 0;
  for (const auto &entry : std::filesystem::recursive_directory_iterator(cache))
    count += entry.path().extension() == ".o" ? 1 : 0;
  return count;
}

// Small POUs are compiled together; what an edit leaves alone is not compiled again.
TEST_F(LargeProject, AnEditCompilesTheUnitThatItIsIn) {
  const ProcessResult generated = runProcess(
      {"python3", STRIDE_SOURCE_DIR "/tests/bench/frontend/generate_project.py", "2500", "."},
      scratch_.path());
  ASSERT_EQ(generated.exitCode, 0) << generated.err;
  auto compiled = [&, before = size_t{0}]() mutable {
    const ProcessResult result =
        stride({"sim", ".", "--debug", "--for", "T#30ms", "--quiet", "--print", "Main.station7"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    const size_t all = unitsIn(scratch_.path() / "cache");
    return all - std::exchange(before, all);
  };
  // 19 stations of more than 6 KB each, the program that calls them, and the application.
  const size_t all = compiled();
  EXPECT_GE(all, 7U);
  EXPECT_LE(all, 16U);
  const std::filesystem::path file = scratch_.path() / "Station7.st";
  const std::string text = readFile(file);
  const size_t at = text.find("iCount := 0;");
  ASSERT_NE(at, std::string::npos);
  writeFile(file, text.substr(0, at) + "iCount := 1;" + text.substr(at + 12));
  EXPECT_EQ(compiled(), 2U); // its unit, and the hashes of the sources
  writeFile(scratch_.path() / "Extra.st", "FUNCTION Extra : INT\nExtra := 7;\nEND_FUNCTION\n");
  const size_t added = compiled(); // what it is in; two where that is too much then
  EXPECT_GE(added, 2U);
  EXPECT_LE(added, 3U);
  writeFile(file, text);
  std::filesystem::remove(scratch_.path() / "Extra.st");
  EXPECT_EQ(compiled(), 0U); // all of that is known
}

// Looking for what was meant would take longer than everything else.
TEST_F(LargeProject, ManyUnknownNamesDoNotTakeLong) {
  std::string text = "VAR_GLOBAL\n";
  for (int i = 0; i < 20000; ++i)
    text += "  variable" + std::to_string(i + 100000) + " : INT;\n";
  text += "END_VAR\nPROGRAM P\n";
  for (int i = 0; i < 20000; ++i)
    text += "variable" + std::to_string(i + 100000) + "x := 1;\n";
  write(text + "END_PROGRAM\n");
  const std::string err = stride({"check", "a.st", "--max-errors", "0"}).err;
  EXPECT_THAT(err, HasSubstr("a similar name exists: `variable100000`"));
  EXPECT_THAT(err, ::testing::Not(HasSubstr("a similar name exists: `variable100999`")));
  EXPECT_THAT(err, HasSubstr("error: 1000 errors"));
}

} // namespace
} // namespace stride::test
