#include "compiler/cli/commands.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/job_pool.hpp"
#include "compiler/syntax/st_text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>

namespace stc::cli {

namespace fs = std::filesystem;

namespace {

/// A file of a template. In its text {name} stands for the project's name, {library} for what ST
/// can call it.
struct TemplateFile {
  std::string_view of; ///< the template's name
  std::string_view path;
  std::string_view text;
};

// compiler/cli/templates; those of no template belong to all.
constexpr TemplateFile kFiles[] = {
#include "compiler/cli/templates.inc"
};

struct Template {
  std::string_view name;
  std::string_view hint; ///< a command to try in the new folder
};

constexpr std::array<Template, 7> kTemplates = {{
    {"axis", "stride sim --for 5s --trace Drive.fSetPosition,Drive.fSetVelocity --out trace.csv"},
    {"two-axes",
     "stride sim --for 5s --trace Roller.fSetVelocity,Slide.fSetVelocity --out trace.csv"},
    {"cam", "stride sim --for 8s --trace Master.fSetPosition,Slave.fSetPosition --out trace.csv"},
    {"io", "stride sim --for 2s --set \"500ms,%IX0.0=TRUE\" --print Main.Lamp"},
    {"tests", "stride test"},
    {"library", "stride test"},
    {"plain", "stride sim --for 2s --print Main"},
}};

std::string replaceAll(std::string text, std::string_view place, const std::string &by) {
  for (size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + by.size()))
    text.replace(at, place.size(), by);
  return text;
}

/// The name as an identifier: `pump-parts` becomes pump_parts, `2d` Lib_2d, `type` Lib_type.
std::string identifierOf(std::string_view name) {
  std::string result;
  for (const char c : name)
    if (c != '_' && isIdentifier(fmt::format("x{}", c)))
      result += c;
    else if (!result.empty() && !result.ends_with('_'))
      result += '_';
  if (result.empty())
    return "Lib";
  return isIdentifier(result) ? result : "Lib_" + result;
}

std::string withName(std::string_view text, const std::string &name) {
  return replaceAll(replaceAll(std::string(text), "{library}", identifierOf(name)), "{name}", name);
}

/// Where a file of a template goes; a `.gitignore` among the templates would hide them from git.
std::string_view placeOf(const TemplateFile &file) {
  return file.of.empty() && file.path == "gitignore" ? ".gitignore" : file.path;
}

} // namespace

std::vector<std::string> templateNames() {
  std::vector<std::string> names;
  for (const Template &each : kTemplates)
    names.emplace_back(each.name);
  return names;
}

int newCommand(const std::string &name, const std::string &projectTemplate) {
  const fs::path folder = fs::path(name).lexically_normal();
  const std::string last =
      (folder.has_filename() ? folder : folder.parent_path()).filename().string();
  for (const char c : last)
    if (static_cast<unsigned char>(c) < ' ' || c == '"' || c == '\\' || c == '\'')
      return showError(Code::ConfigBadName,
                       fmt::format("`{}` cannot be the name of a project", last));
  if (last.empty() || last == "." || last == "..")
    return showError(Code::ConfigBadName,
                     fmt::format("`{}` cannot be the name of a project", name));
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error)))
    return showError(Code::TargetExists, fmt::format("`{}` already exists", name));
  for (const TemplateFile &file : kFiles)
    if (const fs::path path = folder / placeOf(file);
        (file.of.empty() || file.of == projectTemplate) &&
        !writeFile(path, withName(file.text, last)))
      return showError(Code::CannotWrite,
                       fmt::format("`{}` cannot be written: {}", path.string(), lastError()));
  const std::string typed = (folder.native().starts_with('-') ? "./" : "") + folder.string();
  for (const Template &each : kTemplates)
    if (each.name == projectTemplate)
      std::fputs(fmt::format("Created {}. Try:\n\n    cd {}\n    {}\n", folder.string(),
                             shellQuoted({typed}), each.hint)
                     .c_str(),
                 stdout);
  return 0;
}

} // namespace stc::cli
