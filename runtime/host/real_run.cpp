#include "runtime/host/real_run.hpp"

#include "runtime/app/error.hpp"
#include "runtime/host/application_options.hpp"
#include "runtime/host/instance.hpp"
#include "runtime/host/online_change.hpp"
#include "runtime/host/print_values.hpp"
#include "runtime/host/recording.hpp"
#include "runtime/host/script_hook.hpp"
#include "runtime/host/st_backtrace.hpp"
#include "runtime/host/statistics_text.hpp"
#include "runtime/host/trace_ring.hpp"
#include "runtime/monitor/socket_server.hpp"
#include "runtime/task/real_scheduler.hpp"
#include "runtime/task/realtime.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace stride::host {

namespace {

/// How often the main thread looks after traces and faults.
constexpr long kRoundNs = 20'000'000;
constexpr std::size_t kTraceBytes = std::size_t{16} << 20;
constexpr auto kRestartPause = std::chrono::seconds(1);

/// What came of an online change.
struct ChangeResult {
  bool done = false;
  std::vector<std::string> report; ///< What was said about it.
  int64_t pauseNs = 0;             ///< In which no cycle could begin.
};

/// One application from its start to its stop.
class Session {
public:
  /// `number`: of the application among those of the run. Throws app::Error for bad input.
  Session(std::unique_ptr<app::Application> application, std::size_t number,
          const RunOptions &options, const ApplicationOptions &own,
          const task::RealOptions &realOptions)
      : options_(&options), own_(&own), number_(number), name_(application->name()),
        instance_(std::move(application), task::LoopLimit::Clock),
        scheduler_(instance_.tasks(), realOptions) {
    for (const std::string &path : own.print)
      (void)instance_.symbols().resolve(path);
    const StrideAppV1 &app = instance_.app();
    if (!options.files.empty())
      instance_.setFiles(options.files);
    RetainSettings retain = retainSettings(app);
    if (!options.retain.empty())
      retain.file = options.retain;
    if (retain.file.empty())
      retain.file = name_ + ".retain";
    instance_.retain(retain, [this](const std::string &line) { say(line); });
    if (!own.script.empty()) {
      script_.emplace(monitor::Script::fromFile(instance_.symbols(), own.script));
      scriptHook_.emplace(*script_);
    }
  }

  /// `trace` and `service` may be null. False: an initialiser has failed, which has been said.
  bool start(TraceWriter *trace, monitor::Service *service) {
    try {
      if (service != nullptr) {
        served_ = std::make_unique<monitor::SymbolServer>(instance_.tasks());
        served_->addOuterHooks();
      }
      // First of all hooks, so that it sees the end of the cycle behind the others.
      if (trace != nullptr) {
        const TraceColumns &columns = trace->columns();
        trace_ = trace;
        ring_ = std::make_unique<TraceRing>(columns, kTraceBytes / columns.rowSize());
        instance_.tasks().addHook(instance_.tasks().fastest(), *ring_);
      }
      if (!options_->record.empty()) {
        recording_ = std::make_unique<Recording>(options_->record);
        recording_->addHooks(instance_.tasks());
        instance_.setInputs(*recording_);
      }
      onLowStack([this] { instance_.initialise(); });
      if (recording_)
        recording_->begin(instance_.application(), script_ ? &*script_ : nullptr);
      if (script_) {
        instance_.tasks().addHook(instance_.tasks().fastest(), *scriptHook_);
        instance_.addToAllTasks(script_->forces());
      }
      if (served_)
        served_->addInnerHooks();
      if (served_ && recording_)
        served_->setWriteLog(*recording_);
    } catch (const StException &exception) {
      say("error: " + describeWithCalls(task::Fault{exception, "initialisation", 0, 0}));
      return false;
    }
    instance_.retainKeeper()->startSaving();
    scheduler_.start();
    if (service != nullptr) {
      service_ = service;
      service_->attach(number_, {instance_.app().name, served_.get(), &instance_.tasks(),
                                 [this] { return scheduler_.nowNs(); }});
    }
    return true;
  }

  void lookAfter() {
    instance_.lookAfter();
    for (const std::string &line : instance_.takeNews())
      say(line);
    if (ring_)
      ring_->drain(*trace_);
    if (recording_)
      recording_->drain();
  }
  bool failed() { return instance_.tasks().fault().has_value(); }

