#include "runtime/host/simulation.hpp"

#include "runtime/app/error.hpp"
#include "runtime/common/fnv.hpp"
#include "runtime/host/instance.hpp"
#include "runtime/host/online_change.hpp"
#include "runtime/host/print_values.hpp"
#include "runtime/host/recording.hpp"
#include "runtime/host/script_hook.hpp"
#include "runtime/host/set_list.hpp"
#include "runtime/host/st_backtrace.hpp"
#include "runtime/host/trace_writer.hpp"
#include "runtime/task/task_thread.hpp"
#include "runtime/task/virtual_scheduler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <limits>
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
  Progress(Messages &messages, int64_t endNs, bool enabled)
      : messages_(&messages), endNs_(endNs), enabled_(enabled) {}
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
    messages_->show(fmt::format(
        "\r\033[Ksimulated {:.1f} s of {:.1f} s ({:.0f} %), {:.0f} times real time", simulated,
        static_cast<double>(endNs_) * 1e-9,
        100.0 * static_cast<double>(timeNs) / static_cast<double>(endNs_), simulated / wall));
    shown_ = true;
  }
  void clear() {
    if (shown_)
      messages_->show("\r\033[K");
    shown_ = false;
  }
  double wall() const { return secondsSince(start_); }

private:
  Messages *messages_;
  Clock::time_point start_ = Clock::now();
  int64_t endNs_;
  double next_ = 0.5; // short runs show nothing
  uint64_t calls_ = 0;
  bool enabled_;
  bool shown_ = false;
};

/// Changes, sets and script before, trace and progress after each instant.
class Observer final : public task::InstantObserver {
public:
  Observer(Instance &instance, const std::vector<ChangeOption> &changes, SetList &sets,
           script::Script *script, TraceWriter *trace, Progress &progress, Messages &messages)
      : instance_(&instance), changes_(&changes), sets_(&sets), script_(script), trace_(trace),
        progress_(&progress), messages_(&messages) {}

  void beforeInstant(int64_t timeNs) override {
    for (; next_ < changes_->size() && (*changes_)[next_].timeNs <= timeNs; ++next_)
      change((*changes_)[next_].path, timeNs);
    sets_->apply(timeNs, instance_->state());
    if (script_ != nullptr)
      script_->step(timeNs, instance_->state());
  }
  void afterInstant(int64_t timeNs, bool fastest) override {
    if (trace_ != nullptr && fastest)
      trace_->row(timeNs, instance_->state());
    for (const std::string &line : instance_->takeNews()) {
      progress_->clear();
      messages_->say(line);
    }
    progress_->update(timeNs);
  }
  /// The builds whose time has not come.
  std::vector<std::string> changesLeft() const {
    std::vector<std::string> paths;
    for (size_t i = next_; i < changes_->size(); ++i)
      paths.push_back((*changes_)[i].path);
    return paths;
  }
  int64_t nextNs() const override {
    const int64_t change =
        next_ < changes_->size() ? (*changes_)[next_].timeNs : std::numeric_limits<int64_t>::max();
    const int64_t script =
        script_ != nullptr ? script_->nextNs() : std::numeric_limits<int64_t>::max();
    return std::min({sets_->nextNs(), change, script});
  }

private:
  void change(const std::string &path, int64_t timeNs) {
    progress_->clear();
    OnlineChange change(*instance_, path);
    if (change.verdict() == app::Verdict::Refused)
      throw app::Error(fmt::format("--change '{}': the application must be started anew: {}", path,
                                   change.report(false)));
    if (change.verdict() == app::Verdict::Losses)
      messages_->say(change.report(false));
    const app::SymbolTable symbols(change.fresh());
    sets_->resolveIn(symbols);
    if (script_ != nullptr) {
      script::Script script = script_->in(symbols);
      script_->takeOver(script);
    }
    if (trace_ != nullptr) {
      app::TraceColumns columns = trace_->columns().in(symbols);
      trace_->swapColumns(columns);
    }
    if (!change.apply(timeNs))
      throw app::Error(fmt::format("--change '{}': {}", path, change.events().front()));
    instance_->renewSymbols();
    for (const std::string &line : change.atNextStart())
      messages_->say({"warning: ", line});
    for (const std::string &event : change.events())
      messages_->say({"warning: ", event});
  }

  Instance *instance_;
  const std::vector<ChangeOption> *changes_;
  size_t next_ = 0;
  SetList *sets_;
  script::Script *script_;
  TraceWriter *trace_;
  Progress *progress_;
  Messages *messages_;
};

