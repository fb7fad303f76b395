#include "runtime/monitor/socket_server.hpp"

#include "runtime/app/error.hpp"
#include "runtime/monitor/file_handle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <mutex>
#include <new>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace stride::monitor {

namespace {

[[noreturn]] void failed(const std::string &path, const char *what) {
  throw app::Error(
      fmt::format("--listen unix:{}: cannot {}: {}", path, what, std::strerror(errno)));
}

/// After the name of a socket's file until the socket listens.
constexpr char kUnfinished[] = "~";
/// Bytes in the longest path of a socket.
constexpr size_t kMostInPath = sizeof(::sockaddr_un::sun_path) - sizeof kUnfinished;

/// After a failure to take somebody in. [ns]
constexpr int64_t kPauseNs = 1'000'000'000;

/// Of those who begin at the same socket at once, one after the other looks whether somebody
/// listens there. Who may read the folder may hold its lock, too, so nobody waits for it for long.
class FolderLock {
public:
  explicit FolderLock(const std::string &path)
      : folder_(::open(folderOf(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    constexpr int kTries = 100;
    constexpr auto kPause = std::chrono::milliseconds(10);
    for (int i = 0; i < kTries && ::flock(folder_.number(), LOCK_EX | LOCK_NB) != 0 &&
                    (errno == EWOULDBLOCK || errno == EINTR);
         ++i)
      std::this_thread::sleep_for(kPause);
  }

private:
  static std::string folderOf(const std::string &path) {
    const size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
  }

  FileHandle folder_; ///< Closing it gives the lock back.
};

/// Which file has that name; another one may get it later.
std::pair<::dev_t, ::ino_t> fileAt(const std::string &path) {
  struct ::stat status {};
  if (::lstat(path.c_str(), &status) != 0)
    return {};
  return {status.st_dev, status.st_ino};
}

/// Removes a socket file that is left over.
void removeStale(const std::string &path, const ::sockaddr_un &address) {
  struct ::stat status {};
  if (::lstat(path.c_str(), &status) != 0)
    return;
  if (!S_ISSOCK(status.st_mode))
    throw app::Error(
        fmt::format("--listen unix:{}: there is a file of that name that is no socket", path));
  const FileHandle probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (::connect(probe.number(), reinterpret_cast<const ::sockaddr *>(&address), sizeof address) ==
          0 ||
      errno == EAGAIN)
    throw app::Error(
        fmt::format("--listen unix:{}: a running program listens there already", path));
  ::unlink(path.c_str());
}

/// The socket's file gets its name when the socket listens, so that whoever waits for the file can
/// connect at once.
FileHandle listenAt(const std::string &path) {
  const FolderLock alone(path);
  removeStale(path, socketAddress(path));
  const std::string unfinished = path + kUnfinished;
  const ::sockaddr_un address = socketAddress(unfinished);
  removeStale(unfinished, address);
  FileHandle socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket.number() < 0)
    failed(path, "make a socket");
  // Before bind() makes the file, so that nobody else ever finds it open.
  ::fchmod(socket.number(), S_IRUSR | S_IWUSR);
  if (::bind(socket.number(), reinterpret_cast<const ::sockaddr *>(&address), sizeof address) != 0)
    failed(path, "make the socket's file");
  if (::chmod(unfinished.c_str(), S_IRUSR | S_IWUSR) != 0 || ::listen(socket.number(), 8) != 0 ||
      ::rename(unfinished.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    ::unlink(unfinished.c_str());
    errno = reason;
    failed(path, "listen");
  }
  return socket;
}

} // namespace

std::string socketPath(const std::string &address) {
  if (!address.starts_with("unix:") || address.size() == 5)
    throw app::Error(fmt::format("'{}' is no address; write unix:PATH", address));
  std::string path = address.substr(5);
  if (path.size() > kMostInPath)
    throw app::Error(
        fmt::format("'{}' is too long for a socket; {} bytes are possible", path, kMostInPath));
  return path;
}

::sockaddr_un socketAddress(const std::string &path) {
  ::sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

struct SocketServer::Impl {
  struct Client {
    FileHandle socket;
    std::string input;
    std::string output;
    std::atomic<bool> dropped{false};
    int64_t heardNs = 0; ///< When its last complete request came, or it itself.
    int64_t tookNs = 0;  ///< When it last took something, or had taken everything.
  };

  explicit Impl(const std::string &address)
      : path(socketPath(address)), listener(listenAt(path)), file(fileAt(path)),
        wake(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
        service([this](Service::ClientId id, const std::string &line) { send(id, line); },
                [this](Service::ClientId id) { drop(id); }) {
    files.reserve(kMostClients + 2);
    ids.reserve(kMostClients);
    if (wake.number() < 0)
      failed(path, "wait for the end");
  }

  /// In the server's thread, or (detach) in another one under the service's lock: so the text is
  /// only put there under a lock of its own.
  void send(Service::ClientId id, const std::string &line) {
    const std::lock_guard lock(outputMutex);
    const auto found = clients.find(id);
    if (found == clients.end() || found->second.dropped)
      return;
    Client &client = found->second;
    if (client.output.size() + line.size() > kMostUnsent) {
      client.dropped = true;
      return;
    }
    client.output += line;
    client.output += '\n';
  }

  void drop(Service::ClientId id) noexcept {
    const std::lock_guard lock(outputMutex);
    if (const auto found = clients.find(id); found != clients.end())
      found->second.dropped = true;
  }

  /// Nothing ends this thread but the run: for want of memory a client is lost at most.
  void run() noexcept {
    while (!ending.load()) {
      service.poll(task::monotonicNs());
      for (auto &[id, client] : clients)
        flush(client);
      removeDropped();
      wait();
    }
    for (auto &[id, client] : clients)
      flush(client); // what was said last: that it has ended
  }

  void wait() noexcept {
    const int64_t now = task::monotonicNs();
    files.clear();
    ids.clear();
    files.push_back({now < doorNs ? -1 : listener.number(), POLLIN, 0});
    files.push_back({wake.number(), POLLIN, 0});
    for (auto &[id, client] : clients) {
      const std::lock_guard lock(outputMutex);
      const auto events = static_cast<short>(client.output.empty() ? POLLIN : POLLIN | POLLOUT);
      files.push_back({client.socket.number(), events, 0});
      ids.push_back(id);
    }
    const int64_t idle = service.idleNs(now);
    const ::timespec limit = {static_cast<time_t>(idle / 1'000'000'000),
                              static_cast<long>(idle % 1'000'000'000)};
    if (::ppoll(files.data(), files.size(), &limit, nullptr) <= 0)
      return;
    for (size_t i = 0; i < ids.size(); ++i)
      if ((files[i + 2].revents & (POLLIN | POLLHUP | POLLERR)) != 0)
        receive(ids[i], clients.at(ids[i]));
    if ((files[0].revents & POLLIN) != 0)
      answerTheDoor();
  }

  /// Somebody wants to come in. When all places are taken, the client that has been silent for the
  /// longest time loses its own, if that was long enough; else one waits for that.
  void answerTheDoor() noexcept {
    removeDropped(); // who has just left has no place any more
    const int64_t now = task::monotonicNs();
    if (clients.size() < kMostClients) {
      letIn(now);
      return;
    }
    Client *silent = nullptr;
    int64_t sinceNs = 0;
    Service::ClientId who = 0;
    for (auto &[id, client] : clients) {
      const int64_t since = service.busy(id) ? stuckSince(client, now) : client.heardNs;
      if (silent == nullptr || since < sinceNs) {
        silent = &client;
        sinceNs = since;
        who = id;
      }
    }
    if (sinceNs == now) {
      sendAway();
    } else if (now < sinceNs + kSilentNs) {
      doorNs = sinceNs + kSilentNs;
    } else {
      tell(who, R"({"id":null,"error":{"code":"silent","message":"others need the place"}})");
      flush(*silent);
      silent->dropped = true;
    }
  }

  /// Who waits for something is not silent, unless it does not take what it is sent.
  int64_t stuckSince(const Client &client, int64_t now) {
    const std::lock_guard lock(outputMutex);
    return client.output.empty() ? now : std::min(client.tookNs, now);
  }

  FileHandle take() noexcept {
    FileHandle socket(::accept4(listener.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (socket.number() < 0 && errno != EAGAIN && errno != EINTR && errno != ECONNABORTED)
      doorNs = task::monotonicNs() + kPauseNs; // no files, no memory: it is still at the door
    return socket;
  }

  void sendAway() noexcept {
    const FileHandle socket = take();
    constexpr std::string_view kBusy =
        R"({"id":null,"error":{"code":"busy","message":"all places for clients are taken, and all )"
        R"(of them are busy; try again later"}})"
        "\n";
    if (socket.number() >= 0)
      (void)::send(socket.number(), kBusy.data(), kBusy.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }

  void letIn(int64_t now) noexcept {
    FileHandle socket = take();
    if (socket.number() < 0)
      return;
    const Service::ClientId id = ++lastClient;
    try {
      const std::string hello = service.hello();
      {
        const std::lock_guard lock(outputMutex);
        Client &client = clients[id];
        client.socket = std::move(socket);
        client.heardNs = client.tookNs = now;
      }
      send(id, hello);
    } catch (const std::bad_alloc &) {
      drop(id);
    }
  }

  /// As send(), for want of memory nothing.
  void tell(Service::ClientId id, const char *line) noexcept {
    try {
      send(id, line);
    } catch (const std::bad_alloc &) {
      drop(id);
    }
  }

  void receive(Service::ClientId id, Client &client) noexcept {
    try {
      receiveHere(id, client);
    } catch (const std::bad_alloc &) {
      client.dropped = true;
    }
  }

  void receiveHere(Service::ClientId id, Client &client) {
    char buffer[16384];
    const ::ssize_t size = ::recv(client.socket.number(), buffer, sizeof buffer, 0);
    if (size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR)) {
      client.dropped = true;
      return;
    }
    if (size < 0)
      return;
    client.input.append(buffer, static_cast<size_t>(size));
    size_t begin = 0;
    for (size_t end = 0; (end = client.input.find('\n', begin)) != std::string::npos;
         begin = end + 1) {
      std::string_view line(client.input.data() + begin, end - begin);
      if (line.ends_with('\r'))
        line.remove_suffix(1);
      if (line.empty())
        continue;
      client.heardNs = task::monotonicNs();
      service.handle(id, line);
    }
    client.input.erase(0, begin);
    if (client.input.size() > kLongestLine) {
      send(id, R"({"id":null,"error":{"code":"bad_request","message":"the line is too long"}})");
      flush(client);
      client.dropped = true;
    }
  }

  void flush(Client &client) noexcept {
    const std::lock_guard lock(outputMutex);
    if (client.output.empty())
      client.tookNs = task::monotonicNs();
    while (!client.output.empty() && !client.dropped) {
      const ::ssize_t sent = ::send(client.socket.number(), client.output.data(),
                                    client.output.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent <= 0) {
        client.dropped = errno != EAGAIN && errno != EINTR;
        return;
      }
      client.output.erase(0, static_cast<size_t>(sent));
      client.tookNs = task::monotonicNs();
    }
  }

  void removeDropped() noexcept {
    for (auto client = clients.begin(); client != clients.end();) {
      if (!client->second.dropped) {
        ++client;
        continue;
      }
      service.forget(client->first);
      const std::lock_guard lock(outputMutex);
      client = clients.erase(client);
      doorNs = 0;
    }
  }

  std::string path;
  FileHandle listener;
  std::pair<::dev_t, ::ino_t> file; ///< The socket's.
  FileHandle wake;
  std::mutex outputMutex; // of which clients there are and what is sent to them
  std::map<Service::ClientId, Client> clients; // changed by the server's thread only
  Service::ClientId lastClient = 0;
  int64_t doorNs = 0; ///< Until then nobody can be let in.
  std::vector<::pollfd> files;
  std::vector<Service::ClientId> ids;
  Service service;
  std::atomic<bool> ending{false};
  std::thread thread;
};

SocketServer::SocketServer(const std::string &address) : impl_(std::make_unique<Impl>(address)) {}

Service &SocketServer::service() { return impl_->service; }

void SocketServer::start() {
  // Signals are for others.
  ::sigset_t all;
  ::sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  impl_->thread = std::thread([impl = impl_.get()] { impl->run(); });
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

SocketServer::~SocketServer() {
  impl_->ending.store(true);
  const uint64_t one = 1;
  (void)!::write(impl_->wake.number(), &one, sizeof one);
  if (impl_->thread.joinable())
    impl_->thread.join();
  // Somebody may have removed it, and another run listen there now.
  if (fileAt(impl_->path) == impl_->file)
    ::unlink(impl_->path.c_str());
}

} // namespace stride::monitor
