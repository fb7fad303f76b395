#include "runtime/task/low_stack.hpp"

#include "runtime/app/error.hpp"

#include <pthread.h>
#include <sys/mman.h>

#include <bit>
#include <cstdint>
#include <exception>

namespace stride::task {

namespace {

constexpr std::size_t kGuard = 4096;
constexpr uint64_t kStep = uint64_t{1} << 29;
constexpr uint64_t kFirstTop = 2 * kStep;
constexpr uint64_t kFourGiB = uint64_t{1} << 32;

/// Memory for one stack with its guard below.
class Stack {
public:
  Stack() {
    constexpr int kProtection = PROT_READ | PROT_WRITE;
    constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
    for (uint64_t top = kFirstTop; memory_ == nullptr && top <= kFourGiB; top += kStep) {
      void *wanted = std::bit_cast<void *>(top - kMapped);
      void *got = ::mmap(wanted, kMapped, kProtection, kFlags | MAP_FIXED_NOREPLACE, -1, 0);
      if (got == wanted)
        memory_ = got;
      else if (got != MAP_FAILED) // a kernel that does not know MAP_FIXED_NOREPLACE
        ::munmap(got, kMapped);
    }
    if (memory_ == nullptr)
      memory_ = ::mmap(nullptr, kMapped, kProtection, kFlags, -1, 0);
    if (memory_ == MAP_FAILED)
      throw app::Error("the system has no memory for a task's stack");
    ::mprotect(memory_, kGuard, PROT_NONE);
  }
  ~Stack() { ::munmap(memory_, kMapped); }
  Stack(const Stack &) = delete;
  Stack &operator=(const Stack &) = delete;

  void *begin() const { return static_cast<std::byte *>(memory_) + kGuard; }

private:
  static constexpr std::size_t kMapped = kTaskStack + kGuard;
  void *memory_ = nullptr;
};

struct Call {
  const std::function<void()> *function;
  std::exception_ptr exception;
};

extern "C" void *strideRunOnStack(void *argument) {
  auto *call = static_cast<Call *>(argument);
  try {
    (*call->function)();
  } catch (...) {
    call->exception = std::current_exception();
  }
  return nullptr;
}

} // namespace

void runOnLowStack(const std::function<void()> &function) {
  const Stack stack;
  Call call{&function, nullptr};
  pthread_attr_t attributes;
  pthread_t thread{};
  ::pthread_attr_init(&attributes);
  bool started = ::pthread_attr_setstack(&attributes, stack.begin(), kTaskStack) == 0;
  started = started && ::pthread_create(&thread, &attributes, strideRunOnStack, &call) == 0;
  ::pthread_attr_destroy(&attributes);
  if (!started)
    throw app::Error("the system cannot start a thread for the tasks");
  ::pthread_join(thread, nullptr);
  if (call.exception)
    std::rethrow_exception(call.exception);
}

} // namespace stride::task
