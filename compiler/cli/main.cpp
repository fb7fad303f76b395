// The command `stride`.

#include "compiler/cli/commands.hpp"
#include "compiler/semantics/suggest.hpp"
#include "compiler/syntax/conditions.hpp"
#include "compiler/syntax/st_text.hpp"
#include "runtime/common/standard_handles.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <new>

namespace stc::cli {

namespace {

constexpr const char *kVersion = "stride " STRIDE_VERSION;
constexpr int kUsageError = 1;

/// `error=SE0390`, `off=unused-variable`, `error=all-warnings`
void addLevel(Levels &levels, const std::string &text) {
  const std::size_t equal = text.find('=');
  const std::string level = text.substr(0, equal);
  const std::string what = equal == std::string::npos ? "all-warnings" : text.substr(equal + 1);
  static const std::map<std::string, Severity> known = {{"error", Severity::error},
                                                        {"warning", Severity::warning},
                                                        {"note", Severity::note},
                                                        {"off", Severity::off}};
  const auto severity = known.find(level);
  if (severity == known.end())
    throw CLI::ValidationError("-W", "`" + level + "` is none of error, warning, note, off");
  if (const std::optional<Levels::Group> group = findGroup(what)) {
    levels.set(*group, severity->second);
    return;
  }
  const CodeInfo *code = findCode(what);
  if (code == nullptr) {
    const std::vector<std::string> names = settingNames();
    const std::string_view near = nearest(what, {names.begin(), names.end()});
    throw CLI::ValidationError(
        "-W", "there is no diagnostic `" + what + "`" +
                  (near.empty() ? std::string() : "; did you mean `" + std::string(near) + "`?"));
  }
  if (code->severity == Severity::error && severity->second != Severity::error)
    throw CLI::ValidationError("-W", "`" + what + "` is an error, and errors cannot be lowered");
  levels.set(code->code, severity->second);
}

/// How diagnostics are shown.
void addOutputOptions(CLI::App &command, Output &output) {
  static const std::map<std::string, ColorChoice> colors = {{"auto", ColorChoice::automatic},
                                                            {"always", ColorChoice::always},
                                                            {"never", ColorChoice::never}};
  static const std::map<std::string, Format> formats = {{"text", Format::text},
                                                        {"json", Format::json}};
  command.add_option("--color", output.color, "Colours: auto (default), always, never")
      ->transform(CLI::CheckedTransformer(colors).description(""))
      ->type_name("WHEN");
  command.add_option("--format", output.format, "Diagnostics as text (default) or json")
      ->transform(CLI::CheckedTransformer(formats).description(""))
      ->type_name("FORMAT");
  command
      .add_option("--max-errors", output.maxErrors, "Show so many errors (default: 100; 0: all)")
      ->type_name("N");
}

void addProjectOptions(CLI::App &command, ProjectOptions &options, bool build) {
  command
      .add_option("PATH", options.path, "Project folder or .st file (default: the current folder)")
      ->type_name("");
  addOutputOptions(command, options.output);
  command
      .add_option_function<std::vector<std::string>>(
          "-W",
          [&options](const std::vector<std::string> &values) {
            for (const std::string &value : values)
              addLevel(options.levels, value);
          },
          "Severity of diagnostics: error=SE0390, off=unused-variable, error=all-warnings (may be "
          "repeated)")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("LEVEL=NAME");
  command.add_option("-D,--define", options.defines, "Define a name for {IF defined (NAME)}")
      ->check(CLI::Validator(
          [](std::string &text) {
            return readDefine(text) ? std::string() : "`" + text + "` is not NAME or NAME=VALUE";
          },
          std::string()))
      ->allow_extra_args(false)
      ->type_name("NAME[=VALUE]");
  if (!build)
    return;
  command.add_flag("--unchecked", options.unchecked,
                   "Leave out index, range, division and pointer checks");
  command.add_flag("--debug", options.debug, "Compile quickly and with debug information");
}

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
  host.pass("--retain", "Take RETAIN and PERSISTENT variables from FILE and save them at the end",
            "FILE");
  host.passFlag("--quiet", "Neither progress nor summary");
  host.passFlag("--summary", "A summary even when standard error is no terminal");
}

void addRunOptions(const HostOptions &host) {
  host.pass("--for", "How long (default: until Ctrl-C): 5s, T#1h", "TIME");
  addTraceOptions(host);
  host.pass("--record", "Record all inputs for `stride sim --replay`", "FILE");
  host.pass("--retain",
            "File for RETAIN and PERSISTENT variables (default: see [retain] of stride.toml)",
            "FILE");
  host.pass("--listen", "Socket for `stride ctl` and others: unix:PATH", "ADDRESS");
  host.pass("--on-fault", "What happens after an exception: stop (default), restart", "WHAT");
  host.passFlag("--accept-losses", "An online change (SIGHUP) may lose values of variables");
  host.pass("--core", "Processor of the tasks that choose none (default: the last one)", "N");
  host.passFlag("--turns", "Only one task at a time is in a cycle, also with real-time priorities");
  host.pass("--statistics", "File for the statistics at the end (JSON)", "FILE");
  host.passFlag("--histogram", "Distributions of run times and delays with the statistics");
  host.passFlag("--quiet", "No statistics, no warnings about real time");
}

/// The commands below `stride cam`.
void addCamCommands(CLI::App &app, CamOptions &options, int &exitCode) {
  CLI::App *cam = app.add_subcommand("cam", "Check, draw and convert cams");
  cam->require_subcommand(1);
  const auto add = [&](const char *name, CamAction action, const char *what, const char *file) {
    CLI::App *command = cam->add_subcommand(name, what);
    CLI::Option *files = command->add_option("FILE", options.files, file)->required();
    if (action != CamAction::check)
      files->expected(1);
    files->type_name("");
    addOutputOptions(*command, options.output);
    command->callback([&options, &exitCode, action] {
      options.action = action;
      exitCode = camCommand(options);
    });
    return command;
  };
  const auto out = [&](CLI::App *command, const char *what) {
    command->add_option("-o,--out", options.out, what)->type_name("FILE");
  };
  const auto name = [&](CLI::App *command) {
    command->add_option("--name", options.name, "The cam's name (default: the one it has)")
        ->check(CLI::Validator(
            [](std::string &text) {
              return isIdentifier(text) ? std::string()
                                        : "`" + text + "` is no name in Structured Text";
            },
            std::string()))
        ->type_name("NAME");
  };
  constexpr const char *kAny = "Cam file (*.cam.toml), binary file (*.CAM) or table of positions";
  const auto atLeast = [](bool zero) {
    return CLI::Validator(
        [zero](std::string &text) {
          double value = 0;
          const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) &&
                            (value > 0 || (zero && value == 0));
          return good ? std::string()
                      : "`" + text + "` is no number " + (zero ? "from 0 on" : "greater than 0");
        },
        std::string());
  };
  const CLI::Validator positive = atLeast(false);
  const CLI::Validator notNegative = atLeast(true);