  /// The application in this file takes over, or it is said why not.
  ChangeResult change(const std::string &path) {
    ChangeResult result;
    const auto tell = [&](const std::string &line) {
      say(line);
      result.report.push_back(line);
    };
    if (recording_) {
      tell("error: no online change during a recording; the old build goes on");
      return result;
    }
    try {
      std::optional<OnlineChange> loaded;
      onLowStack([&] { loaded.emplace(instance_, path); });
      OnlineChange &change = *loaded;
      if (!isWelcome(change, tell))
        return result;
      const app::SymbolTable symbols(change.fresh());
      for (const std::string &name : own_->print)
        (void)symbols.resolve(name);
      std::optional<TraceColumns> columns;
      if (trace_ != nullptr)
        columns = trace_->columns().in(symbols);
      std::optional<monitor::Script> script;
      if (script_)
        script.emplace(script_->in(symbols));
      auto servedSymbols = std::make_unique<app::SymbolTable>(change.fresh());
      std::unique_lock<std::mutex> held;
      if (service_ != nullptr)
        held = service_->hold();
      std::optional<monitor::SymbolServer::Change> served;
      if (served_)
        served.emplace(served_->prepareChange(std::move(servedSymbols)));
      bool done = false;
      onLowStack([&] { // for FB_Exit and FB_Reinit
        if (scheduler_.options().fifo)
          task::useFifo(0);
        result.pauseNs = scheduler_.betweenCycles([&] {
          done = !instance_.tasks().stopped() && change.apply(scheduler_.nowNs());
          if (done && columns)
            trace_->swapColumns(*columns);
          if (done && script)
            script_->takeOver(*script);
          if (done && served)
            served_->changeApplication(*served);
        });
      });
      lookAfter();
      if (done)
        instance_.renewSymbols();
      for (const std::string &line : change.atNextStart())
        if (done)
          tell("warning: online change: " + line);
      for (const std::string &event : change.events())
        tell("warning: online change: " + event);
      for (std::size_t i = 0; done && served && i < served->lostForces().size(); ++i)
        tell(fmt::format("warning: online change: '{}' is no longer forced: the new build has no "
                         "such variable",
                         served->lostForces()[i]));
      tell(done ? fmt::format("note: online change done; no cycle could begin for {:.0f} us",
                              static_cast<double>(result.pauseNs) * 1e-3)
                : "error: online change given up; the old build goes on");
      result.done = done;
    } catch (const app::Error &error) {
      tell(fmt::format("error: online change: {}; the old build goes on", error.what()));
    }
    return result;
  }

  /// Stops and says what there is to say; false: with an exception.
  bool finish() {
    if (!scheduler_.finish([this] { lookAfter(); }))
      say("warning: not everything came to rest within a minute");
    if (service_ != nullptr)
      service_->detach(number_);
    lookAfter();
    if (recording_)
      if (const std::string problem = recording_->finish(instance_.tasks().fault());
          !problem.empty())
        say("warning: " + problem);
    if (ring_ && ring_->lost() != 0)
      say(fmt::format("warning: the trace lacks {} rows: it could not be written as fast as it was "
                      "taken; trace fewer variables",
                      ring_->lost()));
    printValues(instance_.symbols(), own_->print, instance_.state());
    for (const std::string &line : instance_.remarks())
      say(line);
    if (script_)
      for (const std::string &line : script_->remarks())
        say(line);
    const std::optional<task::Fault> fault = instance_.tasks().fault();
    if (fault)
      say("error: " + describeWithCalls(*fault));
    const std::optional<task::Fault> atEnd = exitInstances();
    lookAfter();
    if (atEnd)
      say("error: " + describeWithCalls(*atEnd));
    static_cast<void>(instance_.retainKeeper()->finish());
    if (!options_->quiet)
      showStatistics();
    return !fault && !atEnd;
  }
  std::unique_ptr<app::Application> release() { return instance_.release(); }

  void showStatistics() {
    const task::TaskSet &tasks = instance_.tasks();
    std::string text = options_->applications.size() > 1 ? name_ + ":\n" : std::string();
    text += statisticsTable(tasks);
    if (options_->histogram)
      for (uint32_t i = 0; i < tasks.count(); ++i)
        text += fmt::format("{}\n{}", tasks.desc(i).name, histogramText(tasks.statistics(i)));
    fmt::print(stderr, "{}", text);
  }

  const task::TaskSet &tasks() { return instance_.tasks(); }
  const std::string &name() const { return name_; }

private:
  /// One line of an application among others carries its name.
  void say(const std::string &line) const {
    if (options_->applications.size() > 1)
      fmt::print(stderr, "{}: ", name_); // also from the thread that saves retained data
    fmt::print(stderr, "{}\n", line);
  }

