#include "runtime/task/fatal.hpp"

#include "runtime/task/signal_handlers.hpp"

#include <csignal>
#include <cstdlib>
#include <cstring>

#include <atomic>

#include <unistd.h>

namespace stride::task {

namespace {

/// 0: nothing is reported.
std::atomic<int> exitCodeOfReport{0};

thread_local const char *noteOfTask = nullptr;
thread_local uint64_t noteOfCycle = 0;

/// A text built without anything that a signal handler must not call.
class Words {
public:
  Words &operator<<(const char *text) {
    for (; *text != 0 && length_ < sizeof text_; ++text)
      text_[length_++] = *text;
    return *this;
  }
  Words &number(uint64_t value, unsigned base) {
    char digits[21];
    char *at = digits + sizeof digits - 1;
    *at = 0;
    do
      *--at = "0123456789abcdef"[value % base];
    while ((value /= base) != 0);
    return *this << at;
  }
  void write() const {
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text_, length_);
  }

private:
  char text_[512];
  size_t length_ = 0;
};

void report(int number, const void *address) noexcept {
  Words words;
  words << "error: fatal: ";
  if (number == SIGABRT)
    words << "the runtime found itself damaged";
  else if (number == SIGSEGV || number == SIGBUS)
    (words << "invalid memory access at 0x").number(reinterpret_cast<uintptr_t>(address), 16)
        << " outside of ST";
  else
    (words << "signal ").number(static_cast<uint64_t>(number), 10) << " outside of ST";
  if (noteOfTask != nullptr)
    (words << " (task " << noteOfTask << ", cycle ").number(noteOfCycle, 10) << ")";
  words << "\n  perhaps ST has written through a pointer to where it had no business; the process "
           "ends at once,\n  and drives get no more set points\n";
  words.write();
}

extern "C" void strideOnAbort(int number) { endBySignal(number, nullptr); }

} // namespace

FatalReport::FatalReport(int exitCode) {
  exitCodeOfReport.store(exitCode);
  useSignalHandlers();
  std::signal(SIGABRT, strideOnAbort);
}

FatalReport::~FatalReport() {
  std::signal(SIGABRT, SIG_DFL);
  releaseSignalHandlers();
  exitCodeOfReport.store(0);
}

void noteCycle(const char *task, uint64_t cycle) noexcept {
  noteOfTask = task;
  noteOfCycle = cycle;
}

void endBySignal(int number, const void *address) noexcept {
  if (const int code = exitCodeOfReport.load(); code != 0) {
    report(number, address);
    ::_exit(code);
  }
  std::signal(number, SIG_DFL);
  std::raise(number);
  ::_exit(128 + number); // the signal is blocked
}

} // namespace stride::task
