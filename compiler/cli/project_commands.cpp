// check, build, sim, run, reset

#include "compiler/cli/run_project.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/installation.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"
#include "compiler/project/run_socket.hpp"
#include "compiler/source/render.hpp"
#include "compiler/source/suggest.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <sys/wait.h>
#include <unistd.h>

namespace stc::cli {

Settings settingsOf(const ProjectOptions &options) {
  Settings settings;
  settings.checks = !options.unchecked;
  settings.levels = options.levels;
  for (const std::string &text : options.defines)
    if (const std::optional<Define> define = readDefine(text))
      settings.defines.push_back(*define);
  return settings;
}

namespace {

// The project, which stays until the process ends where it may.
std::shared_ptr<Project> openProject(const ProjectOptions &options, Purpose purpose,
                                     const LibraryIndex &index) {
  if (options.kept != nullptr)
    options.kept->reset(); // that of the last round of `--watch`
  auto project = std::make_shared<Project>(options.path, purpose, settingsOf(options), index);
  if (options.kept != nullptr)
    *options.kept = project;
  return project;
}

// Opens and builds the project and shows its diagnostics. `exitCode` is that of the command.
std::optional<BuildResult> buildProject(const ProjectOptions &options, BuildOptions build,
                                        ProgressLine &progress, int &exitCode) {
  const EmbeddedLibraryIndex index(standardLibrary());
  const std::shared_ptr<Project> project = openProject(options, Purpose::Build, index);
  std::optional<BuildResult> result;
  if (!project->hasErrors()) {
    build.debug = options.debug;
    build.progress = [&](std::string_view what, size_t done, size_t total) {
      progress.update(what, done, total);
    };
    result = stc::build(*project, build);
  }
  progress.clear();
  exitCode = show(project->diagnostics(), project->sources(), options.output);
  return result;
}

bool has(const std::vector<std::string> &arguments, std::string_view option) {
  return std::find(arguments.begin(), arguments.end(), option) != arguments.end();
}

// Whether a link in the project leads a path of it elsewhere. stride.toml may name another place
// outright; a link is not the user's word.
bool isLedOut(const std::filesystem::path &path, const std::filesystem::path &folder) {
  const std::filesystem::path from = folder.empty() ? "." : folder;
  const std::filesystem::path relative = path.lexically_relative(from);
  return !relative.empty() && *relative.begin() != ".." && leadsOut(from, path);
}

// Adds `option` with a path of the project, unless the user has given it. False: links of the
// project lead it elsewhere, which is shown.
bool addPath(std::vector<std::string> &arguments, const std::string &option,
             const std::filesystem::path &path, const std::filesystem::path &folder,
             const Output &output) {
  if (has(arguments, option))
    return true;
  if (isLedOut(path, folder)) {
    showError(
        Code::LinkInTheWay,
        fmt::format("`{}` leads out of the project; if that is wanted, name the place with {}",
                    path.string(), option),
        output);
    return false;
  }
  arguments.insert(arguments.end(), {option, path.string()});
  return true;
}

// Puts the project's own socket where it is meant. False: there can be none, which is shown.
bool fillInSocket(std::vector<std::string> &arguments, const ProjectOptions &options) {
  for (size_t i = 0; i + 1 < arguments.size(); ++i) {
    if (arguments[i] != "--listen" || arguments[i + 1] != kOwnSocket)
      continue;
    std::string problem;
    const std::optional<std::filesystem::path> socket =
        makeRunSocket(projectPlace(options.path), problem);
    if (!socket) {
      showError(Code::CannotWrite,
                fmt::format("there is no folder for the project's socket: {}; name a place: "
                            "--listen unix:PATH",
                            problem),
                options.output);
      return false;
    }
    arguments[i + 1] = "unix:" + socket->string();
  }
  return true;
}

/// Puts what records a group in place of each `--group`. False: there is no such group, which is
/// shown.
bool fillInGroups(std::vector<std::string> &arguments, const BuildResult &result) {
  for (size_t i = 0; i + 1 < arguments.size(); ++i) {
    if (arguments[i] != "--group")
      continue;
    const auto group =
        std::find_if(result.groups.begin(), result.groups.end(), [&](const GroupTrace &one) {
          return equalIgnoringCase(one.name, arguments[i + 1]);
        });
    if (group == result.groups.end()) {
      std::vector<std::string_view> names;
      for (const GroupTrace &one : result.groups)
        names.push_back(one.name);
      const std::string_view near = nearest(arguments[i + 1], names);
      std::fprintf(stderr, "stride: stride.toml has no [[axes_group]] `%s`%s\n",
                   visible(arguments[i + 1]).c_str(),
                   near.empty() ? "" : fmt::format("; did you mean `{}`?", near).c_str());
      return false;
    }
    arguments[i] = "--set";
    arguments[i + 1] = group->assignment;
    arguments.insert(arguments.begin() + static_cast<ptrdiff_t>(i) + 2,
                     {"--trace", group->columns});
  }
  return true;
}

} // namespace

int become(const std::string &program, std::vector<std::string> arguments, const Output &output,
           std::string_view remedy) {
  std::vector<char *> pointers;
  for (std::string &argument : arguments)
    pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  std::fflush(nullptr);
  ::execvp(program.c_str(), pointers.data());
  return showError(
      Code::ToolchainMissing,
      fmt::format("`{}` cannot be started: {}{}", program, std::strerror(errno), remedy), output);
}

std::optional<BuildResult> buildToRun(const ProjectOptions &options, BuildUse use, int &exitCode,
                                      const std::vector<std::string> &hostArguments) {
  ProgressLine progress;
  BuildOptions build;
  build.use = use;
  // The last one counts, as for the host.
  for (size_t i = 0; i + 1 < hostArguments.size(); ++i)
    if (hostArguments[i] == "--files")
      build.filesFolder = hostArguments[i + 1];
  std::optional<BuildResult> result = buildProject(options, build, progress, exitCode);
  return exitCode == 0 ? std::move(result) : std::nullopt;
}

void holdSignalsOfRuns() {
  ::sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGUSR1);
  ::sigaddset(&signals, SIGHUP);
  ::sigprocmask(SIG_BLOCK, &signals, nullptr);
}

