#include "runtime/host/simulation.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/value_text.hpp"
#include "runtime/host/axis_hooks.hpp"
#include "runtime/host/set_list.hpp"
#include "runtime/host/trace_writer.hpp"
#include "runtime/task/low_stack.hpp"
#include "runtime/task/virtual_scheduler.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <optional>

#include <unistd.h>

namespace stride::host {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

volatile std::sig_atomic_t stopRequested = 0;

extern "C" void strideRequestStop(int) { stopRequested = 1; }

/// One line on a terminal that shows how far a long run is.
class Progress {
public:
  Progress(int64_t endNs, bool enabled) : endNs_(endNs), enabled_(enabled) {}
  ~Progress() { clear(); }
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  void update(int64_t timeNs) {
    if (!enabled_ || (++calls_ & 255U) != 0)
      return;
    const double wall = secondsSince(start_);
    if (wall < next_)
      return;
    next_ = wall + 0.1;
    const double simulated = static_cast<double>(timeNs) * 1e-9;
    fmt::print(stderr, "\r\033[Ksimulated {:.1f} s of {:.1f} s ({:.0f} %), {:.0f} times real time",
               simulated, static_cast<double>(endNs_) * 1e-9,
               100.0 * static_cast<double>(timeNs) / static_cast<double>(endNs_), simulated / wall);
    std::fflush(stderr);
    shown_ = true;
  }
  void clear() {
    if (shown_)
      std::fputs("\r\033[K", stderr);
    shown_ = false;
  }
  double wall() const { return secondsSince(start_); }

private:
  Clock::time_point start_ = Clock::now();
  int64_t endNs_;
  double next_ = 0.5; // short runs show nothing
  uint64_t calls_ = 0;
  bool enabled_;
  bool shown_ = false;
};

/// Sets before, trace and progress after each instant.
class Observer final : public task::InstantObserver {
public:
  Observer(SetList &sets, TraceWriter *trace, Progress &progress, std::byte *state)
      : sets_(&sets), trace_(trace), progress_(&progress), state_(state) {}

  void beforeInstant(int64_t timeNs) override { sets_->apply(timeNs, state_); }
  void afterInstant(int64_t timeNs, bool fastest) override {
    if (trace_ != nullptr && fastest)
      trace_->row(timeNs);
    progress_->update(timeNs);
  }

private:
  SetList *sets_;
  TraceWriter *trace_;
  Progress *progress_;
  std::byte *state_;
};

void printValues(const app::SymbolTable &symbols, const std::vector<app::Symbol> &wanted,
                 std::byte *state) {
  for (const app::Symbol &symbol : wanted) {
    for (const app::Symbol &leaf : symbols.leaves(symbol)) {
      std::byte bit{};
      const void *value = leaf.read(state, bit);
      fmt::print("{} = {}\n", leaf.path(),
                 value != nullptr ? app::formatLiteral(symbols.app(), symbols.type(leaf), value)
                                  : std::string("NULL"));
    }
  }
  std::fflush(stdout);
}

void printSummary(const task::VirtualScheduler &scheduler, const task::RunResult &result,
                  double wall) {
  uint64_t cycles = 0;
  for (const task::TaskStatistics &statistics : scheduler.statistics())
    cycles += statistics.cycles;
  const double simulated = static_cast<double>(result.timeNs) * 1e-9;
  fmt::print(stderr, "{} cycles, {:g} s simulated in {:.3f} s ({:.0f} times real time)\n", cycles,
             simulated, wall, wall > 0 ? simulated / wall : 0.0);
}

/// FB_Exit of every instance; what goes wrong in one of them.
std::optional<task::Fault> exitInstances(app::Application &application, const HostApi &host,
                                         int64_t timeNs, int64_t loopBudget) {
  const StrideAppV1 &app = application.description();
  if (app.exit == nullptr)
    return std::nullopt;
  Ctx ctx{};
  ctx.state = application.state();
  ctx.host = &host;
  ctx.cycleStartNs = timeNs;
  ctx.loopBudget = loopBudget > 0 ? loopBudget : task::VirtualScheduler::kDefaultLoopBudget;
  if (const std::optional<StException> exception = task::guardedCall(app.exit, ctx))
    return task::Fault{*exception, "end of the run", 0, timeNs};
  return std::nullopt;
}

/// Ctrl-C and SIGTERM end the run between two instants; a second one ends the program.
class StopSignals {
public:
  StopSignals() {
    stopRequested = 0;
    struct sigaction action {};
    action.sa_handler = strideRequestStop;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigemptyset(&action.sa_mask);
    ::sigaction(SIGINT, &action, &oldInterrupt_);
    ::sigaction(SIGTERM, &action, &oldTerminate_);
  }
  ~StopSignals() {
    ::sigaction(SIGINT, &oldInterrupt_, nullptr);
    ::sigaction(SIGTERM, &oldTerminate_, nullptr);
  }
  StopSignals(const StopSignals &) = delete;
  StopSignals &operator=(const StopSignals &) = delete;

private:
  struct sigaction oldInterrupt_ {};
  struct sigaction oldTerminate_ {};
};

} // namespace

