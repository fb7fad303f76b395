#include "compiler/project/job_pool.hpp"

#include "compiler/project/file_system.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char **environ; // NOLINT(readability-redundant-declaration)

namespace stc {

namespace {

struct Running {
  size_t job;
  pid_t pid;
  int output; // read end of its pipe
};

/// The environment, but for the language: messages are looked at, and shown in reports of defects;
/// and, if a folder is given, but for where temporary files go.
class JobEnvironment {
public:
  explicit JobEnvironment(const std::string &temporary) : temporary_("TMPDIR=" + temporary) {
    for (char **variable = environ; *variable != nullptr; ++variable)
      if (!std::string_view(*variable).starts_with("LC_ALL=") &&
          (temporary.empty() || !std::string_view(*variable).starts_with("TMPDIR=")))
        variables_.push_back(*variable);
    variables_.push_back(language_.data());
    if (!temporary.empty())
      variables_.push_back(temporary_.data());
    variables_.push_back(nullptr);
  }
  [[nodiscard]] char *const *get() const { return variables_.data(); }

private:
  std::string language_ = "LC_ALL=C";
  std::string temporary_;
  std::vector<char *> variables_;
};

// Starts the command with both output streams in a pipe.
bool start(const Job &job, Running &running, JobResult &result) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    result = {127, lastError()};
    return false;
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  if (!job.folder.empty())
    posix_spawn_file_actions_addchdir_np(&actions, job.folder.c_str());
  std::vector<char *> arguments;
  for (const std::string &argument : job.command)
    arguments.push_back(const_cast<char *>(argument.c_str())); // NOLINT: the C interface
  arguments.push_back(nullptr);
  const JobEnvironment environment(job.temporary);
  const int error = ::posix_spawnp(&running.pid, arguments[0], &actions, nullptr, arguments.data(),
                                   environment.get());
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error != 0) {
    ::close(ends[0]);
    result = {127, std::strerror(error)};
    return false;
  }
  running.output = ends[0];
  return true;
}

// Takes what a job has printed; true at its end.
bool drain(const Running &running, JobResult &result) {
  char buffer[4096];
  const ssize_t count = ::read(running.output, buffer, sizeof(buffer));
  if (count < 0)
    return errno != EINTR && errno != EAGAIN;
  result.output.append(buffer, static_cast<size_t>(count));
  return count == 0;
}

int waitFor(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0)
    if (errno != EINTR)
      return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace

std::vector<JobResult> runJobs(const std::vector<Job> &jobs,
                               const std::function<void(size_t)> &started, unsigned limit) {
  std::vector<JobResult> results(jobs.size(), JobResult{-1, {}});
  if (limit == 0)
    limit = std::max(1U, std::thread::hardware_concurrency());
  std::vector<Running> running;
  size_t next = 0;
  bool failed = false;
  while (!running.empty() || (next < jobs.size() && !failed)) {
    while (running.size() < limit && next < jobs.size() && !failed) {
      if (started)
        started(next);
      Running entry{next, 0, -1};
      results[next].status = 0;
      if (start(jobs[next], entry, results[next]))
        running.push_back(entry);
      else
        failed = true;
      ++next;
    }
    if (running.empty())
      break; // the first one could not even be started
    std::vector<pollfd> waits;
    for (const Running &entry : running)
      waits.push_back({entry.output, POLLIN, 0});
    if (::poll(waits.data(), waits.size(), -1) < 0 && errno != EINTR)
      break;
    for (size_t i = running.size(); i-- > 0;) {
      if (waits[i].revents == 0 || !drain(running[i], results[running[i].job]))
        continue;
      ::close(running[i].output);
      results[running[i].job].status = waitFor(running[i].pid);
      failed = failed || results[running[i].job].status != 0;
      running.erase(running.begin() + static_cast<ptrdiff_t>(i));
    }
  }
  return results;
}

std::string shellQuoted(const std::vector<std::string> &command) {
  std::string result;
  for (const std::string &word : command) {
    if (!result.empty())
      result += ' ';
    const bool plain = !word.empty() &&
                       word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                              "0123456789-_=+./,:@%") == std::string::npos;
    if (plain) {
      result += word;
      continue;
    }
    result += '\'';
    for (const char c : word)
      result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    result += '\'';
  }
  return result;
}

} // namespace stc
