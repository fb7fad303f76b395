#include "tests/support/fault_injection.hpp"

#include "tests/support/text.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stride::test {

namespace {

namespace fs = std::filesystem;

#if defined(__x86_64__)
constexpr uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#else
constexpr uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#endif

std::vector<long> numbersOf(CallClass what) {
  switch (what) {
  case CallClass::Open:
    return {
#ifdef SYS_open
        SYS_open, SYS_creat,
#endif
        SYS_openat};
  case CallClass::Write:
    return {SYS_write,    SYS_pwrite64,        SYS_writev,  SYS_pwritev,
            SYS_pwritev2, SYS_copy_file_range, SYS_sendfile};
  case CallClass::Sync:
    return {SYS_fsync, SYS_fdatasync};
  case CallClass::Rename:
    return {
#ifdef SYS_rename
        SYS_rename,   SYS_link,      SYS_symlink,
#endif
        SYS_renameat, SYS_renameat2, SYS_linkat,  SYS_symlinkat};
  case CallClass::Folder:
    return {
#ifdef SYS_mkdir
        SYS_mkdir,
#endif
        SYS_mkdirat};
  case CallClass::Resize:
    return {
#ifdef SYS_chmod
        SYS_chmod,
#endif
        SYS_ftruncate, SYS_fallocate, SYS_fchmod, SYS_fchmodat};
  case CallClass::Socket:
    return {SYS_socket, SYS_bind, SYS_listen, SYS_accept4};
  case CallClass::Send:
    return {SYS_sendto};
  }
  return {};
}

/// Lets these calls be asked about; the descriptor to do so, or -1.
int intercept(const std::vector<long> &numbers) {
  const auto count = static_cast<uint8_t>(numbers.size());
  std::vector<::sock_filter> code = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(::seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 0, static_cast<uint8_t>(count + 1)),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(::seccomp_data, nr))};
  for (uint8_t i = 0; i < count; ++i)
    code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<uint32_t>(numbers[i]),
                            static_cast<uint8_t>(count - i), 0));
  code.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  code.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF));
  const ::sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
    return -1;
  return static_cast<int>(
      ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_NEW_LISTENER, &program));
}

/// sendmsg() is not among the calls that are intercepted.
void sendDescriptor(int channel, int descriptor) {
  char byte = descriptor < 0 ? 'n' : 'y';
  ::iovec part{&byte, 1};
  alignas(::cmsghdr) char control[CMSG_SPACE(sizeof(int))]{};
  ::msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  if (descriptor >= 0) {
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    ::cmsghdr *head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(head), &descriptor, sizeof descriptor);
  }
  ::sendmsg(channel, &message, 0);
}

int receiveDescriptor(int channel) {
  char byte = 'n';
  ::iovec part{&byte, 1};
  alignas(::cmsghdr) char control[CMSG_SPACE(sizeof(int))]{};
  ::msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  if (::recvmsg(channel, &message, MSG_CMSG_CLOEXEC) <= 0 || byte != 'y')
    return -1;
  const ::cmsghdr *head = CMSG_FIRSTHDR(&message);
  int descriptor = -1;
  if (head != nullptr)
    std::memcpy(&descriptor, CMSG_DATA(head), sizeof descriptor);
  return descriptor;
}

std::string linkOf(const std::string &path) {
  std::error_code error;
  return fs::read_symlink(path, error).string();
}

class Supervisor {
public:
  Supervisor(int listener, const Fault &fault, fs::path folder)
      : listener_(listener), fault_(fault), folder_(std::move(folder)) {}

  void answerOne() {
    ::seccomp_notif asked{};
    if (::ioctl(listener_, SECCOMP_IOCTL_NOTIF_RECV, &asked) != 0)
      return;
    ::seccomp_notif_resp answer{};
    answer.id = asked.id;
    const bool matters = counts(asked);
    if (matters)
      ++calls;
    if (matters && fault_.nth != 0 &&
        (calls == fault_.nth || (fault_.onwards && calls > fault_.nth)))
      answer.error = -fault_.error;
    else
      answer.flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE;
    ::ioctl(listener_, SECCOMP_IOCTL_NOTIF_SEND, &answer);
  }

