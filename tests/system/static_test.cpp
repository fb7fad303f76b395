// stride build --static: one executable that needs nothing else.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"
#include "tests/system/files/file_program.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <elf.h>

#include <cstring>
#include <filesystem>
#include <string>

namespace {

using stride::test::ProcessResult;
using stride::test::readFile;
using stride::test::runProcess;
using stride::test::ScratchDirectory;
using ::testing::HasSubstr;

constexpr const char *kProject = STRIDE_SOURCE_DIR "/examples/PLCopenSingle";
const std::vector<std::string> kSim = {"--for",   "T#3s",
                                       "--set",   "T#1500ms,Ipo.p=50",
                                       "--trace", "Drive.fSetPosition,Drive.fSetVelocity",
                                       "--out",   "trace.csv"};

/// The project apart, so that its folder stays as it is.
std::filesystem::path copyOfProject(const ScratchDirectory &scratch) {
  std::filesystem::path copy = scratch.path() / "PLCopenSingle";
  std::filesystem::copy(kProject, copy, std::filesystem::copy_options::recursive);
  return copy;
}

std::string traceOf(std::vector<std::string> command, const ScratchDirectory &scratch) {
  command.insert(command.end(), kSim.begin(), kSim.end());
  const ProcessResult result = runProcess(command, scratch.path());
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return readFile(scratch.path() / "trace.csv");
}

bool isStatic(const std::filesystem::path &program, Elf64_Half machine) {
  const std::string bytes = readFile(program);
  Elf64_Ehdr header;
  std::memcpy(&header, bytes.data(), sizeof header);
  EXPECT_EQ(header.e_machine, machine);
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment;
    std::memcpy(&segment, bytes.data() + header.e_phoff + i * header.e_phentsize, sizeof segment);
    if (segment.p_type == PT_INTERP || segment.p_type == PT_DYNAMIC)
      return false;
  }
  return true;
}

TEST(Static, RunsLikeTheHost) {
  const ScratchDirectory scratch;
  const std::filesystem::path project = copyOfProject(scratch);
  const ProcessResult built = runProcess(
      {STRIDE_BINARY_DIR "/stride", "build", "PLCopenSingle", "--static"}, scratch.path());
  ASSERT_EQ(built.exitCode, 0) << built.err;
  const std::filesystem::path program = project / "build" / "app";
  EXPECT_TRUE(isStatic(program, EM_X86_64));
  const std::string expected =
      traceOf({STRIDE_BINARY_DIR "/stride", "sim", "PLCopenSingle"}, scratch);
  EXPECT_TRUE(traceOf({program.string(), "sim"}, scratch) == expected);
  EXPECT_THAT(expected, HasSubstr("\n2.013,100,0\n")); // there
  const ProcessResult run = runProcess({program.string(), "run", "--for", "50ms"}, scratch.path());
  EXPECT_EQ(run.exitCode, 0) << run.err;
}

TEST(Static, WorksWithFilesInTheCurrentFolder) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch.path() / "p");
  stride::test::writeFile(scratch.path() / "p" / "stride.toml", stride::test::kFileProject);
  stride::test::writeFile(scratch.path() / "p" / "Main.st", stride::test::kFileProgram);
  const ProcessResult result =
      runProcess({"sh", "-c",
                  STRIDE_BINARY_DIR "/stride build p --static -o app -W off=lints && "
                                    "./app sim --for 1s --print PLC_PRG.rounds,PLC_PRG.wrong && "
                                    "./app run --for 1s --quiet --print PLC_PRG.wrong && ls files"},
                 scratch.path());
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.wrong = 0\nPLC_PRG.wrong = 0\nf0\nf1\nf2\n"));
  EXPECT_THAT(result.out, ::testing::Not(HasSubstr("PLC_PRG.rounds = 0\n")));
}

#ifdef STRIDE_AARCH64
TEST(Static, ForAnotherProcessorGivesTheSameTrace) {
  const ScratchDirectory scratch;
  const std::filesystem::path project = copyOfProject(scratch);
  const ProcessResult built = runProcess({STRIDE_BINARY_DIR "/stride", "build", "PLCopenSingle",
                                          "--static", "--target", "aarch64-linux-gnu", "-o", "arm"},
                                         scratch.path());
  ASSERT_EQ(built.exitCode, 0) << built.err;
  EXPECT_TRUE(isStatic(scratch.path() / "arm", EM_AARCH64));
  const std::string expected =
      traceOf({STRIDE_BINARY_DIR "/stride", "sim", "PLCopenSingle"}, scratch);
  EXPECT_TRUE(traceOf({"qemu-aarch64", "./arm", "sim"}, scratch) == expected);
}
#endif

} // namespace
