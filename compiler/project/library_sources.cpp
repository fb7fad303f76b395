#include "compiler/project/library_sources.hpp"

#include "compiler/assets/cam/cam_source.hpp"
#include "compiler/project/cnc_config.hpp"
#include "compiler/project/library_graph.hpp"
#include "compiler/project/tests.hpp"
#include "compiler/syntax/parser.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace stc {

namespace {

/// What the declaration is called; empty: a library can hold it.
std::string_view foreignContent(const ast::Decl &decl) {
  switch (decl.kind) {
  case ast::DeclKind::Program:
    return "a PROGRAM";
  case ast::DeclKind::Configuration:
    return "a CONFIGURATION";
  case ast::DeclKind::Config:
    return "VAR_CONFIG";
  case ast::DeclKind::Access:
    return "VAR_ACCESS";
  default:
    return {};
  }
}

/// Adds the cams of the library as global variables.
bool addCams(Program &program, const FoundLibrary &library, std::vector<ast::File *> &files) {
  const size_t errors = program.diagnostics.errorCount();
  std::vector<CamSource> cams;
  for (const FileId id : library.cams)
    if (std::optional<CamSource> cam = readCam(program.sources.file(id), program.diagnostics))
      cams.push_back(std::move(*cam));
  const SyntheticSource declarations = camDeclarations(cams, files, program.diagnostics);
  if (program.diagnostics.errorCount() != errors)
    return false;
  if (declarations.empty())
    return true;
  ParseOptions options;
  options.generated = true;
  files.insert(files.begin(),
               parse(program.sources.file(program.sources.add(declarations)), program.interner,
                     program.arena, program.diagnostics, &options));
  return true;
}

/// Adds its CNC programs likewise.
bool addCncPrograms(Program &program, const FoundLibrary &library, const LibraryIndex &index,
                    std::vector<ast::File *> &files) {
  const size_t errors = program.diagnostics.errorCount();
  const CncParts parts =
      declareCncPrograms(program, library.config, library.cncFiles, files, index);
  refuseFiles(parts, program.diagnostics);
  if (program.diagnostics.errorCount() != errors)
    return false;
  if (parts.declarations.empty())
    return true;
  ParseOptions options;
  options.generated = true;
  files.insert(files.begin(),
               parse(program.sources.file(program.sources.add(parts.declarations)),
                     program.interner, program.arena, program.diagnostics, &options));
  return true;
}

bool parseLibrary(Program &program, const FoundLibrary &library, const LibraryIndex &index) {
  const size_t errors = program.diagnostics.errorCount();
  LibrarySource source;
  source.name = library.name;
  source.uses = library.uses;
  source.qualifiedOnly = library.config.library->qualifiedOnly;
  source.pack = library.config.pack;
  source.truncIsInt = library.config.truncIsInt;
  source.about = about(*library.config.library);
  DeclaredNames names(program.sources, library.sources);
  const ParseOptions options{library.config.defines, &names};
  std::vector<const SourceFile *> sources;
  for (const FileId id : library.sources)
    sources.push_back(&program.sources.file(id));
  source.files = parseFiles(sources, program.interner, program.arena, program.diagnostics, &options,
                            Workers(program.settings.jobs));
  attachMembers(source.files, program.arena, program.diagnostics);
  removeTests(source.files, program.arena);
  checkLibraryContent(source.files, program.diagnostics);
  const bool good = addCams(program, library, source.files) &&
                    addCncPrograms(program, library, index, source.files);
  program.librarySources.push_back(std::move(source));
  return good && program.diagnostics.errorCount() == errors;
}

} // namespace

void checkLibraryContent(const std::vector<ast::File *> &files, Diagnostics &diagnostics) {
  for (const ast::File *file : files)
    for (const ast::Decl *decl : file->declarations) {
      const std::string_view what = foreignContent(*decl);
      if (what.empty())
        continue;
      const Span place = decl->name ? decl->name.span : decl->span;
      diagnostics
          .report(Code::LibraryContent, place, fmt::format("{} cannot stand in a library", what),
                  "belongs to a project")
          .help("move it into a project that uses the library; its stride.toml may lie in a folder "
                "of the library, for example `example`");
    }
}

bool readLibraries(Program &program, const ProjectConfig &config,
                   const std::filesystem::path &folder, const LibraryIndex &index) {
  if (config.library)
    program.ownNamespace = config.library->nameSpace.text;
  if (config.libraries.empty())
    return true;
  LibraryGraph graph(program, index, folder);
  bool good = graph.load(config);
  for (const FoundLibrary &library : graph.libraries())
    good = parseLibrary(program, library, index) && good;
  program.uses = graph.uses();
  return good;
}

} // namespace stc
