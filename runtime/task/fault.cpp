#include "runtime/task/fault.hpp"

#include "runtime/app/low_memory.hpp"
#include "runtime/iec/text.h"
#include "runtime/task/fatal.hpp"
#include "runtime/task/signal_handlers.hpp"
#include "runtime/task/task_thread.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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
  const Ctx *ctx;
  Landing *outer;        ///< Of a call around this one.
  unsigned arrivals = 0; ///< Signals: one that comes while the calls are captured adds none.
  size_t callCount = 0;
  uintptr_t calls[StException::kMaxCalls];
};
thread_local Landing *landing = nullptr;

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL};
constexpr int kInvalidAccess = 1;
constexpr int kStackOverflow = 2;

/// Signals of one call after which there is no use in landing once more.
constexpr unsigned kMostArrivals = 3;

/// Lower end and size of this thread's stack, known while a MemoryGuard lives; so is its data
/// stack.
thread_local uintptr_t stackLow = 0;
thread_local size_t stackSize = 0;
thread_local char *dataLow = nullptr;
thread_local char *dataHigh = nullptr;

/// Places for data stacks: 16 in the second half of each part of the memory below 4 GiB.
constexpr auto kDataPlaces = [] {
  constexpr uint64_t kPart = app::kPartOfLowMemory;
  constexpr uint64_t kStep = kPart / 32;
  static_assert(kDataStack + 2 * app::LowMemory::kGuard <= kStep);
  std::array<uint64_t, 16 * (app::kFourGiB / kPart - 1)> places{};
  for (size_t i = 0; i < places.size(); ++i)
    places[i] = (i / 16 + 1) * kPart + kPart / 2 + i % 16 * kStep + app::LowMemory::kGuard;
  return places;
}();

/// Near the lower end of the stack, on which the call is.
bool isStackOverflow(const void *address) {
  const auto at = reinterpret_cast<uintptr_t>(address);
  return at < reinterpret_cast<uintptr_t>(landing->stack) && at < stackLow + stackSize / 2 &&
         at + kBelowTaskStack > stackLow;
}

extern "C" void strideOnSignal(int number, siginfo_t *info, void *) {
  if (landing == nullptr || landing->arrivals == kMostArrivals)
    endBySignal(number, info->si_addr);
  if (landing->arrivals++ == 0) {
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
    for (size_t i = 0; i < std::size(kSignals); ++i)
      ::sigaction(kSignals[i], &action, &old_[i]);
  }
  void release() {
    const std::lock_guard lock(mutex_);
    if (--users_ != 0)
      return;
    for (size_t i = 0; i < std::size(kSignals); ++i)
      ::sigaction(kSignals[i], &old_[i], nullptr);
  }

private:
  std::mutex mutex_;
  size_t users_ = 0;
  struct sigaction old_[std::size(kSignals)]{};
};

SignalHandlers &signalHandlers() {
  static SignalHandlers handlers;
  return handlers;
}

} // namespace

void useSignalHandlers() { signalHandlers().use(); }
void releaseSignalHandlers() { signalHandlers().release(); }

struct MemoryGuard::Impl {
  std::vector<char> stack = std::vector<char>(64U << 10);
  stack_t oldStack{};
  app::LowMemory data{kDataStack, kDataPlaces, "the data stack of a task"};
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
  dataLow = reinterpret_cast<char *>(impl_->data.data());
  dataHigh = dataLow + impl_->data.size();
  signalHandlers().use();
}

MemoryGuard::~MemoryGuard() {
  signalHandlers().release();
  dataLow = dataHigh = nullptr;
  ::sigaltstack(&impl_->oldStack, nullptr);
}

DataStackRange dataStack() noexcept {
  return {reinterpret_cast<uintptr_t>(dataLow), reinterpret_cast<uintptr_t>(dataHigh)};
}

void touchDataStack(size_t bytes) noexcept {
  constexpr size_t kPage = 4096;
  if (dataLow == nullptr)
    return;
  volatile char *const low = dataLow;
  for (size_t at = 0; at < std::min(bytes, kDataStack); at += kPage)
    low[at] = 0;
}

namespace {

/// The data stack as the call finds it, and where the thread lands; both are as before when the
/// call has ended.
class Guarded {
public:
  Guarded(Landing &here, Ctx &ctx)
      : ctx_(ctx), outer_(landing), oldTop_(ctx.dataTop), oldEnd_(ctx.dataEnd) {
    here.ctx = &ctx;
    here.outer = landing;
    ctx.dataTop = outer_ != nullptr ? outer_->ctx->dataTop : dataLow;
    ctx.dataEnd = dataHigh;
    landing = &here;
  }
  ~Guarded() {
    landing = outer_;
    ctx_.dataTop = oldTop_;
    ctx_.dataEnd = oldEnd_;
  }
  Guarded(const Guarded &) = delete;
  Guarded &operator=(const Guarded &) = delete;

private:
  Ctx &ctx_;
  Landing *outer_;
  char *oldTop_;
  char *oldEnd_;
};

} // namespace

std::optional<StException> guardedCall(void (*run)(Ctx *), Ctx &ctx) {
  Landing here;
  char onStack = 0;
  here.stack = &onStack;
  const Guarded guarded(here, ctx);
  // ST frames hold nothing to destroy but their places on the data stack, so a jump out of them
  // leaves nothing behind.
  const int arrived = sigsetjmp(here.place, 0);
  if (arrived != 0) {
    StException exception(arrived == kStackOverflow ? ExceptionCode::StackOverflow
                                                    : ExceptionCode::AccessViolation,
                          nullptr, 0, 0, nullptr);
    exception.setCalls(here.calls, here.callCount);
    return exception;
  }
  try {
    run(&ctx);
  } catch (const StException &exception) {
    return exception;
  }
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
  text += fmt::format(" (task {}, cycle {}, at T{})", fault.task, fault.cycle, digits);
  return e.code() == ExceptionCode::None
             ? text
             : text + fmt::format("; stride explain SR{:04}", static_cast<uint32_t>(e.code()));
}

} // namespace stride::task