  add("check", CamAction::check, "Show what cams are, and fail if one of them jumps", kAny);
  CLI::App *bounds = add("bounds", CamAction::bounds,
                         "Compute how far, how fast and how hard the slave moves", kAny);
  bounds->add_option("--master-vel", options.masterVelocity, "Greatest velocity of the master, u/s")
      ->required()
      ->check(notNegative)
      ->type_name("V");
  bounds
      ->add_option("--master-acc", options.masterAcceleration,
                   "Greatest acceleration of the master, u/s\xC2\xB2 (default: 0)")
      ->check(notNegative)
      ->type_name("A");
  out(add("plot", CamAction::plot, "Draw position, velocity, acceleration and jerk over the master",
          kAny),
      "SVG file to write (default: FILE with .svg)");
  CLI::App *write = add("export", CamAction::exportTable,
                        "Write a table of positions, `master;slave` a line", kAny);
  out(write, "Text file to write (default: FILE with .txt)");
  write->add_option("--points", options.points, "Number of places (default: 361)")
      ->check(CLI::Range(std::size_t{2}, std::size_t{1000000}).description(""))
      ->type_name("N");
  CLI::App *import =
      add("import", CamAction::importTable, "Make a cam file of a table of positions",
          "Text file, `master;slave` or `master:slave` a line");
  out(import, "Cam file to write (default: FILE with .cam.toml)");
  name(import);
  import->add_flag("--periodic", options.periodic, "The cam is periodic");
  import->add_option("--interval", options.interval, "The slave's period, of a periodic cam")
      ->check(notNegative)
      ->type_name("U");
  import
      ->add_option("--tolerance", options.tolerance,
                   "Fewer points: the slave may be off by so much (default: all points)")
      ->check(positive)
      ->type_name("U");
  CLI::App *reduce =
      add("reduce", CamAction::reduce, "Make a cam file of fewer points within a tolerance", kAny);
  reduce->add_option("--tolerance", options.tolerance, "So much the slave may be off")
      ->required()
      ->check(positive)
      ->type_name("U");
  out(reduce, "Cam file to write");
  name(reduce);
  out(add("write", CamAction::write, "Write the binary file that SMC_ReadCAM reads",
          "Cam file (*.cam.toml)"),
      "Binary file to write (default: FILE with .CAM)");
  CLI::App *read = add("read", CamAction::read, "Make a cam file of a binary file",
                       "Binary file (*.CAM), as SMC_WriteCAM writes it");
  out(read, "Cam file to write (default: FILE with .cam.toml)");
  name(read);
}

