#include "compiler/project/run_socket.hpp"

#include "compiler/project/file_system.hpp"
#include "compiler/project/source_files.hpp"
#include "compiler/source/content_hash.hpp"

#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace stc {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kProjectFile = "stride.toml";

/// Where the user's sockets may be, the best place first. A run and `stride ctl` need not have been
/// started from the same session, so the second place is the same for all of them.
std::vector<fs::path> socketFolders() {
  std::vector<fs::path> folders;
  if (const char *runtime = std::getenv("XDG_RUNTIME_DIR"); runtime != nullptr && *runtime == '/')
    folders.push_back(fs::path(runtime) / "stride");
  folders.push_back(fmt::format("/tmp/stride-run-{}", ::geteuid()));
  return folders;
}

/// Why the folder is no place for a socket; empty: it is one.
std::string whyUnfit(const fs::path &folder) {
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0)
    return lastError();
  if (!S_ISDIR(status.st_mode))
    return "it is no folder";
  if (status.st_uid != ::geteuid() || (status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    return "others may write it";
  return {};
}

std::string fileName(const fs::path &place) {
  constexpr size_t kDigits = 16;
  return ContentHash().add(place.string()).hex().substr(0, kDigits) + ".sock";
}

} // namespace

fs::path projectPlace(const fs::path &path) {
  std::error_code error;
  fs::path given = fs::canonical(path.empty() ? "." : path, error);
  if (error)
    return {};
  if (!fs::is_directory(given, error))
    return given.filename() == kProjectFile ? given.parent_path() : given;
  return findProjectFolder(given);
}

std::optional<fs::path> makeRunSocket(const fs::path &place, std::string &problem) {
  for (const fs::path &folder : socketFolders()) {
    if (::mkdir(folder.c_str(), kUserOnly) == 0)
      problem.clear();
    else
      problem = errno == EEXIST ? whyUnfit(folder) : lastError();
    if (problem.empty())
      return folder / fileName(place);
    problem = fmt::format("`{}`: {}", folder.string(), problem);
  }
  return std::nullopt;
}

std::optional<fs::path> findRunSocket(const fs::path &place) {
  std::error_code error;
  for (const fs::path &folder : socketFolders())
    if (whyUnfit(folder).empty() && fs::is_socket(folder / fileName(place), error))
      return folder / fileName(place);
  return std::nullopt;
}

} // namespace stc
