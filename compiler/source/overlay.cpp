#include "compiler/source/overlay.hpp"

#include <system_error>
#include <utility>

namespace stc {

namespace fs = std::filesystem;

namespace {

/// The same for all names of a file that is on the disk, or whose folder is.
fs::path keyOf(const fs::path &path) {
  std::error_code error;
  fs::path whole = fs::weakly_canonical(path, error);
  if (!error && whole.is_absolute())
    return whole;
  whole = fs::absolute(path, error);
  return (error ? path : whole).lexically_normal();
}

} // namespace

void Overlay::set(const fs::path &path, std::string bytes) {
  files_.insert_or_assign(keyOf(path), std::move(bytes));
}

void Overlay::remove(const fs::path &path) { files_.erase(keyOf(path)); }

const std::string *Overlay::find(const fs::path &path) const {
  if (files_.empty())
    return nullptr;
  const auto found = files_.find(keyOf(path));
  return found != files_.end() ? &found->second : nullptr;
}

std::vector<fs::path> Overlay::filesBelow(const fs::path &folder) const {
  std::vector<fs::path> found;
  if (files_.empty())
    return found;
  const fs::path whole = keyOf(folder);
  for (const auto &[path, bytes] : files_) {
    const fs::path rest = path.lexically_relative(whole);
    if (!rest.empty() && *rest.begin() != ".." && *rest.begin() != ".")
      found.push_back(folder / rest);
  }
  return found;
}

} // namespace stc
