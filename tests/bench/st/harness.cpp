// st_harness [--cycles N] [--runs N] [--verify] CHECKED UNCHECKED TWIN
// Runs the two builds of a program and its hand-written twin side by side from the same initial
// state. The checksums must agree after every batch of cycles; otherwise it fails. Unless --verify
// is given, it prints the shortest times per cycle in nanoseconds: checked, unchecked, twin.

#include "runtime/app/application.hpp"
#include "runtime/app/st_exception.hpp"
#include "runtime/app/symbols.hpp"
#include "tests/bench/st/twin.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using stride::app::Application;

constexpr int64_t kIntervalNs = 1'000'000;
constexpr int64_t kLoopBudget = 1'000'000'000;
constexpr double kBatchNs = 4e5; // short, so that some batch is not disturbed

[[noreturn]] void raiseThere(stride::Ctx *, stride::ExceptionCode code, const char *file,
                             uint32_t line, uint32_t col, const char *detail) {
  throw stride::StException(code, file, line, col, detail);
}
int64_t noMoreBudget(stride::Ctx *) { return 0; }
void ignoreLog(stride::Ctx *, uint32_t, const char *) {}

constexpr stride::HostApi kHost = {
    sizeof(stride::HostApi), 0, nullptr, raiseThere, noMoreBudget, ignoreLog};

/// Something that runs cycles and has a checksum.
class Subject {
public:
  Subject() = default;
  Subject(const Subject &) = delete;
  Subject &operator=(const Subject &) = delete;
  virtual ~Subject() = default;
  virtual void run(int64_t cycles) = 0;
  [[nodiscard]] virtual uint64_t checksum() const = 0;
};

class Compiled final : public Subject {
public:
  explicit Compiled(const std::string &path) : application_(Application::load(path)) {
    application_.initialise(kHost);
    context_.state = application_.state();
    context_.taskIntervalNs = kIntervalNs;
    context_.host = &kHost;
    const stride::app::SymbolTable symbols(application_.description());
    checksum_ = symbols.resolve("PLC_PRG.Checksum").address(application_.state());
  }

  void run(int64_t cycles) override {
    const auto task = application_.description().tasks[0].run;
    for (int64_t i = 0; i < cycles; ++i) {
      context_.loopBudget = kLoopBudget;
      task(&context_);
      context_.cycleStartNs += kIntervalNs;
      ++context_.cycle;
    }
  }

  [[nodiscard]] uint64_t checksum() const override {
    uint64_t bits = 0;
    std::memcpy(&bits, checksum_, sizeof bits);
    return bits;
  }

private:
  Application application_;
  stride::Ctx context_{};
  const void *checksum_;
};

class HandWritten final : public Subject {
public:
  explicit HandWritten(const std::string &path) {
    void *const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    const void *const twin = library == nullptr ? nullptr : ::dlsym(library, "stride_twin");
    if (twin == nullptr)
      throw std::runtime_error(::dlerror());
    twin_ = static_cast<const Twin *>(twin);
    // Aligned as the state of an application is.
    const size_t size = (twin_->size + kAlign - 1) / kAlign * kAlign;
    state_.reset(static_cast<std::byte *>(std::aligned_alloc(kAlign, size)));
    std::memset(state_.get(), 0, size);
    twin_->init(state_.get());
  }

  void run(int64_t cycles) override {
    for (int64_t i = 0; i < cycles; ++i) {
      twin_->cycle(state_.get(), nowNs_);
      nowNs_ += kIntervalNs;
    }
  }

  [[nodiscard]] uint64_t checksum() const override { return twin_->checksum(state_.get()); }

private:
  static constexpr size_t kAlign = 4096;
  struct Free {
    void operator()(std::byte *memory) const { std::free(memory); }
  };

  const Twin *twin_;
  std::unique_ptr<std::byte, Free> state_;
  int64_t nowNs_ = 0;
};

double timed(Subject &subject, int64_t cycles) {
  const auto start = std::chrono::steady_clock::now();
  subject.run(cycles);
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

struct Options {
  int64_t cycles = 0; ///< 0: as many as fill a batch
  int runs = 200;
  bool verify = false;
  int only = -1; ///< one of the three alone, for profilers
  std::vector<std::string> files;
};

Options parse(int count, char **arguments) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    if (argument == "--verify")
      options.verify = true;
    else if (argument == "--cycles" && i + 1 < count)
      options.cycles = std::atoll(arguments[++i]);
    else if (argument == "--runs" && i + 1 < count)
      options.runs = std::atoi(arguments[++i]);
    else if (argument == "--only" && i + 1 < count)
      options.only = std::atoi(arguments[++i]);
    else
      options.files.push_back(argument);
  }
  if (options.files.size() != 3)
    throw std::runtime_error("st_harness needs CHECKED UNCHECKED TWIN");
  return options;
}

int measure(const Options &options) {
  Compiled checked(options.files[0]);
  Compiled unchecked(options.files[1]);
  HandWritten twin(options.files[2]);
  const std::array<Subject *, 3> all = {&checked, &unchecked, &twin};
  if (options.only >= 0) {
    all.at(static_cast<size_t>(options.only))->run(options.cycles);
    return 0;
  }
  const auto compare = [&] {
    if (checked.checksum() == twin.checksum() && unchecked.checksum() == twin.checksum())
      return;
    std::fprintf(stderr, "the checksums differ: checked %016llx, unchecked %016llx, twin %016llx\n",
                 static_cast<unsigned long long>(checked.checksum()),
                 static_cast<unsigned long long>(unchecked.checksum()),
                 static_cast<unsigned long long>(twin.checksum()));
    throw std::runtime_error("wrong checksum");
  };
  for (int warm = 0; warm < 5; ++warm) {
    for (Subject *subject : all)
      subject->run(1);
    compare();
  }
  if (options.verify) {
    for (Subject *subject : all)
      subject->run(options.cycles == 0 ? 20 : options.cycles);
    compare();
    return 0;
  }
  int64_t cycles = options.cycles;
  if (cycles == 0) {
    double ns = 0;
    for (Subject *subject : all)
      ns = std::max(ns, timed(*subject, 10) / 10);
    cycles = std::max<int64_t>(1, static_cast<int64_t>(kBatchNs / std::max(ns, 1.0)));
  }
  std::array<double, 3> best = {1e300, 1e300, 1e300};
  for (int run = 0; run < options.runs; ++run) {
    for (size_t i = 0; i < all.size(); ++i)
      best[i] = std::min(best[i], timed(*all[i], cycles) / static_cast<double>(cycles));
    compare();
  }
  std::printf("%.1f %.1f %.1f\n", best[0], best[1], best[2]);
  return 0;
}

} // namespace

int main(int count, char **arguments) {
  try {
    return measure(parse(count, arguments));
  } catch (const std::exception &problem) {
    std::fprintf(stderr, "st_harness: %s\n", problem.what());
    return 1;
  }
}
