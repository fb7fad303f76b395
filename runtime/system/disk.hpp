// Files of the operating system, for the thread that may wait for them.
#ifndef STRIDE_RUNTIME_SYSTEM_DISK_HPP
#define STRIDE_RUNTIME_SYSTEM_DISK_HPP

#include "runtime/system/system_api.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stride::system {

/// A result, or why there is none.
struct Outcome {
  FileError error = FileError::None;
  uint64_t value = 0;
};

/// All files lie in one folder, which is created when the first one is written. Everything here may
/// take as long as the disk does. Used by one thread.
class Disk {
public:
  /// `anywhere`: names may also be absolute or lead out of the folder.
  Disk(std::string root, bool anywhere) : root_(std::move(root)), anywhere_(anywhere) {}
  Disk(const Disk &) = delete;
  Disk &operator=(const Disk &) = delete;
  /// Closes what is open.
  ~Disk();

  /// A file for the asynchronous blocks: its handle.
  Outcome open(std::string_view name, uint32_t mode);
  Outcome close(uint32_t handle);
  Outcome read(uint32_t handle, std::byte *data, uint64_t size);
  Outcome write(uint32_t handle, const std::byte *data, uint64_t size);
  Outcome setPosition(uint32_t handle, uint64_t position);
  Outcome position(uint32_t handle);
  Outcome atEnd(uint32_t handle);

  Outcome size(std::string_view name);
  Outcome times(std::string_view name, uint64_t (&times)[3]);
  Outcome remove(std::string_view name);
  Outcome rename(std::string_view from, std::string_view to);
  Outcome copy(std::string_view from, std::string_view to);

  /// A file descriptor as the value, for somebody else to close.
  Outcome openFile(std::string_view name, uint32_t mode);
  /// Everything, if it is no more than `limit` bytes.
  Outcome load(std::string_view name, std::vector<std::byte> &content, uint64_t limit);

  // On descriptors.
  static Outcome writeAll(int file, const std::byte *data, uint64_t size);
  /// As writeAll, at that place.
  static Outcome writeAllAt(int file, const std::byte *data, uint64_t size, uint64_t position);
  /// Closes it when its data is on the disk.
  static Outcome finish(int file, bool written);

private:
  struct File {
    int descriptor = -1;
    uint32_t generation = 0;
    uint32_t mode = 0; ///< FileMode
  };
  File *find(uint32_t handle);
  /// Where the name leads; empty: nowhere that is allowed.
  std::string resolve(std::string_view name, FileError &error) const;

  std::string root_;
  bool anywhere_;
  std::array<File, 32> files_{};
};

/// What the number in errno means.
FileError fileErrorOf(int number);

} // namespace stride::system

#endif
