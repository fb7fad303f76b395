// Random sequences of operations on a few files, by the blocks and by the functions, against a
// model of the disk in memory: every answer, and at the end the content of every file.
#include "tests/property/file_model.hpp"
#include "tests/support/text.hpp"
#include "tests/unit/system/file_task.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace stride;
using stride::test::FileModel;
using stride::test::FileTask;

constexpr std::array<const char *, 2> kNames = {"a", "b.txt"};
constexpr std::array<uint32_t, 6> kModes = {kFileRead,
                                            kFileWrite | kFileCreate | kFileTruncate,
                                            kFileWrite | kFileCreate | kFileAppend,
                                            kFileRead | kFileWrite,
                                            kFileRead | kFileWrite | kFileCreate | kFileTruncate,
                                            kFileRead | kFileWrite | kFileCreate | kFileAppend};

/// One operation; which of the numbers count depends on it.
struct Step {
  /// Up to FileOp::CloseStream, then the ones of a stream.
  int what = 1;
  size_t name = 0;
  size_t second = 0;
  size_t mode = 0;
  size_t handle = 0; ///< How many ago it was given; none, if there were not so many.
  uint64_t number = 0;
};

constexpr int kStreamOps = static_cast<int>(FileOp::CloseStream) + 1;

void showValue(const Step &step, std::ostream &out) {
  out << "{op " << step.what << ", " << step.name << ", " << step.second << ", mode " << step.mode
      << ", handle " << step.handle << ", " << step.number << "}\n";
}

constexpr int number(FileOp op) { return static_cast<int>(op); }
constexpr int number(StreamOp op) { return kStreamOps + static_cast<int>(op); }

std::vector<Step> sequence() {
  const rc::Gen<Step> step = rc::gen::build<Step>(
      rc::gen::set(&Step::what,
                   rc::gen::weightedElement<int>({
                       {3, number(FileOp::Open)},          {1, number(FileOp::Close)},
                       {3, number(FileOp::Read)},          {4, number(FileOp::Write)},
                       {2, number(FileOp::SetPosition)},   {2, number(FileOp::GetPosition)},
                       {2, number(FileOp::AtEnd)},         {1, number(FileOp::Size)},
                       {1, number(FileOp::Times)},         {1, number(FileOp::Delete)},
                       {1, number(FileOp::Rename)},        {1, number(FileOp::Copy)},
                       {4, number(FileOp::OpenStream)},    {2, number(FileOp::CloseStream)},
                       {3, number(StreamOp::Read)},        {4, number(StreamOp::Write)},
                       {2, number(StreamOp::SetPosition)}, {2, number(StreamOp::GetPosition)},
                       {2, number(StreamOp::AtEnd)},
                   })),
      rc::gen::set(&Step::name, rc::gen::inRange<size_t>(0, kNames.size())),
      rc::gen::set(&Step::second, rc::gen::inRange<size_t>(0, kNames.size())),
      rc::gen::set(&Step::mode, rc::gen::inRange<size_t>(0, kModes.size())),
      rc::gen::set(&Step::handle, rc::gen::inRange<size_t>(0, 4)),
      rc::gen::set(&Step::number, rc::gen::inRange<uint64_t>(0, 70)));
  return *rc::gen::resize(200, rc::gen::container<std::vector<Step>>(step));
}

/// The service and the model do the same.
class Pair {
public:
  Pair(bool virtualTime, uint32_t delay)
      : files_(settings(virtualTime, delay), 1, inputs_), task_(files_, 0) {}

  void run(const std::vector<Step> &steps) {
    for (const Step &step : steps)
      runStep(step);
    files_.finish();
    for (const char *name : kNames) {
      const std::string *const expected = model_.content(name);
      const std::filesystem::path path = scratch_.path() / name;
      RC_ASSERT(std::filesystem::exists(path) == (expected != nullptr));
      if (expected != nullptr)
        RC_ASSERT(test::readFile(path) == *expected);
    }
  }

private:
  system::FileSettings settings(bool virtualTime, uint32_t delay) const {
    system::FileSettings settings;
    settings.root = scratch_.path().string();
    settings.virtualTime = virtualTime;
    settings.delayCycles = delay;
    return settings;
  }

