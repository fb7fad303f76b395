// File descriptors that close themselves, and the addresses of sockets.
#ifndef STRIDE_RUNTIME_MONITOR_FILE_HANDLE_HPP
#define STRIDE_RUNTIME_MONITOR_FILE_HANDLE_HPP

#include <string>
#include <utility>

#include <sys/un.h>
#include <unistd.h>

namespace stride::monitor {

/// Owns a file descriptor; -1: none.
class FileHandle {
public:
  explicit FileHandle(int number = -1) : number_(number) {}
  FileHandle(FileHandle &&other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileHandle &operator=(FileHandle &&other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~FileHandle() {
    if (number_ >= 0)
      ::close(number_);
  }

  int number() const { return number_; }

private:
  int number_;
};

/// `path` is one that socketPath() has accepted.
::sockaddr_un socketAddress(const std::string &path);

} // namespace stride::monitor

#endif
