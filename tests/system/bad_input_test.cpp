// Input that no one means to write, and input that is merely large: `stride` answers with
// diagnostics, never with a crash, a flood of output or a long wait. What fits into a readable file
// is a golden test.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace stride::test {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kTenMegabytes = 10'000'000;
constexpr std::size_t kMostOutput = 100'000;

std::string repeat(std::string_view text, std::size_t times) {
  std::string result;
  result.reserve(text.size() * times);
  for (std::size_t i = 0; i < times; ++i)
    result += text;
  return result;
}

// A program with the variables x : DINT and b : BOOL.
std::string program(const std::string &statements) {
  return "PROGRAM PLC_PRG\nVAR\n  x : DINT;\n  b : BOOL;\nEND_VAR\n" + statements +
         "\nEND_PROGRAM\n";
}

class Input : public ::testing::Test {
protected:
  ProcessResult stride(std::vector<std::string> arguments, const std::string &source) {
    writeFile(scratch_.path() / "input.st", source);
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    return runProcess(arguments, scratch_.path());
  }

  void expectError(const std::string &source) {
    const ProcessResult result = stride({"check", "input.st"}, source);
    const std::string output = result.out + result.err;
    EXPECT_EQ(result.exitCode, 1) << output.substr(0, kMostOutput);
    EXPECT_THAT(output.substr(0, kMostOutput), HasSubstr("error[SE"));
    EXPECT_LT(output.size(), kMostOutput);
  }

  void expectValue(const std::string &source, const std::string &value) {
    const ProcessResult result =
        stride({"sim", "input.st", "--for", "T#10ms", "--print", "PLC_PRG.x"}, source);
    EXPECT_EQ(result.exitCode, 0) << result.err.substr(0, kMostOutput);
    EXPECT_EQ(result.out, "PLC_PRG.x = " + value + "\n");
  }

  ScratchDirectory scratch_;
};

TEST_F(Input, EmptyFileIsNoCrash) {
  const ProcessResult result = stride({"check", "input.st"}, "");
  EXPECT_LE(result.exitCode, 1) << result.err;
}

TEST_F(Input, MissingFileIsAnError) {
  const ProcessResult result =
      runProcess({STRIDE_BINARY_DIR "/stride", "check", "nowhere.st"}, scratch_.path());
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.out + result.err, HasSubstr("nowhere.st"));
}

TEST_F(Input, BinaryFileIsAnError) {
  std::mt19937 random(1);
  std::string bytes(65'536, '\0');
  for (char &byte : bytes)
    byte = static_cast<char>(random());
  expectError(bytes);
}

TEST_F(Input, ZeroBytesAreAnError) { expectError(program(std::string("x := 1;\0\0 x := 2;", 17))); }

TEST_F(Input, TenMegabyteLineOfNonsense) { expectError(repeat("x", kTenMegabytes)); }

TEST_F(Input, TenMegabyteLineOfSymbols) { expectError(repeat("[:=", kTenMegabytes / 3)); }

TEST_F(Input, TenMegabyteCommentOnOneLine) {
  expectValue(program("(*" + repeat("-", kTenMegabytes) + "*) x := 3;"), "3");
}

TEST_F(Input, UnterminatedComment) { expectError("(*" + repeat(" (* text", 10'000)); }

TEST_F(Input, UnterminatedString) { expectError(program("x := 'open")); }

TEST_F(Input, DeepParenthesesAreAnError) {
  expectError(program("x := " + repeat("(", 100'000) + "1" + repeat(")", 100'000) + ";"));
}

TEST_F(Input, OpenParenthesesOnlyAreAnError) {
  expectError(program("x := " + repeat("(", 100'000)));
}

TEST_F(Input, DeepStatementsAreAnError) {
  expectError(program(repeat("IF b THEN\n", 20'000) + repeat("END_IF\n", 20'000)));
}

TEST_F(Input, DeepIndexesAreAnError) {
  expectError(program("x := " + repeat("a[", 20'000) + "1" + repeat("]", 20'000) + ";"));
}

TEST_F(Input, DeepTypesAreAnError) {
  expectError("TYPE T : " + repeat("ARRAY[0..1] OF ", 20'000) + "INT; END_TYPE\n");
}

TEST_F(Input, NestingWithinTheLimitWorks) {
  expectValue(program("x := " + repeat("(", 200) + "7" + repeat(")", 200) + ";"), "7");
  expectValue(
      program("b := TRUE;\n" + repeat("IF b THEN\n", 200) + "x := 8;\n" + repeat("END_IF\n", 200)),
      "8");
}

TEST_F(Input, SumOfTenThousandTerms) {
  expectValue(program("x := 1;\nx := 0" + repeat(" + x", 10'000) + ";"), "10000");
}

TEST_F(Input, ChainOfTenThousandElsifs) {
  std::string chain = "x := 9999;\nIF x = -1 THEN\n  x := 0;\n";
  for (int i = 0; i < 10'000; ++i)
    chain += "ELSIF x = " + std::to_string(i) + " THEN\n  x := " + std::to_string(-i) + ";\n";
  expectValue(program(chain + "END_IF"), "-9999");
}

TEST_F(Input, ChainOfTenThousandNots) {
  const ProcessResult result =
      stride({"check", "input.st"}, program("b := " + repeat("NOT ", 10'000) + "b;"));
  EXPECT_LE(result.exitCode, 1) << result.err;
}

} // namespace
} // namespace stride::test
