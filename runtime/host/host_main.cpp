#include "runtime/host/host_main.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/common/standard_handles.hpp"
#include "runtime/common/usage.hpp"
#include "runtime/host/axis_hooks.hpp"
#include "runtime/host/control.hpp"
#include "runtime/host/exit_code.hpp"
#include "runtime/host/options.hpp"
#include "runtime/host/real_run.hpp"
#include "runtime/host/retain_reset.hpp"
#include "runtime/host/simulation.hpp"
#include "runtime/host/test_run.hpp"
#include "runtime/task/fatal.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <string_view>

#include <unistd.h>

namespace stride::host {

namespace {

constexpr const char *kExitCodes =
    "Exit codes: 0 the run reached its end, 1 bad input, 2 an application was stopped by an\n"
    "exception, 3 the runtime itself could not go on, 4 output that was asked for is not "
    "complete,\n"
    "130 a simulation was interrupted.";

constexpr const char *kControlExitCodes =
    "Exit codes: 0 done, 1 it could not be done, 4 output that was asked for is not complete.";

/// The options as text, before they are understood.
struct SimTexts {
  std::string application;
  std::string duration;
  std::string replay;
  std::vector<std::string> trace;
  std::vector<std::string> sets;
  std::vector<std::string> changes;
  std::vector<std::string> print;
  std::string script;
  std::string out;
  std::string retain;
  std::string files;
  int64_t loopBudget = 0;
  std::string canLog;
  std::string canReplay;
  bool stateHash = false;
  bool quiet = false;
  bool summary = false;
};

void declareRecordings(CLI::App &sim, SimTexts &texts) {
  sim.add_option("--can-log", texts.canLog, "Write the frames of CAN buses, as candump does")
      ->type_name("FILE");
  sim.add_option(
         "--can-replay", texts.canReplay,
         "Frames that '--can-log' has written take the place of a simulated CAN bus; what is "
         "sent is compared with them")
      ->type_name("FILE");
}

void declare(CLI::App &sim, SimTexts &texts, bool builtIn) {
  if (!builtIn)
    sim.add_option("APP", texts.application, "The application that 'stride build' made")
        ->required();
  CLI::Option *duration =
      sim.add_option("--for", texts.duration, "Virtual time to run: T#1s500ms, 5s, 500ms")
          ->type_name("TIME");
  CLI::Option *replay =
      sim.add_option("--replay", texts.replay,
                     "Repeat the cycles and inputs of a run that 'run --record' has recorded")
          ->type_name("FILE")
          ->excludes(duration);
  declareRecordings(sim, texts);
  sim.callback([duration, replay] {
    if (duration->count() == 0 && replay->count() == 0)
      throw CLI::RequiredError("--for");
  });
  sim.add_option("--trace", texts.trace,
                 "Variables to write in every cycle of the fastest task: A,B.c,D[1,2]; may be "
                 "repeated; a structure stands for all its members")
      ->type_name("NAMES")
      ->expected(1)
      ->take_all();
  sim.add_option("--out", texts.out, "File for the trace (CSV); standard output without it")
      ->type_name("FILE");
  sim.add_option("--set", texts.sets,
                 "Write a variable before the first cycle at or after TIME: T#3s,Ipo.p=50; may be "
                 "repeated")
      ->type_name("TIME,NAME=VALUE")
      ->expected(1)
      ->take_all();
  sim.add_option("--change", texts.changes,
                 "A new build takes over before the first cycle at or after TIME: T#3s,new.so; may "
                 "be repeated")
      ->type_name("TIME,APP")
      ->expected(1)
      ->take_all();
  sim.add_option("--script", texts.script,
                 "Script of what is written and forced, and when (docs/scripts.md)")
      ->type_name("FILE");
  sim.add_option("--print", texts.print, "Variables to print at the end; may be repeated")
      ->type_name("NAMES")
      ->expected(1)
      ->take_all();
  sim.add_option("--loop-budget", texts.loopBudget,
                 "Loop iterations one cycle may use before it counts as endless")
      ->check(CLI::PositiveNumber);
  sim.add_flag("--state-hash", texts.stateHash,
               "Print a hash of all variables at the end: equal runs have equal ones");
  sim.add_option("--retain", texts.retain,
                 "Take RETAIN and PERSISTENT variables from this file, and save them at the end")
      ->type_name("FILE");
  sim.add_option("--files", texts.files,
                 "Folder for the program's files; the application's own without it")
      ->type_name("FOLDER");
  sim.add_flag("--quiet", texts.quiet, "Neither progress nor summary");
  sim.add_flag("--summary", texts.summary, "A summary even when standard error is no terminal");
  sim.footer(kExitCodes);
}

/// The options of `run` as text.
struct RunTexts {
  RunOptions options;
  std::string duration;
  std::vector<std::string> trace;
  std::vector<std::string> print;
  std::string onFault = "stop";
  int core = -1;
};

/// Which applications, where they are not built into the program.
void declareApplications(CLI::App &run, RunOptions &options) {
  run.add_option("APP", options.applications,
                 "The applications that 'stride build' made; several run side by side")
      ->required();
  run.add_option("--name", options.name,
                 "Name of the application whose project has none in its stride.toml")
      ->type_name("NAME");
  run.add_option("--latest", options.latest,
                 "Where an online change finds the new build; where the application is without it")
      ->type_name("FILE");
}

/// How long, and what is written of it.
void declareOutput(CLI::App &run, RunTexts &texts) {
  run.add_option("--for", texts.duration, "How long to run: 5s, T#1h; until Ctrl-C without it")
      ->type_name("TIME");
  run.add_option("--trace", texts.trace,
                 "Variables to write in every cycle of the application's fastest task; NAME:PATH "
                 "for those of the application NAME")
      ->type_name("NAMES")
      ->expected(1)
      ->take_all();
  run.add_option("--out", texts.options.out, "File for the trace (CSV); standard output without it")
      ->type_name("FILE");
  run.add_option("--print", texts.print, "Variables to print at the end; may be repeated")
      ->type_name("NAMES")
      ->expected(1)
      ->take_all();
}

/// Files and sockets that the run reads or keeps.
void declareFiles(CLI::App &run, RunOptions &options) {
  run.add_option("--script", options.scripts,
                 "Script of what is written and forced, and when; NAME=FILE for the application "
                 "NAME, may be repeated")
      ->type_name("FILE")
      ->expected(1)
      ->take_all();
  run.add_option("--listen", options.listen,
                 "Socket through which 'ctl' and others read, write and force: unix:PATH")
      ->type_name("ADDRESS");
  run.add_option("--record", options.record,
                 "Record all inputs for 'sim --replay'; the tasks take turns then")
      ->type_name("FILE");
  run.add_option("--can-log", options.canLog, "Write the frames of CAN buses, as candump does")
      ->type_name("FILE");
  run.add_option("--retain", options.retain,
                 "File for RETAIN and PERSISTENT variables; the application's own, or NAME.retain, "
                 "without it")
      ->type_name("FILE");
  run.add_option("--files", options.files,
                 "Folder for the program's files; the application's own without it")
      ->type_name("FOLDER");
}

/// What happens at faults and changes, processors, and what is told of real time.
void declareBehaviour(CLI::App &run, RunTexts &texts) {
  run.add_option("--on-fault", texts.onFault,
                 "What happens when an exception stops an application: stop, restart")
      ->check(CLI::IsMember({"stop", "restart"}))
      ->capture_default_str();
  run.add_flag("--accept-losses", texts.options.acceptLosses,
               "An online change may lose values of variables");
  run.add_option("--core", texts.core,
                 "Processor of the tasks that choose none; the last one "
                 "this process may use without it")
      ->check(CLI::Range(0, 4095))
      ->type_name("N");
  run.add_flag("--turns", texts.options.turns,
               "Only one task at a time is in a cycle, also with real-time priorities");
  run.add_option("--statistics", texts.options.statistics,
                 "File for the statistics at the end (JSON)")
      ->type_name("FILE");
  run.add_flag("--histogram", texts.options.histogram,
               "Show the distribution of run times and delays with the statistics");
  run.add_flag("--quiet", texts.options.quiet, "No statistics, no warnings about real time");
}

/// In the order of the help.
void declare(CLI::App &run, RunTexts &texts, bool builtIn) {
  if (!builtIn)
    declareApplications(run, texts.options);
  declareOutput(run, texts);
  declareFiles(run, texts.options);
  declareBehaviour(run, texts);
  run.footer(
      std::string(
          "SIGUSR1 shows the statistics, SIGHUP takes new builds of the applications over (online\n"
          "change), SIGINT (Ctrl-C) and SIGTERM stop safely.\n") +
      kExitCodes);
}

void declareReset(CLI::App &reset, std::string &kind, std::string &file) {
  reset
      .add_option("KIND", kind,
                  "warm: RETAIN and PERSISTENT variables are kept; cold: PERSISTENT ones; origin: "
                  "nothing")
      ->required()
      ->check(CLI::IsMember({"warm", "cold", "origin"}));
  reset.add_option("FILE", file, "The file that was given with --retain or in stride.toml")
      ->required();
}

void appendPaths(const std::vector<std::string> &texts, std::vector<std::string> &paths) {
  for (const std::string &text : texts) {
    for (std::string &path : splitPaths(text))
      paths.push_back(std::move(path));
  }
}

SimOptions understand(const SimTexts &texts) {
  SimOptions options;
  options.application = texts.application;
  try {
    if (texts.replay.empty())
      options.durationNs = parseDuration(texts.duration, false);
  } catch (const app::Error &error) {
    throw app::Error(fmt::format("--for: {}", error.what()));
  }
  appendPaths(texts.trace, options.trace);
  appendPaths(texts.print, options.print);
  for (const std::string &text : texts.sets)
    options.sets.push_back(parseSet(text));
  for (const std::string &text : texts.changes)
    options.changes.push_back(parseChange(text));
  std::stable_sort(
      options.changes.begin(), options.changes.end(),
      [](const ChangeOption &a, const ChangeOption &b) { return a.timeNs < b.timeNs; });
  options.out = texts.out;
  if (!options.out.empty() && options.trace.empty())
    throw app::Error("--out names a file for a trace, but --trace names nothing to trace");
  options.script = texts.script;
  options.replay = texts.replay;
  if (!options.replay.empty() && !(options.sets.empty() && options.changes.empty()))
    throw app::Error("--replay repeats a run as it was; --set and --change do not go with it");
  options.loopBudget = texts.loopBudget;
  options.stateHash = texts.stateHash;
  options.retain = texts.retain;
  options.files = texts.files;
  options.canLog = texts.canLog;
  options.canReplay = texts.canReplay;
  options.quiet = texts.quiet;
  options.summary = texts.summary;
  return options;
}

RunOptions understand(const RunTexts &texts) {
  RunOptions options = texts.options;
  try {
    if (!texts.duration.empty())
      options.durationNs = parseDuration(texts.duration, false);
  } catch (const app::Error &error) {
    throw app::Error(fmt::format("--for: {}", error.what()));
  }
  appendPaths(texts.trace, options.trace);
  appendPaths(texts.print, options.print);
  if (!options.out.empty() && options.trace.empty())
    throw app::Error("--out names a file for a trace, but --trace names nothing to trace");
  if (!options.retain.empty() && options.applications.size() > 1)
    throw app::Error("--retain names one file, but there are several applications; give each its "
                     "own in [retain] of its stride.toml");
  if (options.applications.size() > 1 && !(options.name.empty() && options.latest.empty()))
    throw app::Error("--name and --latest are for one application, but there are several");
  if (texts.core >= 0)
    options.core = static_cast<uint32_t>(texts.core);
  if (!options.record.empty() && options.applications.size() > 1)
    throw app::Error("--record records one application; start the others by themselves");
  if (!options.canLog.empty() && options.applications.size() > 1)
    throw app::Error("--can-log records one application; start the others by themselves");
  options.onFault = texts.onFault == "restart" ? OnFault::Restart : OnFault::Stop;
  return options;
}

std::unique_ptr<app::Application> loadApplication(const StrideAppV1 *builtIn,
                                                  const std::string &path) {
  return std::make_unique<app::Application>(
      builtIn != nullptr ? app::Application::fromDescription(*builtIn, runtimeLayouts())
                         : app::Application::load(path, runtimeLayouts()));
}

int simulateFrom(const SimTexts &texts, const StrideAppV1 *builtIn, Messages &messages) {
  const SimOptions options = understand(texts);
  return simulate(loadApplication(builtIn, options.application), options, messages);
}

/// A run outlives who reads its messages, a terminal that stops those who write in the background,
/// the largest file that it may write, and the signals that it is sent before it can take them.
void prepareSignals() {
  for (const int signal : {SIGPIPE, SIGTTOU, SIGXFSZ})
    std::signal(signal, SIG_IGN);
  ::sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGUSR1);
  ::sigaddset(&signals, SIGHUP);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

int runFrom(const RunTexts &texts, const StrideAppV1 *builtIn, Messages &messages) {
  const RunOptions options = understand(texts);
  std::vector<std::unique_ptr<app::Application>> applications;
  if (builtIn != nullptr)
    applications.push_back(loadApplication(builtIn, {}));
  for (const std::string &path : options.applications)
    applications.push_back(loadApplication(nullptr, path));
  if (!options.name.empty())
    applications.front()->setDefaultName(options.name);
  return runReal(std::move(applications), options, messages);
}

int resetFrom(const std::string &kind, const std::string &file, Messages &messages) {
  const bool found = resetRetained(kind == "warm"   ? ResetKind::Warm
                                   : kind == "cold" ? ResetKind::Cold
                                                    : ResetKind::Origin,
                                   file, messages);
  return found ? kExitOk : kExitBadInput;
}

/// Does the command and says what keeps it from that. The exit code: also of output that got lost.
int conclude(Output::Wait wait, const std::function<int(Messages &)> &work) {
  Messages messages(wait);
  int code = kExitBadInput;
  try {
    code = work(messages);
  } catch (const std::bad_alloc &) {
    messages.say("error: there is not enough memory");
  } catch (const std::exception &error) {
    messages.say({"error: ", error.what()});
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    messages.say({"error: standard output cannot be written: ", ::strerrordesc_np(errno)});
    code = code == kExitOk ? kExitIncomplete : code;
  }
  return !messages.finish() && code == kExitOk ? kExitIncomplete : code;
}

std::string whatIsWrong(const CLI::App &app, const CLI::ParseError &error) {
  using common::UnknownWord;
  const UnknownWord unknown = common::unknownWord(app, error);
  const std::string meant = app::didYouMean(unknown.word, unknown.known);
  switch (unknown.kind) {
  case UnknownWord::Kind::Command:
    return fmt::format("there is no command '{}'{}", unknown.word, meant);
  case UnknownWord::Kind::Option:
    return fmt::format("there is no option '{}'{}", unknown.word, meant);
  case UnknownWord::Kind::Argument:
    return fmt::format("'{}' was not expected", unknown.word);
  case UnknownWord::Kind::None:
    break;
  }
  const std::string missing = common::missingCommand(app, error);
  return missing.empty() ? error.what() : missing;
}

int command(int argc, const char *const *argv, const StrideAppV1 *builtIn) {
  CLI::App cli("Runs applications that 'stride build' has made.");
  cli.require_subcommand(1);
  cli.footer(kExitCodes);
  // `stride`, when that has become this program.
  const std::string program =
      argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "stride-host";
  cli.name(program);
  SimTexts texts;
  CLI::App *sim =
      cli.add_subcommand("sim", "Run in virtual time: deterministic, as fast as possible");
  declare(*sim, texts, builtIn != nullptr);
  RunTexts runTexts;
  CLI::App *run = cli.add_subcommand("run", "Run by the real clock");
  declare(*run, runTexts, builtIn != nullptr);
  std::string resetKind;
  std::string resetFile;
  CLI::App *reset =
      cli.add_subcommand("reset", "Retained data of an application that stands still");
  declareReset(*reset, resetKind, resetFile);
  TestCommand testCommand;
  CLI::App *test = cli.add_subcommand("test", "Run the unit tests that 'stride test' has built");
  testCommand.declare(*test);
  Control control;
  CLI::App *ctl = cli.add_subcommand("ctl", "Read, write, force in a running application");
  ctl->footer(kControlExitCodes);
  control.declare(*ctl);
  try {
    cli.parse(argc, argv);
  } catch (const CLI::CallForHelp &help) {
    return cli.exit(help);
  } catch (const CLI::ParseError &error) {
    Messages(Output::Wait::Always)
        .say({"error: ", whatIsWrong(cli, error), "\n  '", common::commandPath(cli, program),
              " --help' lists the options"});
    return kExitBadInput;
  }
  if (run->parsed())
    prepareSignals();
  return conclude(run->parsed() ? Output::Wait::Never : Output::Wait::Always,
                  [&](Messages &messages) -> int {
                    if (ctl->parsed())
                      return control.run();
                    if (test->parsed())
                      return testCommand.run(messages);
                    if (reset->parsed())
                      return resetFrom(resetKind, resetFile, messages);
                    return run->parsed() ? runFrom(runTexts, builtIn, messages)
                                         : simulateFrom(texts, builtIn, messages);
                  });
}

} // namespace

int hostMain(int argc, const char *const *argv, const StrideAppV1 *builtIn) {
  common::openStandardHandles();
  const task::FatalReport lastWords(kExitFatal);
  try {
    return command(argc, argv, builtIn);
  } catch (const std::exception &) { // there is not even memory for what it wanted to say
    constexpr std::string_view kText = "error: there is not enough memory\n";
    (void)!::write(STDERR_FILENO, kText.data(), kText.size());
    return kExitBadInput;
  }
}

} // namespace stride::host
