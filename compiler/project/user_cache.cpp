#include "compiler/project/user_cache.hpp"

#include "compiler/project/file_system.hpp"
#include "compiler/source/content_hash.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <grp.h>
#include <pwd.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace stc {

namespace fs = std::filesystem;

namespace {

// Programs that make backups know the first line: https://bford.info/cachedir/
constexpr std::string_view kTag =
    "Signature: 8a477f597d28d172789f06886806bc55\n"
    "# This folder is Stride's cache. It may be removed at any time.\n";
constexpr std::string_view kTagName = "CACHEDIR.TAG";
constexpr std::string_view kVersion = "v1";

// Before the hash at the end of a file of the store.
constexpr std::string_view kSeal = "\nStride seal BLAKE2b-256 ";
constexpr size_t kSealSize = kSeal.size() + 64;

// Bytes of the files of one kind with one first digit, so that all together are 16 times that.
constexpr uintmax_t kShardBytes = 128U << 20U;

constexpr auto kAbandoned = std::chrono::hours(24);

// For somebody who builds the same, and how often that is looked for.
constexpr auto kLongestWait = std::chrono::seconds(60);
constexpr auto kLook = std::chrono::milliseconds(10);

/// Why somebody else could change what is in the folder; empty: nobody can.
std::string whyNotPrivate(const fs::path &folder) {
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0)
    return lastError();
  if (S_ISLNK(status.st_mode))
    return "it is a symbolic link";
  if (!S_ISDIR(status.st_mode))
    return "it is not a folder";
  if (status.st_uid != ::geteuid())
    return fmt::format("it belongs to user {}", status.st_uid);
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    return "others may write it";
  return {};
}

/// Whether nobody is in the group but the user: it has the user's name, as many systems make one
/// for each user, or root's.
bool isOwnGroup(gid_t id) {
  const struct group *group = ::getgrgid(id);
  if (group == nullptr)
    return false;
  const std::string name = group->gr_name;
  const struct passwd *user = ::getpwuid(::geteuid());
  const std::string own = user != nullptr ? user->pw_name : "root";
  const auto isTrusted = [&own](std::string_view one) { return one == own || one == "root"; };
  bool good = isTrusted(name);
  for (char **member = group->gr_mem; good && *member != nullptr; ++member)
    good = isTrusted(*member);
  return good;
}

/// Whether somebody else could put something else in the place of what lies in the folder.
/// Whoever owns `/` has everything anyway.
bool othersMayRenameIn(const struct stat &folder) {
  struct stat all {};
  const bool trusted = folder.st_uid == ::geteuid() || folder.st_uid == 0 ||
                       (::stat("/", &all) == 0 && folder.st_uid == all.st_uid);
  const bool sticky = (folder.st_mode & S_ISVTX) != 0;
  const bool others = (folder.st_mode & S_IWOTH) != 0 ||
                      ((folder.st_mode & S_IWGRP) != 0 && !isOwnGroup(folder.st_gid));
  return !trusted || (others && !sticky);
}

/// Puts the parts of a path before those that are still to be gone.
void goNext(std::vector<fs::path> &pending, const fs::path &path) {
  const std::vector<fs::path> parts(path.begin(), path.end());
  pending.insert(pending.end(), parts.rbegin(), parts.rend());
}

/// Why somebody else could put another folder in the place of what lies in this one: each folder on
/// the way, and each that a link on the way leads through, is looked at. Empty: nobody can.
std::string whyReplaceable(const fs::path &folder) {
  constexpr int kMostLinks = 40; // as the kernel
  std::vector<fs::path> pending;
  std::error_code error;
  goNext(pending, fs::absolute(folder, error));
  fs::path real;
  for (int links = 0; !pending.empty();) {
    const fs::path part = std::move(pending.back());
    pending.pop_back();
    const fs::path next = part == ".." ? real.parent_path() : real / part;
    struct stat status {};
    if (::lstat(next.c_str(), &status) != 0)
      return fmt::format("`{}`: {}", next.string(), lastError());
    // In a folder with S_ISVTX anybody may have made the link.
    const bool isOwn = status.st_uid == ::geteuid() || status.st_uid == 0;
    if (S_ISLNK(status.st_mode) && (!isOwn || ++links > kMostLinks))
      return fmt::format("the link `{}` is not to be trusted", next.string());
    if (S_ISLNK(status.st_mode)) {
      goNext(pending, fs::read_symlink(next, error));
    } else if (!S_ISDIR(status.st_mode) || othersMayRenameIn(status)) {
      return fmt::format("others may replace what is in `{}`", next.string());
    } else {
      real = next;
    }
  }
  return {};
}

