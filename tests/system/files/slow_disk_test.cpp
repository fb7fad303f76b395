// Files of a task of 1 ms, on a good disk and on one that is slow or full.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"
#include "tests/system/files/file_program.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <filesystem>
#include <string>

namespace stride::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Writes a line in every cycle, closes the file after 400 of them and looks what became of it.
constexpr const char *kProgram = R"(PROGRAM PLC_PRG
VAR
  step : INT;
  h : DWORD;
  lines, accepted : DINT;
  line : STRING := '0123456789abcde$N';
  closed : BOOL;
  error, writeError : SYSFILE_ERROR;
END_VAR
CASE step OF
  0:
    h := SysFileOpen('log.txt', 'w');
    IF h <> 0 THEN step := 1; END_IF
  1:
    accepted := accepted + DWORD_TO_DINT(SysFileWrite(h, ADR(line), 16));
    IF SysFileGetError() <> SYSFILE_ERROR.NONE THEN writeError := SysFileGetError(); END_IF
    lines := lines + 1;
    IF lines = 400 THEN step := 2; END_IF
  2:
    closed := SysFileClose(h);
    error := SysFileGetError();
    IF error <> SYSFILE_ERROR.PENDING THEN step := 3; END_IF
END_CASE
END_PROGRAM
)";

/// Writes once, by blocks.
constexpr const char *kBlockProgram = R"(PROGRAM PLC_PRG
VAR
  open : SysFileOpenAsync;
  write : SysFileWriteAsync;
  line : STRING := 'line';
END_VAR
open(bEnable := TRUE, stFileName := 'log.txt', stMode := 'w');
IF open.bDone THEN
  write(bEnable := TRUE, hFile := open.hFile, pBuffer := ADR(line), dwSize := 4);
END_IF
END_PROGRAM
)";

class FilesOfATask : public ::testing::Test {
protected:
  FilesOfATask() {
    std::filesystem::create_directory(project());
    writeFile(project() / "stride.toml", kFileProject);
    writeFile(project() / "Main.st", kProgram);
  }
  std::filesystem::path project() const { return scratch_.path() / "project"; }

  ProcessResult run(int delayMs, int error) {
    return runProcess({STRIDE_BINARY_DIR "/stride", "run", "project", "-W", "off=lints", "--for",
                       "4s", "--print", "PLC_PRG", "--statistics", "statistics.json"},
                      scratch_.path(),
                      {{"LD_PRELOAD", STRIDE_BINARY_DIR "/tests/libslow_disk.so"},
                       {"STRIDE_DISK_MS", std::to_string(delayMs)},
                       {"STRIDE_DISK_ERROR", std::to_string(error)}});
  }
  /// The longest cycle in milliseconds. [ms]
  double longestCycle() const {
    const auto all = nlohmann::json::parse(readFile(scratch_.path() / "statistics.json"));
    return all.at(0).at("runNs").at("max").get<double>() * 1e-6;
  }

  ScratchDirectory scratch_;
};

TEST_F(FilesOfATask, AreWrittenByAGoodDisk) {
  const ProcessResult result = run(0, 0);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.closed = TRUE"));
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.accepted = 6400"));
  EXPECT_EQ(readFile(project() / "files" / "log.txt").size(), 6400U);
}

TEST_F(FilesOfATask, DoNotStretchACycleOnASlowDisk) {
  const ProcessResult result = run(500, 0);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.closed = TRUE"));
  EXPECT_EQ(readFile(project() / "files" / "log.txt").size(), 6400U);
  EXPECT_LT(longestCycle(), 250);
}

TEST_F(FilesOfATask, DoNotStretchACycleByBlocksEither) {
  writeFile(project() / "Main.st", kFileProgram);
  const ProcessResult result = run(300, 0);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.wrong = 0\n"));
  EXPECT_THAT(result.out, Not(HasSubstr("PLC_PRG.rounds = 0\n")));
  EXPECT_LT(longestCycle(), 200);
}

TEST_F(FilesOfATask, SayToBlocksThatTheDiskIsFull) {
  writeFile(project() / "Main.st", kBlockProgram);
  const ProcessResult result = run(200, ENOSPC);
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.write.bDone = FALSE\n"));
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.write.bError = TRUE\n"));
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.write.wErrorId = 7\n"));
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.write.dwWritten = 0\n"));
  EXPECT_LT(longestCycle(), 150);
}

TEST_F(FilesOfATask, SayThatTheDiskIsFull) {
  const ProcessResult result = run(200, ENOSPC);
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.closed = FALSE"));
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.error = NO_SPACE"));
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.writeError = NO_SPACE"));
  EXPECT_THAT(result.err, HasSubstr("file 'log.txt': the disk is full;"));
  EXPECT_LT(longestCycle(), 150);
}

} // namespace
} // namespace stride::test