static ExitCode simulateHere(app::Application &application, const SimOptions &options) {
  const StrideAppV1 &app = application.description();
  std::byte *state = application.state();
  const app::SymbolTable symbols(app);

  // Everything that can be wrong with the input is found before the first cycle.
  std::vector<app::Symbol> wanted;
  for (const std::string &path : options.print)
    wanted.push_back(symbols.resolve(path));
  SetList sets(symbols, options.sets);
  const HostApi &host = task::hostApi();
  task::VirtualScheduler scheduler(app, state, host);
  if (options.loopBudget > 0)
    scheduler.setLoopBudget(options.loopBudget);
  std::optional<TraceWriter> trace;
  if (!options.trace.empty())
    trace.emplace(symbols, options.trace, options.out, state);

  const task::MemoryGuard guard;
  const StopSignals signals;
  try {
    application.initialise(host);
  } catch (const StException &exception) {
    const task::Fault fault{exception, "initialisation", 0, 0};
    fmt::print(stderr, "error: {}\n", task::describe(fault));
    return kExitException;
  }
  const std::vector<std::unique_ptr<task::CycleHook>> hooks = addAxisGroups(application, scheduler);

  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  Progress progress(options.durationNs, terminal && !options.quiet);
  Observer observer(sets, trace ? &*trace : nullptr, progress, state);
  scheduler.setObserver(&observer);
  scheduler.setStopRequest([] { return stopRequested != 0; });
  const task::RunResult result = scheduler.runUntil(options.durationNs);
  const double wall = progress.wall();
  progress.clear();

  if (trace)
    trace->finish();
  printValues(symbols, wanted, state);
  for (const std::unique_ptr<task::CycleHook> &hook : hooks)
    if (const std::string problem = hook->problem(); !problem.empty())
      fmt::print(stderr, "warning: {}\n", problem);
  for (const std::string &line : errorStops(application))
    fmt::print(stderr, "note: {}\n", line);
  if (result.fault)
    fmt::print(stderr, "error: {}\n", task::describe(*result.fault));
  else if (!result.interrupted) {
    for (const std::string &left : sets.left())
      fmt::print(stderr, "warning: --set '{}' was not used: the run ends before\n", left);
  }
  // A program that has failed is not called again.
  std::optional<task::Fault> atEnd;
  if (!result.fault)
    atEnd = exitInstances(application, host, result.timeNs, options.loopBudget);
  if (atEnd)
    fmt::print(stderr, "error: {}\n", task::describe(*atEnd));
  if ((terminal || options.summary) && !options.quiet)
    printSummary(scheduler, result, wall);
  if (result.fault || atEnd)
    return kExitException;
  return result.interrupted ? kExitInterrupted : kExitOk;
}

ExitCode simulate(app::Application &application, const SimOptions &options) {
  ExitCode code = kExitOk;
  task::runOnLowStack([&] { code = simulateHere(application, options); });
  return code;
}

} // namespace stride::host
