#include "compiler/project/source_files.hpp"

#include "compiler/assets/cam/cam_source.hpp"
#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/syntax/st_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <string>
#include <sys/stat.h>

namespace stc {

namespace fs = std::filesystem;

namespace {

/// Entries of folders that one link may lead to: more are no sources, but somebody's whole disk.
constexpr size_t kMostLinked = 10'000;

/// `folder/` and `folder/.` end with an empty name.
fs::path withoutSlash(const fs::path &path) {
  return path.has_filename() || path == path.root_path() ? path : path.parent_path();
}

bool isHiddenFolder(const std::string &name) { return name.starts_with('.') || name == "build"; }

/// The folder is a project of its own.
bool isProject(const Sources &sources, const fs::path &folder) {
  std::error_code ignored;
  return sources.isUnsaved(folder / kManifest) || fs::exists(folder / kManifest, ignored);
}

bool hasSuffix(const std::string &name, std::string_view suffix) {
  return !name.starts_with('.') && lowerCase(name).ends_with(suffix);
}

/// Whether all folders between `top` and the file are looked into.
bool isReached(const Sources &sources, const fs::path &top, const fs::path &file) {
  fs::path folder = top;
  for (const fs::path &part : file.parent_path().lexically_relative(top)) {
    folder /= part;
    if (part != "." && (isHiddenFolder(part.string()) || isProject(sources, folder)))
      return false;
  }
  return true;
}

class Finder {
public:
  Finder(const Sources &sources, std::string_view suffix) : sources_(sources), suffix_(suffix) {}

  void look(const fs::path &root) {
    std::error_code ignored;
    if (fs::is_regular_file(root, ignored)) {
      own_.push_back(root);
      return;
    }
    folder(root);
    for (const fs::path &unsaved : sources_.unsavedBelow(root))
      if (hasSuffix(unsaved.filename().string(), suffix_) && isReached(sources_, root, unsaved))
        own_.push_back(unsaved);
  }

  FoundFiles finish() {
    unique(own_);
    unique(linked_);
    std::set<fs::path> seen;
    std::error_code ignored;
    if (!linked_.empty() || roots_ > 1) {
      std::vector<fs::path> kept;
      for (const std::vector<fs::path> *files : {&own_, &linked_})
        for (const fs::path &file : *files)
          if (seen.insert(fs::weakly_canonical(file, ignored)).second)
            kept.push_back(file);
      own_ = std::move(kept);
      unique(own_);
    }
    found_.files = std::move(own_);
    return std::move(found_);
  }

private:
  static void unique(std::vector<fs::path> &files) {
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
  }

  void folder(const fs::path &root) {
    ++roots_;
    std::error_code error;
    fs::recursive_directory_iterator at(root, fs::directory_options::skip_permission_denied, error);
    for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
      const std::string name = at->path().filename().string();
      std::error_code ignored;
      if (!at->is_directory(ignored)) {
        if (hasSuffix(name, suffix_))
          own_.push_back(at->path());
        continue;
      }
      if (isHiddenFolder(name) || isProject(sources_, at->path()))
        at.disable_recursion_pending();
      else if (at->is_symlink(ignored))
        follow(at->path());
    }
    if (error && !found_.error)
      found_.error = error;
  }

  /// Whether a link leads to a folder around it.
  static bool isAround(const fs::path &link) {
    std::error_code error;
    const fs::path target = fs::canonical(link, error);
    const fs::path parent = link.parent_path();
    const fs::path place = fs::canonical(parent.empty() ? fs::path(".") : parent, error);
    const fs::path relative = place.lexically_relative(target);
    return !error && !relative.empty() && *relative.begin() != "..";
  }

