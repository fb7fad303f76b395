#include "runtime/host/real_run.hpp"

#include "runtime/app/error.hpp"
#include "runtime/host/application_options.hpp"
#include "runtime/host/session.hpp"
#include "runtime/host/statistics_text.hpp"
#include "runtime/host/status_line.hpp"
#include "runtime/monitor/socket_server.hpp"
#include "runtime/task/realtime.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstring>
#include <ctime>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <unistd.h>

namespace stride::host {

namespace {

/// How often the main thread looks after traces and faults.
constexpr long kRoundNs = 20'000'000;
constexpr auto kRestartPause = std::chrono::seconds(1);

/// An application's file and its present session.
struct Slot {
  /// Where an online change finds the new build; empty: it is linked into this program.
  std::string path;
  std::unique_ptr<TraceWriter> trace; ///< Null: none of it is traced.
  std::unique_ptr<Session> session;
  bool stopped = false; ///< For good, with an exception.
  bool good = true;     ///< How the last session has ended.
};

/// Who waits for an online change.
struct AskedChange {
  monitor::Service::Ticket who;
  bool acceptLosses = false; ///< Also when values are lost.
};

class Run {
public:
  Run(std::vector<std::unique_ptr<app::Application>> applications, const RunOptions &options,
      Messages &messages)
      : options_(options), messages_(messages), change_(messages, "the online change"),
        monitor_(messages, "the monitor"), showing_(messages, "the status line"),
        ending_(messages, "the end of the run", ""), status_(messages, wantsStatus(options)),
        report_(task::prepareRealtime()) {
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
    for (size_t i = 0; i < applications.size(); ++i) {
      std::unique_ptr<TraceWriter> trace;
      if (!own_[i].trace.empty())
        trace = std::make_unique<TraceWriter>(app::SymbolTable(applications[i]->description()),
                                              own_[i].trace, own_[i].out, Output::Wait::Never);
      const bool isFile = i < options.applications.size();
      slots_.push_back({!options.latest.empty() ? options.latest
                        : isFile                ? options.applications[i]
                                                : std::string(),
                        std::move(trace), newSession(std::move(applications[i]), i)});
    }
    if (!options.listen.empty())
      listen();
    if (!options.quiet)
      for (const std::string &warning : report_.warnings)
        messages_.say({"warning: ", warning});
  }

  ExitCode go() {
    // Never taken back: whatever comes while the run ends has come too late. Also for the tasks'
    // threads.
    ::sigset_t signals;
    ::sigemptyset(&signals);
    for (const int number : {SIGINT, SIGTERM, SIGUSR1, SIGHUP})
      ::sigaddset(&signals, number);
    ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    for (Slot &slot : slots_)
      slot.stopped = !startSession(slot);
    if (listener_)
      monitor_([this] { listener_->start(); });
    const int64_t endNs =
        options_.durationNs > 0 ? task::monotonicNs() + options_.durationNs : INT64_MAX;
    while (someRun() && task::monotonicNs() < endNs) {
      const ::timespec round = {0, std::clamp<int64_t>(endNs - task::monotonicNs(), 0, kRoundNs)};
      const int number = ::sigtimedwait(&signals, nullptr, &round);
      if (number == SIGINT || number == SIGTERM || toEnd())
        break;
      serve(number);
      lookAfter();
      if (const int64_t now = task::monotonicNs(); status_.due(now))
        showing_([&] { status_.show(now, namedTasks()); });
    }
    status_.clear();
    return end();
  }

private:
  void listen() {
    listener_ = std::make_unique<monitor::SocketServer>(options_.listen);
    listener_->service().addOperation("end", [this](const nlohmann::json &) {
      stopAsked_.store(true);
      return nlohmann::json::object();
    });
    listener_->service().addLateOperation(
        "online_change", [this](monitor::Service::Ticket who, const nlohmann::json &request) {
          const auto accept = request.find("accept_losses");
          const bool isGiven = accept != request.end();
          if (isGiven && !accept->is_boolean())
            throw monitor::ServiceError{"bad_request", "'accept_losses' is true or false"};
          const std::lock_guard lock(askedMutex_);
          asked_.push_back({std::move(who), isGiven && accept->get<bool>()});
        });
  }
  /// What others have asked for, by a signal or through the monitor.
  void serve(int signal) noexcept {
    if (signal == SIGUSR1)
      for (Slot &slot : slots_)
        if (slot.session)
          slot.session->showStatistics();
    if (signal == SIGHUP)
      change_([this] { static_cast<void>(changeAll(false)); });
    for (const AskedChange &asked : takeAsked())
      if (!change_(
              [&] { listener_->service().answerLate(asked.who, changeAll(asked.acceptLosses)); }))
        monitor_([&] {
          listener_->service().refuseLate(asked.who, {"refused", "the online change has failed"});
        });
  }
  /// Also while so many other signals come that they are never all taken.
  bool toEnd() const noexcept {
    ::sigset_t waiting;
    ::sigpending(&waiting);
    return stopAsked_.load() || ::sigismember(&waiting, SIGINT) == 1 ||
           ::sigismember(&waiting, SIGTERM) == 1;
  }

