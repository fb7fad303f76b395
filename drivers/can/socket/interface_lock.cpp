#include "drivers/can/socket/interface_lock.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <stdexcept>

namespace stride::can {
namespace {

/// A name without a file: it begins with a zero.
socklen_t nameFor(const std::string &interface, sockaddr_un &address) {
  const std::string name = "stride-can-master-" + interface;
  const size_t length = std::min(name.size(), sizeof address.sun_path - 1);
  address = {};
  address.sun_family = AF_UNIX;
  std::copy_n(name.begin(), length, address.sun_path + 1);
  return static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
}

const sockaddr *plain(const sockaddr_un &address) {
  return reinterpret_cast<const sockaddr *>(&address);
}

int newSocket() { return ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0); }

/// The process that has the name; 0: it cannot be found out.
pid_t holderOf(const sockaddr_un &address, socklen_t length) {
  const int fd = newSocket();
  if (fd < 0)
    return 0;
  ucred peer{};
  socklen_t size = sizeof peer;
  const bool known = ::connect(fd, plain(address), length) == 0 &&
                     ::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
  ::close(fd);
  return known ? peer.pid : 0;
}

} // namespace

InterfaceLock::InterfaceLock(const std::string &interface) : fd_(newSocket()) {
  sockaddr_un address{};
  const socklen_t length = nameFor(interface, address);
  // Where there are no such sockets nobody is kept apart.
  if (fd_ < 0 || ::bind(fd_, plain(address), length) == 0) {
    if (fd_ >= 0)
      (void)::listen(fd_, SOMAXCONN); // nobody answers; the system tells askers whose it is
    return;
  }
  const bool taken = errno == EADDRINUSE;
  ::close(fd_);
  fd_ = -1;
  if (!taken)
    return;
  const pid_t holder = holderOf(address, length);
  if (holder == ::getpid())
    return;
  throw std::runtime_error(
      "the CAN interface '" + interface + "' has a master: " +
      (holder > 0 ? "process " + std::to_string(holder) : std::string("another process")) +
      " runs with it; two masters would lead the same drives");
}

InterfaceLock::~InterfaceLock() {
  if (fd_ >= 0)
    ::close(fd_);
}

} // namespace stride::can