bool makeFolder(const fs::path &folder) {
  return ::mkdir(folder.c_str(), kUserOnly) == 0 || errno == EEXIST;
}

/// Also the folders it lies in; whatever the umask is, they are the user's alone.
bool makeFolders(const fs::path &folder) {
  std::error_code error;
  return fs::is_directory(folder, error) ||
         (folder.has_relative_path() && makeFolders(folder.parent_path()) && makeFolder(folder));
}

/// Makes a folder with the mark; it appears with it or not at all.
bool makeMarked(const fs::path &folder) {
  std::string fresh = (folder.parent_path() / "new-XXXXXX").string();
  if (::mkdtemp(fresh.data()) == nullptr)
    return false;
  const bool good =
      writeFile(fs::path(fresh) / kTagName, kTag) && ::rename(fresh.c_str(), folder.c_str()) == 0;
  const int error = errno;
  std::error_code ignored;
  if (!good)
    fs::remove_all(fresh, ignored);
  errno = error;
  return good || error == EEXIST || error == ENOTEMPTY; // somebody was quicker
}

/// The folder with the mark in `root`, made if needed; returns what is wrong with it.
std::string openIn(const fs::path &root) {
  if (!makeFolders(root.parent_path()) || !makeFolder(root))
    return lastError();
  if (std::string problem = whyReplaceable(root.parent_path()); !problem.empty())
    return problem;
  if (std::string problem = whyNotPrivate(root); !problem.empty())
    return problem;
  const fs::path folder = root / kVersion;
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0 && !makeMarked(folder))
    return lastError();
  if (std::string problem = whyNotPrivate(folder); !problem.empty())
    return fmt::format("`{}`: {}", folder.string(), problem);
  if (readRegularFile(folder / kTagName) != kTag)
    return fmt::format("`{}` does not carry Stride's mark", folder.string());
  return {};
}

constexpr const char *kTemporary = "/tmp";

fs::path temporaryFolder() {
  const char *folder = std::getenv("TMPDIR");
  return folder != nullptr && *folder == '/' ? folder : kTemporary;
}

fs::path usersRoot() {
  if (const char *cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/')
    return fs::path(cache) / "stride";
  if (const char *home = std::getenv("HOME"); home != nullptr && *home == '/')
    return fs::path(home) / ".cache" / "stride";
  return temporaryFolder() / fmt::format("stride-{}", ::geteuid());
}

bool isOld(const fs::path &path) {
  std::error_code error;
  const auto time = fs::last_write_time(path, error);
  return !error && time < fs::file_time_type::clock::now() - kAbandoned;
}

/// Removes what processes that were ended have left in a folder of ours.
void removeAbandoned(const fs::path &folder, std::string_view prefix) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (at->path().filename().string().starts_with(prefix) && whyNotPrivate(at->path()).empty() &&
        isOld(at->path()))
      fs::remove_all(at->path(), ignored);
  }
}

/// A root that is nobody else's, for as long as the folder for temporary files keeps it: what is
/// in it is run after this process has become another one.
/// Empty when there can be none (errno).
fs::path privateRoot() {
  const std::string prefix = fmt::format("stride-{}-", ::geteuid());
  for (const fs::path &folder : {temporaryFolder(), fs::path(kTemporary)}) {
    removeAbandoned(folder, prefix);
    std::string name = (folder / (prefix + "XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr)
      continue;
    if (openIn(name).empty())
      return name;
    std::error_code ignored;
    fs::remove_all(name, ignored);
    errno = EACCES; // others may write there
  }
  return {};
}

/// The text without its seal, or nothing.
std::optional<std::string_view> unseal(std::string_view text) {
  if (text.size() < kSealSize)
    return std::nullopt;
  const std::string_view content = text.substr(0, text.size() - kSealSize);
  const std::string_view seal = text.substr(content.size());
  if (!seal.starts_with(kSeal) || seal.substr(kSeal.size()) != blake2b256(content))
    return std::nullopt;
  return content;
}

bool copyFile(const fs::path &from, const fs::path &to) {
  const std::optional<std::string> text = readRegularFile(from);
  struct stat status {};
  return text && ::stat(from.c_str(), &status) == 0 && writeFile(to, *text, status.st_mode & 0777);
}

} // namespace

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  if (!path_.empty())
    fs::remove_all(path_, ignored);
}

CacheLock::~CacheLock() {
  if (handle_ < 0)
    return;
  ::unlink(path_.c_str()); // whoever waits for it comes next, and need not wait for anybody else
  ::close(handle_);
}

std::optional<UserCache> UserCache::open() {
  const fs::path root = usersRoot();
  const std::string problem = openIn(root);
  if (problem.empty()) {
    removeAbandoned(root / kVersion / "work", "");
    return UserCache(root / kVersion, {});
  }
  const fs::path other = privateRoot();
  if (other.empty())
    return std::nullopt;
  return UserCache(other / kVersion, fmt::format("`{}` is not used: {}", root.string(), problem));
}

