// A file of the functions that have their answer at once: a whole file in memory to be read, or a
// ring in front of a file to be written. Internal to the file service.
#ifndef STRIDE_RUNTIME_SYSTEM_FILE_STREAM_HPP
#define STRIDE_RUNTIME_SYSTEM_FILE_STREAM_HPP

#include "runtime/system/file_service.hpp"

namespace stride::system {

struct FileService::Stream {
  static constexpr uint64_t kRing = 65536;

  enum State : uint32_t { kFree, kReading, kWriting, kClosing };
  /// The thread takes a free one and gives it free; the task that closes it sets Closing.
  std::atomic<uint32_t> state{kFree};
  std::atomic<uint32_t> generation{0};
  std::atomic<uint32_t> user{0}; ///< A task is at it just now.

  uint64_t position = 0;
  uint64_t length = 0; ///< Of the file, as far as the program knows.

  std::vector<std::byte> image; ///< Reading.

  // Writing: records of a place, a size and the bytes.
  struct Record {
    uint64_t position = 0;
    uint64_t size = 0;
  };
  bool appends = false;
  std::unique_ptr<std::byte[]> ring;
  std::atomic<uint64_t> put{0};
  std::atomic<uint64_t> taken{0};
  std::atomic<FileError> error{FileError::None}; ///< The first one; what comes then is not written.
  int file = -1;                                 ///< The thread's.
  uint64_t lost = 0;                             ///< The thread's. [bytes]
  std::string name;                              ///< The thread's.

  void copyIn(uint64_t at, const void *data, uint64_t size) noexcept;
  void copyOut(uint64_t at, void *data, uint64_t size) const noexcept;
};

} // namespace stride::system

#endif
