#include "runtime/host/session.hpp"

#include "runtime/app/error.hpp"
#include "runtime/host/print_values.hpp"
#include "runtime/host/st_backtrace.hpp"
#include "runtime/host/statistics_text.hpp"
#include "runtime/task/realtime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <utility>

namespace stride::host {

namespace {

constexpr size_t kTraceBytes = size_t{16} << 20;

/// Code of the application runs on such a stack and with signals as its tasks.
void onLowStack(const std::function<void()> &function) {
  task::runOnTaskThread([&] {
    const task::MemoryGuard guard;
    function();
  });
}

} // namespace

Session::Session(std::unique_ptr<app::Application> application, size_t number,
                 const RunOptions &options, const ApplicationOptions &own,
                 const task::RealOptions &realOptions, Messages &messages)
    : messages_(&messages), options_(&options), own_(&own), number_(number),
      name_(application->name()), files_(messages, "the program's files"),
      news_(messages, "messages of the program and its devices"), writing_(messages, "the trace"),
      monitor_(messages, "the monitor"), showing_(messages, "the statistics"),
      ending_(messages, "the end of the run", ""),
      instance_(std::move(application), task::LoopLimit::Clock),
      scheduler_(instance_.tasks(), realOptions) {
  for (const std::string &path : own.print)
    (void)instance_.symbols().resolve(path);
  const StrideAppV1 &app = instance_.app();
  if (!options.files.empty())
    instance_.setFiles(options.files);
  instance_.useRealBuses();
  instance_.recordBuses({options.canLog, {}});
  RetainSettings retain = retainSettings(app);
  if (!options.retain.empty())
    retain.file = options.retain;
  if (retain.file.empty())
    retain.file = name_ + ".retain";
  instance_.retain(retain, [this](std::string_view line) { say(line); });
  if (!own.script.empty()) {
    script_.emplace(script::Script::fromFile(instance_.symbols(), own.script))
        .switchModeOf(instance_.tasks());
    scriptHook_.emplace(*script_);
  }
}

bool Session::start(TraceWriter *trace, monitor::Service *service) {
  try {
    if (service != nullptr) {
      served_ = std::make_unique<monitor::SymbolServer>(instance_.tasks());
      served_->addOuterHooks();
    }
    // First of all hooks, so that it sees the end of the cycle after the others.
    if (trace != nullptr) {
      const app::TraceColumns &columns = trace->columns();
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
    for (const std::string &line : instance_.takeNews())
      say(line);
    sayFault(task::Fault{exception, "initialisation", 0, 0});
    return false;
  }
  instance_.retainKeeper()->startSaving();
  scheduler_.start();
  // From here on there are axes to serve.
  if (service != nullptr && monitor_([&] {
        service->attach(number_, {name_, served_.get(), &instance_.tasks(),
                                  [this] { return scheduler_.nowNs(); }});
      }))
    service_ = service;
  return true;
}

void Session::lookAfter() noexcept {
  files_([this] { instance_.lookAfter(); });
  news_([this] {
    for (const std::string &line : instance_.takeNews())
      say(line);
  });
  if (recording_)
    recording_->drain();
  if (!ring_)
    return;
  ring_->drain(*trace_);
  writing_([this] {
    if (const std::string problem = traceFailed_ ? std::string() : trace_->problem();
        !problem.empty()) {
      traceFailed_ = true;
      say("warning: " + problem + "; the run goes on without it");
    }
  });
}

ChangeResult Session::change(const std::string &path, bool acceptLosses) {
  ChangeResult result;
  const Tell tell = [&](const std::string &line) {
    say(line);
    result.report.push_back(line);
  };
  if (recording_) {
    tell("error: no online change during a recording; the old build goes on");
    return result;
  }
  const auto failed = [&](const char *reason) {
    tell(result.done ? fmt::format("warning: online change: {}", reason)
                     : fmt::format("error: online change: {}; the old build goes on", reason));
  };
  try {
    std::optional<OnlineChange> change;
    onLowStack([&] { change.emplace(instance_, path); });
    if (isWelcome(*change, acceptLosses || options_->acceptLosses, tell))
      takeOver(*change, result, tell);
  } catch (const std::bad_alloc &) {
    failed("there is not enough memory");
  } catch (const std::exception &error) {
    failed(error.what());
  }
  return result;
}

void Session::takeOver(OnlineChange &change, ChangeResult &result, const Tell &tell) {
  const app::SymbolTable symbols(change.fresh());
  for (const std::string &name : own_->print)
    (void)symbols.resolve(name);
  std::optional<app::TraceColumns> columns;
  if (trace_ != nullptr)
    columns = trace_->columns().in(symbols);
  std::optional<script::Script> script;
  if (script_)
    script.emplace(script_->in(symbols));
  auto servedSymbols = std::make_unique<app::SymbolTable>(change.fresh());
  std::unique_lock<std::mutex> held;
  if (service_ != nullptr)
    held = service_->hold();
  std::optional<monitor::SymbolServer::Change> served;
  if (served_)
    served.emplace(served_->prepareChange(std::move(servedSymbols)));
  onLowStack([&] { // for FB_Exit and FB_Reinit
    if (scheduler_.options().fifo)
      task::useFifo(0);
    result.pauseNs = scheduler_.betweenCycles([&] {
      result.done = !instance_.tasks().stopped() && change.apply(scheduler_.nowNs());
      if (result.done && columns)
        trace_->swapColumns(*columns);
      if (result.done && script)
        script_->takeOver(*script);
      if (result.done && served)
        served_->changeApplication(*served);
    });
  });
  lookAfter();
  if (result.done && served)
    served_->finishChange(*served);
  if (result.done)
    instance_.renewSymbols();
  for (const std::string &line : change.atNextStart())
    if (result.done)
      tell("warning: online change: " + line);
  for (const std::string &event : change.events())
    tell("warning: online change: " + event);
  for (size_t i = 0; result.done && served && i < served->lostForces().size(); ++i)
    tell(fmt::format("warning: online change: '{}' is no longer forced: the new build has no "
                     "such variable, or it cannot have that value",
                     served->lostForces()[i]));
  tell(result.done ? fmt::format("note: online change done; no cycle could begin for {:.0f} us",
                                 static_cast<double>(result.pauseNs) * 1e-3)
                   : "error: online change given up; the old build goes on");
}

bool Session::isWelcome(const OnlineChange &change, bool acceptLosses, const Tell &tell) {
  switch (change.verdict()) {
  case app::Verdict::Silent:
    return true;
  case app::Verdict::Losses:
    tell("note: online change with losses\n" + change.report(false));
    if (acceptLosses)
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

Ending Session::finish() noexcept {
  Ending ending;
  const auto part = [&](const auto &work) { ending.complete = ending_(work) && ending.complete; };
  bool rest = true;
  part([&] { rest = scheduler_.finish([this] { lookAfter(); }); });
  if (!rest)
    say("warning: not everything came to rest within a minute");
  if (service_ != nullptr)
    service_->detach(number_);
  lookAfter();
  std::optional<task::Fault> fault;
  part([&] { fault = instance_.tasks().fault(); });
  finishOutputs(ending, fault);
  part([&] {
    for (const std::string &line : instance_.remarks())
      say(line);
    if (script_)
      for (const std::string &line : script_->remarks())
        say(line);
  });
  if (fault)
    sayFault(*fault);
  std::optional<task::Fault> atEnd;
  part([&] { atEnd = exitInstances(); });
  lookAfter();
  if (atEnd)
    sayFault(*atEnd);
  ending.complete = instance_.retainKeeper()->finish() && ending.complete;
  if (!options_->quiet)
    showStatistics();
  ending.good = !failed() && !atEnd;
  return ending;
}

/// What the user has asked for: the recording, the trace, values to print.
void Session::finishOutputs(Ending &ending, const std::optional<task::Fault> &fault) noexcept {
  const auto part = [&](const auto &work) { ending.complete = ending_(work) && ending.complete; };
  if (recording_ && !recording_->finish(fault)) {
    ending.complete = false;
    part([&] { say("warning: " + recording_->problem()); });
  }
  if (ring_) {
    trace_->flush();
    ring_->drain(*trace_);
  }
  if (ring_ && ring_->lost() + ring_->waiting() != 0) {
    ending.complete = false;
    part([&] {
      say(fmt::format("warning: the trace lacks {} rows: it could not be written as fast as it was "
                      "taken; trace fewer variables",
                      ring_->lost() + ring_->waiting()));
    });
  }
  if (own_->print.empty())
    return;
  int error = 0;
  part([&] {
    error = print(printedValues(instance_.symbols(), own_->print, instance_.state()),
                  Output::Wait::Never);
  });
  if (error != 0) {
    ending.complete = false;
    messages_->say({"error: the values to print cannot be written: ", ::strerrordesc_np(error)});
  }
}

void Session::showStatistics() noexcept {
  showing_([this] {
    const task::TaskSet &tasks = instance_.tasks();
    std::string text = options_->applications.size() > 1 ? name_ + ":\n" : std::string();
    text += statisticsTable(tasks);
    if (options_->histogram)
      for (uint32_t i = 0; i < tasks.count(); ++i)
        text += fmt::format("{}\n{}", tasks.desc(i).name, histogramText(tasks.statistics(i)));
    messages_->say(text);
  });
}

/// One line of an application among others carries its name. Also from the thread that saves
/// retained data.
void Session::say(std::string_view line) noexcept {
  if (options_->applications.size() > 1)
    messages_->say({name_, ": ", line});
  else
    messages_->say(line);
}

void Session::sayFault(const task::Fault &fault) noexcept {
  try {
    say("error: " + describeWithCalls(fault));
  } catch (const std::exception &) { // without the place then
    messages_->say({"error: ", fault.exception.what(), " (task ", fault.task, ")"});
  }
}

std::optional<task::Fault> Session::exitInstances() {
  std::optional<task::Fault> fault;
  const int64_t now = scheduler_.nowNs();
  onLowStack([&] { fault = instance_.exit(now); });
  return fault;
}

} // namespace stride::host
