// stride cnc

#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/assets/cnc/nc_source.hpp"
#include "compiler/cli/cnc_drawing.hpp"
#include "compiler/cli/cnc_edit.hpp"
#include "compiler/cli/cnc_project.hpp"
#include "compiler/cli/cnc_run.hpp"
#include "compiler/cli/commands.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/source/sources.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>

namespace stc::cli {

namespace {

constexpr std::string_view kLetters = "XYZABCPQUVW";

/// A program that a command was given.
struct LoadedCnc {
  Sources sources;
  Diagnostics diagnostics;
  std::optional<CncProgram> program;
  std::optional<FileId> file;
  std::map<std::string, const SourceFile *> subprograms;
  bool expanded = false; ///< It is in SoftMotion 3's language: the program is what it amounts to.

  LoadedCnc(const std::string &path, const CncOptions &options, CncValues &values) {
    file = sources.load(path, path, kMaxCncBytes);
    if (!file) {
      diagnostics.report(
          Code::UnreadableFile, {},
          fmt::format("`{}` cannot be read: {}", path, readSourceError(kMaxCncBytes)));
      return;
    }
    const SourceFile &source = sources.file(*file);
    expanded = needsNcLanguage(source.text());
    program = expanded
                  ? expandNc(
                        source, [&](const std::string &name) { return subprogram(path, name); },
                        values, diagnostics)
                  : readCnc(source, diagnostics);
    if (!program || expanded)
      return;
    program->settings = projectSettings(path, options.softMotion);
    setVariables(*program, values, diagnostics);
  }

  /// The file of a subprogram, beside that of the program.
  const SourceFile *subprogram(const std::string &path, const std::string &name) {
    const auto known = subprograms.find(name);
    if (known != subprograms.end())
      return known->second;
    const std::filesystem::path beside =
        std::filesystem::path(path).parent_path() / (name + std::string(kCncSuffix));
    const std::optional<FileId> id = sources.load(beside, beside.string(), kMaxCncBytes);
    return subprograms[name] = id ? &sources.file(*id) : nullptr;
  }

  /// A subprogram alone amounts to nothing, which is no fault.
  void check() {
    if (!expanded || !program->words.empty())
      checkCnc(*program, diagnostics);
  }

