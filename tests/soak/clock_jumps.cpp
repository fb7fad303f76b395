// Loaded into a run by LD_PRELOAD: the wall clock jumps by what the soak writes into a shared file.
// The monotonic clock stays as it is. Waiting for a time of the wall clock, which a jump would
// shorten or prolong, is counted.
#include <cstdint>
#include <cstdlib>

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

namespace {

constexpr int64_t kSecond = 1'000'000'000;

/// What the file holds; both sides are on one machine.
struct Shared {
  int64_t offsetNs; ///< Written by the soak.
  int64_t asked;    ///< How often the wall clock was read.
  int64_t waited;   ///< How often something waits for a time of the wall clock.
};

Shared *shared() {
  static Shared *const place = [] {
    const char *const path = std::getenv("SOAK_CLOCK");
    const int file = path == nullptr ? -1 : ::open(path, O_RDWR | O_CLOEXEC);
    void *const memory =
        file < 0 ? MAP_FAILED
                 : ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file >= 0)
      ::close(file);
    if (memory == MAP_FAILED)
      std::abort();
    return static_cast<Shared *>(memory);
  }();
  return place;
}

int64_t nanoseconds(const timespec &time) { return time.tv_sec * kSecond + time.tv_nsec; }

int64_t read(clockid_t clock) {
  timespec now{};
  ::syscall(SYS_clock_gettime, clock, &now);
  return nanoseconds(now);
}

int64_t wallClock() {
  __atomic_add_fetch(&shared()->asked, 1, __ATOMIC_RELAXED);
  return read(CLOCK_REALTIME) + __atomic_load_n(&shared()->offsetNs, __ATOMIC_RELAXED);
}

/// A time far nearer to the wall clock's than to the monotonic one's is the wall clock's.
void lookAt(const timespec *until) {
  const int64_t time = nanoseconds(*until);
  if (std::llabs(time - read(CLOCK_MONOTONIC)) > std::llabs(time - wallClock()))
    __atomic_add_fetch(&shared()->waited, 1, __ATOMIC_RELAXED);
}

template <typename Function> Function *next(const char *name) {
  return reinterpret_cast<Function *>(::dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec *time) noexcept {
  if (clock != CLOCK_REALTIME && clock != CLOCK_REALTIME_COARSE)
    return static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  const int64_t now = wallClock();
  *time = {now / kSecond, now % kSecond};
  return 0;
}

int gettimeofday(timeval *time, void *) noexcept {
  const int64_t now = wallClock();
  *time = {now / kSecond, now % kSecond / 1000};
  return 0;
}

time_t time(time_t *place) noexcept {
  const time_t now = wallClock() / kSecond;
  if (place != nullptr)
    *place = now;
  return now;
}

int clock_nanosleep(clockid_t clock, int flags, const timespec *until, timespec *rest) {
  if (clock == CLOCK_REALTIME && (flags & TIMER_ABSTIME) != 0)
    lookAt(until);
  static auto *const real =
      next<int(clockid_t, int, const timespec *, timespec *)>("clock_nanosleep");
  return real(clock, flags, until, rest);
}

int pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *mutex,
                           const timespec *until) {
  lookAt(until);
  static auto *const real =
      next<int(pthread_cond_t *, pthread_mutex_t *, const timespec *)>("pthread_cond_timedwait");
  return real(condition, mutex, until);
}

int sem_timedwait(sem_t *semaphore, const timespec *until) {
  lookAt(until);
  static auto *const real = next<int(sem_t *, const timespec *)>("sem_timedwait");
  return real(semaphore, until);
}

} // extern "C"
