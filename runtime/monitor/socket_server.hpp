// A local socket through which other programs watch and change running applications.
#ifndef STRIDE_RUNTIME_MONITOR_SOCKET_SERVER_HPP
#define STRIDE_RUNTIME_MONITOR_SOCKET_SERVER_HPP

#include "runtime/monitor/service.hpp"

#include <cstddef>
#include <memory>
#include <string>

namespace stride::monitor {

/// The path in `unix:PATH`. Throws app::Error for anything else, and for a path that is too long.
std::string socketPath(const std::string &address);

/// Listens at a socket file that only this user may open, in a thread of its own that is no
/// real-time thread and waits for nobody: a client that does not fetch what it is sent, or sends
/// what is no line, is dropped.
class SocketServer {
public:
  static constexpr size_t kMostClients = 16;
  static constexpr size_t kLongestLine = size_t{256} << 10;
  /// One that has sent no complete request for so long, and waits for nothing, or takes nothing of
  /// what it is sent, loses its place when another one needs it.
  static constexpr int64_t kSilentNs = 5'000'000'000;
  static constexpr size_t kMostUnsent = size_t{8} << 20; ///< Bytes for one client.

  /// Replaces a socket file that nobody listens at. Throws app::Error when somebody does, when the
  /// file is no socket, and when the system refuses. start() begins.
  explicit SocketServer(const std::string &address);
  /// Ends the thread and removes the file.
  ~SocketServer();
  SocketServer(const SocketServer &) = delete;
  SocketServer &operator=(const SocketServer &) = delete;

  Service &service();
  /// From now on clients are let in.
  void start();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace stride::monitor

#endif
