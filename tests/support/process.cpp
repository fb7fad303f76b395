#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <csignal>
#include <fcntl.h>
#include <map>
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

/// A command with its surroundings, made before the fork: where there are threads, a child must not
/// allocate.
struct Command {
  std::vector<std::string> environment; ///< NAME=VALUE
  std::vector<char *> argv;
  std::vector<char *> envp;
  const char *directory;

  Command(const std::vector<std::string> &arguments, const std::filesystem::path &folder,
          const std::vector<std::pair<std::string, std::string>> &added)
      : directory(folder.c_str()) {
    std::map<std::string, std::string> variables;
    for (char **one = environ; *one != nullptr; ++one)
      if (const std::string text = *one; text.find('=') != std::string::npos)
        variables.emplace(text.substr(0, text.find('=')), text.substr(text.find('=') + 1));
    variables["NO_COLOR"] = "1";
    for (const auto &[name, value] : added)
      variables[name] = value;
    for (const auto &[name, value] : variables)
      environment.push_back(name + "=" + value);
    for (std::string &variable : environment)
      envp.push_back(variable.data());
    envp.push_back(nullptr);
    for (const std::string &argument : arguments)
      argv.push_back(const_cast<char *>(argument.c_str())); // execvpe does not write to them
    argv.push_back(nullptr);
  }
};

/// Becomes the command; in a child.
[[noreturn]] void become(const Command &command) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (chdir(command.directory) == 0)
    execvpe(command.argv[0], command.argv.data(), command.envp.data());
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
  const Command command(arguments, directory, environment);
  const pid_t child = fork();
  if (child < 0)
    throw std::runtime_error("cannot fork");
  if (child == 0) {
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(out.c_str(), O_WRONLY | O_CREAT, STDOUT_FILENO);
    redirect(err.c_str(), O_WRONLY | O_CREAT, STDERR_FILENO);
    become(command);
  }
  const int code = waitFor(child, arguments.front() + " in " + directory.string());
  return {code, readFile(out), readFile(err)};
}

ProcessResult runOnTerminal(const std::vector<std::string> &arguments,
                            const std::filesystem::path &directory,
                            const std::vector<std::pair<std::string, std::string>> &environment) {
  const Command command(arguments, directory, environment);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child < 0)
    throw std::runtime_error("cannot make a terminal");
  if (child == 0)
    become(command);
  std::string shown;
  char buffer[4096];
  for (ssize_t count = 0; (count = read(terminal, buffer, sizeof buffer)) > 0;) // EIO at its end
    shown.append(buffer, static_cast<size_t>(count));
  const int code = waitFor(child, arguments.front() + " in " + directory.string());
  close(terminal);
  return {code, shown, {}};
}

} // namespace stride::test
