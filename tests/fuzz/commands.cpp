#include "tests/fuzz/commands.hpp"

#include "compiler/codegen/codegen.hpp"
#include "compiler/project/format_project.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"
#include "compiler/source/render.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace stride::fuzz {

namespace fs = std::filesystem;

namespace {

void demand(bool condition, const char *what) {
  if (condition)
    return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

struct InputFile {
  std::string name;
  std::string_view text;
};

/// Only names that stay in the folder and that the commands look at.
std::string fileName(std::string_view given, size_t number) {
  if (given == "stride.toml" || given.ends_with(".cam.toml") || given.ends_with(".st"))
    if (given.find('/') == std::string_view::npos && given.size() < 100 && given[0] != '.' &&
        given.find('\0') == std::string_view::npos)
      return std::string(given);
  return "file" + std::to_string(number) + ".st";
}

std::vector<InputFile> splitFiles(std::string_view text) {
  std::vector<InputFile> files{{"input.st", {}}};
  const char *begin = text.data();
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    if (line.starts_with(kFileMark) && files.size() < 8) {
      line.remove_prefix(kFileMark.size());
      files.push_back({fileName(line.substr(0, line.find_first_of("\r\n")), files.size()), {}});
      begin = text.data();
    } else {
      files.back().text = {begin, static_cast<size_t>(line.data() + line.size() - begin)};
    }
  }
  if (files.size() > 1 && files[0].text.empty())
    files.erase(files.begin());
  return files;
}

void drawAll(const std::vector<stc::Diagnostic> &diagnostics, const stc::Sources &sources) {
  for (const stc::Diagnostic &diagnostic : diagnostics) {
    for (const stc::Label &label : diagnostic.labels)
      demand(!label.span.valid() || (label.span.begin <= label.span.end &&
                                     label.span.end <= sources.file(label.span.file).text().size()),
             "a diagnostic's place lies outside of its file");
    (void)stc::renderText(diagnostic, sources);
    (void)stc::renderJson(diagnostic, sources);
  }
}

void checkAndGenerate(const fs::path &path, stc::Purpose purpose) {
  const stc::EmbeddedLibraryIndex index(stc::standardLibrary());
  const stc::Project project(path, purpose, {}, index);
  drawAll(project.diagnostics(), project.sources());
  if (project.hasErrors() || purpose == stc::Purpose::Check)
    return;
  demand(!stc::generateApplication(project.program(), project.appConfig()).empty(),
         "a program without errors gives no C++");
}

void format(const fs::path &path) {
  stc::Sources sources;
  stc::Diagnostics diagnostics;
  std::vector<stc::FormattedFile> once = stc::formatPath(path, sources, diagnostics);
  drawAll(diagnostics.all(), sources);
  if (diagnostics.hasErrors())
    return;
  std::vector<stc::FormattedFile> twice = once;
  for (stc::FormattedFile &file : twice)
    file.before = file.after;
  stc::formatFiles(twice, stc::readFormatSettings(path, sources, diagnostics), sources,
                   diagnostics);
  demand(!diagnostics.hasErrors(), "a formatted file has errors");
  for (size_t i = 0; i < once.size(); ++i)
    demand(once[i].after == twice[i].after, "formatting a formatted file changes it");
}

} // namespace

void runCommands(std::string_view text, const fs::path &folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::vector<InputFile> files = splitFiles(text);
  for (const InputFile &file : files)
    std::ofstream(folder / file.name, std::ios::binary) << file.text;
  const bool single = files.size() == 1 && files[0].name == "input.st";
  const fs::path path = single ? folder / "input.st" : folder;
  checkAndGenerate(path, stc::Purpose::Check);
  checkAndGenerate(path, stc::Purpose::Build);
  if (text.find("TEST") != std::string_view::npos || text.find("test") != std::string_view::npos)
    checkAndGenerate(path, stc::Purpose::Test);
  format(path);
}

} // namespace stride::fuzz