  int finish(const Output &output) {
    Diagnostics sorted = diagnostics;
    sorted.sort();
    return show(sorted.all(), sources, output);
  }
};

CncValues valuesOf(const CncOptions &options) {
  CncValues values;
  for (const std::string &text : options.sets)
    (void)values.add(text); // the command line has been checked
  return values;
}

/// Reports values for variables that no program has, when the last one is there.
void checkValues(const CncValues &values, LoadedCnc &loaded) {
  const std::string unknown = values.unknown();
  if (!unknown.empty() && !loaded.diagnostics.hasErrors())
    loaded.diagnostics.report(Code::CncVariable, {}, unknown);
}

/// Rounded to what can be read; no `-0`.
std::string shownNumber(double value) {
  const std::string text = fmt::format("{:.6g}", value);
  return text == "-0" ? "0" : text;
}

int cncCheck(const CncOptions &options) {
  int exitCode = 0;
  CncValues values = valuesOf(options);
  for (const std::string &path : options.files) {
    LoadedCnc loaded(path, options, values);
    if (&path == &options.files.back())
      checkValues(values, loaded);
    if (loaded.program)
      loaded.check();
    exitCode = std::max(exitCode, loaded.finish(options.output));
  }
  return exitCode;
}

/// Writes the queue of the program in `file`. What there is to say of it.
std::string writeQueue(const std::string &file, const std::string &out, const CncProgram &program,
                       Diagnostics &diagnostics) {
  if (std::error_code unknown; std::filesystem::equivalent(file, out, unknown)) {
    diagnostics
        .report(Code::CannotWrite, {},
                fmt::format("`{}` is the program: it is not overwritten", out))
        .help("name another file with -o");
    return {};
  }
  const auto objects = cncQueueOf(program, diagnostics);
  if (!objects)
    return {};
  if (!writeFile(out, cncQueueFile(program, *objects))) {
    diagnostics.report(Code::CannotWrite, {},
                       fmt::format("`{}` cannot be written: {}", out, lastError()));
    return {};
  }
  return fmt::format("{}: {} objects, {} bytes of memory for SMC_ReadNCQueue\n", out,
                     objects->size(),
                     std::max<size_t>(objects->size(), 2) * sizeof(stride::cnc::PathObject));
}

/// What the options say of path processors and corners counts more than what the project says.
void setProcessors(const CncOptions &options, CncSettings &settings) {
  constexpr double kAngleTolerance = 0.001; // [degrees]
  if (options.preprocess.processors)
    settings.preprocess = *options.preprocess.processors;
  settings.toolRadius = options.preprocess.toolRadius.value_or(settings.toolRadius);
  settings.angleTolerance =
      options.motion.angleTolerance.value_or(settings.angleTolerance.value_or(kAngleTolerance));
}

std::string infoText(const std::string &path, const CncProgram &program, Diagnostics &diagnostics) {
  const CncInfo info = infoOf(program, diagnostics);
  std::string text = fmt::format("{}{}\n", path, program.title.empty() ? "" : ": " + program.title);
  text += fmt::format("  lines       {}\n  sentences   {}\n", program.lines, info.sentences);
  text +=
      fmt::format("  objects     {}{}\n", info.objects,
                  info.functions == 0 ? "" : fmt::format(", {} of them functions", info.functions));
  text += fmt::format("  length      {}\n", shownNumber(info.length));
  if (info.rapidLength != 0)
    text += fmt::format("  positioning {}\n", shownNumber(info.rapidLength));
  for (size_t axis = 0; axis < kLetters.size(); ++axis)
    if ((info.axes >> axis & 1) != 0)
      text += fmt::format("  {}           {} … {}\n", kLetters[axis], shownNumber(info.least[axis]),
                          shownNumber(info.most[axis]));
  text += info.leastVelocity == info.mostVelocity
              ? fmt::format("  velocity    {}\n", shownNumber(info.mostVelocity))
              : fmt::format("  velocity    {} … {}\n", shownNumber(info.leastVelocity),
                            shownNumber(info.mostVelocity));
  if (info.endless)
    text += "  its jumps do not end: this is the first part\n";
  else if (!info.complete)
    text += "  an error ends it: this is the part before it\n";
  return text;
}

int cncInfo(const CncOptions &options) {
  int exitCode = 0;
  CncValues values = valuesOf(options);
  for (const std::string &path : options.files) {
    LoadedCnc loaded(path, options, values);
    if (&path == &options.files.back())
      checkValues(values, loaded);
    if (loaded.program) {
      setProcessors(options, loaded.program->settings);
      const std::string text = infoText(path, *loaded.program, loaded.diagnostics);
      if (!loaded.diagnostics.hasErrors())
        print(text);
    }
    exitCode = std::max(exitCode, loaded.finish(options.output));
  }
  return exitCode;
}

int cncFormat(const CncOptions &options) {
  int exitCode = 0;
  CncValues none;
  for (const std::string &path : options.files) {
    LoadedCnc loaded(path, options, none);
    if (loaded.expanded) {
      loaded.diagnostics.report(Code::CncText, {loaded.file.value_or(0), 0, 0},
                                "programs with expressions and subprograms cannot be formatted yet",
                                "left as it is");
    } else if (loaded.program) {
      const std::string_view before = loaded.sources.file(*loaded.file).text();
      const std::string after = formatCnc(before);
      if (options.check && after != before) {
        print(fmt::format("{} is not formatted\n", path));
        exitCode = 1;
      } else if (after != before && !writeFile(path, after)) {
        loaded.diagnostics.report(Code::CannotWrite, {},
                                  fmt::format("`{}` cannot be written: {}", path, lastError()));
      }
    }
    exitCode = std::max(exitCode, loaded.finish(options.output));
  }
  return exitCode;
}

/// Drives a program, for a table or a picture.
int cncMotion(const CncOptions &options) {
  const std::string &path = options.files.front();
  if (options.motion.velocityMode == "quadratic" && !(options.motion.jerk > 0))
    return showError(Code::CncSentence, "--velocity-mode quadratic needs a --jerk", options.output);
  CncValues values = valuesOf(options);
  LoadedCnc loaded(path, options, values);
  std::string says;
  if (loaded.program) {
    CncProgram &program = *loaded.program;
    checkValues(values, loaded);
    setProcessors(options, program.settings);
    if (options.motion.velocity > 0)
      program.settings.velocity = options.motion.velocity;
    if (options.motion.acceleration > 0)
      program.settings.acceleration = program.settings.deceleration = options.motion.acceleration;
    CncOptions driven = options;
    driven.motion.angleTolerance = program.settings.angleTolerance;
    loaded.check();
    if (!loaded.diagnostics.hasErrors())
      (options.action == CncAction::Run ? runCnc : plotCnc)(path, program, driven,
                                                            loaded.diagnostics, says);
  }
  const int exitCode = loaded.finish(options.output);
  print(says);
  return exitCode;
}

/// Writes a queue file.
int cncQueue(const CncOptions &options) {
  const std::string &path = options.files.front();
  CncValues values = valuesOf(options);
  LoadedCnc loaded(path, options, values);
  std::string says;
  if (loaded.program) {
    CncProgram &program = *loaded.program;
    checkValues(values, loaded);
    CncSettings &settings = program.settings;
    settings.compile = CncCompile::QueueFile;
    setProcessors(options, settings);
    settings.stepSuppress = settings.stepSuppress || options.queue.stepSuppress;
    const auto take = [](double given, std::optional<double> &value) {
      if (given > 0)
        value = given;
    };
    take(options.motion.velocity, settings.velocity);
    take(options.motion.acceleration, settings.acceleration);
    take(options.queue.deceleration, settings.deceleration);
    if (options.queue.axes != 0) {
      std::copy(std::begin(options.queue.start), std::end(options.queue.start),
                std::begin(settings.start.coordinate));
      settings.start.axes = options.queue.axes;
    }
    loaded.check();
    if (!loaded.diagnostics.hasErrors())
      says = writeQueue(path, options.out, program, loaded.diagnostics);
  }
  const int exitCode = loaded.finish(options.output);
  print(says);
  return exitCode;
}

/// Draws the path of a program.
int cncDrawing(const CncOptions &options) {
  const std::string &path = options.files.front();
  CncValues values = valuesOf(options);
  LoadedCnc loaded(path, options, values);
  if (loaded.program) {
    checkValues(values, loaded);
    loaded.check();
    if (!loaded.diagnostics.hasErrors())
      exportDrawing(path, *loaded.program, options, loaded.diagnostics);
  }
  return loaded.finish(options.output);
}

} // namespace

int cncCommand(const CncOptions &options) {
  switch (options.action) {
  case CncAction::Run:
  case CncAction::Plot:
    return cncMotion(options);
  case CncAction::Queue:
    return cncQueue(options);
  case CncAction::ImportDxf:
    return importDrawing(options);
  case CncAction::ExportDxf:
    return cncDrawing(options);
  case CncAction::Number:
  case CncAction::Rotate:
  case CncAction::Shift:
  case CncAction::Scale:
  case CncAction::Mirror:
  case CncAction::Reverse:
  case CncAction::Split:
  case CncAction::Expand:
    return editCnc(options);
  case CncAction::Check:
    return cncCheck(options);
  case CncAction::Info:
    return cncInfo(options);
  case CncAction::Format:
    break;
  }
  return cncFormat(options);
}

} // namespace stc::cli
