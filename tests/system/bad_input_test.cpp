// Input that no one means to write, and input that is merely large: `stride` answers with
// diagnostics, never with a crash, a flood of output or a long wait. What fits into a readable file
// is a golden test.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <random>
#include <sys/stat.h>

namespace stride::test {
namespace {

using ::testing::HasSubstr;

constexpr size_t kTenMegabytes = 10'000'000;
constexpr size_t kMostOutput = 100'000;

std::string repeat(std::string_view text, size_t times) {
  std::string result;
  result.reserve(text.size() * times);
  for (size_t i = 0; i < times; ++i)
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

// Types, blocks, functions, methods, variables with names of so many characters; some differ in the
// last one only.
std::string longNames(size_t length) {
  const auto name = [&](char last) { return std::string(length - 1, 'n') + last; };
  return "TYPE " + name('t') + " : STRUCT " + name('v') + " : DINT := 3; e : (" + name('x') + ", " +
         name('y') + "); END_STRUCT END_TYPE\n" + //
         "FUNCTION " + name('f') + " : DINT " + name('f') + " := 10; END_FUNCTION\n" + "FUNCTION " +
         name('g') + " : DINT " + name('g') + " := 20; END_FUNCTION\n" + "FUNCTION_BLOCK " +
         name('b') + " VAR s : " + name('t') + "; END_VAR\nMETHOD " + name('m') + " : DINT " +
         name('m') + " := s." + name('v') + "; END_METHOD END_FUNCTION_BLOCK\n" + "VAR_GLOBAL " +
         name('i') + " : " + name('b') + "; END_VAR\n" +
         program("x := " + name('i') + "." + name('m') + "() + " + name('f') + "() + " + name('g') +
                 "();");
}

TEST_F(Input, LongNamesAreBuilt) {
  expectValue(longNames(229), "33");
  expectValue(longNames(255), "33");
}

TEST_F(Input, LongerNamesAreErrors) {
  expectError(longNames(256));
  expectError(longNames(1000));
}

// ----------------------------------------------------------------------------------------------
// what is no file

class Place : public Input {
protected:
  ProcessResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    return runProcess(arguments, scratch_.path());
  }

  void expectUnreadable(const std::vector<std::string> &arguments, const std::string &reason) {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exitCode, 1) << result.err;
    EXPECT_THAT(result.out + result.err, HasSubstr("error[SE0101]"));
    EXPECT_THAT(result.out + result.err, HasSubstr(reason));
  }

  void pipe(const std::string &name) {
    ASSERT_EQ(::mkfifo((scratch_.path() / name).c_str(), 0600), 0);
  }
};

constexpr const char *kNotRegular = "it is not a regular file";

TEST_F(Place, PipeAsASource) {
  pipe("input.st");
  expectUnreadable({"check", "input.st"}, kNotRegular);
  expectUnreadable({"fmt", "input.st"}, kNotRegular);
  expectUnreadable({"build", "input.st"}, kNotRegular);
}

TEST_F(Place, PipesInAProject) {
  writeFile(scratch_.path() / "main.st", program("x := 1;"));
  pipe("other.st");
  expectUnreadable({"check", "."}, kNotRegular);
  expectUnreadable({"fmt", "."}, kNotRegular);
  std::filesystem::remove(scratch_.path() / "other.st");
  pipe("Cam1.cam.toml");
  expectUnreadable({"check", "."}, kNotRegular);
  expectUnreadable({"cam", "check", "Cam1.cam.toml"}, kNotRegular);
  std::filesystem::remove(scratch_.path() / "Cam1.cam.toml");
  pipe("stride.toml");
  expectUnreadable({"check", "."}, kNotRegular);
  expectUnreadable({"fmt", "."}, kNotRegular);
  pipe("Cam2.CAM");
  expectUnreadable({"cam", "check", "Cam2.CAM"}, kNotRegular);
}

TEST_F(Place, DevicesAsSources) {
  expectUnreadable({"check", "/dev/zero"}, kNotRegular);
  expectUnreadable({"fmt", "/dev/zero"}, kNotRegular);
  std::filesystem::create_symlink("/dev/zero", scratch_.path() / "input.st");
  expectUnreadable({"check", "input.st"}, kNotRegular);
}

TEST_F(Place, FilesWithoutMeasure) {
  writeFile(scratch_.path() / "input.st", "");
  std::filesystem::resize_file(scratch_.path() / "input.st", uintmax_t{1} << 40);
  expectUnreadable({"check", "input.st"}, "it is longer than 16 MiB");
  expectUnreadable({"fmt", "input.st"}, "it is longer than 16 MiB");
  std::filesystem::resize_file(scratch_.path() / "input.st", (16U << 20U) + 1);
  expectUnreadable({"check", "input.st"}, "it is longer than 16 MiB");
  std::filesystem::resize_file(scratch_.path() / "input.st", 16U << 20U);
  const ProcessResult result = run({"check", "input.st"});
  EXPECT_THAT(result.out + result.err, HasSubstr("is not a text file"));
}

TEST_F(Place, ScriptWithoutEnd) {
  writeFile(scratch_.path() / "input.st", program("x := 1;"));
  const ProcessResult result = run({"sim", "input.st", "--for", "T#10ms", "--script", "/dev/zero"});
  EXPECT_NE(result.exitCode, 0);
  EXPECT_THAT(result.err, HasSubstr("longer than 16 MiB"));
}

// ----------------------------------------------------------------------------------------------
// deep and wide

std::string number(int i) { return std::to_string(i); }

// A type for each number: the first ones hold, extend or name the next ones, or the other way
// round.
std::string chain(int count, bool rootFirst, const std::function<std::string(int)> &declaration) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += declaration(rootFirst ? count - 1 - i : i);
  return text;
}