  void runStep(const Step &step) {
    if (step.what >= kStreamOps) {
      useStream(step, static_cast<StreamOp>(step.what - kStreamOps));
      return;
    }
    FileRequest request{};
    request.op = static_cast<FileOp>(step.what);
    request.name = kNames[step.name];
    request.second = kNames[step.second];
    request.mode = kModes[step.mode];
    request.position = step.number;
    request.size = step.number;
    const bool stream = request.op == FileOp::OpenStream || request.op == FileOp::CloseStream;
    if (request.op == FileOp::OpenStream && step.mode >= 3)
      request.mode = kModes[step.mode - 3]; // without '+'
    const std::vector<uint32_t> &handles = stream ? streams_ : blocks_;
    const size_t which = whichOf(handles, step);
    request.file = which < handles.size() ? handles[which] : 0xABCD;
    const std::string text = textOf(step.number);
    request.data = text.data();

    std::string data(request.op == FileOp::Read ? step.number : 0, '?');
    const FileAnswer answer = stream ? ask(request) : startAndPoll(request, data);
    const FileModel::Answer expected = model_.run(request, which);
    RC_ASSERT(answer.error == expected.error);
    if (request.op == FileOp::Open || request.op == FileOp::OpenStream) {
      if (answer.error == FileError::None)
        (stream ? streams_ : blocks_).push_back(static_cast<uint32_t>(answer.value));
    } else if (request.op != FileOp::Times) { // which are the machine's
      RC_ASSERT(answer.value == expected.value);
      RC_ASSERT(data.substr(0, answer.value) == expected.data);
    }
  }

  void useStream(const Step &step, StreamOp op) {
    const size_t which = whichOf(streams_, step);
    const uint32_t file = which < streams_.size() ? streams_[which] : 0xABCD;
    if (op == StreamOp::Write && which != lastWriter_) { // only each one's writes keep their order
      waitForDisk();
      lastWriter_ = which;
    }
    std::string data = op == StreamOp::Write ? textOf(step.number) : std::string(step.number, '?');
    FileAnswer answer{};
    uint64_t written = 0;
    do { // by the real clock there may be no room
      files_.stream(task_.ctx(), op, file, data.data() + written, step.number - written, answer);
      written += answer.value;
      cycle();
    } while (answer.error == FileError::Pending);
    if (op == StreamOp::Write)
      answer.value = written;
    const FileModel::Answer expected = model_.useStream(op, which, data, step.number);
    RC_ASSERT(answer.error == expected.error);
    RC_ASSERT(answer.value == expected.value);
    if (op == StreamOp::Read)
      RC_ASSERT(data.substr(0, answer.value) == expected.data);
  }

  static size_t whichOf(const std::vector<uint32_t> &handles, const Step &step) {
    return step.handle < handles.size() ? handles.size() - 1 - step.handle : handles.size();
  }

  void waitForDisk() {
    FileRequest request{};
    request.op = FileOp::Size;
    request.name = kNames[0];
    (void)ask(request);
  }

  FileAnswer ask(const FileRequest &request) {
    for (;;) {
      FileAnswer answer{};
      files_.ask(task_.ctx(), request, answer);
      if (answer.done != 0)
        return answer;
      cycle();
    }
  }

  FileAnswer startAndPoll(const FileRequest &request, std::string &data) {
    const uint32_t number = task_.start(request);
    RC_ASSERT(number != 0U);
    for (;;) {
      const FileAnswer answer = task_.poll(number, &data);
      if (answer.done != 0)
        return answer;
      cycle();
    }
  }

  void cycle() {
    task_.cycle();
    files_.lookAfter();
    std::this_thread::yield();
  }

  std::string textOf(uint64_t size) {
    std::string text(size, ' ');
    for (char &c : text)
      c = static_cast<char>('A' + letter_++ % 58);
    return text;
  }

  test::ScratchDirectory scratch_;
  test::PlainInputs inputs_;
  system::FileService files_;
  FileTask task_;
  FileModel model_{32, 16};
  std::vector<uint32_t> blocks_; ///< Handles in the order in which they were given.
  std::vector<uint32_t> streams_;
  size_t lastWriter_ = 0;
  int letter_ = 0;
};

RC_GTEST_PROP(FilesProperty, AnswersAreThoseOfAModelInVirtualTime, ()) {
  const uint32_t delay = *rc::gen::inRange<uint32_t>(0, 4);
  Pair(true, delay).run(sequence());
}

RC_GTEST_PROP(FilesProperty, AnswersAreThoseOfAModelByTheRealClock, ()) {
  Pair(false, 1).run(sequence());
}

} // namespace
