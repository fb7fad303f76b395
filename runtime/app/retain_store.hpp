// Images of retained variables on disk.
#ifndef STRIDE_RUNTIME_APP_RETAIN_STORE_HPP
#define STRIDE_RUNTIME_APP_RETAIN_STORE_HPP

#include "runtime/app/retain_image.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stride::app {

/// What a RetainStore asks of the operating system. Every call but read() returns 0 or an errno.
class RetainFiles {
public:
  RetainFiles() = default;
  RetainFiles(const RetainFiles &) = delete;
  RetainFiles &operator=(const RetainFiles &) = delete;
  virtual ~RetainFiles() = default;

  /// A new, empty file in the place of what is there.
  virtual int create(const std::string &path, int &handle) = 0;
  virtual int write(int handle, std::span<const std::byte> bytes) = 0;
  /// What was written is on the disk.
  virtual int sync(int handle) = 0;
  virtual int close(int handle) = 0;
  virtual int rename(const std::string &from, const std::string &to) = 0;
  /// ENOENT when there is none.
  virtual int remove(const std::string &path) = 0;
  /// The names in the folder are on the disk.
  virtual int syncFolder(const std::string &folder) = 0;
  /// The whole file; ENOENT when there is none.
  virtual int read(const std::string &path, std::vector<std::byte> &bytes) = 0;
};

/// Those of the system.
RetainFiles &systemFiles();

/// Keeps the last two images in FILE.a and FILE.b. A new one is written to FILE.new, made durable,
/// and renamed onto the older of the two, and the folder is made durable: whatever happens in
/// between, the newest image whose save() succeeded, or a newer one, is complete in one of them.
class RetainStore {
public:
  RetainStore(std::string file, RetainFiles &files = systemFiles());

  /// The newest complete image; what was wrong with the others goes to `problems`. Throws Error
  /// where a file is there but cannot be read, or is of a newer version: it must not be
  /// overwritten. To be called before the first save().
  std::optional<RetainImage> load(std::vector<std::string> &problems);

  /// Saves with the next sequence number. Throws Error; the next call tries again from the start.
  void save(const std::string &application, uint64_t buildHash, std::span<const std::byte> layout,
            std::span<const std::byte> values);

  /// Removes all images, the newest last: up to that moment it is what a start would find. Throws
  /// Error: it is not certain that they are gone for good; a file that was never an image stands in
  /// the place of one, and all are left.
  void clear();

  /// Of the last image that was loaded or saved.
  uint64_t sequence() const { return sequence_; }
  const std::string &file() const { return file_; }

private:
  void refuseOthers() const;
  [[noreturn]] void fail(const char *what, const std::string &path, int error) const;

  std::string file_;
  std::string folder_;
  RetainFiles *files_;
  uint64_t sequence_ = 0;
  bool nextIsB_ = false; ///< Where the next image goes: not where the last good one is.
};

/// The exclusive right to a retain file, for as long as the object lives; the system ends it with
/// the process, however that ends.
class RetainLock {
public:
  /// Creates the folder if needed. Throws Error when somebody else has it.
  explicit RetainLock(const std::string &file);
  RetainLock(const RetainLock &) = delete;
  RetainLock &operator=(const RetainLock &) = delete;
  ~RetainLock();

private:
  int handle_ = -1;
};

} // namespace stride::app

#endif
