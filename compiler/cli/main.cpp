// The command `stride`.

#include "compiler/cli/command_line.hpp"
#include "compiler/cli/version.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/toml/interval.hpp"
#include "runtime/common/standard_handles.hpp"
#include "runtime/common/usage.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <malloc.h>
#include <new>

namespace stc::cli {

namespace {

constexpr int kUsageError = 1;

/// The allocator keeps what is freed: the next large text would only be given the same pages once
/// more, cleared by the system one after the other.
void keepFreedMemory() {
  constexpr int kMegabyte = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
  ::mallopt(M_TRIM_THRESHOLD, 256 * kMegabyte);
  ::mallopt(M_TOP_PAD, 4 * kMegabyte);
}

void declareNew(CLI::App &app, Invocation &call) {
  CLI::App *create = app.add_subcommand("new", "Make a project that builds and runs");
  create->add_option("NAME", call.name, "Folder to create")->required()->type_name("");
  create
      ->add_option("--template", call.projectTemplate,
                   "axis (default): one drive; two-axes: one follows the other by a gear; cam: it "
                   "follows by a cam; io: inputs and outputs; tests: a block with unit tests; "
                   "library: a library for other projects; plain: a program alone")
      ->check(CLI::IsMember(templateNames()).description(""))
      ->type_name("TEMPLATE");
  create->callback([&call] { call.exitCode = newCommand(call.name, call.projectTemplate); });
}

void declareCheck(CLI::App &app, Invocation &call) {
  CLI::App *check = app.add_subcommand("check", "Parse, resolve and type-check");
  addProjectOptions(*check, call.project, false);
  check->add_flag("--watch", call.watch, "Again whenever a file of the project is saved");
  check->callback([&call] {
    call.exitCode = call.watch ? watchCheckCommand(call.project) : checkCommand(call.project);
  });
}

void declareBuild(CLI::App &app, Invocation &call) {
  CLI::App *build = app.add_subcommand("build", "Make the application");
  addProjectOptions(*build, call.project, true);
  build
      ->add_option("-o,--out", call.out, "The shared object to write (with --emit cpp: the folder)")
      ->type_name("OUT");
  CLI::Option *emitOption =
      build->add_option("--emit", call.emit, "cpp: only write the C++ sources")
          ->check(CLI::IsMember({"cpp"}).description(""))
          ->type_name("KIND");
  build
      ->add_flag("--static", call.kind.isStatic,
                 "One executable that needs no other files: the runtime and the application")
      ->excludes(emitOption);
  build->add_option("--target", call.kind.target, "For another processor: aarch64-linux-gnu")
      ->check(CLI::IsMember({"aarch64-linux-gnu"}).description(""))
      ->type_name("TARGET");
  build->callback([&call] {
    call.kind.emitCpp = call.emit == "cpp";
    call.exitCode = buildCommand(call.project, call.out, call.kind);
  });
}

void declareDoc(CLI::App &app, Invocation &call) {
  CLI::App *document = app.add_subcommand("doc", "Write the reference of the project as HTML");
  addProjectOptions(*document, call.project, false);
  document->add_flag("--library", call.library, "That of the standard library instead");
  document
      ->add_option("--figures", call.figures,
                   "Pictures LIBRARY/NAME.svg, with what they show in NAME.txt")
      ->type_name("FOLDER");
  document->add_option("-o,--out", call.out, "Folder for the pages (default: doc)")
      ->type_name("FOLDER");
  document->callback([&call] {
    call.exitCode = documentCommand(call.project, call.library, call.figures, call.out);
  });
}

void declareTest(CLI::App &app, Invocation &call) {
  CLI::App *test = app.add_subcommand(
      "test", "Build and run the unit tests, and compare the traces of [[test]]");
  addProjectOptions(*test, call.project, false);
  test->add_flag("--unchecked", call.project.unchecked,
                 "Leave out index, range, division and pointer checks");
  test->add_option("--filter", call.tests.filter, "Run the tests of these names only: Tank*")
      ->type_name("GLOB");
  test->add_option("--junit", call.tests.junit, "Write the results as JUnit XML")
      ->type_name("FILE");
  test->add_flag("--bless", call.tests.bless,
                 "Write the traces of [[test]] that differ where they are expected");
  test->add_flag("--list", call.tests.list, "Only name the tests");
  test->callback([&call] { call.exitCode = testCommand(call.project, call.tests); });
}

void declareFmt(CLI::App &app, Invocation &call) {
  CLI::App *fmt = app.add_subcommand("fmt", "Format source files");
  fmt->add_option("PATH", call.formatting.paths,
                  "Project folders and .st files (default: the current folder)")
      ->type_name("");
  fmt->add_flag("--check", call.formatting.check,
                "Write nothing; name the files that are not formatted and fail");
  fmt->add_flag("--diff", call.formatting.diff, "Write nothing; show what would change");
  fmt->add_flag("--stdin", call.formatting.fromStdin, "From standard input to standard output");
  addOutputOptions(*fmt, call.formatting.output);
  fmt->callback([&call] { call.exitCode = formatCommand(call.formatting); });
}

void declarePlot(CLI::App &app, Invocation &call) {
  CLI::App *plot = app.add_subcommand("plot", "Draw a trace");
  plot->add_option("TRACE", call.plot.trace, "CSV file that `stride sim --out` wrote")
      ->required()
      ->type_name("");
  plot->add_option("-o,--out", call.plot.out,
                   "File to write: .svg, or .html with a cursor and a zoom (default: TRACE with "
                   ".svg)")
      ->type_name("FILE");
  const auto time = [plot](const char *option, std::optional<double> &to, const char *help) {
    plot->add_option_function<std::string>(
            option,
            [option, &to](const std::string &text) {
              const std::optional<int64_t> ns = parseInterval(text);
              if (!ns)
                throw CLI::ValidationError(option,
                                           "`" + text + "` is no duration; write 2s or 1s500ms");
              to = static_cast<double>(*ns) * 1e-9;
            },
            help)
        ->type_name("TIME");
  };
  time("--from", call.plot.from, "Where the picture begins: 2s, T#1s500ms");
  time("--to", call.plot.to, "Where it ends");
  plot->add_option("--title", call.plot.title, "Text above the picture")->type_name("TEXT");
  CLI::Option *xy =
      plot->add_option("--xy", call.plot.xy,
                       "Two columns against each other instead of time: X.fSetPosition,"
                       "Y.fSetPosition (may be repeated)")
          ->allow_extra_args(false)
          ->type_name("NAMES");
  plot->add_option("--color", call.plot.color, "Of --xy: the column that colours the curves")
      ->needs(xy)
      ->type_name("NAME");
  plot->add_option("--panel", call.plot.panels,
                   "Columns of a panel, with * and ?: Drive.f*Position,Main.n; with a title: "
                   "Paths=Drive.f*Position (may be repeated; without it a panel per quantity)")
      ->allow_extra_args(false)
      ->excludes(xy)
      ->type_name("[TITLE=]NAMES");
  plot->add_option("--project", call.plot.project,
                   "Where the trace comes from: for types and units (default: the project that it "
                   "lies in, or of the current folder)")
      ->type_name("PATH");
  plot->callback([&call] { call.exitCode = plotCommand(call.plot); });
}

void declareExplain(CLI::App &app, Invocation &call) {
  CLI::App *explain =
      app.add_subcommand("explain", "Explain a diagnostic, an exception or a SoftMotion error");
  const CLI::Option *code =
      explain->add_option("CODE", call.code, "SE0203, SR0001, or a number or name of SMC_ERROR")
          ->type_name("");
  explain->add_flag("--list", call.listCodes, "List all codes");
  explain->callback([&call, code] {
    if (!call.listCodes && code->count() == 0)
      throw CLI::RequiredError("CODE or --list");
    call.exitCode = call.listCodes ? explainList() : explainCommand(call.code);
  });
}

/// "; did you mean `check`?", or an empty text.
std::string meantBy(std::string_view word, const std::vector<std::string> &known) {
  const std::string_view near = nearest(word, {known.begin(), known.end()});
  return near.empty() ? std::string() : "; did you mean `" + std::string(near) + "`?";
}

std::vector<std::string> commandNames(const CLI::App &app) {
  std::vector<std::string> names;
  for (const CLI::App *command : app.get_subcommands({}))
    names.push_back(command->get_name());
  return names;
}

void declareHelp(CLI::App &app, Invocation &call) {
  CLI::App *help = app.add_subcommand("help", "Show the commands, or the options of one");
  help->add_option("COMMAND", call.topic, "check, build, sim, …")->type_name("");
  help->callback([&app, &call] {
    if (call.topic == "ctl") {
      call.exitCode = hostOnlyCommand("ctl", {"--help"});
      return;
    }
    const CLI::App *shown = nullptr;
    for (const CLI::App *command : app.get_subcommands({}))
      if (command->get_name() == call.topic)
        shown = command;
    if (call.topic.empty())
      std::fputs(call.overview.c_str(), stdout);
    else if (shown == nullptr)
      throw CLI::ValidationError("there is no command `" + call.topic + "`" +
                                 meantBy(call.topic, commandNames(app)));
    else
      std::fputs(shown->help("stride").c_str(), stdout);
  });
  call.overview = app.help(); // asked while a command is parsed, it would be that command's
}

std::string whatIsWrong(const CLI::App &app, const CLI::ParseError &error) {
  using stride::common::UnknownWord;
  const UnknownWord unknown = stride::common::unknownWord(app, error);
  const std::string meant = meantBy(unknown.word, unknown.known);
  switch (unknown.kind) {
  case UnknownWord::Kind::Command:
    return "there is no command `" + unknown.word + "`" + meant;
  case UnknownWord::Kind::Option:
    return "there is no option `" + unknown.word + "`" + meant;
  case UnknownWord::Kind::Argument:
    return "`" + unknown.word + "` was not expected";
  case UnknownWord::Kind::None:
    break;
  }
  const std::string missing = stride::common::missingCommand(app, error);
  return missing.empty() ? error.what() : missing;
}

/// `--listen` alone means the project's own socket: CLI11 would take the project for its value.
std::vector<std::string> argumentsOf(int argc, char **argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  for (size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i)
    if (arguments[i] == "--listen" &&
        (i + 1 == arguments.size() || arguments[i + 1].find(':') == std::string::npos))
      arguments[i] += '=' + std::string(kOwnSocket);
  std::reverse(arguments.begin(), arguments.end()); // as CLI11 wants them
  return arguments;
}

int run(int argc, char **argv, Kept &kept) {
  CLI::App app("Structured Text and SoftMotion programs: check, build, simulate");
  app.set_version_flag("--version", versionText());
  app.require_subcommand(0, 1);
  app.name("stride");
  Invocation call;
  call.project.kept = &kept;
  // In the order in which the overview shows them.
  for (const auto declare :
       {declareNew, declareImports, declareCheck, declareBuild, declareRuns, declareDoc,
        declareTest, declareFmt, declarePlot, declareExports, declareCams, declareCnc, declareCan,
        declareCsy, declareLibraries, declareExplain, declareCompletion, declareHelp})
    declare(app, call);
  try {
    app.parse(argumentsOf(argc, argv));
  } catch (const CLI::Success &success) { // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError &error) {
    std::fprintf(stderr, "stride: %s\nTry: %s --help\n", whatIsWrong(app, error).c_str(),
                 stride::common::commandPath(app, "stride").c_str());
    return kUsageError;
  }
  if (app.get_subcommands().empty())
    std::fputs(app.help().c_str(), stdout);
  return call.exitCode;
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
  stc::cli::keepFreedMemory();
  stc::cli::Kept kept;
  try {
    // Ends here, with `kept` as it is.
    std::exit(stc::cli::concluded(stc::cli::run(argc, argv, kept)));
  } catch (const std::bad_alloc &) {
    std::fputs("stride: there is not enough memory\n", stderr);
    return 1;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "stride: internal error: %s\n", error.what());
    return 70;
  }
}
