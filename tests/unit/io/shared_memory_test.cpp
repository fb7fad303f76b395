#include "drivers/io/shared_memory_io.hpp"
#include "runtime/app/error.hpp"
#include "runtime/io/stride_io.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace stride::io {
namespace {

class SharedMemory : public ::testing::Test {
protected:
  SharedMemory() {
    settings_.name = "D";
    settings_.parameters.add({"segment", segment_, 0});
    settings_.inputBytes = 64;
    settings_.outputBytes = 64;
  }
  ~SharedMemory() override { ::shm_unlink(segment_.c_str()); }

  /// The other side.
  stride_io_header *header() {
    const int file = ::shm_open(segment_.c_str(), O_RDWR, 0);
    void *memory = ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    return static_cast<stride_io_header *>(memory);
  }

  std::string segment_ = "/stride-unit-io-" + std::to_string(::getpid());
  IoSettings settings_;
};

TEST_F(SharedMemory, BothDirections) {
  const std::unique_ptr<IoDriver> io = shared_memory::makeDriver(settings_);
  stride_io_header *other = header();
  EXPECT_EQ(other->magic, STRIDE_IO_MAGIC);
  EXPECT_EQ(other->state, STRIDE_IO_RUNNING);
  const std::array<BYTE, 3> out{1, 2, 3};
  io->write(5, out);
  std::array<BYTE, 3> seen{};
  ASSERT_EQ(stride_io_read_outputs(other, 5, seen.data(), 3), 1);
  EXPECT_EQ(seen, out);
  stride_io_write_inputs(other, 7, out.data(), 3);
  std::array<BYTE, 3> in{};
  ASSERT_TRUE(io->read(7, in));
  EXPECT_EQ(in, out);
  io->stopped();
  EXPECT_EQ(other->state, STRIDE_IO_STOPPED);
}

TEST_F(SharedMemory, HalfWrittenInputsAreNotTaken) {
  const std::unique_ptr<IoDriver> io = shared_memory::makeDriver(settings_);
  stride_io_header *other = header();
  ++other->input_begin; // in the middle of writing, for ever
  std::array<BYTE, 3> in{};
  EXPECT_FALSE(io->read(0, in));
}

TEST_F(SharedMemory, Timeout) {
  settings_.parameters.add({"timeout", "", 1e-6});
  const std::unique_ptr<IoDriver> io = shared_memory::makeDriver(settings_);
  stride_io_header *other = header();
  EXPECT_TRUE(io->works(500));
  EXPECT_FALSE(io->works(1500));
  const BYTE byte = 1;
  stride_io_write_inputs(other, 0, &byte, 1);
  EXPECT_TRUE(io->works(2000));
  EXPECT_TRUE(io->works(3000));
  EXPECT_FALSE(io->works(3001));
}

TEST_F(SharedMemory, NeverTorn) {
  const std::unique_ptr<IoDriver> io = shared_memory::makeDriver(settings_);
  stride_io_header *other = header();
  std::atomic<bool> stop{false};
  std::thread plant([&] {
    std::array<BYTE, 64> values{};
    std::array<BYTE, 64> seen{};
    for (BYTE n = 0; !stop; ++n) {
      values.fill(n);
      stride_io_write_inputs(other, 0, values.data(), 64);
      if (stride_io_read_outputs(other, 0, seen.data(), 64) != 0) {
        for (const BYTE byte : seen)
          EXPECT_EQ(byte, seen[0]);
      }
    }
  });
  std::array<BYTE, 64> in{};
  int taken = 0;
  for (int i = 0; i < 100000; ++i) {
    std::array<BYTE, 64> out{};
    out.fill(static_cast<BYTE>(i));
    io->write(0, out);
    if (!io->read(0, in))
      continue;
    ++taken;
    for (const BYTE byte : in)
      ASSERT_EQ(byte, in[0]);
  }
  stop = true;
  plant.join();
  EXPECT_GT(taken, 0);
}

TEST_F(SharedMemory, WhatIsWrongIsSaid) {
  settings_.parameters = {};
  settings_.parameters.add({"segment", "no/such", 0}); // becomes "/no/such"
  try {
    shared_memory::makeDriver(settings_);
    FAIL();
  } catch (const app::Error &error) {
    EXPECT_NE(std::string(error.what()).find("I/O device 'D': the shared memory '/no/such'"),
              std::string::npos);
  }
}

} // namespace
} // namespace stride::io