class Deep : public Input {
protected:
  void expectChain(const std::string &start, const std::function<std::string(int)> &next, int most,
                   const std::string &rest) {
    for (const bool rootFirst : {false, true}) {
      for (const int count : {most, most + 1, 20'000}) {
        const std::string source =
            chain(count, rootFirst, [&](int i) { return i == 0 ? start : next(i); }) + rest;
        const ProcessResult result = stride({"check", "input.st", "-W", "off=lints"}, source);
        EXPECT_EQ(result.exitCode, count == most ? 0 : 1) << count << rootFirst << result.err;
        if (count != most) {
          EXPECT_THAT(result.err + result.out, HasSubstr("error[SE0114]")) << count << rootFirst;
        }
      }
    }
  }
};

TEST_F(Deep, StructuresInStructures) {
  expectChain(
      "TYPE T0 : STRUCT a : INT; END_STRUCT END_TYPE\n",
      [](int i) {
        return "TYPE T" + number(i) + " : STRUCT a : T" + number(i - 1) + "; END_STRUCT END_TYPE\n";
      },
      256, program(";"));
}

TEST_F(Deep, BlocksThatExtendBlocks) {
  expectChain(
      "FUNCTION_BLOCK B0 END_FUNCTION_BLOCK\n",
      [](int i) {
        return "FUNCTION_BLOCK B" + number(i) + " EXTENDS B" + number(i - 1) +
               " END_FUNCTION_BLOCK\n";
      },
      257, program(";"));
}

TEST_F(Deep, InterfacesThatExtendInterfaces) {
  expectChain(
      "INTERFACE I0 END_INTERFACE\n",
      [](int i) {
        return "INTERFACE I" + number(i) + " EXTENDS I" + number(i - 1) + " END_INTERFACE\n";
      },
      257, program(";"));
}

TEST_F(Deep, LongChainsOfOtherThings) {
  const auto survives = [&](const std::string &source) {
    const ProcessResult result = stride({"check", "input.st", "-W", "off=lints"}, source);
    EXPECT_LE(result.exitCode, 1) << result.err.substr(0, 1000);
  };
  for (const bool rootFirst : {false, true}) {
    survives(chain(20'000, rootFirst,
                   [](int i) {
                     return "VAR_GLOBAL CONSTANT c" + number(i) +
                            " : INT := " + (i == 0 ? std::string("1") : "c" + number(i - 1)) +
                            "; END_VAR\n";
                   }) +
             program("x := c19999;"));
    survives(chain(20'000, rootFirst,
                   [](int i) {
                     return "TYPE A" + number(i) + " : " +
                            (i == 0 ? std::string("INT") : "A" + number(i - 1)) + "; END_TYPE\n";
                   }) +
             program(";"));
    survives(chain(20'000, rootFirst,
                   [](int i) {
                     return "TYPE P" + number(i) + " : STRUCT next : POINTER TO P" +
                            number(i == 0 ? 0 : i - 1) + "; END_STRUCT END_TYPE\n";
                   }) +
             program(";"));
    survives(chain(20'000, rootFirst,
                   [](int i) {
                     return "FUNCTION F" + number(i) + " : INT F" + number(i) +
                            " := " + (i == 0 ? std::string("1") : "F" + number(i - 1) + "()") +
                            "; END_FUNCTION\n";
                   }) +
             program("F19999();"));
  }
}

// What is reached on 2^n ways is looked at once.
TEST_F(Deep, DiamondsAreLinear) {
  std::string source = "INTERFACE L0 METHOD m : INT END_METHOD END_INTERFACE\n"
                       "INTERFACE R0 METHOD m : INT END_METHOD END_INTERFACE\n";
  for (int i = 1; i < 60; ++i)
    for (const char *side : {"L", "R"})
      source += std::string("INTERFACE ") + side + number(i) + " EXTENDS L" + number(i - 1) +
                ", R" + number(i - 1) + " END_INTERFACE\n";
  source += "FUNCTION_BLOCK B IMPLEMENTS L59, R59\nVAR_IN_OUT io : INT; END_VAR\n"
            "METHOD m : INT m := 7; END_METHOD END_FUNCTION_BLOCK\n";
  // 28 levels of two: 2 GiB would be 31.
  source += "TYPE S0 : STRUCT a, b : BYTE := 1; END_STRUCT END_TYPE\n";
  for (int i = 1; i < 24; ++i)
    source +=
        "TYPE S" + number(i) + " : STRUCT a, b : S" + number(i - 1) + "; END_STRUCT END_TYPE\n";
  source +=
      "FUNCTION_BLOCK B0 VAR_IN_OUT io : INT; END_VAR VAR RETAIN n : BYTE; END_VAR METHOD FB_Exit "
      ": BOOL VAR_INPUT bInCopyCode : BOOL; END_VAR END_METHOD END_FUNCTION_BLOCK\n";
  for (int i = 1; i < 16; ++i)
    source += "FUNCTION_BLOCK B" + number(i) + " VAR a, b : B" + number(i - 1) +
              "; END_VAR END_FUNCTION_BLOCK\n";
  source += "VAR_GLOBAL s : S23; blocks, others : B15; END_VAR\n";
  const std::string body = program("x := x + 1; others := blocks; INI(blocks, TRUE);");
  const ProcessResult result = stride({"build", "input.st", "--emit", "cpp"}, source + body);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  uintmax_t bytes = 0;
  for (const auto &file :
       std::filesystem::recursive_directory_iterator(scratch_.path() / "input-cpp"))
    bytes += file.is_regular_file() ? file.file_size() : 0;
  EXPECT_LT(bytes, 1'000'000U);
}

} // namespace
} // namespace stride::test