std::string hostProgram() {
  std::string missing;
  const std::optional<Installation> installation = findInstallation(missing);
  return installation ? installation->host.string() : missing;
}

int runHost(std::vector<std::string> arguments, const Output &output) {
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0)
    ::_exit(becomeHost(std::move(arguments), output));
  int status = 0;
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR)
    continue;
  if (child < 0)
    return showError(Code::ToolchainMissing,
                     fmt::format("no process can be started: {}", std::strerror(errno)), output);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int becomeHost(std::vector<std::string> arguments, const Output &output) {
  arguments.insert(arguments.begin(), "stride"); // whose part it is, for its messages
  return become(hostProgram(), std::move(arguments), output);
}

int checkCommand(const ProjectOptions &options) {
  const EmbeddedLibraryIndex index(standardLibrary());
  const std::shared_ptr<const Project> project = openProject(options, Purpose::Check, index);
  return show(project->diagnostics(), project->sources(), options.output);
}

int buildCommand(const ProjectOptions &options, const std::string &out, const BuildKind &kind) {
  const bool emitCpp = kind.emitCpp;
  BuildOptions build;
  build.output = out;
  build.emitOnly = emitCpp;
  build.isStatic = kind.isStatic;
  build.target = kind.target;
  const std::filesystem::path path(options.path);
  std::error_code error;
  // What somebody asks to be built from a single file is put where he stands.
  if (out.empty() && !emitCpp && std::filesystem::is_regular_file(path, error) &&
      path.filename() != "stride.toml")
    build.output = path.stem().string() + (kind.isStatic ? "" : ".so");
  ProgressLine progress;
  int exitCode = 0;
  const std::optional<BuildResult> result = buildProject(options, build, progress, exitCode);
  if (result && progress.isTerminal())
    std::fputs(emitCpp ? fmt::format("Written: {}\n", visible(result->application.string())).c_str()
                       : fmt::format("Built {} in {:.2f} s ({} of {} units compiled)\n",
                                     visible(result->application.string()), progress.seconds(),
                                     result->compiled, result->units)
                             .c_str(),
               stderr);
  return exitCode;
}

int hostOnlyCommand(const std::string &command, const std::vector<std::string> &hostArguments) {
  std::vector<std::string> arguments = {command};
  arguments.insert(arguments.end(), hostArguments.begin(), hostArguments.end());
  return becomeHost(std::move(arguments), {});
}

int controlCommand(std::vector<std::string> arguments) {
  const auto isHelp = [](const std::string &word) { return word == "--help" || word == "-h"; };
  if (arguments.empty() || std::any_of(arguments.begin(), arguments.end(), isHelp) ||
      arguments.front().find(':') != std::string::npos)
    return hostOnlyCommand("ctl",
                           arguments.empty() ? std::vector<std::string>{"--help"} : arguments);
  std::filesystem::path project;
  if (const std::string &first = arguments.front(); first == "." || first == ".." ||
                                                    first.find('/') != std::string::npos ||
                                                    first.ends_with(".st")) {
    project = first;
    arguments.erase(arguments.begin());
  }
  const std::filesystem::path place = projectPlace(project);
  if (place.empty())
    return showError(Code::PathNotFound,
                     fmt::format("there is no file or folder `{}`", project.string()));
  const std::optional<std::filesystem::path> socket = findRunSocket(place);
  if (!socket) {
    std::fprintf(stderr,
                 "stride: no run of `%s` listens: start it with `stride run --listen`, or name its "
                 "socket: stride ctl unix:PATH\n",
                 visible(place.string()).c_str());
    return 1;
  }
  arguments.insert(arguments.begin(), "unix:" + socket->string());
  return hostOnlyCommand("ctl", arguments);
}

