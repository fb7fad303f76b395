// Two tasks and the thread at once, under ThreadSanitizer.
#include "tests/support/text.hpp"
#include "tests/unit/system/file_task.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace stride::test {
namespace {

/// Writes a file, closes it, reads it back: in its own cycles, again and again.
void work(system::FileService &files, uint32_t index, int rounds, int &good) {
  FileTask task(files, index);
  const std::string name = "file" + std::to_string(index);
  const auto until = [&](auto ask) {
    for (;;) {
      const FileAnswer answer = ask();
      task.cycle();
      if (answer.done != 0)
        return answer;
      std::this_thread::yield();
    }
  };
  for (int round = 0; round < rounds; ++round) {
    const std::string text = name + " in round " + std::to_string(round);
    const auto out =
        static_cast<uint32_t>(until([&] { return task.open(name.c_str(), kAnew); }).value);
    for (size_t at = 0; at < text.size();)
      at += task.write(out, std::string_view(text).substr(at, 3)).value;
    if (until([&] { return task.close(out); }).error != FileError::None)
      return;
    const auto in =
        static_cast<uint32_t>(until([&] { return task.open(name.c_str(), kReading); }).value);
    good += task.read(in, 1000) == text ? 1 : 0;
    (void)until([&] { return task.close(in); });
  }
}

/// Reads what another task opens and closes.
void readShared(system::FileService &files, const std::atomic<uint32_t> &handle,
                std::atomic<int> &reads, const std::atomic<bool> &end, int &wrong) {
  FileTask task(files, 1);
  while (!end) {
    const std::string got = task.read(handle, 4096);
    if (!got.empty())
      reads.fetch_add(1, std::memory_order_relaxed);
    wrong += got == std::string(got.size(), 'x') ? 0 : 1;
    (void)task.stream(StreamOp::SetPosition, handle, 0);
    task.cycle();
  }
}

TEST(FileStress, AFileIsNotGoneWhileAnotherTaskReadsIt) {
  const ScratchDirectory scratch;
  writeFile(scratch.path() / "shared", std::string(4096, 'x'));
  PlainInputs inputs;
  system::FileSettings settings;
  settings.root = scratch.path().string();
  system::FileService files(settings, 2, inputs);
  std::atomic<uint32_t> handle{0};
  std::atomic<bool> end{false};
  int wrong = 0;
  std::atomic<int> reads{0};
  std::thread reader([&] { readShared(files, handle, reads, end, wrong); });
  FileTask task(files, 0);
  const auto until = [&](auto ask) {
    for (;;) {
      const FileAnswer answer = ask();
      task.cycle();
      files.lookAfter();
      if (answer.done != 0)
        return answer;
      std::this_thread::yield();
    }
  };
  for (int round = 0; round < 300; ++round) {
    const int before = reads.load(std::memory_order_relaxed);
    handle = static_cast<uint32_t>(until([&] { return task.open("shared", kReading); }).value);
    while (reads.load(std::memory_order_relaxed) == before)
      std::this_thread::yield();
    EXPECT_EQ(until([&] { return task.close(handle); }).error, FileError::None);
  }
  end = true;
  reader.join();
  EXPECT_EQ(wrong, 0);
}

TEST(FileStress, TasksDoNotMeet) {
  const ScratchDirectory scratch;
  PlainInputs inputs;
  system::FileSettings settings;
  settings.root = scratch.path().string();
  constexpr int kRounds = 100;
  std::vector<int> good(3);
  {
    system::FileService files(settings, 3, inputs);
    std::vector<std::thread> tasks;
    std::atomic<size_t> finished{0};
    for (uint32_t i = 0; i < good.size(); ++i)
      tasks.emplace_back([&, i] {
        work(files, i, kRounds, good[i]);
        ++finished;
      });
    while (finished < good.size()) {
      files.lookAfter();
      std::this_thread::yield();
    }
    for (std::thread &task : tasks)
      task.join();
  }
  EXPECT_EQ(good, std::vector<int>(3, kRounds));
}

} // namespace
} // namespace stride::test
