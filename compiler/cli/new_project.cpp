#include "compiler/cli/commands.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/syntax/st_text.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <span>

namespace stc::cli {

namespace fs = std::filesystem;

namespace {

struct TemplateFile {
  std::string_view path;
  std::string_view text; ///< {name} stands for the project's name
};

struct Template {
  std::string_view name;
  std::span<const TemplateFile> files;
  std::string_view hint; ///< a command to try in the new folder
};

constexpr std::array<TemplateFile, 2> kAxisFiles = {{
    {"stride.toml", R"toml([project]
name = "{name}"

[[task]]
name = "MotionTask"
interval = "T#2ms"
programs = ["Main"]

[[bus]]
name = "Bus"
InterfaceType = "Dummy (simulated drives)"

  [[bus.axis_group]]
  name = "AxisGroup"
  sTask = "MotionTask"

    [[bus.axis_group.drive]]
    name = "Drive"                  # the variable of type AXIS_REF
    wDriveId = 1
    iMovementType = "linear"
    dwRatioTechUnitsDenom = 10000   # 10000 increments are ...
    iRatioTechUnitsNum = 1          # ... 1 mm
)toml"},
    {"Main.st", R"st(/// Moves the drive to and fro between 0 and 100 mm.
PROGRAM Main
VAR
  Power : MC_Power;
  Move : MC_MoveAbsolute;
  /// Where the drive moves to. [mm]
  Target : LREAL := 100;
END_VAR

Power(Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE, Axis := Drive);
Move(Execute := Power.Status, Position := Target, Velocity := 80, Acceleration := 200,
     Deceleration := 200, Axis := Drive);

IF Move.Done THEN
  Move(Execute := FALSE, Axis := Drive); // the next move needs a rising edge
  Target := 100 - Target;
END_IF
END_PROGRAM
)st"},
}};

constexpr std::array<TemplateFile, 2> kPlainFiles = {{
    {"stride.toml", R"toml([project]
name = "{name}"

[[task]]
name = "Task"
interval = "T#10ms"
programs = ["Main"]
)toml"},
    {"Main.st", R"st(/// Called in every cycle.
PROGRAM Main
VAR
  Blink : TON;
  Lamp : BOOL;
END_VAR

Blink(IN := NOT Blink.Q, PT := T#500ms);
IF Blink.Q THEN
  Lamp := NOT Lamp;
END_IF
END_PROGRAM
)st"},
}};

constexpr std::array<Template, 2> kTemplates = {{
    {"axis", kAxisFiles,
     "stride sim --for T#5s --trace Drive.fSetPosition,Drive.fSetVelocity --out trace.csv"},
    {"plain", kPlainFiles, "stride sim --for T#2s --print Main"},
}};

std::string withName(std::string_view text, const std::string &name) {
  std::string result(text);
  constexpr std::string_view kPlace = "{name}";
  for (size_t at = result.find(kPlace); at != std::string::npos;
       at = result.find(kPlace, at + name.size()))
    result.replace(at, kPlace.size(), name);
  return result;
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
  for (const Template &each : kTemplates) {
    if (each.name != projectTemplate)
      continue;
    for (const TemplateFile &file : each.files)
      if (const fs::path path = folder / file.path; !writeFile(path, withName(file.text, last)))
        return showError(Code::CannotWrite,
                         fmt::format("`{}` cannot be written: {}", path.string(), lastError()));
    std::fputs(fmt::format("Created {}. Try:\n\n    cd {}\n    {}\n", folder.string(),
                           folder.string(), each.hint)
                   .c_str(),
               stdout);
    return 0;
  }
  return 1;
}

} // namespace stc::cli
