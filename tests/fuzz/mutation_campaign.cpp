#include "tests/fuzz/mutation_campaign.hpp"

#include "tests/fuzz/commands.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <system_error>
#include <time.h>
#include <unistd.h>

namespace stride::fuzz {

namespace {

constexpr size_t kMostBytes = 16'384;
constexpr size_t kMostFailures = 20;
constexpr time_t kTooLong = 60; // seconds of processor time: what would never end takes longer

// What the child writes and its parent reads when it is gone.
struct Progress {
  uint64_t number = 0;
  uint64_t slowest = 0;
  double slowestSeconds = 0;
};

class SharedProgress {
public:
  SharedProgress()
      : memory_(::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE,
                       MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED)
      throw std::system_error(errno, std::generic_category(), "mmap");
    new (memory_) Progress;
  }
  ~SharedProgress() { ::munmap(memory_, sizeof(Progress)); }
  SharedProgress(const SharedProgress &) = delete;
  SharedProgress &operator=(const SharedProgress &) = delete;
  Progress &operator*() const { return *static_cast<Progress *>(memory_); }

private:
  void *memory_;
};

double processorSeconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

[[noreturn]] void work(const TokenMutator &mutator, Progress &progress, uint64_t last,
                       const std::filesystem::path &folder) {
  try {
    for (; progress.number <= last; ++progress.number) {
      const itimerval limit{{0, 0}, {kTooLong, 0}};
      ::setitimer(ITIMER_PROF, &limit, nullptr);
      const std::string source = mutatedSource(mutator, progress.number);
      const double begin = processorSeconds();
      runCommands(source, folder);
      const double seconds = processorSeconds() - begin;
      if (seconds > progress.slowestSeconds) {
        progress.slowestSeconds = seconds;
        progress.slowest = progress.number;
      }
    }
  } catch (const std::exception &error) {
    ::fprintf(stderr, "source %llu: %s\n", static_cast<unsigned long long>(progress.number),
              error.what());
    std::abort();
  }
  ::_exit(0);
}

} // namespace

std::string mutatedSource(const TokenMutator &mutator, uint64_t number) {
  std::mt19937_64 random(number);
  const std::vector<std::string> &corpus = mutator.corpus();
  const auto some = [&] {
    return mutator.mutate(corpus[random() % corpus.size()], random(), kMostBytes);
  };
  std::string source = some();
  if (random() % 4 == 0)
    source = mutator.cross(source, corpus[random() % corpus.size()], random(), kMostBytes);
  if (random() % 8 == 0)
    source += "\n" + std::string(kFileMark) + "second.st\n" + some();
  return source;
}

Campaign runCampaign(const TokenMutator &mutator, uint64_t first, uint64_t count,
                     const std::filesystem::path &folder) {
  Campaign campaign;
  const SharedProgress progress;
  (*progress).number = first;
  const uint64_t last = first + count - 1;
  while ((*progress).number <= last && campaign.failures.size() < kMostFailures) {
    const pid_t child = ::fork();
    if (child < 0)
      throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0)
      work(mutator, *progress, last, folder);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
      break;
    const uint64_t number = (*progress).number++;
    ::fprintf(stderr, "source %llu: %s\n", static_cast<unsigned long long>(number),
              WIFSIGNALED(status) ? ::strsignal(WTERMSIG(status)) : "ended by itself");
    campaign.failures.push_back(
        {number, WIFSIGNALED(status) ? WTERMSIG(status) : 0, mutatedSource(mutator, number)});
  }
  campaign.slowest = (*progress).slowest;
  campaign.slowestSeconds = (*progress).slowestSeconds;
  return campaign;
}

} // namespace stride::fuzz