  ExitCode end() noexcept {
    monitor_([this] {
      for (const AskedChange &asked : takeAsked())
        listener_->service().refuseLate(asked.who, {"gone", "the run is ending"});
    });
    bool good = true;
    for (Slot &slot : slots_) {
      good = !slot.stopped && good;
      if (!slot.stopped)
        finish(slot);
      good = slot.good && good;
    }
    for (const Slot &slot : slots_)
      if (slot.trace && !slot.trace->finish()) {
        complete_ = false;
        ending_([&] { messages_.say({"error: ", slot.trace->problem()}); });
      }
    if (!options_.statistics.empty())
      complete_ = ending_([this] { writeStatistics(); }) && complete_;
    return !good ? kExitException : complete_ ? kExitOk : kExitIncomplete;
  }
  void finish(Slot &slot) noexcept {
    const Ending ending = slot.session->finish();
    slot.good = ending.good;
    complete_ = ending.complete && complete_;
  }

  static void checkCores(const StrideAppV1 &app, const std::vector<uint32_t> &cores) {
    for (uint32_t i = 0; i < app.taskCount; ++i)
      if (const uint32_t core = app.tasks[i].core;
          core != kNoIndex && std::find(cores.begin(), cores.end(), core) == cores.end())
        throw app::Error(fmt::format("task '{}' wants processor {}; this process may use {}",
                                     app.tasks[i].name, core, fmt::join(cores, ", ")));
  }

  std::unique_ptr<Session> newSession(std::unique_ptr<app::Application> application,
                                      size_t number) {
    return std::make_unique<Session>(std::move(application), number, options_, own_[number],
                                     realOptions_, messages_);
  }
  bool startSession(Slot &slot) {
    return slot.session->start(slot.trace.get(), listener_ ? &listener_->service() : nullptr);
  }

  /// By application: whether it was done, what there is to say, the pause.
  nlohmann::json changeAll(bool acceptLosses) {
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
        result = slot.session->change(slot.path, acceptLosses);
      results.push_back({{"name", slot.session->name()},
                         {"result", result.done ? "done" : "refused"},
                         {"report", result.report},
                         {"pause_ns", result.pauseNs}});
    }
    return {{"applications", std::move(results)}};
  }
  std::vector<AskedChange> takeAsked() noexcept {
    const std::lock_guard lock(askedMutex_);
    return std::exchange(asked_, {});
  }

  std::vector<NamedTasks> namedTasks() const {
    std::vector<NamedTasks> all;
    for (const Slot &slot : slots_)
      if (slot.session)
        all.push_back({slot.session->name(), &slot.session->tasks()});
    return all;
  }
  /// Unless rows of a trace come to the same terminal.
  static bool wantsStatus(const RunOptions &options) {
    const bool rowsShown = !options.trace.empty() && (options.out.empty() || options.out == "-") &&
                           ::isatty(STDOUT_FILENO) != 0;
    return !options.quiet && !rowsShown;
  }

  void writeStatistics() {
    const std::string text = statisticsJson(namedTasks());
    Output output(options_.statistics, text.size(), Output::Wait::Never);
    output.append(text);
    if (!output.finish())
      throw app::Error(
          fmt::format("cannot write '{}': {}", options_.statistics,
                      output.error() != 0 ? std::strerror(output.error()) : "nobody reads it"));
  }
  bool someRun() const {
    return std::any_of(slots_.begin(), slots_.end(), [](const Slot &s) { return !s.stopped; });
  }

  void lookAfter() noexcept {
    messages_.lookAfter();
    for (Slot &slot : slots_) {
      if (slot.stopped)
        continue;
      slot.session->lookAfter();
      if (!slot.session->failed())
        continue;
      finish(slot);
      slot.stopped = true;
      if (options_.onFault == OnFault::Restart) {
        std::this_thread::sleep_for(kRestartPause);
        restart(slot);
      }
    }
  }

  /// Starts it anew; what keeps it from that leaves the others alone.
  void restart(Slot &slot) noexcept {
    try {
      std::unique_ptr<app::Application> application = slot.session->release();
      messages_.say({"note: '", application->name(), "' is started again"});
      slot.session.reset(); // gives its retained data up
      slot.session = newSession(std::move(application), static_cast<size_t>(&slot - slots_.data()));
      slot.stopped = !startSession(slot);
    } catch (const std::exception &error) {
      messages_.say({"error: it cannot be started again: ", error.what()});
    }
  }

  const RunOptions &options_;
  Messages &messages_;
  Aside change_;
  Aside monitor_;
  Aside showing_;
  Aside ending_;
  StatusLine status_;
  bool complete_ = true; ///< All output that was asked for is there.
  task::RealtimeReport report_;
  task::NoDeepSleep awake_;
  task::RealOptions realOptions_;
  std::vector<ApplicationOptions> own_; ///< By application.
  std::vector<Slot> slots_;
  std::atomic<bool> stopAsked_{false};
  std::mutex askedMutex_;
  std::vector<AskedChange> asked_;
  std::unique_ptr<monitor::SocketServer> listener_; // ends before what it serves
};

} // namespace

ExitCode runReal(std::vector<std::unique_ptr<app::Application>> applications,
                 const RunOptions &options, Messages &messages) {
  return Run(std::move(applications), options, messages).go();
}

} // namespace stride::host
