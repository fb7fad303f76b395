// check --watch, run --watch
#include "compiler/cli/file_watch.hpp"
#include "compiler/cli/run_project.hpp"
#include "compiler/source/render.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stc::cli {

namespace {

constexpr int kLookMs = 200;
constexpr int kSignalled = 128;

/// A line between what was said and what follows, at its beginning also where the run shows a
/// status line.
void say(const std::string &text) {
  std::fputs(
      fmt::format("{}stride: {}\n", ::isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "", text).c_str(),
      stderr);
  std::fflush(stderr);
}

int cannotWatch() {
  say(fmt::format("changes cannot be watched: {}", std::strerror(errno)));
  return 1;
}

// The run that signals are handed on to; 0: none.
std::atomic<pid_t> child{0};

extern "C" void handOn(int number) {
  if (const pid_t run = child.load(); run != 0)
    ::kill(run, number);
}

constexpr int kHandedOn[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};

/// Starts the run in a process of its own, which ends with this one.
bool start(const std::vector<std::string> &arguments, const Output &output) {
  const pid_t parent = ::getpid();
  std::fflush(nullptr);
  ::sigset_t all;
  ::sigset_t before;
  ::sigemptyset(&all);
  for (const int number : kHandedOn)
    ::sigaddset(&all, number);
  ::sigprocmask(SIG_BLOCK, &all, &before); // until each knows what to do with them
  const pid_t run = ::fork();
  if (run == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent)
      ::_exit(1);
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    holdSignalsOfRuns();
    ::_exit(becomeHost(arguments, output));
  }
  if (run > 0) {
    child.store(run);
    struct sigaction action {};
    action.sa_handler = handOn;
    for (const int number : kHandedOn)
      ::sigaction(number, &action, nullptr);
  }
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  return run > 0;
}

/// The exit code of the run when it has ended.
std::optional<int> ended() {
  int status = 0;
  if (::waitpid(child.load(), &status, WNOHANG) != child.load())
    return std::nullopt;
  child.store(0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

} // namespace

int watchCheckCommand(const ProjectOptions &options) {
  FileWatch watch(options.path);
  while (true) {
    watch.refresh();
    say(checkCommand(options) == 0 ? "no errors; waiting for changes" : "waiting for changes");
    for (FileWatch::Event event = FileWatch::Event::Nothing; event != FileWatch::Event::Changed;) {
      event = watch.wait(-1);
      if (event == FileWatch::Event::Failed)
        return cannotWatch();
    }
  }
}

int watchRunCommand(const ProjectOptions &options, const std::vector<std::string> &hostArguments) {
  FileWatch watch(options.path);
  std::filesystem::path running;
  bool changed = true; // nothing has been built yet
  while (true) {
    if (changed) {
      watch.refresh();
      int exitCode = 0;
      const std::optional<BuildResult> result =
          buildToRun(options, BuildUse::Run, exitCode, hostArguments);
      if (!result)
        say(child.load() != 0 ? "the old program goes on; waiting for changes"
                              : "waiting for changes");
      else if (child.load() == 0) {
        const auto arguments = hostArgumentsOf(options, "run", *result, hostArguments);
        if (!arguments || !start(*arguments, options.output))
          return 1;
      } else if (result->runnable != running) {
        ::kill(child.load(), SIGHUP);
      }
      if (result)
        running = result->runnable;
    }
    const FileWatch::Event event = watch.wait(kLookMs);
    if (event == FileWatch::Event::Failed)
      return cannotWatch();
    changed = event == FileWatch::Event::Changed;
    if (child.load() == 0)
      continue;
    if (const std::optional<int> exitCode = ended())
      return *exitCode;
  }
}

} // namespace stc::cli
