#include "compiler/import/input_files.hpp"

#include "compiler/import/encoding.hpp"
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/reader.hpp"
#include "compiler/source/read_source.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <sys/stat.h>

namespace stc::import {

namespace fs = std::filesystem;

namespace {

/// Formats with a file per object, whose folders are those of the project.
constexpr std::array<std::string_view, 7> kFilePerObject = {".tcpou", ".tcdut", ".tcgvl", ".tcio",
                                                            ".scl",   ".udt",   ".db"};

bool isFilePerObject(const Object &object) {
  const std::string extension =
      stride::common::lowerCase(fs::path(object.origin.file).extension().string());
  return object.folder.empty() &&
         std::ranges::find(kFilePerObject, extension) != kFilePerObject.end();
}

/// Names of the folders that a file lies in.
std::vector<std::string> foldersAbove(const std::string &file) {
  std::vector<std::string> names;
  for (const fs::path &part : fs::path(file).lexically_normal().parent_path())
    names.push_back(part.string());
  return names;
}

/// Folders of files become folders of the project, from where they differ.
void placeByFolders(Model &model) {
  std::optional<std::vector<std::string>> common;
  for (const Object &object : model.objects) {
    if (!isFilePerObject(object))
      continue;
    const std::vector<std::string> folders = foldersAbove(object.origin.file);
    if (!common)
      common = folders;
    common->resize(
        static_cast<size_t>(std::ranges::mismatch(*common, folders).in1 - common->begin()));
  }
  for (Object &object : model.objects) {
    if (!isFilePerObject(object))
      continue;
    const std::vector<std::string> folders = foldersAbove(object.origin.file);
    for (size_t i = common->size(); i < folders.size(); ++i)
      for (std::string &each : foldersOf("\\/" + folders[i]))
        object.folder.push_back(std::move(each));
  }
}

/// Where a file that another one names lies.
std::string pathTo(const FileReference &reference) {
  return (fs::path(reference.origin.file).parent_path() / reference.path).lexically_normal();
}

/// Folders may hold files that their projects have, but do not build.
void dropExcluded(Model &model) {
  std::set<std::string> files;
  for (const FileReference &each : model.excluded)
    files.insert(pathTo(each));
  for (const FileReference &each : model.references) // of another project
    files.erase(pathTo(each));
  if (files.empty())
    return;
  const auto dropped = [&](const auto &each) {
    return files.contains(fs::path(each.origin.file).lexically_normal().string());
  };
  std::erase_if(model.objects, dropped);
  std::erase_if(model.tasks, dropped);
  std::erase_if(model.changed, dropped);
  std::erase_if(model.leftOut, dropped);
  std::erase_if(model.unreadable, dropped);
}

/// Ends of lines as other systems have them.
void dropCarriageReturns(std::string &text) {
  size_t to = 0;
  for (size_t from = 0; from < text.size(); ++from)
    if (text[from] != '\r' || from + 1 == text.size() || text[from + 1] != '\n')
      text[to++] = text[from];
  text.resize(to);
}

/// Exports with pictures are longer than sources may be.
constexpr size_t kMostBytes = size_t{256} << 20U;
constexpr int kDeepest = 64; ///< folders in each other

class FileReader {
public:
  FileReader(const std::string &encoding, Model &model) : encoding_(encoding), model_(model) {}

  void add(const std::string &path) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
      if (!addFolder(path, 0))
        refuseFolder(path);
      foreign_.clear();
      return;
    }
    if (isNew(path))
      read(path);
  }

  /// Files that projects name. They may name further ones.
  void addReferences() {
    for (; followed_ < model_.references.size(); ++followed_) {
      const FileReference reference = model_.references[followed_];
      const std::string path = pathTo(reference);
      std::error_code error;
      if (!hasKnownExtension(path))
        model_.leftOut.push_back(
            {reference.origin, reference.path, "files with this ending are not imported"});
      else if (!fs::is_regular_file(path, error))
        model_.leftOut.push_back({reference.origin, reference.path, "the file is not there"});
      else if (isNew(path))
        read(path);
    }
  }

private:
  void refuse(Origin origin, std::string why) {
    model_.unreadable.push_back({std::move(origin), "file", std::move(why)});
  }

  /// Nothing below it can be read: the files that at least are of a project tool say more.
  void refuseFolder(const std::string &path) {
    if (foreign_.empty())
      refuse({path, 1}, "no file below it has an ending that is imported");
    for (const std::string &each : foreign_)
      read(each);
  }

  /// Whether this is the first path to a file or folder. What is not there is always new.
  bool isNew(const std::string &path) {
    struct ::stat status {};
    return ::stat(path.c_str(), &status) != 0 ||
           seen_.insert({status.st_dev, status.st_ino}).second;
  }

  /// True when there was something to read.
  bool addFolder(const std::string &folder, int depth) {
    if (!isNew(folder))
      return true;
    if (depth == kDeepest)
      return refuse({folder, 1}, "its folders are nested deeper than 64"), true;
    std::error_code error;
    std::vector<std::string> names;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
      if (const std::string name = at->path().filename().string(); !name.starts_with('.'))
        names.push_back(name);
    if (error) {
      refuse({folder, 1}, fmt::format("the folder cannot be read: {}", error.message()));
      return true;
    }
    std::sort(names.begin(), names.end());
    bool found = false;
    for (const std::string &name : names) {
      const std::string path = (fs::path(folder) / name).string();
      std::error_code ignored;
      if (fs::is_directory(path, ignored))
        found = addFolder(path, depth + 1) || found;
      else if (!isNew(path))
        found = found || hasKnownExtension(name);
      else if (hasKnownExtension(name))
        read(path), found = true;
      else if (formatOf(name, {}).known)
        foreign_.push_back(path);
    }
    return found;
  }

  void read(const std::string &path) {
    const std::optional<std::string> bytes = readSource(path, kMostBytes);
    if (!bytes)
      return refuse({path, 1}, fmt::format("it cannot be read: {}", readSourceError(kMostBytes)));
    FormatChoice choice = formatOf(path, *bytes);
    if (choice.format == nullptr && choice.known)
      return refuse({path, 1}, std::move(choice.refusal));
    DecodedText text = decoded(*bytes, encoding_);
    if (!text.problem.empty())
      return refuse({path, text.line}, text.problem);
    choice = formatOf(path, text.text); // UTF-16 shows only now what it is
    if (choice.format == nullptr)
      return refuse({path, 1}, std::move(choice.refusal));
    if (text.assumed)
      model_.assumedEncoding.push_back(path);
    dropCarriageReturns(text.text);
    const size_t refused = model_.unreadable.size();
    choice.format->read(path, text.text, model_);
    model_.files += model_.unreadable.size() == refused ? 1 : 0;
  }

  const std::string &encoding_;
  Model &model_;
  std::set<std::pair<dev_t, ino_t>> seen_;
  size_t followed_ = 0;              ///< references that have been read
  std::vector<std::string> foreign_; ///< known, but not read: named when nothing else is there
};

} // namespace

Model readFiles(const std::vector<std::string> &paths, const std::string &encoding) {
  Model model;
  FileReader reader(encoding, model);
  for (const std::string &path : paths)
    reader.add(path);
  reader.addReferences();
  dropExcluded(model);
  placeByFolders(model);
  return model;
}

} // namespace stc::import
