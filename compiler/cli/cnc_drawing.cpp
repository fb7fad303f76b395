// Drawings as files.
#include "compiler/cli/cnc_drawing.hpp"

#include "compiler/project/file_system.hpp"
#include "compiler/source/sources.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace stc::cli {

namespace {

namespace fs = std::filesystem;

/// A name that a variable can have: programs of a project become variables.
std::string variableName(const std::string &text) {
  std::string name;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    if (letter || (digit && !name.empty()))
      name += c;
    else if (digit)
      name += std::string("P") + c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (name.ends_with('_'))
    name.pop_back();
  return name.empty() ? "Drawing" : name;
}

/// The names of the programs' files, without the suffix; each is there once.
std::vector<std::string> namesOf(const std::vector<DxfProgram> &programs,
                                 const CncOptions &options) {
  const std::string base = options.drawing.base.empty()
                               ? variableName(fs::path(options.files.front()).stem().string())
                               : options.drawing.base;
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (size_t i = 0; i < programs.size(); ++i) {
    std::string name = base;
    if (options.drawing.import.part == DxfPart::Layer)
      name += "_" + variableName(programs[i].layer);
    else if (options.drawing.import.part == DxfPart::Contour)
      name += fmt::format("_{}", i + 1);
    // Layers may differ in characters that no variable has.
    const auto lower = [](std::string text) {
      std::transform(text.begin(), text.end(), text.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
      });
      return text;
    };
    std::string once = name;
    for (int n = 2; !taken.insert(lower(once)).second; ++n)
      once = fmt::format("{}_{}", name, n);
    names.push_back(once);
  }
  return names;
}

std::string shownLength(double value) { return fmt::format("{:.6g}", value); }

std::string says(const std::string &file, const DxfProgram &program, DxfPart part) {
  std::string text = fmt::format("{}: {} contour{}, {} closed", file, program.contours,
                                 program.contours == 1 ? "" : "s", program.closed);
  if (part != DxfPart::Contour)
    text += fmt::format("; {} between them, {} as drawn", shownLength(program.travel),
                        shownLength(program.drawnTravel));
  return text + "\n";
}

/// Whether all programs may be written.
bool mayWrite(const std::vector<fs::path> &files, const CncOptions &options,
              Diagnostics &diagnostics) {
  std::error_code unknown;
  for (const fs::path &file : files)
    if (!options.drawing.replace && fs::exists(file, unknown)) {
      diagnostics
          .report(Code::CannotWrite, {},
                  fmt::format("`{}` is there: it is not overwritten", file.string()))
          .help("say --replace if it shall be, or give the programs another name with --base");
      return false;
    }
  return true;
}

void writePrograms(const std::vector<DxfProgram> &programs, const CncOptions &options,
                   Diagnostics &diagnostics, std::string &text) {
  const std::vector<std::string> names = namesOf(programs, options);
  const fs::path folder =
      options.out.empty() ? fs::path(options.files.front()).parent_path() : fs::path(options.out);
  std::vector<fs::path> files;
  for (const std::string &name : names)
    files.push_back(folder / (name + std::string(kCncSuffix)));
  if (!mayWrite(files, options, diagnostics))
    return;
  std::error_code unknown;
  if (!folder.empty())
    fs::create_directories(folder, unknown); // what is wrong, writing says
  for (size_t i = 0; i < files.size(); ++i) {
    if (!writeFile(files[i], programs[i].text)) {
      diagnostics.report(Code::CannotWrite, {},
                         fmt::format("`{}` cannot be written: {}", files[i].string(), lastError()));
      return;
    }
    text += says(files[i].string(), programs[i], options.drawing.import.part);
  }
}

} // namespace

int importDrawing(const CncOptions &options) {
  const std::string &path = options.files.front();
  Sources sources;
  Diagnostics diagnostics;
  std::string text;
  if (const std::optional<FileId> id = sources.load(path, path, kMaxDxfBytes); !id) {
    diagnostics.report(Code::UnreadableFile, {},
                       fmt::format("`{}` cannot be read: {}", path, readSourceError(kMaxDxfBytes)));
  } else if (const auto programs =
                 importDxf(sources.file(*id), options.drawing.import, diagnostics)) {
    writePrograms(*programs, options, diagnostics, text);
  }
  diagnostics.sort();
  const int exitCode = show(diagnostics.all(), sources, options.output);
  print(text);
  return exitCode;
}

void exportDrawing(const std::string &path, const CncProgram &program, const CncOptions &options,
                   Diagnostics &diagnostics) {
  const std::optional<std::string> text = exportDxf(program, options.drawing.out, diagnostics);
  if (!text)
    return;
  if (options.out.empty()) {
    print(*text);
    return;
  }
  if (std::error_code unknown; fs::equivalent(path, options.out, unknown)) {
    diagnostics
        .report(Code::CannotWrite, {},
                fmt::format("`{}` is the program: it is not overwritten", options.out))
        .help("name another file with -o");
    return;
  }
  if (!writeFile(options.out, *text))
    diagnostics.report(Code::CannotWrite, {},
                       fmt::format("`{}` cannot be written: {}", options.out, lastError()));
}

} // namespace stc::cli
