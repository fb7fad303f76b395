#include "drivers/io/shared_memory_io.hpp"

#include "runtime/app/error.hpp"
#include "runtime/io/stride_io.h"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stride::io::shared_memory {

namespace {

constexpr uint32_t roundUp(uint32_t bytes) { return (bytes + 63U) / 64U * 64U; }

/// The name of a segment begins with a slash.
std::string segmentOf(const IoSettings &settings) {
  const std::string segment = settings.parameters.text("segment");
  return segment.starts_with('/') ? segment : "/" + segment;
}

[[noreturn]] void fail(const IoSettings &settings, const char *what) {
  throw app::Error(fmt::format(
      "I/O device '{}': the shared memory '{}' {}: {}; see what is in /dev/shm and who may use it",
      settings.name, segmentOf(settings), what, std::strerror(errno)));
}

class SharedMemoryIo final : public IoDriver {
public:
  explicit SharedMemoryIo(const IoSettings &settings)
      : timeoutNs_(std::llround(settings.parameters.number("timeout") * 1e9)) {
    const uint32_t inputs = roundUp(sizeof(stride_io_header));
    const uint32_t outputs = inputs + roundUp(settings.inputBytes);
    size_ = outputs + roundUp(settings.outputBytes);
    const int file = ::shm_open(segmentOf(settings).c_str(), O_RDWR | O_CREAT, 0660);
    if (file < 0)
      fail(settings, "cannot be opened");
    if (::ftruncate(file, static_cast<off_t>(size_)) != 0) {
      ::close(file);
      fail(settings, "cannot be given its size");
    }
    void *memory = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (memory == MAP_FAILED)
      fail(settings, "cannot be mapped");
    io_ = static_cast<stride_io_header *>(memory);
    // The counters go on where an earlier run has left them; one of them may have been killed
    // between both.
    io_->version = STRIDE_IO_VERSION;
    io_->input_bytes = settings.inputBytes;
    io_->output_bytes = settings.outputBytes;
    io_->input_offset = inputs;
    io_->output_offset = outputs;
    __atomic_store_n(&io_->output_end, __atomic_load_n(&io_->output_begin, __ATOMIC_SEQ_CST),
                     __ATOMIC_SEQ_CST);
    __atomic_store_n(&io_->state, STRIDE_IO_RUNNING, __ATOMIC_SEQ_CST);
    __atomic_store_n(&io_->magic, STRIDE_IO_MAGIC, __ATOMIC_SEQ_CST);
    seen_.store(__atomic_load_n(&io_->input_end, __ATOMIC_SEQ_CST), std::memory_order_relaxed);
    start_ = base() + inputs;
    outputs_ = base() + outputs;
  }
  ~SharedMemoryIo() override {
    stopped();
    ::munmap(io_, size_);
  }

  bool works(int64_t nowNs) noexcept override {
    if (timeoutNs_ == 0)
      return true;
    const uint64_t end = __atomic_load_n(&io_->input_end, __ATOMIC_ACQUIRE);
    if (seen_.exchange(end, std::memory_order_relaxed) != end)
      aliveNs_.store(nowNs, std::memory_order_relaxed);
    return nowNs - aliveNs_.load(std::memory_order_relaxed) <= timeoutNs_;
  }

  bool read(uint32_t first, std::span<BYTE> to) noexcept override {
    constexpr int kTries = 8; // the other side may be slower than a cycle
    for (int i = 0; i < kTries; ++i) {
      const uint64_t end = __atomic_load_n(&io_->input_end, __ATOMIC_SEQ_CST);
      std::memcpy(to.data(), start_ + first, to.size());
      std::atomic_thread_fence(std::memory_order_seq_cst);
      if (__atomic_load_n(&io_->input_begin, __ATOMIC_SEQ_CST) == end)
        return true;
    }
    return false;
  }

  void write(uint32_t first, std::span<const BYTE> from) noexcept override {
    __atomic_fetch_add(&io_->output_begin, 1U, __ATOMIC_SEQ_CST);
    std::atomic_thread_fence(std::memory_order_seq_cst);
    std::memcpy(outputs_ + first, from.data(), from.size());
    __atomic_fetch_add(&io_->output_end, 1U, __ATOMIC_SEQ_CST);
  }

  void stopped() noexcept override {
    __atomic_store_n(&io_->state, STRIDE_IO_STOPPED, __ATOMIC_SEQ_CST);
  }

private:
  BYTE *base() { return reinterpret_cast<BYTE *>(io_); }

  int64_t timeoutNs_;
  size_t size_ = 0;
  stride_io_header *io_ = nullptr;
  BYTE *start_ = nullptr;
  BYTE *outputs_ = nullptr;
  std::atomic<uint64_t> seen_{0};
  std::atomic<int64_t> aliveNs_{0};
};

} // namespace

std::unique_ptr<IoDriver> makeDriver(const IoSettings &settings) {
  return std::make_unique<SharedMemoryIo>(settings);
}

} // namespace stride::io::shared_memory
