#include "compiler/project/cnc_config.hpp"

#include "compiler/assets/cnc/nc_source.hpp"
#include "compiler/project/type_finder.hpp"
#include "compiler/source/suggest.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace stc {

namespace {

namespace cnc = stride::cnc;

constexpr std::string_view kLetters = "XYZABCPQUVW";

std::optional<double> valueOf(const CheckedSection &section, std::string_view name) {
  const TomlNode *value = section.get(name);
  return value != nullptr ? std::optional(value->floating) : std::nullopt;
}

std::string normal(std::string_view path) {
  return std::filesystem::path(path).lexically_normal().string();
}

bool isQueue(CncCompile compile) {
  return compile == CncCompile::Queue || compile == CncCompile::QueueFile;
}

/// What counts for queues only.
void warnOfIdle(const CheckedSection &section, CncCompile compile, Diagnostics &diagnostics) {
  if (isQueue(compile))
    return;
  for (const std::string_view name :
       {"angle_tolerance", "queue_bytes", "step_suppress", "preprocess", "tool_radius"})
    if (const TomlNode *value = section.get(name))
      diagnostics.report(Code::ConfigWithoutEffect, value->span,
                         fmt::format("`{}` has no effect here", name),
                         "only with compile = \"queue\" or \"queue-file\"");
}

/// There is no such path processor.
void reportProcessor(const TomlNode &name, Diagnostics &diagnostics) {
  Diagnostic &diagnostic = diagnostics.report(
      Code::ConfigUnknownChoice, name.span,
      fmt::format("`preprocess` has no choice \"{}\"", name.text), "unknown choice");
  if (const std::string_view near = nearest(name.text, {"tool", "loops", "smooth", "round"});
      !near.empty())
    diagnostic.help(fmt::format("did you mean \"{}\"?", near));
  diagnostic.note("possible: \"tool\", \"loops\", \"smooth\", \"round\"");
}

/// Reads the path processors. What is wrong is reported; then there are none.
void readProcessors(const CheckedSection &section, CncSettings &settings,
                    Diagnostics &diagnostics) {
  settings.toolRadius = section.real("tool_radius", 0);
  const TomlNode *list = section.get("preprocess");
  if (list != nullptr) {
    for (const TomlNode &name : list->children) {
      const std::optional<CncProcessor> processor = cncProcessor(name.text);
      if (!processor) {
        reportProcessor(name, diagnostics);
        return;
      }
      settings.preprocess.push_back(*processor);
    }
    if (const std::optional<CncOrderFault> fault = findOrderFault(settings.preprocess)) {
      Diagnostic &diagnostic = diagnostics.report(
          Code::CncProcessors, list->children[fault->at].span, fault->message, fault->label);
      if (!fault->help.empty())
        diagnostic.help(fault->help);
      settings.preprocess.clear();
      return;
    }
  }
  const auto &used = settings.preprocess;
  if (isQueue(settings.compile) && section.get("tool_radius") != nullptr &&
      std::find(used.begin(), used.end(), CncProcessor::Tool) == used.end())
    diagnostics.report(Code::ConfigWithoutEffect, section.get("tool_radius")->span,
                       "`tool_radius` has no effect here", "only with \"tool\" in `preprocess`");
}

/// The file in the folder for files that the program becomes.
std::string fileNameOf(const CncProgram &program) {
  return fmt::format("{}/{}{}", kCncFolder, program.name,
                     program.settings.compile == CncCompile::TextFile ? kCncSuffix : kQueueSuffix);
}

/// Makes of the programs of a project what they become.
class CncMaker {
public:
  CncMaker(Program &program, const std::vector<ast::File *> &files, const LibraryIndex &index)
      : program_(program), files_(files), finder_(program, index) {}

  void add(CncProgram read, const SourceFile &file) {
    const size_t errors = program_.diagnostics.errorCount();
    checkCnc(read, program_.diagnostics);
    CncAsset asset{std::move(read), {}};
    const CncCompile compile = asset.program.settings.compile;
    if (isQueue(compile) && program_.diagnostics.errorCount() == errors)
      makeQueue(asset);
    if (compile == CncCompile::TextFile)
      addFile(asset.program, std::string(file.text()));
    if (compile == CncCompile::QueueFile) {
      addFile(asset.program, cncQueueFile(asset.program, asset.objects));
      asset.objects.clear();
    }
    assets_.push_back(std::move(asset));
  }

  CncParts finish() {
    CncParts parts{cncDeclarations(assets_, files_, types_, program_.diagnostics), {}};
    parts.files = std::move(made_);
    return parts;
  }

private:
  /// Makes the queue, and reports what hinders it.
  void makeQueue(CncAsset &asset) {
    const size_t errors = program_.diagnostics.errorCount();
    freezeCnc(asset.program, files_, types_, program_.diagnostics);
    if (program_.diagnostics.errorCount() != errors)
      return;
    std::optional<std::vector<cnc::PathObject>> objects =
        cncQueueOf(asset.program, program_.diagnostics);
    if (!objects)
      return;
    asset.objects = std::move(*objects);
    const CncSettings &settings = asset.program.settings;
    const size_t count = asset.objects.size();
    const size_t needed = std::max<size_t>(count, 2) * sizeof(cnc::PathObject);
    const bool given = settings.queueBytes != 0;
    if (given && settings.queueBytes < needed)
      program_.diagnostics
          .report(Code::CncQueue, settings.queueBytesSpan,
                  fmt::format("the path of `{}` needs {} bytes", settings.file, needed),
                  "too few bytes")
          .note(fmt::format("it has {} objects of {} bytes", count, sizeof(cnc::PathObject)));
    else if (!given && settings.compile == CncCompile::Queue && count > kMostCompiled)
      program_.diagnostics
          .report(Code::CncQueue, settings.span,
                  fmt::format("the path of `{}` has {} objects", settings.file, count),
                  fmt::format("a variable has {} at most", kMostCompiled))
          .help("`compile = \"queue-file\"` makes a file of it, which SMC_ReadNCQueue reads");
  }

