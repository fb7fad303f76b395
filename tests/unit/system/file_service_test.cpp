// The file service with a good, a slow and a broken disk.
#include "tests/support/text.hpp"
#include "tests/unit/system/faulty_disk.hpp"
#include "tests/unit/system/file_task.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <thread>

namespace stride::test {
namespace {

using namespace std::chrono_literals;
using system::FileService;
using system::FileSettings;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Clock = std::chrono::steady_clock;

class Files : public ::testing::Test {
protected:
  FileSettings settings(bool virtualTime) {
    FileSettings settings;
    settings.root = (scratch_.path() / "files").string();
    settings.virtualTime = virtualTime;
    return settings;
  }
  ~Files() override {
    faultyDisk().delayMs = 0;
    faultyDisk().error = 0;
  }
  /// Asks in cycle after cycle until it is done.
  template <class Ask> static FileAnswer until(FileTask &task, Ask ask) {
    for (int i = 0; i < 5000; ++i) {
      const FileAnswer answer = ask();
      if (answer.done != 0)
        return answer;
      task.cycle();
      task.files().lookAfter();
      std::this_thread::sleep_for(1ms);
    }
    return {};
  }
  std::string content(const char *name) { return readFile(scratch_.path() / "files" / name); }

  ScratchDirectory scratch_;
  PlainInputs inputs_;
};

TEST_F(Files, AnswersInVirtualTimeComeAfterTheDelay) {
  FileSettings with = settings(true);
  with.delayCycles = 3;
  FileService files(with, 1, inputs_);
  FileTask task(files, 0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(task.open("a", kAnew).error, FileError::Pending) << i;
    task.cycle();
  }
  const FileAnswer opened = task.open("a", kAnew);
  EXPECT_EQ(opened.done, 1);
  EXPECT_EQ(opened.error, FileError::None);
}

TEST_F(Files, WritesAndReadsThroughMemory) {
  FileService files(settings(false), 1, inputs_);
  FileTask task(files, 0);
  const FileAnswer file = until(task, [&] { return task.open("a.txt", kAnew); });
  ASSERT_EQ(file.error, FileError::None);
  const auto handle = static_cast<uint32_t>(file.value);
  EXPECT_EQ(task.write(handle, "hello").value, 5U);
  EXPECT_EQ(task.stream(StreamOp::SetPosition, handle, 1).value, 1U);
  EXPECT_EQ(task.write(handle, "a").value, 1U);
  EXPECT_EQ(until(task, [&] { return task.close(handle); }).error, FileError::None);
  EXPECT_EQ(content("a.txt"), "hallo");
  EXPECT_EQ(task.close(handle).error, FileError::BadHandle);

  const FileAnswer again = until(task, [&] { return task.open("a.txt", kReading); });
  ASSERT_EQ(again.error, FileError::None);
  const auto reader = static_cast<uint32_t>(again.value);
  EXPECT_EQ(task.read(reader, 2), "ha");
  EXPECT_EQ(task.stream(StreamOp::AtEnd, reader).value, 0U);
  EXPECT_EQ(task.read(reader, 100), "llo");
  EXPECT_EQ(task.stream(StreamOp::AtEnd, reader).value, 1U);
  EXPECT_EQ(task.stream(StreamOp::SetPosition, reader, 6).error, FileError::NotPossible);
  EXPECT_EQ(task.write(reader, "x").error, FileError::NotPossible);
}

TEST_F(Files, WhatWasAcceptedIsWrittenAtTheEnd) {
  {
    FileService files(settings(false), 1, inputs_);
    FileTask task(files, 0);
    const FileAnswer file = until(task, [&] { return task.open("log", kAtEnd); });
    ASSERT_EQ(file.error, FileError::None);
    for (int i = 0; i < 100; ++i)
      ASSERT_EQ(task.write(static_cast<uint32_t>(file.value), "0123456789").value, 10U);
  }
  EXPECT_EQ(content("log").size(), 1000U);
}

TEST_F(Files, WhatWasAskedIsDoneAtTheEndIfThereWasNoTimeBefore) {
  {
    FileService files(settings(false), 1, inputs_);
    FileTask task(files, 0);
    EXPECT_EQ(task.open("log", kAnew).error, FileError::Pending);
  }
  EXPECT_EQ(content("log"), "");
}

TEST_F(Files, AreOverAfterTheEnd) {
  FileService files(settings(false), 1, inputs_);
  FileTask task(files, 0);
  EXPECT_EQ(task.open("log", kAnew).error, FileError::Pending);
  files.finish();
  files.lookAfter();
  EXPECT_EQ(task.open("other", kAnew).error, FileError::Pending);
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "files" / "other"));
}

