#include "compiler/project/library_graph.hpp"

#include "compiler/project/library_values.hpp"
#include "compiler/project/source_files.hpp"
#include "compiler/source/read_source.hpp"
#include "compiler/syntax/st_text.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

namespace stc {

namespace fs = std::filesystem;

namespace {

fs::path absoluteFrom(const char *variable) {
  const char *value = std::getenv(variable);
  return value != nullptr && *value == '/' ? fs::path(value) : fs::path();
}

/// Libraries of Stride that stand in for those of TwinCAT.
constexpr std::string_view kOtherSystems = "Tc2_";

std::string listed(const std::vector<std::string> &names) {
  std::string all;
  for (const std::string &name : names)
    all += (all.empty() ? "" : ", ") + name;
  return all;
}

} // namespace

fs::path userLibraries() {
  if (const fs::path data = absoluteFrom("XDG_DATA_HOME"); !data.empty())
    return data / "stride" / "libraries";
  const fs::path home = absoluteFrom("HOME");
  return home.empty() ? fs::path() : home / ".local" / "share" / "stride" / "libraries";
}

std::vector<fs::path> libraryFolders() {
  std::vector<fs::path> folders;
  if (const char *own = std::getenv("STRIDE_LIBRARIES"))
    for (std::string_view rest = own; !rest.empty();) {
      const size_t end = std::min(rest.find(':'), rest.size());
      if (end != 0)
        folders.emplace_back(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  if (fs::path user = userLibraries(); !user.empty())
    folders.push_back(std::move(user));
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  folders.push_back(program.parent_path().parent_path() / "share" / "stride" / "libraries");
  return folders;
}

std::vector<InstalledLibrary> installedLibraries(const std::string &lowerName) {
  std::vector<InstalledLibrary> found;
  const auto look = [&](const fs::path &folder) {
    Sources sources;
    Diagnostics ignored; // what is wrong with it is said when it is used
    const std::optional<FileId> id = sources.load(folder / kManifest, std::string(kManifest));
    if (!id)
      return;
    const ProjectConfig config = readConfig(sources.file(*id), ignored);
    if (!config.library || config.library->name.text.empty() ||
        (!lowerName.empty() && !equalIgnoringCase(config.library->name.text, lowerName)))
      return;
    found.push_back(
        {folder, config.library->name.text, config.library->version.text, config.library->number});
  };
  const auto forFolders = [](const fs::path &in, const auto &action) {
    std::error_code error;
    for (fs::directory_iterator at(in, error); !error && at != fs::directory_iterator();
         at.increment(error))
      if (std::error_code ignored; at->is_directory(ignored))
        action(at->path());
  };
  for (const fs::path &folder : libraryFolders())
    forFolders(folder, [&](const fs::path &one) {
      if (!lowerName.empty() && !equalIgnoringCase(one.filename().string(), lowerName))
        return;
      look(one);
      forFolders(one, look);
    });
  std::stable_sort(found.begin(), found.end(),
                   [](const InstalledLibrary &a, const InstalledLibrary &b) {
                     const std::string x = lowerCase(a.name);
                     const std::string y = lowerCase(b.name);
                     return x != y ? x < y : a.number > b.number;
                   });
  return found;
}

bool LibraryGraph::load(const ProjectConfig &config) {
  const size_t errors = program_.diagnostics.errorCount();
  std::error_code error;
  if (config.library)
    open_.push_back({fs::weakly_canonical(project_, error), config.library->name.text});
  for (const LibraryUse &wanted : config.libraries)
    if (!wanted.nameSpace.text.empty() && !wanted.path.text.empty())
      renamed_.emplace(fs::weakly_canonical(project_ / wanted.path.text, error), wanted.nameSpace);
  Unique names(Code::ConfigDuplicateName, program_.diagnostics);
  for (const LibraryUse &wanted : config.libraries)
    if (!wanted.name.text.empty() &&
        names.add(lowerCase(wanted.name.text), wanted.name.span,
                  fmt::format("the library `{}` is used twice", wanted.name.text)))
      if (std::optional<LibrarySource::Use> used = use(wanted, nullptr))
        uses_.push_back(std::move(*used));
  return program_.diagnostics.errorCount() == errors;
}

/// Reads the library, unless that has been done; nothing: it is one of Stride's, or wrong.
std::optional<LibrarySource::Use> LibraryGraph::use(const LibraryUse &wanted,
                                                    const FoundLibrary *by) {
  if (by != nullptr && !wanted.parameters.empty()) {
    const ConfigName &first = wanted.parameters.front().name;
    program_.diagnostics
        .report(Code::LibraryParameter, first.span,
                fmt::format("the library `{}` sets a parameter of another one", by->name),
                "only a project sets parameters")
        .help("set it in the [[library]] of the project");
    return std::nullopt;
  }
  if (const std::optional<std::string> standard = standardLibrary(wanted)) {
    takeLibraryValues(program_, wanted, *standard);
    // Its names are those of Stride's own blocks: they hide these where they are asked for.
    if (by == nullptr && standard->starts_with(kOtherSystems))
      return LibrarySource::Use{*standard, *standard};
    return std::nullopt;
  }
  const std::optional<fs::path> folder = folderOf(wanted, by);
  if (!folder)
    return std::nullopt;
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(*folder, error);
  if (isOpen(wanted, canonical))
    return std::nullopt;
  auto known = std::find_if(libraries_.begin(), libraries_.end(),
                            [&](const FoundLibrary &one) { return one.canonical == canonical; });
  if (known == libraries_.end()) {
    std::optional<FoundLibrary> found = read(wanted, *folder);
    if (!found)
      return std::nullopt;
    open_.push_back({canonical, found->config.library->name.text});
    for (const LibraryUse &next : found->config.libraries)
      if (std::optional<LibrarySource::Use> used = use(next, &*found))
        found->uses.push_back(std::move(*used));
    open_.pop_back();
    checkNames(*found);
    libraries_.push_back(std::move(*found));
    known = libraries_.end() - 1;
  } else if (!isThatLibrary(wanted, *known)) {
    return std::nullopt;
  }
  takeLibraryValues(program_, wanted, known->name);
  const std::string &own = known->config.library->nameSpace.text;
  return LibrarySource::Use{wanted.nameSpace.text.empty() ? own : wanted.nameSpace.text,
                            known->name};
}

/// A library that comes with Stride.
std::optional<std::string> LibraryGraph::standardLibrary(const LibraryUse &wanted) const {
  const std::string lower = lowerCase(wanted.name.text);
  if (!wanted.path.text.empty() || !index_.isLibrary(lower))
    return std::nullopt;
  if (!wanted.version.text.empty())
    program_.diagnostics.report(Code::ConfigWithoutEffect, wanted.version.span,
                                "`version` has no effect here", "this library is a part of Stride");
  for (const std::string_view library : index_.libraries())
    if (index_.answersTo(library, lower))
      return std::string(library);
  return wanted.name.text;
}

std::string LibraryGraph::shown(const fs::path &path) const {
  const fs::path relative = path.lexically_relative(project_);
  return (relative.empty() ? path : relative).lexically_normal().string();
}

std::optional<fs::path> LibraryGraph::folderOf(const LibraryUse &wanted, const FoundLibrary *by) {
  if (!wanted.path.text.empty())
    return ((by != nullptr ? by->folder : project_) / wanted.path.text).lexically_normal();
  const std::vector<InstalledLibrary> candidates = installedLibraries(lowerCase(wanted.name.text));
  std::vector<std::string> versions;
  for (const InstalledLibrary &one : candidates) {
    if (fits(one.number, wanted.version.text))
      return one.folder;
    versions.push_back(one.version);
  }
  if (!candidates.empty()) {
    program_.diagnostics
        .report(Code::LibraryVersion, wanted.version.span,
                fmt::format("no version of the library `{}` that is installed fits \"{}\"",
                            wanted.name.text, wanted.version.text),
                "wanted here")
        .note("installed: " + listed(versions))
        .help("install a version that fits, or change `version`");
    return std::nullopt;
  }
  std::vector<std::string> folders;
  for (const fs::path &folder : libraryFolders())
    folders.push_back(folder.string());
  program_.diagnostics
      .report(Code::LibraryMissing, wanted.name.span,
              fmt::format("the library `{}` is not installed", wanted.name.text),
              "no library of this name")
      .note("looked for in " + listed(folders))
      .help("say where it is, `path = \"../" + wanted.name.text +
            "\"`, or install it: `stride library install FOLDER`");
  return std::nullopt;
}

bool LibraryGraph::isOpen(const LibraryUse &wanted, const fs::path &canonical) {
  const auto first = std::find_if(open_.begin(), open_.end(),
                                  [&](const Open &one) { return one.canonical == canonical; });
  if (first == open_.end())
    return false;
  std::string circle;
  for (auto at = first; at != open_.end(); ++at)
    circle += "`" + at->name + (at == first ? "` needs " : "`, which needs ");
  circle += "`" + first->name + "`";
  program_.diagnostics
      .report(Code::LibraryCycle, wanted.name.span,
              fmt::format("the library `{}` needs itself", first->name), "the circle closes here")
      .note(circle)
      .help("move what both need into a library that needs neither");
  return true;
}

/// Name and version are those that somebody wants.
bool LibraryGraph::isThatLibrary(const LibraryUse &wanted, const FoundLibrary &found) {
  const LibraryInfo &info = *found.config.library;
  const Span place = wanted.path.span.valid() ? wanted.path.span : wanted.name.span;
  if (!equalIgnoringCase(info.name.text, wanted.name.text)) {
    program_.diagnostics
        .report(
            Code::LibraryMissing, place,
            fmt::format("the library there is `{}`, not `{}`", info.name.text, wanted.name.text),
            "leads to another library")
        .label(info.name.span, "it is called so here")
        .help(fmt::format("write `name = \"{}\"`", info.name.text));
    return false;
  }
  if (fits(info.number, wanted.version.text))
    return true;
  program_.diagnostics
      .report(Code::LibraryVersion, wanted.version.span,
              fmt::format("the library `{}` has version {}, which does not fit \"{}\"",
                          info.name.text, info.version.text, wanted.version.text),
              "wanted here")
      .label(info.version.span, "its version")
      .help("use another copy of the library, or change `version`");
  return false;
}

std::optional<FoundLibrary> LibraryGraph::read(const LibraryUse &wanted, const fs::path &folder) {
  Diagnostics &diagnostics = program_.diagnostics;
  const Span place = wanted.path.span.valid() ? wanted.path.span : wanted.name.span;
  const fs::path manifest = folder / kManifest;
  const std::optional<FileId> id = program_.sources.load(manifest, shown(manifest));
  if (!id) {
    diagnostics
        .report(Code::LibraryMissing, place,
                fmt::format("there is no library in `{}`", shown(folder)),
                fmt::format("`stride.toml` cannot be read: {}", readSourceError()))
        .help("`path` leads from this stride.toml to the folder of the library");
    return std::nullopt;
  }
  diagnostics.setForeign(*id);
  const Levels levels = diagnostics.levels(); // the project's, not the library's
  const size_t errors = diagnostics.errorCount();
  FoundLibrary found;
  found.folder = folder;
  found.config = readConfig(program_.sources.file(*id), diagnostics);
  diagnostics.setLevels(levels);
  if (diagnostics.errorCount() != errors)
    return std::nullopt;
  if (!found.config.library) {
    diagnostics
        .report(Code::LibraryMissing, place,
                fmt::format("`{}` is a project, not a library", shown(folder)),
                "its stride.toml has no [library]")
        .help("begin its stride.toml with [library], `name = …` and `version = \"…\"`");
    return std::nullopt;
  }
  std::error_code error;
  found.canonical = fs::weakly_canonical(folder, error);
  // As the project calls it, whoever needs it first.
  const auto renamed = renamed_.find(found.canonical);
  const ConfigName &other = renamed != renamed_.end() ? renamed->second : wanted.nameSpace;
  found.name = other.text.empty() ? found.config.library->nameSpace.text : other.text;
  found.nameSpan = other.text.empty() ? wanted.name.span : other.span;
  if (!isThatLibrary(wanted, found) || !readFiles(found))
    return std::nullopt;
  return found;
}

bool LibraryGraph::readFiles(FoundLibrary &library) {
  Diagnostics &diagnostics = program_.diagnostics;
  std::vector<fs::path> roots;
  if (!findRoots(library.folder, library.config.sources, program_.sources, diagnostics, roots))
    return false;
  const auto load = [&](const FoundFiles &found, std::vector<FileId> &ids) {
    if (!reportUnfound(found, library.folder, diagnostics))
      return false;
    for (const fs::path &file : found.files) {
      const std::optional<FileId> id = program_.sources.load(file, shown(file));
      if (!id) {
        diagnostics.report(
            Code::UnreadableFile, {},
            fmt::format("`{}` cannot be read: {}", file.string(), readSourceError()));
        return false;
      }
      // The same text, wherever the library lies.
      program_.sources.file(*id).setCodeName(
          fmt::format("<{}>/{}", library.name, file.lexically_relative(library.folder).string()));
      diagnostics.setForeign(*id);
      ids.push_back(*id);
    }
    return true;
  };
  std::vector<FileId> cncFiles;
  const fs::path filesRoot = filesFolder(library.folder, library.config);
  if (!load(findSources(program_.sources, roots), library.sources) ||
      !load(findCams(program_.sources, roots), library.cams) ||
      !load(findCncFiles(program_.sources, roots, filesRoot), cncFiles))
    return false;
  // The name without the library's: `<Lib>/path`.
  for (const FileId id : cncFiles)
    library.cncFiles.push_back(
        {id, program_.sources.file(id).codeName().substr(library.name.size() + 3)});
  return true;
}

/// Every library has a name of its own in the program.
void LibraryGraph::checkNames(const FoundLibrary &found) {
  const std::string help = "give one of them another name in the project: `namespace = \"" +
                           found.name + "2\"` in its [[library]]";
  if (index_.isReserved(lowerCase(found.name)))
    program_.diagnostics
        .report(Code::LibraryNamespace, found.nameSpan,
                fmt::format("the namespace `{}` is that of a library of Stride", found.name),
                "this library has it, too")
        .help("give it another name in the project: `namespace = \"My" + found.name +
              "\"` in its [[library]]");
  for (const FoundLibrary &other : libraries_)
    if (equalIgnoringCase(other.name, found.name))
      program_.diagnostics
          .report(Code::LibraryNamespace, found.nameSpan,
                  fmt::format("two libraries have the namespace `{}`", found.name),
                  fmt::format("that of the library in `{}`", shown(found.folder)))
          .label(other.nameSpan, fmt::format("that of the library in `{}`", shown(other.folder)))
          .help(help);
}

} // namespace stc