  unsigned calls = 0;

private:
  /// Not what loaders, compilers and the system do for themselves.
  bool counts(const ::seccomp_notif &asked) const {
    const std::string process = "/proc/" + std::to_string(asked.pid);
    const auto file = [&](uint64_t number) {
      return linkOf(process + "/fd/" + std::to_string(number));
    };
    switch (fault_.what) {
    case CallClass::Write: {
      const std::string target = file(asked.data.args[0]);
      return ours(target) || target.starts_with("pipe:") || asked.data.args[0] == STDOUT_FILENO ||
             asked.data.args[0] == STDERR_FILENO;
    }
    case CallClass::Open:
      return opensToWrite(asked);
    default:
      return true;
    }
  }
  bool opensToWrite(const ::seccomp_notif &asked) const {
    const bool at = asked.data.nr == SYS_openat;
    const uint64_t flags = asked.data.args[at ? 2 : 1];
    const bool writes =
        (flags & O_ACCMODE) != O_RDONLY || (flags & O_CREAT) != 0 || !hasFlags(asked);
    char path[512]{};
    ::iovec here{path, sizeof path - 1};
    ::iovec there{reinterpret_cast<void *>(asked.data.args[at ? 1 : 0]), sizeof path - 1};
    if (!writes || ::process_vm_readv(static_cast<pid_t>(asked.pid), &here, 1, &there, 1, 0) <= 0)
      return false;
    return path[0] != '/' || ours(path);
  }
  static bool hasFlags([[maybe_unused]] const ::seccomp_notif &asked) {
#ifdef SYS_creat
    return asked.data.nr != SYS_creat;
#else
    return true;
#endif
  }
  bool ours(const std::string &path) const { return path.starts_with(folder_.string()); }

  int listener_;
  Fault fault_;
  fs::path folder_;
};

struct Child {
  pid_t pid = -1;
  int listener = -1;
};

void redirect(const std::string &path, int flags, int descriptor) {
  const int file = ::open(path.c_str(), flags, 0600);
  if (file < 0 || ::dup2(file, descriptor) < 0)
    ::_exit(127);
  ::close(file);
}

Child start(const std::vector<std::string> &arguments, const fs::path &directory,
            const Fault &fault, const fs::path &outputs,
            const std::vector<std::pair<std::string, std::string>> &environment) {
  std::vector<char *> argv;
  for (const std::string &argument : arguments)
    argv.push_back(const_cast<char *>(argument.c_str())); // execvp does not write to them
  argv.push_back(nullptr);
  std::array<int, 2> channel{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, channel.data()) != 0)
    throw std::runtime_error("no sockets");
  Child child;
  child.pid = ::fork();
  if (child.pid == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::setpgid(0, 0);
    ::setenv("NO_COLOR", "1", 1);
    for (const auto &[name, value] : environment)
      ::setenv(name.c_str(), value.c_str(), 1);
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect((outputs / "out").string(), O_WRONLY | O_CREAT, STDOUT_FILENO);
    redirect((outputs / "err").string(), O_WRONLY | O_CREAT, STDERR_FILENO);
    if (::chdir(directory.c_str()) != 0)
      ::_exit(127);
    const int listener = intercept(numbersOf(fault.what));
    sendDescriptor(channel[1], listener);
    ::close(listener);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  ::close(channel[1]);
  if (child.pid > 0)
    child.listener = receiveDescriptor(channel[0]);
  ::close(channel[0]);
  return child;
}

} // namespace

FaultedRun runWithFault(const std::vector<std::string> &arguments, const fs::path &directory,
                        const Fault &fault,
                        const std::vector<std::pair<std::string, std::string>> &environment,
                        int seconds) {
  const ScratchDirectory outputs;
  const Child child = start(arguments, directory, fault, outputs.path(), environment);
  if (child.pid < 0)
    throw std::runtime_error("cannot fork");
  Supervisor supervisor(child.listener, fault, directory);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  FaultedRun run;
  int status = 0;
  for (;;) {
    ::pollfd file{child.listener, POLLIN, 0};
    if (child.listener >= 0 && ::poll(&file, 1, 20) > 0 && (file.revents & POLLIN) != 0)
      supervisor.answerOne();
    else if (child.listener < 0)
      ::usleep(1000);
    if (::waitpid(child.pid, &status, WNOHANG) != 0)
      break;
    if (!run.tooLong && std::chrono::steady_clock::now() > end) {
      run.tooLong = true;
      ::kill(-child.pid, SIGKILL);
    }
  }
  ::kill(-child.pid, SIGKILL); // what it may have left
  if (child.listener >= 0)
    ::close(child.listener);
  run.result = {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                readFile(outputs.path() / "out"), readFile(outputs.path() / "err")};
  run.calls = supervisor.calls;
  return run;
}

bool canInjectFaults() {
  const ScratchDirectory scratch;
  return runWithFault({"sh", "-c", "echo x"}, scratch.path(), {CallClass::Write}).calls == 1;
}

} // namespace stride::test