  bool isWelcome(const OnlineChange &change,
                 const std::function<void(const std::string &)> &tell) const {
    switch (change.verdict()) {
    case app::Verdict::Silent:
      return true;
    case app::Verdict::Losses:
      tell("note: online change with losses\n" + change.report(false));
      if (options_->acceptLosses)
        return true;
      tell("error: online change refused: values would be lost; --accept-losses allows that");
      return false;
    case app::Verdict::Refused:
      tell("error: online change refused, the application must be started anew\n" +
           change.report(false));
      return false;
    }
    return false;
  }

  /// Code of the application runs on such a stack and with signals as its tasks.
  static void onLowStack(const std::function<void()> &function) {
    task::runOnTaskThread([&] {
      const task::MemoryGuard guard;
      function();
    });
  }

  std::optional<task::Fault> exitInstances() {
    std::optional<task::Fault> fault;
    const int64_t now = scheduler_.nowNs();
    onLowStack([&] { fault = instance_.exit(now); });
    return fault;
  }

  const RunOptions *options_;
  const ApplicationOptions *own_;
  std::size_t number_;
  std::string name_;
  Instance instance_;
  TraceWriter *trace_ = nullptr;
  std::unique_ptr<TraceRing> ring_;
  std::unique_ptr<Recording> recording_;
  std::optional<monitor::Script> script_;
  std::optional<ScriptHook> scriptHook_;
  std::unique_ptr<monitor::SymbolServer> served_;
  monitor::Service *service_ = nullptr;
  task::RealScheduler scheduler_; // its threads end before the rest goes
};

/// An application's file and its present session.
struct Slot {
  /// Where an online change finds the new build; empty: it is linked into this program.
  std::string path;
  std::unique_ptr<TraceWriter> trace; ///< Null: none of it is traced.
  std::unique_ptr<Session> session;
  bool stopped = false; ///< For good, with an exception.
};

class Run {
public:
  Run(std::vector<std::unique_ptr<app::Application>> applications, const RunOptions &options)
      : options_(options), report_(task::prepareRealtime()) {
    realOptions_.fifo = report_.fifo;
    realOptions_.turns = options.turns || !options.record.empty() || !report_.fifo;
    const std::vector<uint32_t> cores = task::allowedCores();
    for (const std::unique_ptr<app::Application> &application : applications)
      checkCores(application->description(), cores);
    if (options.core && std::find(cores.begin(), cores.end(), *options.core) == cores.end())
      throw app::Error(fmt::format("--core {}: this process may not use that processor; it may use "
                                   "{}",
                                   *options.core, fmt::join(cores, ", ")));
    // Away from the first one, on which most of the machine's interrupts arrive.
    realOptions_.core = options.core ? *options.core : cores.empty() ? 0 : cores.back();
    own_ = optionsByApplication(applications, options);
    for (std::size_t i = 0; i < applications.size(); ++i) {
      std::unique_ptr<TraceWriter> trace;
      if (!own_[i].trace.empty())
        trace = std::make_unique<TraceWriter>(app::SymbolTable(applications[i]->description()),
                                              own_[i].trace, own_[i].out);
      const bool isFile = i < options.applications.size();
      slots_.push_back({!options.latest.empty() ? options.latest
                        : isFile                ? options.applications[i]
                                                : std::string(),
                        std::move(trace), newSession(std::move(applications[i]), i), false});
    }
    if (!options.listen.empty()) {
      listener_ = std::make_unique<monitor::SocketServer>(options.listen);
      listener_->service().addOperation("stop", [this](const nlohmann::json &) {
        stopAsked_.store(true);
        return nlohmann::json::object();
      });
      listener_->service().addLateOperation("online_change", [this](monitor::Service::Ticket who) {
        const std::lock_guard lock(askedMutex_);
        asked_.push_back(std::move(who));
      });
    }
    if (!options.quiet)
      for (const std::string &warning : report_.warnings)
        fmt::print(stderr, "warning: {}\n", warning);
  }

