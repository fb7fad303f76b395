#include "compiler/cli/commands.hpp"
#include "compiler/project/file_system.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>

namespace stc::cli {

namespace fs = std::filesystem;

namespace {

/// A file of a template. In its text {name} stands for the project's name.
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

constexpr std::array<Template, 6> kTemplates = {{
    {"axis", "stride sim --for 5s --trace Drive.fSetPosition,Drive.fSetVelocity --out trace.csv"},
    {"two-axes",
     "stride sim --for 5s --trace Roller.fSetVelocity,Slide.fSetVelocity --out trace.csv"},
    {"cam", "stride sim --for 8s --trace Master.fSetPosition,Slave.fSetPosition --out trace.csv"},
    {"io", "stride sim --for 2s --set \"500ms,%IX0.0=TRUE\" --print Main.Lamp"},
    {"tests", "stride test"},
    {"plain", "stride sim --for 2s --print Main"},
}};

std::string withName(std::string_view text, const std::string &name) {
  std::string result(text);
  constexpr std::string_view kPlace = "{name}";
  for (size_t at = result.find(kPlace); at != std::string::npos;
       at = result.find(kPlace, at + name.size()))
    result.replace(at, kPlace.size(), name);
  return result;
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
  for (const Template &each : kTemplates)
    if (each.name == projectTemplate)
      std::fputs(fmt::format("Created {}. Try:\n\n    cd {}\n    {}\n", folder.string(),
                             folder.string(), each.hint)
                     .c_str(),
                 stdout);
  return 0;
}

} // namespace stc::cli
