// What files hold and what operations on them answer, by strings in memory.
#ifndef STRIDE_TESTS_PROPERTY_FILE_MODEL_HPP
#define STRIDE_TESTS_PROPERTY_FILE_MODEL_HPP

#include "runtime/system/system_api.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace stride::test {

class FileModel {
public:
  FileModel(size_t mostOpen, size_t mostStreams) : mostOpen_(mostOpen), mostStreams_(mostStreams) {}

  struct Answer {
    FileError error = FileError::None;
    uint64_t value = 0;
    std::string data; ///< Read
  };

  /// Null: there is no such file.
  const std::string *content(const std::string &name) const {
    const auto found = disk_.find(name);
    return found == disk_.end() ? nullptr : found->second.get();
  }

  /// `handle`: which of the files that were ever opened so; one beyond: none of them. A handle is
  /// not in the answer.
  Answer run(const FileRequest &request, size_t handle) {
    const std::string name = request.name;
    const std::string second = request.second;
    switch (request.op) {
    case FileOp::None:
      break;
    case FileOp::Open:
      return open(name, request.mode, blocks_, mostOpen_);
    case FileOp::OpenStream:
      return open(name, request.mode, streams_, mostStreams_);
    case FileOp::CloseStream:
      return close(streams_, handle);
    case FileOp::Size:
      return content(name) == nullptr ? Answer{FileError::NotFound, 0, {}}
                                      : Answer{FileError::None, content(name)->size(), {}};
    case FileOp::Times:
      return {content(name) == nullptr ? FileError::NotFound : FileError::None, 0, {}};
    case FileOp::Delete:
      return {disk_.erase(name) == 0 ? FileError::NotFound : FileError::None, 0, {}};
    case FileOp::Rename:
      return rename(name, second);
    case FileOp::Copy:
      return copy(name, second);
    default:
      return useBlock(request, handle);
    }
    return {FileError::NotPossible, 0, {}};
  }

  Answer useStream(StreamOp op, size_t handle, const std::string &data, uint64_t number) {
    if (handle >= streams_.size() || !streams_[handle].isOpen)
      return {FileError::BadHandle, 0, {}};
    File &file = streams_[handle];
    const bool reads = (file.mode & kFileRead) != 0;
    switch (op) {
    case StreamOp::Read: {
      if (!reads)
        return {FileError::NotPossible, 0, {}};
      std::string got = file.image.substr(file.position, number);
      file.position += got.size();
      return {FileError::None, got.size(), got};
    }
    case StreamOp::Write:
      if (reads)
        return {FileError::NotPossible, 0, {}};
      if (data.empty()) // leaves the end where it is, wherever the position is
        return {};
      put(*file.bytes, (file.mode & kFileAppend) != 0 ? file.bytes->size() : file.position, data);
      file.position += data.size();
      file.length = std::max(file.length, file.position);
      return {FileError::None, data.size(), {}};
    case StreamOp::SetPosition:
      if (reads ? number > file.length : (file.mode & kFileAppend) != 0)
        return {FileError::NotPossible, 0, {}};
      file.position = number;
      return {FileError::None, 1, {}};
    case StreamOp::GetPosition:
      return {FileError::None, file.position, {}};
    case StreamOp::AtEnd:
      return {FileError::None, file.position >= file.length ? 1U : 0U, {}};
    }
    return {};
  }

private:
  struct File {
    std::shared_ptr<std::string> bytes; ///< Also when it has lost its name.
    uint32_t mode = 0;
    uint64_t position = 0;
    bool isOpen = true;
    std::string image;   ///< Of a stream that is read: what the file held when it was opened.
    uint64_t length = 0; ///< Of a stream: as the program knows it.
  };

  static void put(std::string &bytes, uint64_t position, const std::string &data) {
    if (data.empty())
      return;
    bytes.resize(std::max<uint64_t>(bytes.size(), position + data.size()), '\0');
    bytes.replace(position, data.size(), data);
  }

  Answer open(const std::string &name, uint32_t mode, std::vector<File> &files, size_t most) {
    if (static_cast<size_t>(std::count_if(files.begin(), files.end(),
                                          [](const File &file) { return file.isOpen; })) >= most)
      return {FileError::TooMany, 0, {}};
    if (content(name) == nullptr) {
      if ((mode & kFileCreate) == 0)
        return {FileError::NotFound, 0, {}};
      disk_[name] = std::make_shared<std::string>();
    }
    File file;
    file.bytes = disk_[name];
    file.mode = mode;
    if ((mode & kFileTruncate) != 0)
      file.bytes->clear();
    file.image = *file.bytes;
    file.length = file.image.size();
    if (&files == &streams_ && (mode & kFileAppend) != 0)
      file.position = file.length;
    files.push_back(file);
    return {};
  }

  Answer close(std::vector<File> &files, size_t handle) {
    if (handle >= files.size() || !files[handle].isOpen)
      return {FileError::BadHandle, 0, {}};
    files[handle].isOpen = false;
    return {};
  }

  Answer rename(const std::string &from, const std::string &to) {
    if (content(to) != nullptr)
      return {FileError::Exists, 0, {}};
    const auto node = disk_.extract(from);
    if (node.empty())
      return {FileError::NotFound, 0, {}};
    disk_[to] = node.mapped();
    return {};
  }

  Answer copy(const std::string &from, const std::string &to) {
    if (content(from) == nullptr)
      return {FileError::NotFound, 0, {}};
    if (from == to)
      return {FileError::Exists, 0, {}};
    if (content(to) == nullptr)
      disk_[to] = std::make_shared<std::string>();
    *disk_[to] = *disk_[from];
    return {FileError::None, disk_[to]->size(), {}};
  }

  Answer useBlock(const FileRequest &request, size_t handle) {
    if (request.op == FileOp::Close)
      return close(blocks_, handle);
    if (handle >= blocks_.size() || !blocks_[handle].isOpen)
      return {FileError::BadHandle, 0, {}};
    File &file = blocks_[handle];
    switch (request.op) {
    case FileOp::Read: {
      if ((file.mode & kFileRead) == 0)
        return {FileError::NotPossible, 0, {}};
      std::string got = file.position < file.bytes->size()
                            ? file.bytes->substr(file.position, request.size)
                            : std::string();
      file.position += got.size();
      return {FileError::None, got.size(), got};
    }
    case FileOp::Write: {
      if ((file.mode & kFileWrite) == 0)
        return {FileError::NotPossible, 0, {}};
      if ((file.mode & kFileAppend) != 0 && request.size != 0)
        file.position = file.bytes->size();
      put(*file.bytes, file.position,
          std::string(static_cast<const char *>(request.data), request.size));
      file.position += request.size;
      return {FileError::None, request.size, {}};
    }
    case FileOp::SetPosition:
      file.position = request.position;
      return {FileError::None, file.position, {}};
    case FileOp::GetPosition:
      return {FileError::None, file.position, {}};
    default: // AtEnd
      return {FileError::None, file.position >= file.bytes->size() ? 1U : 0U, {}};
    }
  }

  size_t mostOpen_;
  size_t mostStreams_;
  std::map<std::string, std::shared_ptr<std::string>> disk_;
  std::vector<File> blocks_;
  std::vector<File> streams_;
};

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_FILE_MODEL_HPP
