// The commands that become stride-host.

#include "compiler/cli/command_line.hpp"

namespace stc::cli {

namespace {

/// Options of a command that stride-host gets as they are.
class HostOptions {
public:
  HostOptions(CLI::App &command, std::vector<std::string> &arguments)
      : command_(&command), arguments_(&arguments) {}

  CLI::Option *pass(const char *option, const char *help, const char *type) const {
    return command_
        ->add_option_function<std::vector<std::string>>(
            option,
            [arguments = arguments_, option](const std::vector<std::string> &values) {
              for (const std::string &value : values)
                arguments->insert(arguments->end(), {option, value});
            },
            help)
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false)
        ->type_name(type);
  }
  void passFlag(const char *option, const char *help) const {
    command_->add_flag_callback(
        option, [arguments = arguments_, option] { arguments->emplace_back(option); }, help);
  }

private:
  CLI::App *command_;
  std::vector<std::string> *arguments_;
};

/// What simulations and runs have in common.
void addTraceOptions(const HostOptions &host) {
  host.pass("--files", "Folder for the program's files (default: see [files] of stride.toml)",
            "FOLDER");
  host.pass("--trace", "Variables to record in every cycle: Drive.fSetPosition,Main.n", "NAMES");
  host.pass("--out", "CSV file for the trace (default: standard output)", "FILE");
  host.pass("--print", "Variables to print at the end", "NAMES");
  host.pass("--script", "Script of what is written and forced, and when", "FILE");
}

void addSimOptions(const HostOptions &host) {
  host.pass("--group",
            "Record a group of [[axes_group]] in every cycle: state, tool, axes (may be repeated)",
            "NAME");
  host.pass("--for", "How long, in virtual time: T#5s", "TIME");
  host.pass("--replay", "Repeat a run that `stride run --record` has recorded, instead of --for",
            "FILE");
  addTraceOptions(host);
  host.pass("--set",
            "Write a variable at a time: T#3s,Main.p=50; without a time at once (may be repeated)",
            "[TIME,]NAME=VALUE");
  host.pass("--change", "A new build takes over at a time: T#3s,new.so (may be repeated)",
            "TIME,APP");
  host.pass("--loop-budget", "Loop iterations a cycle may use before it counts as endless",
            "COUNT");
  host.passFlag("--state-hash", "Print a hash of all variables at the end");
  host.pass("--can-log", "Write the frames of CAN buses, as candump does", "FILE");
  host.pass("--can-replay",
            "Frames of --can-log in place of the simulated bus, compared with what is sent",
            "FILE");
  host.pass("--retain", "Take RETAIN and PERSISTENT variables from FILE and save them at the end",
            "FILE");
  host.passFlag("--quiet", "Neither progress nor summary");
  host.passFlag("--summary", "A summary even when standard error is no terminal");
}

void addRunOptions(const HostOptions &host) {
  host.pass("--for", "How long (default: until Ctrl-C): 5s, T#1h", "TIME");
  addTraceOptions(host);
  host.pass("--record", "Record all inputs for `stride sim --replay`", "FILE");
  host.pass("--can-log", "Write the frames of CAN buses, as candump does", "FILE");
  host.pass("--retain",
            "File for RETAIN and PERSISTENT variables (default: see [retain] of stride.toml)",
            "FILE");
  host.pass("--listen",
            "Socket for `stride ctl` and others: unix:PATH, or alone: the project's own",
            "[ADDRESS]");
  host.pass("--on-fault", "What happens after an exception: stop (default), restart", "WHAT");
  host.passFlag("--accept-losses", "An online change (SIGHUP) may lose values of variables");
  host.pass("--core", "Processor of the tasks that choose none (default: the last one)", "N");
  host.passFlag("--turns", "Only one task at a time is in a cycle, also with real-time priorities");
  host.pass("--statistics", "File for the statistics at the end (JSON)", "FILE");
  host.passFlag("--histogram", "Distributions of run times and delays with the statistics");
  host.passFlag("--quiet", "No statistics, no warnings about real time");
}

void declareSim(CLI::App &app, Invocation &call) {
  CLI::App *sim = app.add_subcommand("sim", "Build, then run in virtual time");
  addProjectOptions(*sim, call.project, true);
  addSimOptions(HostOptions(*sim, call.host));
  sim->callback([sim, &call] {
    if (sim->get_option("--for")->count() + sim->get_option("--replay")->count() == 0)
      throw CLI::RequiredError("--for");
    call.exitCode = hostCommand(call.project, "sim", call.host);
  });
}

void declareRun(CLI::App &app, Invocation &call) {
  CLI::App *runApp = app.add_subcommand("run", "Build, then run by the real clock");
  addProjectOptions(*runApp, call.project, true);
  addRunOptions(HostOptions(*runApp, call.host));
  runApp->add_flag("--watch", call.watch,
                   "Build whenever a file of the project is saved, and change the running program "
                   "online");
  runApp->callback([&call] {
    call.exitCode = call.watch ? watchRunCommand(call.project, call.host)
                               : hostCommand(call.project, "run", call.host);
  });
}

void declareDebug(CLI::App &app, Invocation &call) {
  CLI::App *debug = app.add_subcommand("debug", "Build, then run in virtual time under gdb");
  addProjectOptions(*debug, call.project, true);
  addSimOptions(HostOptions(*debug, call.host));
  debug->remove_option(debug->get_option("--debug"));
  debug->add_option("-x,--command", call.session.scripts, "File of gdb commands (may be repeated)")
      ->allow_extra_args(false)
      ->type_name("FILE");
  debug->add_flag("--batch", call.session.batch, "Leave gdb after these commands");
  debug->callback([debug, &call] {
    if (debug->get_option("--for")->count() + debug->get_option("--replay")->count() == 0)
      call.host.insert(call.host.end(), {"--for", "T#24h"});
    call.project.debug = true;
    call.exitCode = debugCommand(call.project, call.host, call.session);
  });
}

void declareReset(CLI::App &app, Invocation &call) {
  CLI::App *reset =
      app.add_subcommand("reset", "Reset retained data of a project that stands still");
  reset
      ->add_option("KIND", call.resetKind,
                   "warm: the next start keeps RETAIN and PERSISTENT variables, as every start\n"
                   "cold: it keeps PERSISTENT variables; RETAIN get their initial values\n"
                   "origin: all variables get their initial values")
      ->required()
      ->check(CLI::IsMember({"warm", "cold", "origin"}).description(""))
      ->type_name("");
  addProjectOptions(*reset, call.project, false);
  reset->callback([&call] { call.exitCode = resetCommand(call.project, call.resetKind); });
}

void declareCtl(CLI::App &app, Invocation &call) {
  CLI::App *ctl = app.add_subcommand("ctl", "Read, write, force in a running application");
  ctl->prefix_command(); // stride-host knows what comes after it
  ctl->set_help_flag();
  ctl->callback([ctl, &call] { call.exitCode = controlCommand(ctl->remaining()); });
}

} // namespace

void declareRuns(CLI::App &app, Invocation &call) {
  declareSim(app, call);
  declareRun(app, call);
  declareDebug(app, call);
  declareReset(app, call);
  declareCtl(app, call);
}

} // namespace stc::cli
