#include "compiler/import/project_files.hpp"

#include "runtime/common/text.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

namespace stc::import {

namespace {

/// Longest name of a file without its ending; file systems end at 255 bytes.
constexpr size_t kLongestName = 200;

/// The name as that of a file: letters, digits, `_`, and what is not ASCII.
std::string fileNameOf(const std::string &name) {
  std::string result = name.substr(0, kLongestName);
  for (char &c : result)
    if (static_cast<unsigned char>(c) < 0x80 && c != '_' && (c < '0' || c > '9') &&
        (c < 'A' || c > 'Z') && (c < 'a' || c > 'z'))
      c = '_';
  return result.empty() ? "unnamed" : result;
}

std::string pathOf(const Object &object, std::set<std::string> &taken) {
  std::string stem;
  for (const std::string &folder : object.folder)
    stem += folder + "/";
  stem += fileNameOf(object.name);
  std::string path = stem + ".st";
  for (size_t n = 2; !taken.insert(stride::common::lowerCase(path)).second; ++n)
    path = fmt::format("{}_{}.st", stem, n);
  return path;
}

std::string tomlText(std::string_view text) {
  std::string result = "\"";
  for (const char c : text)
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < ' ' || c == 0x7f)
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      result += c;
  return result + '"';
}

std::string tomlOf(const Task &task) {
  std::string text = fmt::format("\n[[task]]\nname = {}\n", tomlText(task.name));
  if (!task.event.empty())
    text += fmt::format("kind = \"event\"\nevent = {}\n", tomlText(task.event));
  else if (task.interval.empty())
    text += "kind = \"freewheeling\"\n";
  if (!task.interval.empty())
    text += fmt::format("interval = {}\n", tomlText(task.interval));
  const bool number = std::all_of(task.priority.begin(), task.priority.end(),
                                  [](char c) { return c >= '0' && c <= '9'; });
  if (!task.priority.empty())
    text += fmt::format("priority = {}\n", number ? task.priority : tomlText(task.priority));
  text += "programs = [";
  for (size_t i = 0; i < task.programs.size(); ++i)
    text += (i == 0 ? "" : ", ") + tomlText(task.programs[i]);
  return text + "]\n";
}

std::string placeOf(const Origin &origin) { return fmt::format("{}:{}", origin.file, origin.line); }

std::string section(std::string_view title, const std::vector<Remark> &remarks) {
  if (remarks.empty())
    return {};
  std::string text = fmt::format("\n## {}: {}\n\n", title, remarks.size());
  for (const Remark &each : remarks)
    text += fmt::format("- {}: {}: {}\n", placeOf(each.origin), each.object, each.text);
  return text;
}

} // namespace

std::vector<ProjectFile> projectFiles(const Model &model, const std::string &name) {
  std::vector<ProjectFile> files;
  std::set<std::string> taken;
  std::string converted;
  for (const Object &object : model.objects) {
    files.push_back({pathOf(object, taken), object.text});
    converted +=
        fmt::format("- {}: {}: {}\n", placeOf(object.origin), object.name, files.back().path);
  }
  std::string toml = fmt::format("[project]\nname = {}\n", tomlText(name));
  for (const Task &task : model.tasks) {
    toml += tomlOf(task);
    converted += fmt::format("- {}: task {}: stride.toml\n", placeOf(task.origin), task.name);
  }
  files.push_back({"stride.toml", toml});
  files.push_back(
      {"import-report.md",
       fmt::format("# Import of {}\n{}{}\n## Converted: {}\n\n{}", name,
                   section("Left out", model.leftOut), section("Changed", model.changed),
                   model.objects.size() + model.tasks.size(), converted)});
  return files;
}

} // namespace stc::import
