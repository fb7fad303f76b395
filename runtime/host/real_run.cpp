#include "runtime/host/real_run.hpp"

#include "runtime/app/error.hpp"
#include "runtime/host/instance.hpp"
#include "runtime/host/print_values.hpp"
#include "runtime/host/statistics_text.hpp"
#include "runtime/host/trace_ring.hpp"
#include "runtime/task/real_scheduler.hpp"
#include "runtime/task/realtime.hpp"

#include <fmt/format.h>

#include <csignal>
#include <ctime>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

namespace stride::host {

namespace {

/// How often the main thread looks after traces and faults.
constexpr long kRoundNs = 20'000'000;
constexpr std::size_t kTraceBytes = std::size_t{16} << 20;
constexpr auto kRestartPause = std::chrono::seconds(1);

/// One application from its start to its stop.
class Session {
public:
  Session(app::Application &application, const RunOptions &options,
          const task::RealOptions &realOptions)
      : options_(&options), instance_(application, task::LoopLimit::Clock),
        scheduler_(instance_.tasks(), realOptions) {
    for (const std::string &path : options.print)
      printed_.push_back(instance_.symbols().resolve(path));
  }

  /// `trace` may be null. False: an initialiser has failed, which has been said.
  bool start(TraceWriter *trace) {
    try {
      // First of all hooks, so that it sees the end of the cycle behind the others.
      if (trace != nullptr) {
        const TraceColumns &columns = trace->columns();
        trace_ = trace;
        ring_ = std::make_unique<TraceRing>(columns, kTraceBytes / columns.rowSize());
        instance_.tasks().addHook(instance_.tasks().fastest(), *ring_);
      }
      instance_.initialise();
    } catch (const StException &exception) {
      say("error: " + task::describe(task::Fault{exception, "initialisation", 0, 0}));
      return false;
    }
    scheduler_.start();
    return true;
  }

  void lookAfter() {
    if (ring_)
      ring_->drain(*trace_);
  }
  bool failed() { return instance_.tasks().fault().has_value(); }

  /// Stops and says what there is to say; false: with an exception.
  bool finish() {
    if (!scheduler_.finish())
      say("warning: not everything came to rest within a minute");
    lookAfter();
    if (ring_ && ring_->lost() != 0)
      say(fmt::format("warning: the trace lacks {} rows: it could not be written as fast as it was "
                      "taken; trace fewer variables",
                      ring_->lost()));
    printValues(instance_.symbols(), printed_, instance_.state());
    for (const std::string &line : instance_.remarks())
      say(line);
    const std::optional<task::Fault> fault = instance_.tasks().fault();
    if (fault)
      say("error: " + task::describe(*fault));
    const std::optional<task::Fault> atEnd = instance_.exit(scheduler_.nowNs());
    if (atEnd)
      say("error: " + task::describe(*atEnd));
    if (!options_->quiet)
      showStatistics();
    return !fault && !atEnd;
  }

  void showStatistics() {
    const task::TaskSet &tasks = instance_.tasks();
    std::string text = statisticsTable(tasks);
    if (options_->histogram)
      for (uint32_t i = 0; i < tasks.count(); ++i)
        text += fmt::format("{}\n{}", tasks.desc(i).name, histogramText(tasks.statistics(i)));
    fmt::print(stderr, "{}", text);
  }

private:
  /// One line of an application among others carries its name.
  void say(const std::string &line) const {
    if (options_->applications.size() > 1)
      fmt::print(stderr, "{}: ", instance_.app().name);
    fmt::print(stderr, "{}\n", line);
  }

  const RunOptions *options_;
  Instance instance_;
  std::vector<app::Symbol> printed_;
  TraceWriter *trace_ = nullptr;
  std::unique_ptr<TraceRing> ring_;
  task::RealScheduler scheduler_; // its threads end before the rest goes
};

/// An application and its present session.
struct Slot {
  app::Application *application = nullptr;
  std::unique_ptr<Session> session;
  bool stopped = false; ///< For good, with an exception.
};

class Run {
public:
  Run(std::vector<app::Application> &applications, const RunOptions &options)
      : options_(options), report_(task::prepareRealtime()) {
    realOptions_.fifo = report_.fifo;
    realOptions_.turns = options.turns || !report_.fifo;
    const std::vector<uint32_t> cores = task::allowedCores();
    if (options.core && std::find(cores.begin(), cores.end(), *options.core) == cores.end())
      throw app::Error(fmt::format("--core {}: this process may not use that processor; it may use "
                                   "{}",
                                   *options.core, fmt::join(cores, ", ")));
    // Away from the first one, on which most of the machine's interrupts arrive.
    realOptions_.core = options.core ? *options.core : cores.empty() ? 0 : cores.back();
    for (app::Application &application : applications)
      slots_.push_back({&application, nullptr, false});
    for (Slot &slot : slots_)
      slot.session = newSession(slot);
    if (!options.trace.empty())
      trace_.emplace(app::SymbolTable(applications.front().description()), options.trace,
                     options.out);
    if (!options.quiet)
      for (const std::string &warning : report_.warnings)
        fmt::print(stderr, "warning: {}\n", warning);
  }

  ExitCode go() {
    ::sigset_t signals;
    ::sigemptyset(&signals);
    for (const int number : {SIGINT, SIGTERM, SIGUSR1})
      ::sigaddset(&signals, number);
    ::sigset_t before;
    ::pthread_sigmask(SIG_BLOCK, &signals, &before); // also for the tasks' threads
    for (Slot &slot : slots_)
      slot.stopped = !startSession(slot);
    const int64_t endNs =
        options_.durationNs > 0 ? task::monotonicNs() + options_.durationNs : INT64_MAX;
    while (someRun() && task::monotonicNs() < endNs) {
      const ::timespec round = {0, std::clamp<int64_t>(endNs - task::monotonicNs(), 0, kRoundNs)};
      const int number = ::sigtimedwait(&signals, nullptr, &round);
      if (number == SIGINT || number == SIGTERM)
        break;
      if (number == SIGUSR1)
        for (Slot &slot : slots_)
          slot.session->showStatistics();
      lookAfter();
    }
    bool good = true;
    for (Slot &slot : slots_)
      good = !slot.stopped && slot.session->finish() && good;
    if (trace_)
      trace_->finish();
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return good ? kExitOk : kExitException;
  }

private:
  std::unique_ptr<Session> newSession(const Slot &slot) {
    return std::make_unique<Session>(*slot.application, options_, realOptions_);
  }
  bool startSession(Slot &slot) { return slot.session->start(trace_ ? &*trace_ : nullptr); }
  bool someRun() const {
    return std::any_of(slots_.begin(), slots_.end(), [](const Slot &s) { return !s.stopped; });
  }

  void lookAfter() {
    for (Slot &slot : slots_) {
      if (slot.stopped)
        continue;
      slot.session->lookAfter();
      if (!slot.session->failed())
        continue;
      slot.session->finish();
      slot.stopped = true;
      if (options_.onFault == OnFault::Restart) {
        std::this_thread::sleep_for(kRestartPause);
        fmt::print(stderr, "note: '{}' is started again\n", slot.application->description().name);
        slot.session = newSession(slot);
        slot.stopped = !startSession(slot);
      }
    }
  }

  const RunOptions &options_;
  task::RealtimeReport report_;
  task::RealOptions realOptions_;
  std::optional<TraceWriter> trace_;
  std::vector<Slot> slots_;
};

} // namespace

ExitCode runReal(std::vector<app::Application> &applications, const RunOptions &options) {
  return Run(applications, options).go();
}

} // namespace stride::host
