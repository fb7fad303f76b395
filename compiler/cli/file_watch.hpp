#ifndef STRIDE_COMPILER_CLI_FILE_WATCH_HPP
#define STRIDE_COMPILER_CLI_FILE_WATCH_HPP
// Waiting until somebody saves a file of a project.

#include <filesystem>
#include <string>

namespace stc::cli {

/// Sees changes of the sources, cams and stride.toml of a project's folder and of those below it,
/// or of a single source file. inotify.
class FileWatch {
public:
  enum class Event { Changed, Nothing, Failed };

  /// `path`: as a command is given it; empty: the current folder.
  explicit FileWatch(const std::filesystem::path &path);
  ~FileWatch();
  FileWatch(const FileWatch &) = delete;
  FileWatch &operator=(const FileWatch &) = delete;

  /// Looks for folders that are new. What changes from now on wait() tells.
  void refresh();
  /// Waits for a change, and until no other has followed for a moment; Nothing after `limitMs`, or
  /// at a signal, Failed when the system can watch nothing (errno).
  [[nodiscard]] Event wait(int limitMs);

private:
  void add(const std::filesystem::path &folder) const;
  bool take() const;

  std::filesystem::path folder_;
  std::string only_; ///< name of the single file; empty: all of them
  int handle_;
};

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_FILE_WATCH_HPP