int run(int argc, char **argv) {
  CLI::App app("Structured Text and SoftMotion programs: check, build, simulate");
  app.set_version_flag("--version", kVersion);
  app.require_subcommand(0, 1);
  app.name("stride");
  int exitCode = 0;

  std::string name;
  std::string projectTemplate = "axis";
  CLI::App *create = app.add_subcommand("new", "Make a project that builds and moves an axis");
  create->add_option("NAME", name, "Folder to create")->required()->type_name("");
  create->add_option("--template", projectTemplate, "axis (default): one drive; plain: no drives")
      ->check(CLI::IsMember(templateNames()).description(""))
      ->type_name("TEMPLATE");
  create->callback([&] { exitCode = newCommand(name, projectTemplate); });

  ProjectOptions options;
  CLI::App *check = app.add_subcommand("check", "Parse, resolve and type-check");
  addProjectOptions(*check, options, false);
  check->callback([&] { exitCode = checkCommand(options); });

  std::string out;
  std::string emit;
  CLI::App *build = app.add_subcommand("build", "Make the application");
  addProjectOptions(*build, options, true);
  build->add_option("-o,--out", out, "The shared object to write (with --emit cpp: the folder)")
      ->type_name("OUT");
  CLI::Option *emitOption = build->add_option("--emit", emit, "cpp: only write the C++ sources")
                                ->check(CLI::IsMember({"cpp"}).description(""))
                                ->type_name("KIND");
  BuildKind kind;
  build
      ->add_flag("--static", kind.isStatic,
                 "One executable that needs no other files: the runtime and the application")
      ->excludes(emitOption);
  build->add_option("--target", kind.target, "For another processor: aarch64-linux-gnu")
      ->check(CLI::IsMember({"aarch64-linux-gnu"}).description(""))
      ->type_name("TARGET");
  build->callback([&] {
    kind.emitCpp = emit == "cpp";
    exitCode = buildCommand(options, out, kind);
  });

  std::vector<std::string> host;
  CLI::App *sim = app.add_subcommand("sim", "Build, then run in virtual time");
  addProjectOptions(*sim, options, true);
  addSimOptions(HostOptions(*sim, host));
  sim->callback([&] {
    if (sim->get_option("--for")->count() + sim->get_option("--replay")->count() == 0)
      throw CLI::RequiredError("--for");
    exitCode = hostCommand(options, "sim", host);
  });

  CLI::App *runApp = app.add_subcommand("run", "Build, then run by the real clock");
  addProjectOptions(*runApp, options, true);
  addRunOptions(HostOptions(*runApp, host));
  runApp->callback([&] { exitCode = hostCommand(options, "run", host); });

  DebugSession session;
  CLI::App *debug = app.add_subcommand("debug", "Build, then run in virtual time under gdb");
  addProjectOptions(*debug, options, true);
  addSimOptions(HostOptions(*debug, host));
  debug->remove_option(debug->get_option("--debug"));
  debug->add_option("-x,--command", session.scripts, "File of gdb commands (may be repeated)")
      ->allow_extra_args(false)
      ->type_name("FILE");
  debug->add_flag("--batch", session.batch, "Leave gdb after these commands");
  debug->callback([&] {
    if (debug->get_option("--for")->count() + debug->get_option("--replay")->count() == 0)
      host.insert(host.end(), {"--for", "T#24h"});
    options.debug = true;
    exitCode = debugCommand(options, host, session);
  });

  std::string resetKind;
  CLI::App *reset =
      app.add_subcommand("reset", "Reset retained data of a project that stands still");
  reset
      ->add_option("KIND", resetKind,
                   "warm: the next start keeps RETAIN and PERSISTENT variables, as every start\n"
                   "cold: it keeps PERSISTENT variables; RETAIN get their initial values\n"
                   "origin: all variables get their initial values")
      ->required()
      ->check(CLI::IsMember({"warm", "cold", "origin"}).description(""))
      ->type_name("");
  addProjectOptions(*reset, options, false);
  reset->callback([&] { exitCode = resetCommand(options, resetKind); });
  CLI::App *ctl = app.add_subcommand("ctl", "Read, write, force in a running application");
  ctl->prefix_command(); // stride-host knows what comes behind it
  ctl->set_help_flag();
  ctl->callback([&] { exitCode = hostOnlyCommand("ctl", ctl->remaining()); });

  bool library = false;
  CLI::App *document = app.add_subcommand("doc", "Write the reference of the project as HTML");
  addProjectOptions(*document, options, false);
  document->add_flag("--library", library, "That of the standard library instead");
  std::string figures;
  document
      ->add_option("--figures", figures,
                   "Pictures LIBRARY/NAME.svg, with what they show in NAME.txt")
      ->type_name("FOLDER");
  document->add_option("-o,--out", out, "Folder for the pages (default: doc)")->type_name("FOLDER");
  document->callback([&] { exitCode = documentCommand(options, library, figures, out); });

  TestOptions tests;
  CLI::App *test = app.add_subcommand("test", "Build and run the unit tests");
  addProjectOptions(*test, options, false);
  test->add_flag("--unchecked", options.unchecked,
                 "Leave out index, range, division and pointer checks");
  test->add_option("--filter", tests.filter, "Run the tests of these names only: Tank*")
      ->type_name("GLOB");
  test->add_option("--junit", tests.junit, "Write the results as JUnit XML")->type_name("FILE");
  test->add_flag("--list", tests.list, "Only name the tests");
  test->callback([&] { exitCode = testCommand(options, tests); });

  FormatOptions formatting;
  CLI::App *fmt = app.add_subcommand("fmt", "Format source files");
  fmt->add_option("PATH", formatting.paths,
                  "Project folders and .st files (default: the current folder)")
      ->type_name("");
  fmt->add_flag("--check", formatting.check,
                "Write nothing; name the files that are not formatted and fail");
  fmt->add_flag("--diff", formatting.diff, "Write nothing; show what would change");
  fmt->add_flag("--stdin", formatting.fromStdin, "From standard input to standard output");
  addOutputOptions(*fmt, formatting.output);
  fmt->callback([&] { exitCode = formatCommand(formatting); });

  std::string trace;
  CLI::App *plot = app.add_subcommand("plot", "Draw a trace");
  plot->add_option("TRACE", trace, "CSV file that `stride sim --out` wrote")
      ->required()
      ->type_name("");
  plot->add_option("-o,--out", out, "SVG file to write (default: TRACE with .svg)")
      ->type_name("FILE");
  plot->callback([&] { exitCode = plotCommand(trace, out); });

  CamOptions cams;
  addCamCommands(app, cams, exitCode);

  std::string what;
  bool list = false;
  CLI::App *explain = app.add_subcommand("explain", "Explain a diagnostic or a SoftMotion error");
  explain->add_option("CODE", what, "SE0203, or a number or name of SMC_ERROR")->type_name("");
  explain->add_flag("--list", list, "List all codes");
  explain->callback([&] {
    if (!list && what.empty())
      throw CLI::RequiredError("CODE or --list");
    exitCode = list ? explainList() : explainCommand(what);
  });

  std::string topic;
  std::string overview;
  CLI::App *help = app.add_subcommand("help", "Show the commands, or the options of one");
  help->add_option("COMMAND", topic, "check, build, sim, …")->type_name("");
  help->callback([&] {
    if (topic == "ctl") {
      exitCode = hostOnlyCommand("ctl", {"--help"});
      return;
    }
    const CLI::App *shown = nullptr;
    for (const CLI::App *command : app.get_subcommands({}))
      if (command->get_name() == topic)
        shown = command;
    if (topic.empty())
      std::fputs(overview.c_str(), stdout);
    else if (shown == nullptr)
      throw CLI::ValidationError("COMMAND", "there is no command `" + topic + "`");
    else
      std::fputs(shown->help("stride").c_str(), stdout);
  });
  overview = app.help(); // asked while a command is parsed, it would be that command's

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success &success) { // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError &error) {
    std::fprintf(stderr, "stride: %s\nTry: stride%s --help\n", error.what(),
                 app.get_subcommands().empty()
                     ? ""
                     : (" " + app.get_subcommands().front()->get_name()).c_str());
    return kUsageError;
  }
  if (app.get_subcommands().empty())
    std::fputs(app.help().c_str(), stdout);
  return exitCode;
}

/// The exit code when what was shown could not be written.
int concluded(int exitCode) {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::fprintf(stderr, "stride: standard output cannot be written: %s\n", std::strerror(errno));
    exitCode = std::max(exitCode, 1);
  }
  return std::ferror(stderr) != 0 ? std::max(exitCode, 1) : exitCode;
}

} // namespace

} // namespace stc::cli

int main(int argc, char **argv) {
  stride::common::openStandardHandles();
  std::signal(SIGXFSZ, SIG_IGN); // like a full disk: nothing half written stays
  // Whatever the caller ignores: compilers that are started get the default, too. The host of
  // `stride run` ignores it.
  std::signal(SIGPIPE, SIG_DFL);
  try {
    return stc::cli::concluded(stc::cli::run(argc, argv));
  } catch (const std::bad_alloc &) {
    std::fputs("stride: there is not enough memory\n", stderr);
    return 1;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "stride: internal error: %s\n", error.what());
    return 70;
  }
}
