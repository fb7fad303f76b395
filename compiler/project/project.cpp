#include "compiler/project/project.hpp"

#include "compiler/assets/cam/cam_source.hpp"
#include "compiler/project/axes_group_sources.hpp"
#include "compiler/project/cnc_config.hpp"
#include "compiler/project/csy_sources.hpp"
#include "compiler/project/library_sources.hpp"
#include "compiler/project/source_files.hpp"
#include "compiler/source/read_source.hpp"
#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/st_text.hpp"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <unordered_map>

namespace stc {

namespace fs = std::filesystem;

Project::Project(const fs::path &path, Purpose purpose, const Settings &settings,
                 const LibraryIndex &index, const Overlay *overlay) {
  program_.sources = Sources(overlay);
  program_.settings = settings;
  program_.diagnostics.setLevels(settings.levels);
  load(path.empty() ? findProjectFolder(".") : path);
  if (loaded_)
    analyse(purpose, index);
}

void Project::load(const fs::path &given) {
  std::error_code error;
  const fs::file_status status = fs::status(given, error);
  if (!fs::exists(status) && !program_.sources.isUnsaved(given)) {
    if (status.type() == fs::file_type::not_found)
      program_.diagnostics.report(Code::PathNotFound, {},
                                  fmt::format("there is no file or folder `{}`", given.string()));
    else // a link that leads to itself, a folder that must not be searched
      program_.diagnostics.report(
          Code::UnreadableFile, {},
          fmt::format("`{}` cannot be read: {}", given.string(), error.message()));
    return;
  }
  if (fs::is_directory(status) || given.filename() == kManifest) {
    path_ = fs::is_directory(status) ? given : given.parent_path();
    if (path_.empty())
      path_ = ".";
    config_.name = fs::absolute(path_, error).lexically_normal().filename().string();
    if (config_.name.empty()) // the path ends with a slash
      config_.name =
          fs::absolute(path_, error).lexically_normal().parent_path().filename().string();
    loadFolder();
    return;
  }
  path_ = given;
  single_ = true;
  ownName_ = true;
  config_.name = given.stem().string();
  loadFiles({given});
  for (const FileId id : sourceFiles_)
    program_.sources.file(id).setCodeName(given.filename().string());
  loaded_ = !hasErrors();
}

void Project::loadFolder() {
  std::error_code error;
  const fs::path manifest = path_ / kManifest;
  // A link that leads nowhere, or to itself, was meant to be one, too.
  if (program_.sources.isUnsaved(manifest) || fs::exists(fs::symlink_status(manifest, error))) {
    if (const std::optional<FileId> id = program_.sources.load(manifest, std::string(kManifest)))
      tomlFile_ = *id;
    else
      program_.diagnostics.report(
          Code::UnreadableFile, {},
          fmt::format("`{}` cannot be read: {}", manifest.string(), readSourceError()));
  }
  readOwnConfig();
  std::vector<fs::path> roots;
  if (!findRoots(path_, config_.sources, program_.sources, program_.diagnostics, roots))
    return;
  const FoundFiles sources = findSources(program_.sources, roots);
  if (reportUnfound(sources, path_, program_.diagnostics) && sources.files.empty())
    program_.diagnostics
        .report(Code::NoSources, {},
                fmt::format("there are no `.st` files in `{}`", path_.string()))
        .help("`stride new NAME` makes a project to start from");
  if (tomlFile_ == 0 && sources.files.size() > 1)
    program_.diagnostics
        .report(
            Code::NoManifest, {},
            fmt::format("`{}` has no stride.toml: its {} source files are taken for one project",
                        path_.string(), sources.files.size()))
        .help("if they are one, make an empty stride.toml there; if not, name one file");
  loadFiles(sources.files);
  loadAssets(findCams(program_.sources, roots), camFiles_);
  loadAssets(findCncFiles(program_.sources, roots, filesFolder(path_, config_)), cncFiles_);
  loaded_ = !sources.files.empty();
}

/// Loads files besides the sources.
void Project::loadAssets(const FoundFiles &found, std::vector<FileId> &ids) {
  for (const fs::path &file : found.files) {
    const std::string name = file.lexically_relative(path_).string();
    if (const std::optional<FileId> id = program_.sources.load(file, name))
      ids.push_back(*id);
    else
      program_.diagnostics.report(Code::UnreadableFile, {},
                                  fmt::format("`{}` cannot be read: {}", name, readSourceError()));
  }
}

/// Sources, which several threads read; those of a folder are named after their place in it.
void Project::loadFiles(const std::vector<fs::path> &files) {
  constexpr size_t kBytesPerFile = 1024; // to ask for a file takes as long as to read these
  struct Read {
    std::optional<std::string> bytes;
    std::string name;
    int error = 0; ///< of readSourceError()
  };
  std::vector<Read> read(files.size());
  const unsigned threads =
      Workers(program_.settings.jobs).threadsFor(files.size(), files.size() * kBytesPerFile);
  Workers::each(files.size(), threads, [&](size_t i, unsigned) {
    read[i].name = (single_ ? files[i] : files[i].lexically_relative(path_)).string();
    read[i].bytes = program_.sources.read(files[i]);
    read[i].error = errno;
  });
  for (size_t i = 0; i < files.size(); ++i) {
    if (read[i].bytes) {
      sourceFiles_.push_back(
          program_.sources.addBytes(std::move(read[i].name), std::move(*read[i].bytes)));
      continue;
    }
    errno = read[i].error;
    program_.diagnostics.report(
        Code::UnreadableFile, {},
        fmt::format("`{}` cannot be read: {}", files[i].string(), readSourceError()));
  }
}

bool Project::declaresNothing(const std::vector<ast::File *> &files) const {
  return !hasErrors() && std::all_of(files.begin(), files.end(), [](const ast::File *file) {
    return file->declarations.empty();
  });
}

void Project::readOwnConfig() {
  if (tomlFile_ == 0)
    return;
  ProjectConfig read = readConfig(program_.sources.file(tomlFile_), program_.diagnostics);
  program_.settings.poolSize = read.poolSize;
  if (read.name.empty() && read.library)
    read.name = read.library->name.text;
  ownName_ = !read.name.empty();
  if (!ownName_)
    read.name = config_.name;
  config_ = std::move(read);
  program_.settings.addressing = config_.addressing;
  program_.settings.imageBytes = config_.imageBytes;
  program_.settings.pack = config_.pack;
  program_.settings.truncIsInt = config_.truncIsInt;
  program_.settings.softMotion3 = config_.generation == 3;
  for (const CsyConfig &csy : config_.csy)
    program_.settings.modules.push_back({csy.rack, csy.slot});
}

/// What the configuration declares goes to the files; false: something of it is missing, which the
/// program would miss everywhere.
bool Project::addDeclarations(Purpose purpose, ProgramCheck programCheck,
                              std::vector<ast::File *> &files, const ParseOptions &options,
                              const LibraryIndex &index) {
  if (ast::File *instances = readConfigurations(config_, files, program_))
    files.push_back(instances);
  if (purpose == Purpose::Test) {
    files.push_back(parseSynthetic(testProgram(tests_), options));
    configureTests(config_);
  }
  resolveTasks(config_, files, programCheck, program_.diagnostics);
  const SyntheticSource plc = plcDeclarations(config_, files, program_.diagnostics);
  if (!plc.empty()) {
    files.insert(files.begin(), parseSynthetic(plc, options));
    plcFile_ = files.front()->id;
  }
  if (!declareAxesGroups(files, options, index) || !declareCsy(files, options) ||
      !declareCams(files, options) || !declareCnc(files, options, index))
    return false;
  for (const TaskConfig &task : config_.tasks)
    if (!task.event.text.empty())
      files.insert(files.begin(), eventFile(task, options));
  return true;
}

void Project::analyse(Purpose purpose, const LibraryIndex &index) {
  const bool librariesFound = readLibraries(program_, config_, path_, index);
  const size_t configErrors = program_.diagnostics.errorCount();
  DeclaredNames names(program_.sources, sourceFiles_);
  ParseOptions options{config_.defines, &names};
  options.defines.insert(options.defines.end(), program_.settings.defines.begin(),
                         program_.settings.defines.end());
  std::vector<const SourceFile *> sources;
  for (const FileId id : sourceFiles_)
    sources.push_back(&program_.sources.file(id));
  std::vector<ast::File *> files =
      parseFiles(sources, program_.interner, program_.arena, program_.diagnostics, &options,
                 Workers(program_.settings.jobs));
  attachMembers(files, program_.arena, program_.diagnostics);
  const bool syntaxErrors = program_.diagnostics.errorCount() != configErrors;
  if (config_.library)
    checkLibraryContent(files, program_.diagnostics);
  tests_ = findTests(files, program_.diagnostics);
  if (purpose == Purpose::Build)
    removeTests(files, program_.arena);
  if (declaresNothing(files)) {
    program_.diagnostics.report(
        Code::NothingDeclared, {},
        sourceFiles_.size() == 1
            ? fmt::format("`{}` declares nothing", program_.sources.file(sourceFiles_[0]).name())
            : std::string("the source files declare nothing"));
    return;
  }
  if (config_.incomplete || !librariesFound)
    return; // what is missing of the configuration would be missed everywhere in the program
  const ProgramCheck programCheck = syntaxErrors                ? ProgramCheck::Skip
                                    : purpose == Purpose::Build ? ProgramCheck::Runnable
                                                                : ProgramCheck::Existing;
  if (!addDeclarations(purpose, programCheck, files, options, index))
    return;
  program_.files = files;
  check(program_, files, index);
  if (!hasErrors())
    shareVariables();
}

ast::File *Project::parseSynthetic(const SyntheticSource &source, ParseOptions options) {
  options.generated = true;
  return parse(program_.sources.file(program_.sources.add(source)), program_.interner,
               program_.arena, program_.diagnostics, &options);
}

/// Adds the groups of [[axes_group]] as global variables. False: some are wrong.
bool Project::declareAxesGroups(std::vector<ast::File *> &files, const ParseOptions &options,
                                const LibraryIndex &index) {
  const size_t errors = program_.diagnostics.errorCount();
  const SyntheticSource groups = axesGroupDeclarations(program_, config_, files, index);
  if (program_.diagnostics.errorCount() != errors)
    return false;
  if (!groups.empty())
    files.insert(files.begin(), parseSynthetic(groups, options));
  return true;
}

/// Adds the modules of [[csy]] as global variables and programs. False: some are wrong.
bool Project::declareCsy(std::vector<ast::File *> &files, const ParseOptions &options) {
  const size_t errors = program_.diagnostics.errorCount();
  const SyntheticSource modules = csyDeclarations(config_, program_.diagnostics);
  if (program_.diagnostics.errorCount() != errors)
    return false;
  if (!modules.empty())
    files.insert(files.begin(), parseSynthetic(modules, options));
  return true;
}

/// Adds the cams of the cam files as global variables. False: some are wrong.
bool Project::declareCams(std::vector<ast::File *> &files, const ParseOptions &options) {
  const size_t errors = program_.diagnostics.errorCount();
  std::vector<CamSource> cams;
  for (const FileId id : camFiles_)
    if (std::optional<CamSource> cam = readCam(program_.sources.file(id), program_.diagnostics))
      cams.push_back(std::move(*cam));
  const SyntheticSource declarations = camDeclarations(cams, files, program_.diagnostics);
  if (program_.diagnostics.errorCount() != errors)
    return false;
  if (!declarations.empty())
    files.insert(files.begin(), parseSynthetic(declarations, options));
  return true;
}

/// The same of the CNC files.
bool Project::declareCnc(std::vector<ast::File *> &files, const ParseOptions &options,
                         const LibraryIndex &index) {
  const size_t errors = program_.diagnostics.errorCount();
  std::vector<CncFound> found;
  for (const FileId id : cncFiles_)
    found.push_back({id, program_.sources.file(id).name()});
  CncParts parts = declareCncPrograms(program_, config_, found, files, index);
  if (config_.library)
    refuseFiles(parts, program_.diagnostics);
  if (program_.diagnostics.errorCount() != errors)
    return false;
  if (!parts.declarations.empty())
    files.insert(files.begin(), parseSynthetic(parts.declarations, options));
  madeFiles_ = std::move(parts.files);
  return true;
}

/// The FUNCTION for the event of a task, in a file of the name of that in which the event stands.
ast::File *Project::eventFile(const TaskConfig &task, const ParseOptions &options) {
  const SourceFile &from = program_.sources.file(task.event.span.file);
  LineColumn at = from.position(task.event.span.begin);
  if (from.id() == tomlFile_)
    ++at.column; // after the quotation mark
  ast::File *file = parseSynthetic(eventDeclaration(task, from.name(), at), options);
  program_.sources.file(file->id).setCodeName(from.codeName());
  return file;
}

/// What tasks have in common, and what they must not.
void Project::shareVariables() {
  const AppConfig app = appConfig();
  std::vector<TaskEntry> tasks;
  for (const AppConfig::Task &task : app.tasks) {
    tasks.push_back({task.name, {task.programs.begin(), task.programs.end()}});
    for (const AppConfig::Task &other :
         app.tasks) { // every task looks at the events after its own cycle
      if (other.event != nullptr)
        tasks.back().pous.push_back(other.event);
    }
  }
  std::unordered_map<std::string, uint32_t> drives;
  for (const AxisGroupConfig &group : config_.axisGroups) {
    for (uint32_t task = 0; task < tasks.size(); ++task) {
      if (!equalIgnoringCase(tasks[task].name, group.task.text))
        continue;
      for (const DriveConfig &drive : group.drives)
        drives.emplace(lowerCase(drive.name.text), task);
    }
  }
  findSharing(program_, tasks, [&](const VarSymbol *v) {
    const bool isDrive = v->globals != nullptr && v->name.span.file == plcFile_ && plcFile_ != 0;
    const auto found = drives.find(std::string(v->name.id->lower));
    return isDrive && found != drives.end() ? found->second : kNoTask;
  });
}

std::vector<Diagnostic> Project::diagnostics() const {
  Diagnostics sorted = program_.diagnostics;
  sorted.sort();
  std::vector<Diagnostic> result = sorted.all();
  for (Diagnostic &diagnostic : result)
    for (Label &label : diagnostic.labels)
      label.span = program_.sources.origin(label.span);
  return result;
}

std::vector<std::string> Project::files() const {
  std::vector<std::string> names;
  for (const std::vector<FileId> *ids : {&sourceFiles_, &camFiles_, &cncFiles_})
    for (const FileId id : *ids)
      names.push_back(program_.sources.file(id).name());
  return names;
}

std::vector<std::pair<std::string, std::string>> Project::units() const {
  std::vector<std::pair<std::string, std::string>> units;
  for (const AxisGroupConfig &group : config_.axisGroups)
    for (const DriveConfig &drive : group.drives)
      if (!drive.unit.empty())
        units.emplace_back(drive.name.text, drive.unit);
  for (const AxisConfig &axis : config_.axes)
    if (!axis.unit.empty())
      units.emplace_back(axis.name.text, axis.unit);
  return units;
}

std::vector<PouSymbol *> Project::programsOf(const std::vector<ConfigName> &names) const {
  std::vector<PouSymbol *> programs;
  for (const ConfigName &name : names)
    for (PouSymbol *pou : program_.user->pous)
      if (pou->decl->kind == ast::DeclKind::Program && equalIgnoringCase(pou->name.text, name.text))
        programs.push_back(pou);
  return programs;
}

AppConfig Project::appConfig() const {
  AppConfig app;
  if (ownName_)
    app.name = config_.name;
  app.retainFile = config_.retainFile;
  app.retainPeriodNs = config_.retainPeriodNs;
  app.filesRoot = config_.filesRoot;
  app.filesAnywhere = config_.filesAnywhere;
  app.filesDelay = config_.filesDelay;
  for (const TaskConfig &from : config_.tasks) {
    AppConfig::Task task;
    task.name = from.name.text;
    task.start = from.start;
    task.intervalNs = from.intervalNs;
    task.priority = from.priority;
    task.watchdogNs = from.watchdogNs;
    task.watchdogSensitivity = from.watchdogSensitivity;
    task.core = from.core;
    if (!from.event.text.empty())
      for (const PouSymbol *pou : program_.user->pous)
        if (equalIgnoringCase(pou->name.text, eventFunction(from)))
          task.event = pou;
    for (size_t i = 0; i < config_.axisGroups.size(); ++i)
      if (isSyncOf(from, config_.axisGroups[i]))
        task.sync = i;
    task.programs = programsOf(from.programs);
    task.stopPrograms = programsOf(from.stopPrograms);
    app.tasks.push_back(std::move(task));
  }
  for (const IoConfig &io : config_.ioDevices)
    app.ioDevices.push_back(io.device);
  for (const BusConfig &bus : config_.buses)
    app.buses.push_back({bus.name.text, bus.interfaceType, bus.driver, bus.parameters});
  for (const AxisGroupConfig &from : config_.axisGroups) {
    AppConfig::AxisGroup group;
    group.name = from.name.text;
    group.bus = from.bus;
    group.task = from.task.text;
    group.cycleUs = from.cycleUs;
    group.parameters = from.parameters;
    for (const DriveConfig &drive : from.drives)
      group.drives.push_back({drive.name.text, sharedVariable(drive), drive.id, drive.parameters});
    for (const EncoderConfig &encoder : from.encoders)
      group.encoders.push_back({encoder.name.text, encoder.id, encoder.parameters});
    group.data = sharedVariable(from);
    app.axisGroups.push_back(std::move(group));
  }
  for (const auto &[variable, unit] : units())
    app.units.push_back({variable, unit});
  return app;
}

} // namespace stc