  ExitCode go() {
    ::sigset_t signals;
    ::sigemptyset(&signals);
    for (const int number : {SIGINT, SIGTERM, SIGUSR1, SIGHUP})
      ::sigaddset(&signals, number);
    ::sigset_t before;
    ::pthread_sigmask(SIG_BLOCK, &signals, &before); // also for the tasks' threads
    for (Slot &slot : slots_)
      slot.stopped = !startSession(slot);
    if (listener_)
      listener_->start();
    const int64_t endNs =
        options_.durationNs > 0 ? task::monotonicNs() + options_.durationNs : INT64_MAX;
    while (someRun() && task::monotonicNs() < endNs) {
      const ::timespec round = {0, std::clamp<int64_t>(endNs - task::monotonicNs(), 0, kRoundNs)};
      const int number = ::sigtimedwait(&signals, nullptr, &round);
      if (number == SIGINT || number == SIGTERM || stopAsked_.load())
        break;
      if (number == SIGUSR1)
        for (Slot &slot : slots_)
          if (slot.session)
            slot.session->showStatistics();
      if (number == SIGHUP)
        static_cast<void>(changeAll());
      for (const monitor::Service::Ticket &who : takeAsked())
        listener_->service().answerLate(who, changeAll());
      lookAfter();
    }
    for (const monitor::Service::Ticket &who : takeAsked())
      listener_->service().refuseLate(who, {"gone", "the run is ending"});
    bool good = true;
    for (Slot &slot : slots_)
      good = !slot.stopped && slot.session->finish() && good;
    for (const Slot &slot : slots_)
      if (slot.trace)
        slot.trace->finish();
    if (!options_.statistics.empty())
      writeStatistics();
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return good ? kExitOk : kExitException;
  }

private:
  static void checkCores(const StrideAppV1 &app, const std::vector<uint32_t> &cores) {
    for (uint32_t i = 0; i < app.taskCount; ++i)
      if (const uint32_t core = app.tasks[i].core;
          core != kNoIndex && std::find(cores.begin(), cores.end(), core) == cores.end())
        throw app::Error(fmt::format("task '{}' wants processor {}; this process may use {}",
                                     app.tasks[i].name, core, fmt::join(cores, ", ")));
  }

  std::unique_ptr<Session> newSession(std::unique_ptr<app::Application> application,
                                      std::size_t number) {
    return std::make_unique<Session>(std::move(application), number, options_, own_[number],
                                     realOptions_);
  }
  bool startSession(Slot &slot) {
    return slot.session->start(slot.trace.get(), listener_ ? &listener_->service() : nullptr);
  }

  /// By application: whether it was done, what there is to say, the pause.
  nlohmann::json changeAll() {
    nlohmann::json results = nlohmann::json::array();
    for (Slot &slot : slots_) {
      if (!slot.session)
        continue; // it could not be started again
      ChangeResult result;
      if (slot.stopped)
        result.report = {"error: no online change: the application does not run any more"};
      else if (slot.path.empty())
        result.report = {"error: no online change: the application is linked into the program"};
      else
        result = slot.session->change(slot.path);
      results.push_back({{"name", slot.session->name()},
                         {"result", result.done ? "done" : "refused"},
                         {"report", result.report},
                         {"pause_ns", result.pauseNs}});
    }
    return {{"applications", std::move(results)}};
  }
  std::vector<monitor::Service::Ticket> takeAsked() {
    const std::lock_guard lock(askedMutex_);
    return std::exchange(asked_, {});
  }

  void writeStatistics() {
    std::vector<NamedTasks> all;
    for (const Slot &slot : slots_)
      if (slot.session)
        all.push_back({slot.session->name(), &slot.session->tasks()});
    const std::string text = statisticsJson(all);
    const std::string &path = options_.statistics;
    std::FILE *file = std::fopen(path.c_str(), "wb");
    const bool written =
        file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
    if ((file != nullptr && std::fclose(file) != 0) || !written)
      throw app::Error(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
  }
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
        restart(slot);
      }
    }
  }

  /// Starts it anew; what keeps it from that leaves the others alone.
  void restart(Slot &slot) {
    try {
      std::unique_ptr<app::Application> application = slot.session->release();
      fmt::print(stderr, "note: '{}' is started again\n", application->name());
      slot.session.reset(); // gives its retained data up
      slot.session =
          newSession(std::move(application), static_cast<std::size_t>(&slot - slots_.data()));
      slot.stopped = !startSession(slot);
    } catch (const app::Error &error) {
      fmt::print(stderr, "error: it cannot be started again: {}\n", error.what());
    }
  }

  const RunOptions &options_;
  task::RealtimeReport report_;
  task::NoDeepSleep awake_;
  task::RealOptions realOptions_;
  std::vector<ApplicationOptions> own_; ///< By application.
  std::vector<Slot> slots_;
  std::atomic<bool> stopAsked_{false};
  std::mutex askedMutex_;
  std::vector<monitor::Service::Ticket> asked_;     ///< Who waits for an online change.
  std::unique_ptr<monitor::SocketServer> listener_; // ends before what it serves
};

} // namespace

ExitCode runReal(std::vector<std::unique_ptr<app::Application>> applications,
                 const RunOptions &options) {
  return Run(std::move(applications), options).go();
}

} // namespace stride::host
