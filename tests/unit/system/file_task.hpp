// A task that uses the file service, without an application.
#ifndef STRIDE_TESTS_UNIT_SYSTEM_FILE_TASK_HPP
#define STRIDE_TESTS_UNIT_SYSTEM_FILE_TASK_HPP

#include "runtime/system/file_service.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stride::test {

class PlainInputs final : public system::Inputs {
public:
  void pass(void *, size_t) noexcept override {}
  bool replays() const noexcept override { return false; }
};

class FileTask {
public:
  FileTask(system::FileService &files, uint32_t index) : files_(&files) { ctx_.taskIndex = index; }

  void cycle() { ++ctx_.cycle; }
  system::FileService &files() { return *files_; }
  const Ctx &ctx() const { return ctx_; }

  /// A request of the blocks.
  uint32_t start(const FileRequest &request) { return files_->start(ctx_, request); }
  FileAnswer poll(uint32_t number, std::string *data = nullptr) {
    FileAnswer answer{};
    files_->poll(ctx_, number, data != nullptr ? data->data() : nullptr,
                 data != nullptr ? data->size() : 0, answer);
    return answer;
  }

  FileAnswer ask(FileOp op, const char *name, const char *second = nullptr, uint32_t mode = 0,
                 uint32_t file = 0) {
    FileRequest request{};
    request.op = op;
    request.name = name;
    request.second = second;
    request.mode = mode;
    request.file = file;
    FileAnswer answer{};
    files_->ask(ctx_, request, answer);
    return answer;
  }
  FileAnswer open(const char *name, uint32_t mode) {
    return ask(FileOp::OpenStream, name, nullptr, mode);
  }
  FileAnswer close(uint32_t file) { return ask(FileOp::CloseStream, nullptr, nullptr, 0, file); }
  FileAnswer write(uint32_t file, std::string_view text) {
    FileAnswer answer{};
    std::string copy(text);
    files_->stream(ctx_, StreamOp::Write, file, copy.data(), copy.size(), answer);
    return answer;
  }
  std::string read(uint32_t file, size_t size) {
    FileAnswer answer{};
    std::string text(size, '\0');
    files_->stream(ctx_, StreamOp::Read, file, text.data(), size, answer);
    text.resize(answer.value);
    return text;
  }
  FileAnswer stream(StreamOp op, uint32_t file, uint64_t size = 0) {
    FileAnswer answer{};
    files_->stream(ctx_, op, file, nullptr, size, answer);
    return answer;
  }

private:
  system::FileService *files_;
  Ctx ctx_{};
};

inline constexpr uint32_t kReading = kFileRead;
inline constexpr uint32_t kAnew = kFileWrite | kFileCreate | kFileTruncate;
inline constexpr uint32_t kAtEnd = kFileWrite | kFileCreate | kFileAppend;

} // namespace stride::test

#endif // STRIDE_TESTS_UNIT_SYSTEM_FILE_TASK_HPP
