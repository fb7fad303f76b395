#include "runtime/task/realtime.hpp"

#include <fmt/format.h>

#include <alloca.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace stride::task {

namespace {

constexpr int kHighest = 80;
constexpr const char *kRemedy =
    "  allow it once with: sudo setcap cap_sys_nice,cap_ipc_lock+ep \"$(command -v stride-host)\"\n"
    "  or for a user in /etc/security/limits.conf: rtprio 90, memlock unlimited; or run it as root";

bool setFifo(int priority) noexcept {
  ::sched_param parameters{};
  parameters.sched_priority = priority;
  return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0;
}

} // namespace

NoDeepSleep::NoDeepSleep() noexcept : file_(::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC)) {
  const int32_t microseconds = 0;
  if (file_ >= 0 && ::write(file_, &microseconds, sizeof microseconds) < 0) {
    ::close(file_);
    file_ = -1;
  }
}

NoDeepSleep::~NoDeepSleep() {
  if (file_ >= 0)
    ::close(file_);
}

RealtimeReport prepareRealtime() {
  RealtimeReport report;
  int policy = SCHED_OTHER;
  ::sched_param before{};
  ::pthread_getschedparam(::pthread_self(), &policy, &before);
  ::sched_param wanted{};
  wanted.sched_priority = kHighest;
  const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &wanted);
  report.fifo = error == 0;
  if (report.fifo)
    ::pthread_setschedparam(::pthread_self(), policy, &before);
  else
    report.warnings.push_back(
        fmt::format("the tasks run without real-time priority (SCHED_FIFO: {}): other programs can "
                    "delay them, and they take turns at cycle boundaries\n{}",
                    std::strerror(error), kRemedy));
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    report.warnings.push_back(fmt::format("the memory cannot be locked (mlockall: {}): a page that "
                                          "was swapped out delays a cycle{}",
                                          std::strerror(errno),
                                          report.fifo ? fmt::format("\n{}", kRemedy) : ""));
  return report;
}

bool useFifo(uint32_t taskPriority) noexcept {
  return setFifo(kHighest - static_cast<int>(taskPriority));
}

std::vector<uint32_t> allowedCores() {
  std::vector<uint32_t> cores;
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) == 0)
    for (uint32_t i = 0; i < CPU_SETSIZE; ++i)
      if (CPU_ISSET(i, &set))
        cores.push_back(i);
  return cores;
}

bool pinTo(uint32_t core) noexcept {
  if (core >= CPU_SETSIZE)
    return false;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(core, &set);
  return ::pthread_setaffinity_np(::pthread_self(), sizeof set, &set) == 0;
}

__attribute__((noinline)) void touchStack(size_t bytes) noexcept {
  constexpr size_t kPage = 4096;
  auto *memory = static_cast<volatile char *>(alloca(bytes));
  for (size_t i = 0; i < bytes; i += kPage)
    memory[bytes - 1 - i] = 0;
}

void useExactTimers() noexcept { ::prctl(PR_SET_TIMERSLACK, 1UL); }

} // namespace stride::task