std::optional<WorkFolder> UserCache::makeWorkFolder() const {
  const fs::path all = folder_ / "work";
  std::string name = (all / "XXXXXX").string();
  if (!makeFolder(all) || ::mkdtemp(name.data()) == nullptr)
    return std::nullopt;
  return WorkFolder(name);
}

fs::path UserCache::place(std::string_view key, std::string_view kind) const {
  return folder_ / (kind == ".o" ? "objects" : "applications") / key.substr(0, 1) /
         fmt::format("{}{}", key, kind);
}

std::optional<std::string> UserCache::content(std::string_view key, std::string_view kind) const {
  const fs::path path = place(key, kind);
  if (::utimensat(AT_FDCWD, path.c_str(), nullptr, AT_SYMLINK_NOFOLLOW) != 0)
    return std::nullopt;
  std::optional<std::string> text = readRegularFile(path);
  if (const std::optional<std::string_view> content = text ? unseal(*text) : std::nullopt) {
    text->resize(content->size());
    return text;
  }
  std::error_code ignored; // whatever it is, be it a folder
  fs::remove_all(path, ignored);
  return std::nullopt;
}

bool UserCache::mayHave(std::string_view key, std::string_view kind) const {
  return ::access(place(key, kind).c_str(), F_OK) == 0;
}

bool UserCache::fetch(std::string_view key, std::string_view kind, const fs::path &to) const {
  const fs::path from = place(key, kind);
  return content(key, kind) && (::link(from.c_str(), to.c_str()) == 0 || copyFile(from, to));
}

std::optional<std::string> UserCache::publish(std::string_view key, std::string_view kind,
                                              const fs::path &from) const {
  std::optional<std::string> text = readRegularFile(from);
  struct stat status {};
  if (!text || ::stat(from.c_str(), &status) != 0)
    return std::nullopt;
  const size_t size = text->size();
  text->append(kSeal).append(blake2b256({text->data(), size}));
  if (!writeFile(place(key, kind), *text, status.st_mode & 0777))
    return std::nullopt;
  text->resize(size);
  return text;
}

std::optional<std::string> UserCache::note(std::string_view key) const {
  return readRegularFile(folder_ / "notes" / key);
}

void UserCache::setNote(std::string_view key, std::string_view text) const {
  static_cast<void>(writeFile(folder_ / "notes" / key, text)); // it is found out again next time
}

fs::path UserCache::latest(std::string_view key) const {
  return folder_ / "latest" / fmt::format("{}.so", key);
}

bool UserCache::setLatest(std::string_view key, const fs::path &to) const {
  const fs::path link = latest(key);
  if (!makeFolder(link.parent_path()))
    return false;
  // In a folder that is nobody else's, so that its name is.
  const std::optional<WorkFolder> fresh = makeWorkFolder();
  return fresh && ::symlink(to.c_str(), (fresh->path() / "link").c_str()) == 0 &&
         ::rename((fresh->path() / "link").c_str(), link.c_str()) == 0;
}

std::optional<CacheLock> UserCache::lock(std::string_view key) const {
  const fs::path path = folder_ / "locks" / key;
  if (!makeFolder(path.parent_path()))
    return std::nullopt;
  const int handle = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (handle < 0)
    return std::nullopt;
  const auto end = std::chrono::steady_clock::now() + kLongestWait;
  while (::flock(handle, LOCK_EX | LOCK_NB) != 0) {
    if ((errno != EWOULDBLOCK && errno != EINTR) || std::chrono::steady_clock::now() > end) {
      ::close(handle);
      return std::nullopt;
    }
    std::this_thread::sleep_for(kLook);
  }
  return CacheLock(handle, path);
}

void UserCache::prune(std::string_view key, std::string_view kind) const {
  struct Entry {
    fs::file_time_type time;
    uintmax_t size;
    fs::path path;
  };
  std::vector<Entry> entries;
  uintmax_t total = 0;
  std::error_code error;
  for (fs::directory_iterator at(place(key, kind).parent_path(), error), end; !error && at != end;
       at.increment(error)) {
    std::error_code ignored;
    entries.push_back({at->last_write_time(ignored), at->file_size(ignored), at->path()});
    total += entries.back().size;
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry &a, const Entry &b) { return a.time < b.time; });
  for (const Entry &entry : entries) {
    // The newest stays, however large it is.
    if (total <= kShardBytes || &entry == &entries.back())
      break;
    fs::remove(entry.path, error);
    total -= entry.size;
  }
}

} // namespace stc
