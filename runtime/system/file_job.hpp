// One request to the file service and its answer. Internal to it.
#ifndef STRIDE_RUNTIME_SYSTEM_FILE_JOB_HPP
#define STRIDE_RUNTIME_SYSTEM_FILE_JOB_HPP

#include "runtime/system/file_service.hpp"

namespace stride::system {

struct FileService::Job {
  /// A task takes a free one and fills it, the thread makes a queued one done, the task takes the
  /// answer and gives it free.
  enum State : uint32_t { kFree, kFilling, kQueued, kDone };
  std::atomic<uint32_t> state{kFree};
  std::atomic<uint32_t> generation{0};
  uint64_t ticket = 0; ///< The order of the requests.
  std::atomic<uint32_t> task{0};
  uint64_t cycle = 0;
  /// Who takes the answer.
  enum class Taker : uint8_t {
    Number, ///< poll()
    Asker,  ///< ask() with the same question
    Nobody,
  };
  Taker taker = Taker::Number;

  FileOp op = FileOp::None;
  uint32_t mode = 0;
  uint32_t file = 0;
  uint64_t position = 0;
  uint64_t size = 0;
  char name[kFileName] = {};
  char second[kFileName] = {};
  std::unique_ptr<std::byte[]> data = std::make_unique_for_overwrite<std::byte[]>(kFileChunk);

  FileAnswer answer{};
};

} // namespace stride::system

#endif
