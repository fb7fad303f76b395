#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <pty.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stride::test {

namespace {

constexpr int kCannotStart = 127;

void redirect(const char *path, int flags, int descriptor) {
  const int file = open(path, flags, 0600);
  if (file < 0 || dup2(file, descriptor) < 0)
    _exit(kCannotStart);
  close(file);
}

/// Becomes the command; in a child.
[[noreturn]] void become(const std::vector<std::string> &arguments,
                         const std::filesystem::path &directory,
                         const std::vector<std::pair<std::string, std::string>> &environment) {
  std::vector<char *> argv;
  for (const std::string &argument : arguments)
    argv.push_back(const_cast<char *>(argument.c_str())); // execvp does not write to them
  argv.push_back(nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setenv("NO_COLOR", "1", 1);
  for (const auto &[name, value] : environment)
    setenv(name.c_str(), value.c_str(), 1);
  if (chdir(directory.c_str()) == 0)
    execvp(argv[0], argv.data());
  _exit(kCannotStart);
}

int waitFor(pid_t child, const std::string &what) {
  int status = 0;
  if (waitpid(child, &status, 0) < 0)
    throw std::runtime_error("cannot wait for " + what);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (code == kCannotStart)
    throw std::runtime_error("cannot start " + what);
  return code;
}

} // namespace

ProcessResult runProcess(const std::vector<std::string> &arguments,
                         const std::filesystem::path &directory,
                         const std::vector<std::pair<std::string, std::string>> &environment) {
  const ScratchDirectory scratch;
  const std::string out = scratch.path() / "out";
  const std::string err = scratch.path() / "err";
  const pid_t child = fork();
  if (child < 0)
    throw std::runtime_error("cannot fork");
  if (child == 0) {
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(out.c_str(), O_WRONLY | O_CREAT, STDOUT_FILENO);
    redirect(err.c_str(), O_WRONLY | O_CREAT, STDERR_FILENO);
    become(arguments, directory, environment);
  }
  const int code = waitFor(child, arguments.front() + " in " + directory.string());
  return {code, readFile(out), readFile(err)};
}

ProcessResult runOnTerminal(const std::vector<std::string> &arguments,
                            const std::filesystem::path &directory,
                            const std::vector<std::pair<std::string, std::string>> &environment) {
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child < 0)
    throw std::runtime_error("cannot make a terminal");
  if (child == 0)
    become(arguments, directory, environment);
  std::string shown;
  char buffer[4096];
  for (ssize_t count = 0; (count = read(terminal, buffer, sizeof buffer)) > 0;) // EIO at its end
    shown.append(buffer, static_cast<size_t>(count));
  const int code = waitFor(child, arguments.front() + " in " + directory.string());
  close(terminal);
  return {code, shown, {}};
}

} // namespace stride::test
