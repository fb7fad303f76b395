#include "runtime/monitor/socket_client.hpp"

#include "runtime/app/error.hpp"
#include "runtime/monitor/service.hpp"
#include "runtime/monitor/socket_server.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include <sys/socket.h>
#include <sys/time.h>

namespace stride::monitor {

using nlohmann::json;

namespace {

/// Longer than it takes a server to make room.
constexpr int kDoorSeconds = 10;

} // namespace

SocketClient::SocketClient(const std::string &address)
    : address_(address), socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const ::sockaddr_un at = socketAddress(socketPath(address));
  waitAtMost(kDoorSeconds);
  if (::connect(socket_.number(), reinterpret_cast<const ::sockaddr *>(&at), sizeof at) != 0)
    throw app::Error(errno == EAGAIN
                         ? fmt::format("{} lets nobody in: too many others wait there", address)
                         : fmt::format("nobody listens at {}: {}; start 'stride run --listen {}'",
                                       address, std::strerror(errno), address));
  const json hello = receive();
  if (const auto error = hello.find("error"); error != hello.end())
    throw app::Error(fmt::format("{} lets nobody in: {}", address,
                                 error->value("message", "all places are taken")));
  if (hello.value("hello", "") != "stride")
    throw app::Error(fmt::format("{} is no monitor of Stride", address));
  if (hello.value("version", 0) != Service::kVersion)
    throw app::Error(fmt::format("{} speaks version {} of the protocol, this program version {}",
                                 address, hello.value("version", 0), Service::kVersion));
  waitAtMost(0); // an answer may take its time
}

/// 0: for ever.
void SocketClient::waitAtMost(int seconds) const noexcept {
  const ::timeval limit{seconds, 0};
  ::setsockopt(socket_.number(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  ::setsockopt(socket_.number(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
}

json SocketClient::ask(json request) {
  request["id"] = ++lastId_;
  send(request.dump());
  for (;;) {
    json answer = receive();
    const auto id = answer.find("id");
    if (id == answer.end() || *id != lastId_)
      continue;
    if (const auto error = answer.find("error"); error != answer.end())
      throw app::Error(error->value("message", "the request was refused"));
    return answer["result"];
  }
}

json SocketClient::receive() {
  size_t end = 0;
  while ((end = input_.find('\n')) == std::string::npos) {
    char buffer[65536];
    const ::ssize_t size = ::recv(socket_.number(), buffer, sizeof buffer, 0);
    if (size < 0 && errno == EINTR)
      continue;
    if (size < 0 && errno == EAGAIN)
      throw app::Error(fmt::format("{} has not answered for {} s: the program there is stopped, or "
                                   "all its places are taken",
                                   address_, kDoorSeconds));
    if (size <= 0)
      throw app::Error(fmt::format("the connection to {} has ended", address_));
    input_.append(buffer, static_cast<size_t>(size));
  }
  json line = json::parse(input_.substr(0, end), nullptr, false);
  input_.erase(0, end + 1);
  if (!line.is_object())
    throw app::Error(fmt::format("{} is no monitor of Stride", address_));
  return line;
}

void SocketClient::send(const std::string &line) {
  const std::string text = line + '\n';
  for (size_t sent = 0; sent < text.size();) {
    const ::ssize_t size =
        ::send(socket_.number(), text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (size < 0 && errno == EINTR)
      continue;
    if (size <= 0)
      throw app::Error(fmt::format("the connection to {} has ended", address_));
    sent += static_cast<size_t>(size);
  }
}

} // namespace stride::monitor