std::optional<std::vector<std::string>> hostArgumentsOf(const ProjectOptions &options,
                                                        const std::string &command,
                                                        const BuildResult &result,
                                                        const std::vector<std::string> &own) {
  const bool isRun = command == "run";
  std::vector<std::string> arguments = {command, result.runnable.string()};
  if (isRun)
    arguments.insert(arguments.end(), {"--name", result.name});
  if (isRun && !result.latest.empty())
    arguments.insert(arguments.end(), {"--latest", result.latest.string()});
  arguments.insert(arguments.end(), own.begin(), own.end());
  if (!fillInSocket(arguments, options) || !fillInGroups(arguments, result))
    return std::nullopt;
  if ((isRun &&
       !addPath(arguments, "--retain", result.retainFile, result.folder, options.output)) ||
      ((isRun || command == "sim") &&
       !addPath(arguments, "--files", result.filesRoot, result.folder, options.output)))
    return std::nullopt;
  return arguments;
}

int hostCommand(const ProjectOptions &options, const std::string &command,
                const std::vector<std::string> &hostArguments) {
  int exitCode = 0;
  const bool isRun = command == "run";
  const std::optional<BuildResult> result =
      buildToRun(options, isRun ? BuildUse::Run : BuildUse::RunOnce, exitCode, hostArguments);
  if (!result)
    return exitCode;
  std::optional<std::vector<std::string>> arguments =
      hostArgumentsOf(options, command, *result, hostArguments);
  if (!arguments)
    return 1;
  if (isRun)
    holdSignalsOfRuns();
  return becomeHost(std::move(*arguments), options.output);
}

int debugCommand(const ProjectOptions &options, const std::vector<std::string> &hostArguments,
                 const DebugSession &session) {
  int exitCode = 0;
  const std::optional<BuildResult> result =
      buildToRun(options, BuildUse::RunOnce, exitCode, hostArguments);
  if (!result)
    return exitCode;
  // The names of the sources count from there.
  std::error_code error;
  std::string missing;
  const std::optional<Installation> installation = findInstallation(missing);
  if (!installation)
    return showError(Code::ToolchainMissing, missing, options.output);
  std::vector<std::string> arguments = {
      "gdb",
      "-q",
      "-iex",
      "set auto-load local-gdbinit off", // of the folder, which may be the project's
      "-x",
      installation->debugScript.string(),
      "-ex",
      "directory " + (std::filesystem::current_path(error) / result->folder).string(),
      "-ex",
      fmt::format("set substitute-path {} {}", kHeadersInLineTables, result->headers.string()),
      "-ex",
      "st start"};
  if (session.batch)
    arguments.insert(arguments.begin() + 1, "-batch");
  for (const std::string &script : session.scripts)
    arguments.insert(arguments.end(), {"-x", script});
  arguments.insert(arguments.end(),
                   {"--args", installation->host.string(), "sim", result->runnable.string()});
  arguments.insert(arguments.end(), hostArguments.begin(), hostArguments.end());
  if (!fillInGroups(arguments, *result))
    return 1;
  return become("gdb", std::move(arguments), options.output,
                "; on Debian, `apt install gdb` installs it");
}

int resetCommand(const ProjectOptions &options, const std::string &kind) {
  const EmbeddedLibraryIndex index(standardLibrary());
  // Only where the file is, which errors in the sources do not change.
  const Project project(options.path, Purpose::Check, settingsOf(options), index);
  if (project.name().empty())
    return show(project.diagnostics(), project.sources(), options.output);
  const std::filesystem::path file = retainFileOf(project);
  if (isLedOut(file, folderOf(project)))
    return showError(
        Code::LinkInTheWay,
        fmt::format("`{}` leads out of the project; if that is wanted, use `stride-host "
                    "reset {} FILE` with the place it leads to",
                    file.string(), kind),
        options.output);
  std::error_code error;
  const auto exists = [&](const char *ending) {
    return std::filesystem::symlink_status(file.string() + ending, error).type() !=
           std::filesystem::file_type::not_found;
  };
  // Before the first run, and after `reset origin`; who cannot look gets to know from the host.
  if (!exists(".a") && !exists(".b")) {
    print(fmt::format("Nothing to reset: there are no retained data in `{}`.\n", file.string()));
    return 0;
  }
  return becomeHost({"reset", kind, file.string()}, options.output);
}

} // namespace stc::cli
