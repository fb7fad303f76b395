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
    for (std::size_t at = 0; at < text.size();)
      at += task.write(out, std::string_view(text).substr(at, 3)).value;
    if (until([&] { return task.close(out); }).error != FileError::None)
      return;
    const auto in =
        static_cast<uint32_t>(until([&] { return task.open(name.c_str(), kReading); }).value);
    good += task.read(in, 1000) == text ? 1 : 0;
    (void)until([&] { return task.close(in); });
  }
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
    std::atomic<std::size_t> finished{0};
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