TEST_F(Files, ASlowDiskIsNotWaitedFor) {
  FileService files(settings(false), 1, inputs_);
  FileTask task(files, 0);
  const FileAnswer file = until(task, [&] { return task.open("log", kAnew); });
  const auto handle = static_cast<uint32_t>(file.value);
  faultyDisk().delayMs = 300;
  const std::string part(4096, 'x');
  const Clock::time_point start = Clock::now();
  uint64_t accepted = 0;
  for (int i = 0; i < 40; ++i) {
    const FileAnswer answer = task.write(handle, part);
    accepted += answer.value;
    if (answer.value < part.size()) {
      EXPECT_EQ(answer.error, FileError::Pending);
    }
  }
  const FileAnswer closing = task.close(handle);
  EXPECT_LT(Clock::now() - start, 250ms);
  EXPECT_EQ(closing.error, FileError::Pending);
  EXPECT_GE(accepted, 60000U);
  EXPECT_LT(accepted, 40U * 4096);
  EXPECT_EQ(until(task, [&] { return task.close(handle); }).error, FileError::None);
  EXPECT_EQ(content("log").size(), accepted);
  EXPECT_THAT(files.takeNews(), IsEmpty());
}

TEST_F(Files, AFullDiskIsToldToTheProgramAndToTheOperator) {
  FileService files(settings(false), 1, inputs_);
  FileTask task(files, 0);
  const FileAnswer file = until(task, [&] { return task.open("log", kAnew); });
  const auto handle = static_cast<uint32_t>(file.value);
  faultyDisk().error = ENOSPC;
  EXPECT_EQ(task.write(handle, "0123456789").value, 10U);
  FileAnswer next{};
  for (int i = 0; i < 5000 && next.error == FileError::None; ++i) {
    std::this_thread::sleep_for(1ms);
    next = task.write(handle, {});
  }
  EXPECT_EQ(next.error, FileError::NoSpace);
  EXPECT_EQ(task.write(handle, "more").value, 0U);
  EXPECT_EQ(until(task, [&] { return task.close(handle); }).error, FileError::NoSpace);
  EXPECT_THAT(files.takeNews(), ElementsAre(HasSubstr("10 bytes")));
}

TEST_F(Files, ForgottenAnswersMakeRoom) {
  FileSettings with = settings(true);
  FileService files(with, 1, inputs_);
  FileTask task(files, 0);
  for (int i = 0; i < 32; ++i)
    (void)task.ask(FileOp::Size, std::to_string(i).c_str());
  for (int i = 0; i < 102; ++i)
    task.cycle();
  EXPECT_EQ(task.ask(FileOp::Size, "x").done, 0); // finds no place, makes one
  EXPECT_EQ(task.ask(FileOp::Size, "x").done, 0);
  task.cycle();
  EXPECT_EQ(task.ask(FileOp::Size, "x").error, FileError::NotFound);
}

TEST_F(Files, NamesDoNotLeadOut) {
  FileSettings with = settings(true);
  with.delayCycles = 0;
  FileService files(with, 1, inputs_);
  FileTask task(files, 0);
  for (const char *name : {"../x", "/x", "a/../../x", "C:\\x", "a\\..\\..\\x", ".."})
    EXPECT_EQ(task.open(name, kAnew).error, FileError::Outside) << name;
  for (const char *name : {"", "a/"})
    EXPECT_EQ(task.open(name, kAnew).error, FileError::BadName) << name;
  EXPECT_EQ(task.open("no/such", kReading).error, FileError::NotFound);
}

} // namespace
} // namespace stride::test
