#include "compiler/project/cnc_config.hpp"
#include "compiler/assets/cnc/nc_source.hpp"

#include <array>
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

} // namespace

void readCncSection(const CheckedSection &section, ProjectConfig &config,
                    Diagnostics &diagnostics) {
  const TomlNode *file = section.get("file");
  if (file == nullptr)
    return;
  CncSettings settings;
  settings.file = normal(file->text);
  settings.span = file->span;
  settings.compile = section.choice("compile", 1) != 0;
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

SyntheticSource declareCncPrograms(Program &program, const ProjectConfig &config,
                                   const std::vector<FileId> &cncFiles,
                                   const std::vector<ast::File *> &files) {
  std::vector<CncProgram> programs;
  std::vector<bool> used(config.cnc.size());
  for (const FileId id : cncFiles) {
    const SourceFile &file = program.sources.file(id);
    std::optional<CncProgram> read = readProgram(file, program.diagnostics);
    for (size_t i = 0; i < config.cnc.size(); ++i)
      if (config.cnc[i].file == normal(file.name())) {
        used[i] = true;
        if (read)
          read->settings = config.cnc[i];
      }
    if (!read)
      continue;
    checkCnc(*read, program.diagnostics);
    programs.push_back(std::move(*read));
  }
  for (size_t i = 0; i < config.cnc.size(); ++i)
    if (!used[i])
      program.diagnostics
          .report(Code::PathNotFound, config.cnc[i].span,
                  fmt::format("there is no CNC file `{}`", config.cnc[i].file), "named here")
          .help("`file` is a *.cnc file of the project, named from its folder on");
  return cncDeclarations(programs, files, program.diagnostics);
}

} // namespace stc
