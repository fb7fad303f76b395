// The other end of a monitor's socket.
#ifndef STRIDE_RUNTIME_MONITOR_SOCKET_CLIENT_HPP
#define STRIDE_RUNTIME_MONITOR_SOCKET_CLIENT_HPP

#include "runtime/monitor/file_handle.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace stride::monitor {

/// Speaks with a running application. Waits for its answers. All functions throw app::Error when
/// the connection breaks.
class SocketClient {
public:
  /// `unix:PATH`. Throws app::Error when nobody listens there, or speaks another protocol, and when
  /// one is not let in within ten seconds.
  explicit SocketClient(const std::string &address);

  /// The result of an operation; `id` is added to the request. Throws app::Error with the message
  /// of the answer when it is refused. Events that come meanwhile are passed over.
  nlohmann::json ask(nlohmann::json request);
  /// The next line, whatever it is.
  nlohmann::json receive();

private:
  void send(const std::string &line);
  void waitAtMost(int seconds) const noexcept;

  std::string address_;
  FileHandle socket_;
  std::string input_;
  uint64_t lastId_ = 0;
};

} // namespace stride::monitor

#endif
