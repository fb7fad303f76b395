// I/O devices with a second process: the plant is this test.
#include "runtime/io/stride_io.h"
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// The other side of the segment; null as long as the program has not made it.
stride_io_header *open(const std::string &segment) {
  const int file = ::shm_open(segment.c_str(), O_RDWR, 0);
  if (file < 0)
    return nullptr;
  void *memory = ::lseek(file, 0, SEEK_END) > 0
                     ? ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0)
                     : MAP_FAILED;
  ::close(file);
  if (memory == MAP_FAILED)
    return nullptr;
  auto *io = static_cast<stride_io_header *>(memory);
  if (__atomic_load_n(&io->magic, __ATOMIC_SEQ_CST) == STRIDE_IO_MAGIC)
    return io;
  ::munmap(memory, 4096);
  return nullptr;
}

class SharedIo : public ::testing::Test {
protected:
  SharedIo() : segment_("/stride-io-test-" + std::to_string(::getpid())) {}
  ~SharedIo() override { ::shm_unlink(segment_.c_str()); }

  ProcessResult stride(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    return runProcess(arguments, scratch_.path(),
                      {{"XDG_CACHE_HOME", (scratch_.path() / "cache").string()}});
  }

  std::string segment_;
  ScratchDirectory scratch_;
};

// The program counts on when the plant has answered its number with its complement; both are eight
// bytes, so that halves of two numbers would be seen.
TEST_F(SharedIo, PlantAnswers) {
  writeFile(scratch_.path() / "stride.toml", "[[task]]\nname = \"Task\"\ninterval = \"T#1ms\"\n"
                                             "programs = [\"Main\"]\n"
                                             "[[io]]\nname = \"Plant\"\ndevice = \"SharedMemory\"\n"
                                             "inputs = 16\noutputs = 16\nsegment = \"" +
                                                 segment_ +
                                                 "\"\ntimeout = \"T#10s\"\n"
                                                 "  [[io.channel]]\n  name = \"Stop\"\n"
                                                 "  address = \"%QB15\"\n  safe_value = 170\n");
  writeFile(scratch_.path() / "Main.st", R"(
PROGRAM Main
  VAR
    asked AT %QL0 : LWORD;
    again AT %QL1 : LWORD;
    answer AT %IL0 : LWORD;
    torn AT %IL1 : LWORD;
    rounds : UDINT;
    wrong : UDINT;
    divisor : INT := 1;
  END_VAR
  IF (answer XOR torn) <> 0 THEN
    wrong := wrong + 1;
  END_IF
  IF answer = NOT asked THEN
    rounds := rounds + 1;
    asked := asked + 16#0101_0101_0101_0101;
    again := asked AND 16#00FF_FFFF_FFFF_FFFF;
  END_IF
  IF rounds >= 50 THEN
    divisor := 0; // a fault: outputs get their safe values
  END_IF
  rounds := rounds / INT_TO_UDINT(divisor);
END_PROGRAM
)");
  ASSERT_EQ(stride({"build"}).exitCode, 0);
  std::atomic<bool> done{false};
  std::atomic<unsigned> state{0};
  std::atomic<unsigned> safe{0};
  std::thread plant([&] {
    stride_io_header *io = nullptr;
    while (!done) {
      if (io == nullptr)
        io = open(segment_);
      uint64_t asked[2] = {};
      if (io != nullptr && stride_io_read_outputs(io, 0, asked, 16) != 0) {
        const uint64_t answer[2] = {~asked[0], ~asked[0]};
        stride_io_write_inputs(io, 0, answer, 16);
      }
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    if (io == nullptr)
      return;
    state = __atomic_load_n(&io->state, __ATOMIC_SEQ_CST);
    unsigned char byte = 0;
    if (stride_io_read_outputs(io, 15, &byte, 1) != 0)
      safe = byte;
  });
  const ProcessResult result =
      stride({"run", "--for", "T#20s", "--print", "Main", "--record", "io.rec"});
  done = true;
  plant.join();
  EXPECT_EQ(result.exitCode, 2) << result.err; // the division
  EXPECT_THAT(result.out, HasSubstr("Main.rounds = 50\n"));
  EXPECT_THAT(result.out, HasSubstr("Main.wrong = 0\n"));
  EXPECT_EQ(state, STRIDE_IO_STOPPED);
  EXPECT_EQ(safe, 170U);

  // Without the plant: the answers come from the recording.
  ::shm_unlink(segment_.c_str());
  const ProcessResult replay = stride({"sim", "--replay", "io.rec", "--print", "Main"});
  EXPECT_EQ(replay.exitCode, 2) << replay.err;
  EXPECT_EQ(replay.out, result.out);
  EXPECT_EQ(::shm_open(segment_.c_str(), O_RDWR, 0), -1) << "a replay opens no device";
}

TEST_F(SharedIo, NobodyAnswers) {
  writeFile(scratch_.path() / "stride.toml",
            "[[io]]\nname = \"Plant\"\ndevice = \"SharedMemory\"\ninputs = 1\nsegment = \"" +
                segment_ + "\"\ntimeout = \"T#50ms\"\n");
  writeFile(scratch_.path() / "Main.st",
            "PROGRAM Main VAR key AT %IB0 : BYTE; seen : BYTE; END_VAR seen := key; END_PROGRAM");
  const ProcessResult result = stride({"sim", "--for", "T#200ms", "--print", "Plant"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("Plant.bLost = TRUE\n"));
  const std::string once =
      "warning: I/O device 'Plant' is lost: its outputs have their safe values\n";
  EXPECT_EQ(result.err, once);
  const ProcessResult run = stride({"run", "--for", "T#300ms", "--quiet", "--print", "Plant"});
  EXPECT_THAT(run.out, HasSubstr("Plant.bLost = TRUE\n"));
  EXPECT_EQ(run.err, once);
}

} // namespace
} // namespace stride::test
