#ifndef STRIDE_COMPILER_PROJECT_USER_CACHE_HPP
#define STRIDE_COMPILER_PROJECT_USER_CACHE_HPP
// What Stride keeps for a user between builds: compiled units and applications.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace stc {

/// A folder of one build alone; it goes with the object, unless it is kept.
class WorkFolder {
public:
  explicit WorkFolder(std::filesystem::path path) : path_(std::move(path)) {}
  WorkFolder(WorkFolder &&other) noexcept : path_(std::move(other.path_)) { other.path_.clear(); }
  WorkFolder &operator=(WorkFolder &&) = delete;
  WorkFolder(const WorkFolder &) = delete;
  WorkFolder &operator=(const WorkFolder &) = delete;
  ~WorkFolder();

  [[nodiscard]] const std::filesystem::path &path() const { return path_; }
  /// It stays for whoever reads the message about what went wrong in it, for a day.
  void keep() { path_.clear(); }

private:
  std::filesystem::path path_;
};

/// The right to do something that another process would do as well; it ends with the object.
class CacheLock {
public:
  CacheLock(int handle, std::filesystem::path path) : handle_(handle), path_(std::move(path)) {}
  CacheLock(CacheLock &&other) noexcept : handle_(other.handle_), path_(std::move(other.path_)) {
    other.handle_ = -1;
  }
  CacheLock &operator=(CacheLock &&) = delete;
  CacheLock(const CacheLock &) = delete;
  CacheLock &operator=(const CacheLock &) = delete;
  ~CacheLock();

private:
  int handle_;
  std::filesystem::path path_;
};

/// The user's cache of Stride: `$XDG_CACHE_HOME/stride`, `~/.cache/stride`, or `stride-UID` in the
/// folder for temporary files. It is used only where it belongs to the user, nobody else may write
/// it or put something else in its place, and it is no link; otherwise a private folder for
/// temporary files takes its place. In it is a
/// folder `v1` that carries a mark (CACHEDIR.TAG): nothing outside of that is written or removed.
///
/// Files of the store have names that say what they were made from (a ContentHash) and end with a
/// seal, the hash of their contents. They appear complete or not at all, and what does not have its
/// seal (a machine lost its power) is as if it was not there. ELF files are not harmed by a seal.
class UserCache {
public:
  /// Nothing when not even a private folder can be made (errno).
  [[nodiscard]] static std::optional<UserCache> open();

  /// What was wrong with the user's own cache folder, where a private one is used; else empty.
  [[nodiscard]] const std::string &problem() const { return problem_; }
  /// The place of the mark.
  [[nodiscard]] const std::filesystem::path &folder() const { return folder_; }

  /// A new, empty folder; nothing on failure (errno).
  [[nodiscard]] std::optional<WorkFolder> makeWorkFolder() const;

  /// Where the store has, or would have, a file: `kind` is the suffix of its name (`.o`, `.so`).
  [[nodiscard]] std::filesystem::path place(std::string_view key, std::string_view kind) const;
  /// What the store has, without its seal; nothing when it does not have it, complete. It counts as
  /// used now.
  [[nodiscard]] std::optional<std::string> content(std::string_view key,
                                                   std::string_view kind) const;
  /// The store has such a file, complete or not.
  [[nodiscard]] bool mayHave(std::string_view key, std::string_view kind) const;
  /// Whether the store has the file, complete; then `to` is the same file, or a copy of it.
  [[nodiscard]] bool fetch(std::string_view key, std::string_view kind,
                           const std::filesystem::path &to) const;
  /// Puts a copy of `from` into the store, with a seal; returns what it holds. Nothing on failure
  /// (errno).
  std::optional<std::string> publish(std::string_view key, std::string_view kind,
                                     const std::filesystem::path &from) const;

  /// Small texts by key: what is read from them must be checked as any input.
  [[nodiscard]] std::optional<std::string> note(std::string_view key) const;
  void setNote(std::string_view key, std::string_view text) const;

  /// Where the latest build of the project with this key is found, if it has one: a link to a file
  /// of the store.
  [[nodiscard]] std::filesystem::path latest(std::string_view key) const;
  /// From now on that leads to `to`. False on failure (errno).
  [[nodiscard]] bool setLatest(std::string_view key, const std::filesystem::path &to) const;

  /// Waits for whoever does what has this key, but not for ever: somebody may have suspended it.
  /// Nothing then, and where locks do not work: the same work is done twice, which harms nobody.
  [[nodiscard]] std::optional<CacheLock> lock(std::string_view key) const;

  /// Removes the files that were used longest ago from the part of the store that `key` is in, when
  /// they take too much room.
  void prune(std::string_view key, std::string_view kind) const;

private:
  UserCache(std::filesystem::path folder, std::string problem)
      : folder_(std::move(folder)), problem_(std::move(problem)) {}

  std::filesystem::path folder_;
  std::string problem_;
};

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_USER_CACHE_HPP
