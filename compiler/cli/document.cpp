// stride doc

#include "compiler/cli/commands.hpp"
#include "compiler/doc/html.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"
#include "compiler/syntax/parser.hpp"

#include <fmt/format.h>

namespace stc::cli {

namespace {

int write(const std::vector<doc::Page> &pages, const std::filesystem::path &folder,
          const Output &output) {
  for (const doc::Page &page : pages)
    if (!writeIfDifferent(folder / page.path, page.text))
      return showError(Code::cannotWrite,
                       fmt::format("{}: {}", (folder / page.path).string(), lastError()), output);
  return 0;
}

std::vector<doc::Module> standardLibraryModules() {
  const EmbeddedLibraryIndex index(standardLibrary());
  Interner interner;
  Arena arena;
  SourceManager sources;
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

} // namespace

int documentCommand(const ProjectOptions &options, bool library, const std::string &out) {
  if (library)
    return write(doc::htmlPages("Stride's library", standardLibraryModules()), out, options.output);
  const EmbeddedLibraryIndex index(standardLibrary());
  const Project project(options.path, Purpose::check, settingsOf(options), index);
  const int exitCode = show(project.diagnostics(), project.sources(), options.output);
  if (exitCode != 0)
    return exitCode;
  const std::vector<ast::File *> &parsed = project.program().files;
  const std::vector<const ast::File *> files(parsed.begin(), parsed.end());
  return write(
      doc::htmlPages(project.name(), {doc::describe(project.name(), files, project.sources())}),
      out, options.output);
}

} // namespace stc::cli