  /// What a link to a folder leads to: each folder once, so that circles end.
  void follow(const fs::path &link) {
    if (isAround(link)) {
      found_.notFollowed.emplace_back(link, "a folder around it");
      return;
    }
    std::vector<fs::path> files;
    std::vector<fs::path> pending = {link};
    size_t entries = 0;
    while (!pending.empty()) {
      const fs::path at = pending.back();
      pending.pop_back();
      std::error_code error;
      if (!followed_.insert(fs::canonical(at, error)).second)
        continue;
      fs::directory_iterator entry(at, fs::directory_options::skip_permission_denied, error);
      for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        if (++entries > kMostLinked) {
          found_.notFollowed.emplace_back(link, fmt::format("more than {} files", kMostLinked));
          return;
        }
        const std::string name = entry->path().filename().string();
        std::error_code ignored;
        if (!entry->is_directory(ignored)) {
          if (hasSuffix(name, suffix_))
            files.push_back(entry->path());
        } else if (!isHiddenFolder(name) && !isProject(sources_, entry->path())) {
          pending.push_back(entry->path());
        }
      }
    }
    linked_.insert(linked_.end(), files.begin(), files.end());
  }

  const Sources &sources_;
  std::string_view suffix_;
  FoundFiles found_;
  std::vector<fs::path> own_;    ///< without following links to folders
  std::vector<fs::path> linked_; ///< what these lead to
  std::set<fs::path> followed_;
  size_t roots_ = 0;
};

FoundFiles findFiles(const Sources &sources, const std::vector<fs::path> &roots,
                     std::string_view suffix) {
  Finder finder(sources, suffix);
  for (const fs::path &root : roots)
    finder.look(root);
  return finder.finish();
}

} // namespace

FoundFiles findSources(const Sources &sources, const std::vector<fs::path> &roots) {
  return findFiles(sources, roots, ".st");
}

FoundFiles findCams(const Sources &sources, const std::vector<fs::path> &roots) {
  return findFiles(sources, roots, kCamSuffix);
}

FoundFiles findCncFiles(const Sources &sources, const std::vector<fs::path> &roots,
                        const fs::path &without) {
  FoundFiles found = findFiles(sources, roots, kCncSuffix);
  // Absolute: the folder may lie beside the project.
  std::error_code error;
  const fs::path folder = withoutSlash(fs::absolute(without, error).lexically_normal());
  std::erase_if(found.files, [&folder](const fs::path &file) {
    std::error_code ignored;
    const fs::path relative =
        fs::absolute(file, ignored).lexically_normal().lexically_relative(folder);
    return !relative.empty() && *relative.begin() != "..";
  });
  return found;
}

bool findRoots(const fs::path &folder, const std::vector<ConfigName> &named, const Sources &sources,
               Diagnostics &diagnostics, std::vector<fs::path> &roots) {
  if (named.empty())
    roots.push_back(folder);
  bool good = true;
  for (const ConfigName &one : named) {
    fs::path root = withoutSlash((folder / one.text).lexically_normal());
    std::error_code ignored;
    if (fs::exists(root, ignored) || sources.isUnsaved(root)) {
      roots.push_back(std::move(root));
      continue;
    }
    diagnostics
        .report(Code::PathNotFound, one.span,
                fmt::format("there is no file or folder `{}`", one.text), "named here")
        .help("`sources` names folders and `.st` files from the folder of stride.toml on");
    good = false;
  }
  return good;
}

bool reportUnfound(const FoundFiles &found, const fs::path &folder, Diagnostics &diagnostics) {
  for (const auto &[link, why] : found.notFollowed)
    diagnostics
        .report(Code::LinkNotFollowed, {},
                fmt::format("the link `{}` leads to {}", link.string(), why))
        .help("let it lead to a folder of sources, or remove it");
  if (found.error)
    diagnostics.report(
        Code::UnreadableFile, {},
        fmt::format("`{}` cannot be read: {}", folder.string(), found.error.message()));
  return found.notFollowed.empty() && !found.error;
}

fs::path findProjectFolder(const fs::path &folder) {
  struct stat own {};
  if (::stat(folder.c_str(), &own) != 0)
    return folder;
  std::error_code error;
  const fs::path start = withoutSlash(fs::absolute(folder, error).lexically_normal());
  fs::path around; // `..` so often
  for (fs::path at = start;; at = at.parent_path(), around /= "..") {
    // Somebody else's file in a folder for everybody, such as /tmp, makes no project of this one.
    struct stat manifest {};
    if (::stat((at / kManifest).c_str(), &manifest) == 0 && manifest.st_uid == own.st_uid)
      return around.empty() ? folder : withoutSlash((folder / around).lexically_normal());
    if (at == at.parent_path())
      return folder;
  }
}

} // namespace stc