uint64_t hashOf(const std::byte *data, uint64_t size) {
  return common::Fnv1a<uint64_t>().add(std::span(data, size)).value();
}

std::string summaryOf(const task::TaskSet &tasks, const task::RunResult &result, double wall) {
  uint64_t cycles = 0;
  for (uint32_t i = 0; i < tasks.count(); ++i)
    cycles += tasks.statistics(i).figures().cycles;
  const double simulated = static_cast<double>(result.timeNs) * 1e-9;
  return fmt::format("{} cycles, {:g} s simulated in {:.3f} s ({:.0f} times real time)", cycles,
                     simulated, wall, wall > 0 ? simulated / wall : 0.0);
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

static task::RunResult advance(Instance &instance, Observer &observer, int64_t durationNs) {
  task::VirtualScheduler scheduler(instance.tasks());
  scheduler.setObserver(&observer);
  scheduler.setStopRequest([] { return stopRequested != 0; });
  return scheduler.runUntil(durationNs);
}

/// The cycles of a recorded run in their order.
static task::RunResult repeat(Replay &replay, Instance &instance, Observer &observer) {
  task::TaskSet &tasks = instance.tasks();
  task::RunResult result;
  const std::optional<task::Fault> &fault = replay.fault();
  const bool inLoop =
      fault &&
      (fault->exception.code() == ExceptionCode::EndlessLoop ||
       (fault->exception.code() == ExceptionCode::Watchdog && fault->exception.file() != nullptr));
  if (inLoop)
    tasks.repeatEndedLoop(*fault);
  while (const std::optional<RecordedCycle> cycle = replay.nextCycle()) {
    if (stopRequested != 0) {
      result.interrupted = true;
      break;
    }
    if (cycle->task >= tasks.count())
      break;
    if (cycle->stopped)
      tasks.stop();
    tasks.setMode(cycle->mode);
    if (cycle->takesModeOver)
      tasks.takeModeOver(cycle->task, cycle->startNs);
    else
      tasks.runCycle(cycle->task, cycle->startNs, 0);
    observer.afterInstant(cycle->startNs, cycle->task == tasks.fastest());
    result.timeNs = cycle->startNs;
  }
  if (!result.interrupted)
    replay.compareEnd(instance.application());
  // The watchdog is a matter of the real clock: nothing in the replay raises its exception.
  if (fault && !result.interrupted)
    tasks.fail(*fault);
  result.fault = tasks.fault();
  return result;
}

namespace {

/// An application in simulated time, from its input to what is said at the end.
class Simulation {
public:
  /// Everything that can be wrong with the input is found here, before the first cycle.
  Simulation(std::unique_ptr<app::Application> application, const SimOptions &options,
             Messages &messages);

  /// False: an exception has ended it, which was said.
  bool initialise();
  ExitCode run();

private:
  static SetList readSets(Instance &instance, const SimOptions &options);
  void addHooks();
  bool writeResults();
  void sayLeft(const Observer &observer) const;
  void sayOutcome(const task::RunResult &result, const Observer &observer) const;
  bool replayFailed() const { return replay_ && !replay_->problem().empty(); }

  const SimOptions &options_;
  Messages &messages_;
  Instance instance_;
  SetList sets_;
  std::optional<TraceWriter> trace_;
  std::optional<script::Script> script_;
  std::optional<Replay> replay_;
  std::optional<ScriptHook> scriptHook_;
};

/// Also sees that what is to be printed is there.
SetList Simulation::readSets(Instance &instance, const SimOptions &options) {
  if (options.changes.empty()) // else a later build may have what this one lacks
    for (const std::string &path : options.print)
      (void)instance.symbols().resolve(path);
  return SetList(instance.symbols(), options.sets);
}

Simulation::Simulation(std::unique_ptr<app::Application> application, const SimOptions &options,
                       Messages &messages)
    : options_(options), messages_(messages),
      instance_(std::move(application), task::LoopLimit::Budget),
      sets_(readSets(instance_, options)) {
  if (!options.files.empty())
    instance_.setFiles(options.files);
  instance_.recordBuses({options.canLog, options.canReplay});
  if (!options.retain.empty())
    instance_.retain({options.retain}, [&messages](std::string_view line) { messages.say(line); });
  if (options.loopBudget > 0)
    instance_.tasks().setLoopBudget(options.loopBudget);
  if (!options.trace.empty())
    trace_.emplace(instance_.symbols(), options.trace, options.out);
  if (!options.script.empty())
    script_.emplace(script::Script::fromFile(instance_.symbols(), options.script))
        .switchModeOf(instance_.tasks());
  if (!options.replay.empty()) {
    replay_.emplace(options.replay, instance_.application(), script_ ? &*script_ : nullptr);
    instance_.setInputs(*replay_);
  }
}

bool Simulation::initialise() {
  try {
    instance_.initialise();
  } catch (const StException &exception) {
    for (const std::string &line : instance_.takeNews())
      messages_.say(line);
    const task::Fault fault{exception, "initialisation", 0, 0};
    messages_.say({"error: ", describeWithCalls(fault)});
    return false;
  }
  addHooks();
  return true;
}

/// A replay goes through the cycles of a run, in which the script was a hook.
void Simulation::addHooks() {
  if (script_) {
    if (replay_)
      instance_.tasks().addHook(instance_.tasks().fastest(), scriptHook_.emplace(*script_));
    instance_.addToAllTasks(script_->forces());
  }
  if (replay_) {
    replay_->addHooks(instance_.tasks());
    replay_->restoreState(instance_.application());
  }
}

/// Finishes the trace and prints; false: something could not be written, which was said.
bool Simulation::writeResults() {
  bool complete = !trace_ || trace_->finish();
  if (!complete)
    messages_.say({"error: ", trace_->problem()});
  std::string printed = printedValues(instance_.symbols(), options_.print, instance_.state());
  if (options_.stateHash)
    printed += fmt::format("state {:016x}\n", hashOf(instance_.state(), instance_.app().stateSize));
  if (const int error = print(printed, Output::Wait::Always); error != 0) {
    complete = false;
    messages_.say({"error: standard output cannot be written: ", ::strerrordesc_np(error)});
  }
  return complete;
}

/// What was to be done later than the end.
void Simulation::sayLeft(const Observer &observer) const {
  for (const std::string &left : sets_.left())
    messages_.say({"warning: --set '", left, "' was not used: the run ends before"});
  for (const std::string &left : observer.changesLeft())
    messages_.say({"warning: --change '", left, "' was not done: the run ends before"});
  if (script_)
    for (const std::string &line : script_->remarks())
      messages_.say(line);
}

void Simulation::sayOutcome(const task::RunResult &result, const Observer &observer) const {
  for (const std::string &line : instance_.remarks())
    messages_.say(line);
  if (replayFailed())
    messages_.say({"error: ", replay_->problem()});
  if (result.fault)
    messages_.say({"error: ", describeWithCalls(*result.fault)});
  else if (!result.interrupted)
    sayLeft(observer);
}

ExitCode Simulation::run() {
  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  Progress progress(messages_, options_.durationNs, terminal && !options_.quiet && !replay_);
  Observer observer(instance_, options_.changes, sets_, script_ ? &*script_ : nullptr,
                    trace_ ? &*trace_ : nullptr, progress, messages_);
  const task::RunResult result = replay_ ? repeat(*replay_, instance_, observer)
                                         : advance(instance_, observer, options_.durationNs);
  const double wall = progress.wall();
  progress.clear();

  bool complete = writeResults();
  sayOutcome(result, observer);
  const std::optional<task::Fault> atEnd = instance_.exit(result.timeNs);
  for (const std::string &line : instance_.takeNews())
    messages_.say(line);
  if (atEnd)
    messages_.say({"error: ", describeWithCalls(*atEnd)});
  if (RetainKeeper *const retain = instance_.retainKeeper())
    complete = retain->finish() && complete;
  if ((terminal || options_.summary) && !options_.quiet)
    messages_.say(summaryOf(instance_.tasks(), result, wall));
  if (replayFailed())
    return kExitBadInput;
  if (result.fault || atEnd)
    return kExitException;
  if (result.interrupted)
    return kExitInterrupted;
  return complete ? kExitOk : kExitIncomplete;
}

} // namespace

static ExitCode simulateHere(std::unique_ptr<app::Application> application,
                             const SimOptions &options, Messages &messages) {
  Simulation simulation(std::move(application), options, messages);
  const task::MemoryGuard guard;
  const StopSignals signals;
  return simulation.initialise() ? simulation.run() : kExitException;
}

ExitCode simulate(std::unique_ptr<app::Application> application, const SimOptions &options,
                  Messages &messages) {
  ExitCode code = kExitOk;
  task::runOnTaskThread([&] { code = simulateHere(std::move(application), options, messages); });
  return code;
}

} // namespace stride::host
