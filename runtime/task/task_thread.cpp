#include "runtime/task/task_thread.hpp"

#include "runtime/app/error.hpp"

#include <pthread.h>
#include <sys/mman.h>

#include <utility>

namespace stride::task {

struct TaskThread::Impl {
  /// Memory for one stack with what lies below.
  class Stack {
  public:
    Stack()
        : memory_(::mmap(nullptr, kMapped, PROT_NONE,
                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0)) {
      if (memory_ == MAP_FAILED)
        throw app::Error("the system has no memory for a task's stack");
      if (::mprotect(begin(), kTaskStack, PROT_READ | PROT_WRITE) != 0) {
        ::munmap(memory_, kMapped);
        throw app::Error("the system has no memory for a task's stack");
      }
    }
    ~Stack() { ::munmap(memory_, kMapped); }
    Stack(const Stack &) = delete;
    Stack &operator=(const Stack &) = delete;

    void *begin() const { return static_cast<std::byte *>(memory_) + kBelowTaskStack; }

  private:
    static constexpr size_t kMapped = kBelowTaskStack + kTaskStack;
    void *memory_;
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

TaskThread::TaskThread(std::function<void()> function) : impl_(std::make_unique<Impl>()) {
  impl_->function = std::move(function);
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  impl_->running = ::pthread_attr_setstack(&attributes, impl_->stack.begin(), kTaskStack) == 0 &&
                   ::pthread_create(&impl_->thread, &attributes, Impl::run, impl_.get()) == 0;
  ::pthread_attr_destroy(&attributes);
  if (!impl_->running)
    throw app::Error("the system cannot start a thread for the tasks");
}

TaskThread::~TaskThread() {
  if (impl_->running)
    ::pthread_join(impl_->thread, nullptr);
}

void TaskThread::join() {
  if (impl_->running)
    ::pthread_join(impl_->thread, nullptr);
  impl_->running = false;
  if (impl_->exception)
    std::rethrow_exception(std::exchange(impl_->exception, nullptr));
}

void runOnTaskThread(const std::function<void()> &function) { TaskThread(function).join(); }

} // namespace stride::task