  void addFile(const CncProgram &program, std::string bytes) {
    const std::string name = fileNameOf(program);
    for (const CncFile &other : made_)
      if (equalIgnoringCase(other.name, name)) {
        program_.diagnostics
            .report(Code::ConfigNameClash, program.settings.span,
                    fmt::format("two programs become the file `{}`", name), "this one, too")
            .label(other.span, "already here")
            .help("rename one of them");
        return;
      }
    made_.push_back({name, std::move(bytes), program.settings.span});
  }

  /// Objects of a queue without queue_bytes: 15 MB.
  static constexpr size_t kMostCompiled = 20'000;

  Program &program_;
  const std::vector<ast::File *> &files_;
  TypeFinder finder_;
  const CncTypes types_ = [this](std::string_view lower) { return finder_.find(lower); };
  std::vector<CncAsset> assets_;
  std::vector<CncFile> made_;
};

} // namespace

void readCncSection(const CheckedSection &section, ProjectConfig &config,
                    Diagnostics &diagnostics) {
  const TomlNode *file = section.get("file");
  if (file == nullptr)
    return;
  CncSettings settings;
  settings.file = normal(file->text);
  settings.span = file->span;
  settings.compile =
      static_cast<CncCompile>(section.choice("compile", static_cast<int64_t>(CncCompile::Program)));
  settings.angleTolerance = valueOf(section, "angle_tolerance");
  settings.queueBytes = static_cast<uint32_t>(section.integer("queue_bytes", 0));
  if (const TomlNode *bytes = section.get("queue_bytes"))
    settings.queueBytesSpan = bytes->span;
  settings.stepSuppress = section.boolean("step_suppress", false);
  readProcessors(section, settings, diagnostics);
  warnOfIdle(section, settings.compile, diagnostics);
  settings.velocity = valueOf(section, "default_velocity");
  settings.acceleration = valueOf(section, "default_acceleration");
  settings.deceleration = valueOf(section, "default_deceleration");
  for (const CheckedSection &start : section.sections("start", diagnostics))
    for (size_t axis = 0; axis < kLetters.size(); ++axis)
      if (const std::optional<double> value = valueOf(start, kLetters.substr(axis, 1))) {
        settings.start.coordinate[axis] = *value;
        settings.start.axes = static_cast<uint16_t>(settings.start.axes | 1U << axis);
      }
  for (const CncSettings &other : config.cnc)
    if (other.file == settings.file) {
      diagnostics
          .report(Code::ConfigDuplicateName, settings.span,
                  fmt::format("two sections [[cnc]] are about `{}`", settings.file), "again here")
          .label(other.span, "already here");
      return;
    }
  config.cnc.push_back(std::move(settings));
}

namespace {

/// Programs of a project are G-code without expressions: those are read at run time only.
std::optional<CncProgram> readProgram(const SourceFile &file, Diagnostics &diagnostics) {
  if (!needsNcLanguage(file.text()))
    return readCnc(file, diagnostics);
  diagnostics
      .report(Code::CncText, {file.id(), 0, 0},
              "expressions, local variables and subprograms are read at run time only",
              "a program in SoftMotion 3's language")
      .help("move the file into the folder for files, where SMC_ReadNCFile2 reads it");
  return std::nullopt;
}

} // namespace

std::filesystem::path filesFolder(const std::filesystem::path &folder,
                                  const ProjectConfig &config) {
  return folder / (config.filesRoot.empty() ? "files" : config.filesRoot);
}

CncParts declareCncPrograms(Program &program, const ProjectConfig &config,
                            const std::vector<CncFound> &cncFiles,
                            const std::vector<ast::File *> &files, const LibraryIndex &index) {
  CncMaker maker(program, files, index);
  std::vector<bool> used(config.cnc.size());
  for (const CncFound &found : cncFiles) {
    const SourceFile &file = program.sources.file(found.id);
    std::optional<CncProgram> read = readProgram(file, program.diagnostics);
    for (size_t i = 0; i < config.cnc.size(); ++i)
      if (config.cnc[i].file == normal(found.name)) {
        used[i] = true;
        if (read)
          read->settings = config.cnc[i];
      }
    if (read) {
      read->settings.softMotion3 = config.generation == 3;
      maker.add(std::move(*read), file);
    }
  }
  for (size_t i = 0; i < config.cnc.size(); ++i)
    if (!used[i])
      program.diagnostics
          .report(Code::PathNotFound, config.cnc[i].span,
                  fmt::format("there is no CNC file `{}`", config.cnc[i].file), "named here")
          .help("`file` is a *.cnc file of the project, named from its folder on");
  return maker.finish();
}

void refuseFiles(const CncParts &parts, Diagnostics &diagnostics) {
  for (const CncFile &file : parts.files)
    diagnostics
        .report(Code::LibraryContent, file.span, "a library makes no files", "belongs to a project")
        .help("a program of a library becomes a variable: `compile = \"program\"` or "
              "`compile = \"queue\"`");
}

} // namespace stc
