#include "runtime/task/fault.hpp"

#include "runtime/iec/text.h"

#include <fmt/format.h>

#include <csetjmp>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <vector>

#include <pthread.h>

namespace stride::task {

namespace {

/// The call that a signal of this thread ends; null outside of guardedCall. Signal handlers reach
/// nothing but this.
struct Landing {
  sigjmp_buf place;
  const volatile char *stack;
  bool arrived = false; ///< A signal has come: another one while its calls are captured adds none.
  std::size_t callCount = 0;
  uintptr_t calls[StException::kMaxCalls];
};
thread_local Landing *landing = nullptr;

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL};
constexpr int kInvalidAccess = 1;
constexpr int kStackOverflow = 2;

/// Lower end and size of this thread's stack, known while a MemoryGuard lives.
thread_local uintptr_t stackLow = 0;
thread_local std::size_t stackSize = 0;

/// Near the lower end of the stack, on which the call is.
bool isStackOverflow(const void *address) {
  constexpr uintptr_t kBelow = 64U << 20; // a large frame reaches far behind the end
  const auto at = reinterpret_cast<uintptr_t>(address);
  return at < reinterpret_cast<uintptr_t>(landing->stack) && at < stackLow + stackSize / 2 &&
         at + kBelow > stackLow;
}

extern "C" void strideOnSignal(int number, siginfo_t *info, void *) {
  if (landing == nullptr) {
    std::signal(number, SIG_DFL); // a defect of our own: end as usual
    std::raise(number);
    return;
  }
  if (!landing->arrived) {
    landing->arrived = true;
    landing->callCount = captureCalls(landing->calls, StException::kMaxCalls);
  }
  siglongjmp(landing->place,
             number == SIGSEGV && isStackOverflow(info->si_addr) ? kStackOverflow : kInvalidAccess);
}

[[noreturn]] void raiseInHost(Ctx *, ExceptionCode code, const char *file, uint32_t line,
                              uint32_t col, const char *detail) {
  StException exception(code, file, line, col, detail);
  exception.captureCalls();
  throw exception;
}

int64_t refuseMoreLoops(Ctx *) { return 0; }

void describeCaught(Ctx *, Caught *out) {
  try {
    throw;
  } catch (const StException &exception) {
    if (exception.code() == ExceptionCode::EndlessLoop ||
        exception.code() == ExceptionCode::Watchdog || exception.code() == ExceptionCode::Internal)
      throw;
    out->code = exception.code();
    out->line = exception.line();
    out->col = exception.column();
    out->file = exception.file();
    std::snprintf(out->detail, sizeof(out->detail), "%s", exception.detail());
  }
}

void logToStderr(Ctx *, uint32_t, const char *text) { std::fprintf(stderr, "%s\n", text); }

} // namespace

namespace {

/// The handlers of the process, counted: there is one set of them, however many threads run tasks.
class SignalHandlers {
public:
  void use() {
    const std::lock_guard lock(mutex_);
    if (users_++ != 0)
      return;
    struct sigaction action {};
    action.sa_sigaction = strideOnSignal;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
    ::sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < std::size(kSignals); ++i)
      ::sigaction(kSignals[i], &action, &old_[i]);
  }
  void release() {
    const std::lock_guard lock(mutex_);
    if (--users_ != 0)
      return;
    for (std::size_t i = 0; i < std::size(kSignals); ++i)
      ::sigaction(kSignals[i], &old_[i], nullptr);
  }

private:
  std::mutex mutex_;
  std::size_t users_ = 0;
  struct sigaction old_[std::size(kSignals)]{};
};

SignalHandlers &signalHandlers() {
  static SignalHandlers handlers;
  return handlers;
}

} // namespace

struct MemoryGuard::Impl {
  std::vector<char> stack = std::vector<char>(64U << 10);
  stack_t oldStack{};
};

MemoryGuard::MemoryGuard() : impl_(std::make_unique<Impl>()) {
  pthread_attr_t attributes;
  if (::pthread_getattr_np(::pthread_self(), &attributes) == 0) {
    void *low = nullptr;
    ::pthread_attr_getstack(&attributes, &low, &stackSize);
    stackLow = reinterpret_cast<uintptr_t>(low);
    ::pthread_attr_destroy(&attributes);
  }
  stack_t stack{};
  stack.ss_sp = impl_->stack.data();
  stack.ss_size = impl_->stack.size();
  ::sigaltstack(&stack, &impl_->oldStack);
  signalHandlers().use();
}

MemoryGuard::~MemoryGuard() {
  signalHandlers().release();
  ::sigaltstack(&impl_->oldStack, nullptr);
}

StackRange threadStack() noexcept { return {stackLow, stackLow + stackSize}; }

std::optional<StException> guardedCall(void (*run)(Ctx *), Ctx &ctx) {
  Landing here;
  char onStack = 0;
  here.stack = &onStack;
  // ST frames hold nothing to destroy, so a jump out of them leaves nothing behind.
  const int arrived = sigsetjmp(here.place, 0);
  if (arrived != 0) {
    landing = nullptr;
    StException exception(arrived == kStackOverflow ? ExceptionCode::StackOverflow
                                                    : ExceptionCode::AccessViolation,
                          nullptr, 0, 0, nullptr);
    exception.setCalls(here.calls, here.callCount);
    return exception;
  }
  landing = &here;
  try {
    run(&ctx);
  } catch (const StException &exception) {
    landing = nullptr;
    return exception;
  }
  landing = nullptr;
  return std::nullopt;
}

const HostApi &hostApi() {
  static constexpr HostApi kApi = {sizeof(HostApi), 0,           nullptr,       raiseInHost,
                                   refuseMoreLoops, logToStderr, describeCaught};
  return kApi;
}

std::string describe(const Fault &fault, std::string_view place) {
  const StException &e = fault.exception;
  std::string text = e.what();
  if (e.detail()[0] != 0)
    text += fmt::format(": {}", e.detail());
  if (e.file() != nullptr)
    text += fmt::format(" at {}:{}:{}", e.file(), e.line(), e.column());
  else if (!place.empty())
    text += fmt::format(" at {}", place);
  char time[stride::text::kBufferSize];
  stride::text::formatLtime(time, fault.timeNs);
  const char *digits = std::strchr(time, '#');
  return text + fmt::format(" (task {}, cycle {}, at T{})", fault.task, fault.cycle, digits);
}

} // namespace stride::task
