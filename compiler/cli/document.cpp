// stride doc

#include "compiler/cli/commands.hpp"
#include "compiler/doc/html.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/output_folder.hpp"
#include "compiler/project/project.hpp"
#include "compiler/syntax/parser.hpp"

#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <optional>

namespace stc::cli {

namespace {

/// Into the folder that the user has named, or else into `doc` where he stands: perhaps in a
/// project whose author has put a link there.
int write(const std::vector<doc::Page> &pages, const std::string &out, const Output &output) {
  const std::filesystem::path below = out.empty() ? "doc" : "";
  const std::optional<OutputFolder> folder = OutputFolder::open(out);
  for (const doc::Page &page : pages) {
    const std::filesystem::path name = below / page.path;
    if (folder &&
        (folder->read(name, page.text.size()) == page.text || folder->write(name, page.text)))
      continue;
    const std::string path = (std::filesystem::path(out) / name).string();
    if (errno == ELOOP)
      return showError(Code::LinkInTheWay,
                       fmt::format("`{}` is not written: a symbolic link leads there", path),
                       output);
    return showError(Code::CannotWrite, fmt::format("{}: {}", path, lastError()), output);
  }
  return 0;
}

std::vector<doc::Module> standardLibraryModules() {
  const EmbeddedLibraryIndex index(standardLibrary());
  Interner interner;
  Arena arena;
  Sources sources;
  Diagnostics diagnostics;
  std::vector<doc::Module> modules;
  modules.push_back(doc::builtinFunctions());
  for (const std::string_view library : index.libraries()) {
    std::vector<const ast::File *> files;
    for (const LibraryIndex::Entry &entry : index.files(library)) {
      const FileId id = sources.add(std::string(entry.fileName), std::string(entry.text));
      files.push_back(parse(sources.file(id), interner, arena, diagnostics));
    }
    modules.push_back(doc::describe(std::string(library), files, sources));
  }
  return modules;
}

/// The project, then the libraries of one's own that it uses.
std::vector<doc::Module> modulesOf(const Project &project) {
  std::vector<doc::Module> modules;
  const auto add = [&](const std::string &name, const std::vector<ast::File *> &parsed,
                       const std::string &text) {
    const std::vector<const ast::File *> files(parsed.begin(), parsed.end());
    modules.push_back(doc::describe(name, files, project.sources()));
    modules.back().text = text;
  };
  add(project.name(), project.program().files,
      project.library() ? about(*project.library()) : std::string());
  for (const LibrarySource &library : project.program().librarySources)
    add(library.name, library.files, library.about);
  return modules;
}

/// The pages with the pictures that the folder has of entries of the modules.
std::vector<doc::Page> pagesOf(const std::string &title, std::vector<doc::Module> modules,
                               const std::string &figures) {
  std::vector<doc::Page> pictures;
  if (!figures.empty())
    for (doc::Module &module : modules)
      for (doc::Entry &entry : module.entries) {
        const std::string file = module.name + "/" + entry.name;
        std::optional<std::string> picture = readFile(figures + "/" + file + ".svg");
        if (!picture)
          continue;
        entry.figure = "figures/" + file + ".svg";
        entry.caption = readFile(figures + "/" + file + ".txt").value_or(std::string());
        pictures.push_back({entry.figure, std::move(*picture)});
      }
  std::vector<doc::Page> pages = doc::htmlPages(title, modules);
  pages.insert(pages.end(), std::make_move_iterator(pictures.begin()),
               std::make_move_iterator(pictures.end()));
  return pages;
}

} // namespace

int documentCommand(const ProjectOptions &options, bool library, const std::string &figures,
                    const std::string &out) {
  if (!figures.empty() && !std::filesystem::is_directory(figures))
    return showError(Code::UnreadableFile, fmt::format("`{}` is not a folder", figures),
                     options.output);
  if (library)
    return write(pagesOf("Stride's library", standardLibraryModules(), figures), out,
                 options.output);
  const EmbeddedLibraryIndex index(standardLibrary());
  const Project project(options.path, Purpose::Check, settingsOf(options), index);
  const int exitCode = show(project.diagnostics(), project.sources(), options.output);
  if (exitCode != 0)
    return exitCode;
  return write(pagesOf(project.name(), modulesOf(project), figures), out, options.output);
}

} // namespace stc::cli
