#include "runtime/task/low_stack.hpp"

#include "runtime/app/error.hpp"

#include <pthread.h>
#include <sys/mman.h>

#include <bit>
#include <cstdint>
#include <utility>

namespace stride::task {

namespace {

constexpr std::size_t kGuard = 4096;
constexpr uint64_t kStep = uint64_t{1} << 29;
constexpr uint64_t kFirstTop = 2 * kStep;
constexpr uint64_t kFourGiB = uint64_t{1} << 32;

} // namespace

struct LowThread::Impl {
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

  std::function<void()> function;
  Stack stack;
  pthread_t thread{};
  bool running = false;
  std::exception_ptr exception;

  static void *run(void *argument) {
    auto *self = static_cast<Impl *>(argument);
    try {
      self->function();
    } catch (...) {
      self->exception = std::current_exception();
    }
    return nullptr;
  }
};

LowThread::LowThread(std::function<void()> function) : impl_(std::make_unique<Impl>()) {
  impl_->function = std::move(function);
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  impl_->running = ::pthread_attr_setstack(&attributes, impl_->stack.begin(), kTaskStack) == 0 &&
                   ::pthread_create(&impl_->thread, &attributes, Impl::run, impl_.get()) == 0;
  ::pthread_attr_destroy(&attributes);
  if (!impl_->running)
    throw app::Error("the system cannot start a thread for the tasks");
}

LowThread::~LowThread() {
  if (impl_->running)
    ::pthread_join(impl_->thread, nullptr);
}

void LowThread::join() {
  if (impl_->running)
    ::pthread_join(impl_->thread, nullptr);
  impl_->running = false;
  if (impl_->exception)
    std::rethrow_exception(std::exchange(impl_->exception, nullptr));
}

void runOnLowStack(const std::function<void()> &function) { LowThread(function).join(); }

} // namespace stride::task
