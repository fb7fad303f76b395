#include "compiler/import/project_files.hpp"

#include "compiler/source/identifier.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>

#include <fmt/format.h>

namespace stc::import {

namespace {

/// Longest name of a file without its ending; file systems end at 255 bytes.
constexpr size_t kLongestName = 200;
constexpr size_t kDeepestFolder = 20;

/// The name as that of a file: letters, digits, `_`, and what is not ASCII.
std::string fileNameOf(const std::string &name) {
  size_t length = std::min(name.size(), kLongestName);
  while (length < name.size() && length > 0 &&
         (static_cast<unsigned char>(name[length]) & 0xC0U) == 0x80U)
    --length; // never in the middle of a character
  std::string result = name.substr(0, length);
  for (char &c : result)
    if (static_cast<unsigned char>(c) < 0x80 && c != '_' && (c < '0' || c > '9') &&
        (c < 'A' || c > 'Z') && (c < 'a' || c > 'z'))
      c = '_';
  return result.empty() ? "unnamed" : result;
}

/// A folder whose files belong to the project: those named `build` do not.
std::string folderNameOf(const std::string &name) {
  std::string result;
  for (const char c : name.substr(0, kLongestName))
    result += static_cast<unsigned char>(c) < ' ' || c == '/' || c == '\\' ? '_' : c;
  if (result.empty() || result.front() == '.' || equalIgnoringCase(result, "build"))
    result.insert(result.begin(), '_');
  return result;
}

/// Takes the path, or another one when it is taken.
std::string freePath(const std::string &stem, const std::string &ending,
                     std::map<std::string, size_t> &taken) {
  std::string path = stem + ending;
  // Counted for each name, so that many of one name take no longer than others.
  size_t &count = taken[stride::common::lowerCase(path)];
  if (++count == 1)
    return path;
  for (;; ++count) {
    path = fmt::format("{}_{}{}", stem, count, ending);
    if (taken.try_emplace(stride::common::lowerCase(path), 1).second)
      return path;
  }
}

std::string pathOf(const Object &object, std::map<std::string, size_t> &taken) {
  std::string stem;
  for (size_t i = 0; i < std::min(object.folder.size(), kDeepestFolder); ++i)
    stem += folderNameOf(object.folder[i]) + "/";
  return freePath(stem + fileNameOf(object.name), ".st", taken);
}

/// The kind that an event and an interval together mean.
std::string tomlOf(const Task &task) {
  std::string text = fmt::format("\n[[task]]\nname = {}\n", tomlText(task.name));
  if (!task.event.empty())
    text += fmt::format("kind = \"{}\"\nevent = {}\n", task.status ? "status" : "event",
                        tomlText(task.event));
  else if (task.interval.empty())
    text += "kind = \"freewheeling\"\n";
  if (!task.interval.empty())
    text += fmt::format("interval = {}\n", tomlText(task.interval));
  if (!task.priority.empty())
    text +=
        fmt::format("priority = {}\n", tomlNumber(task.priority).value_or(tomlText(task.priority)));
  if (!task.watchdog.empty())
    text += fmt::format("watchdog = {}\n", tomlText(task.watchdog));
  if (!task.watchdog.empty() && task.watchdogSensitivity != 1)
    text += fmt::format("watchdog_sensitivity = {}\n", task.watchdogSensitivity);
  text += "programs = [";
  for (size_t i = 0; i < task.programs.size(); ++i)
    text += (i == 0 ? "" : ", ") + tomlText(task.programs[i]);
  return text + "]\n";
}

/// Guessed values are marked, missing ones are comments to fill in.
std::string tomlOf(const std::vector<Parameter> &parameters, std::string_view indent) {
  std::string text;
  for (const Parameter &each : parameters)
    text += fmt::format("{}{}{} = {}{}\n", indent, each.certainty == Certainty::Missing ? "# " : "",
                        each.key, each.value,
                        each.certainty == Certainty::Sure      ? ""
                        : each.certainty == Certainty::Guessed ? "  # CHECK: guessed by the import"
                                                               : "  # MISSING: not in the import");
  return text;
}

std::string tomlOf(const BusSetup &bus) {
  std::string text = fmt::format(
      "\n[[bus]]\nname = {}\nInterfaceType = \"Dummy (simulated drives)\"\n", tomlText(bus.name));
  for (const DriveGroupSetup &group : bus.groups) {
    text += fmt::format("\n  [[bus.axis_group]]\n  name = {}\n", tomlText(group.name));
    text += tomlOf(group.parameters, "  ");
    for (const DriveSetup &drive : group.drives) {
      text += fmt::format("\n    [[bus.axis_group.drive]]\n    name = {}\n", tomlText(drive.name));
      text += tomlOf(drive.parameters, "    ");
    }
    for (const DriveSetup &encoder : group.encoders) {
      text +=
          fmt::format("\n    [[bus.axis_group.encoder]]\n    name = {}\n", tomlText(encoder.name));
      text += tomlOf(encoder.parameters, "    ");
    }
  }
  return text;
}

std::string tomlOf(const Model &model, const ProjectSettings &settings) {
  std::string text = fmt::format("[{}]\nname = {}\n", settings.library ? "library" : "project",
                                 tomlText(settings.name));
  if (settings.library)
    text += "version = \"1.0.0\"\n";
  const bool hasImage = std::ranges::any_of(
      model.sections, [](const ManifestSection &each) { return each.name == "image"; });
  if (!model.addressing.empty() && !hasImage)
    text += fmt::format("\n[image]\naddressing = {}\n", tomlText(model.addressing));
  for (const std::string &name : model.named)
    text += fmt::format("\n[[{}]]\nname = {}\n", settings.library ? "library.uses" : "library",
                        tomlText(name));
  if (settings.library)
    return text;
  for (const Task &task : model.tasks)
    text += tomlOf(task);
  for (const BusSetup &bus : model.buses)
    text += tomlOf(bus);
  for (const ManifestSection &section : model.sections)
    text +=
        fmt::format("\n{}\n", section.text.substr(0, section.text.find_last_not_of(" \t\r\n") + 1));
  return text;
}

/// Text in a comment of ST, on one line.
std::string commentOf(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return result;
}

std::string variablesOf(const std::vector<IoChannel> &channels) {
  std::string text = "// Inputs and outputs that the PLC configuration names.\nVAR_GLOBAL\n";
  for (const IoChannel &each : channels)
    text += fmt::format("  {} AT {} : {};{}\n", each.name, each.address, each.type,
                        each.comment.empty() ? "" : " // " + commentOf(each.comment));
  return text + "END_VAR\n";
}

/// Binds variables to the drives that they stand for.
std::string bindingsOf(const std::vector<AxisLink> &links) {
  std::string text = "// Which drive an axis of the program stands for.\nVAR_CONFIG\n";
  for (const AxisLink &each : links)
    text += fmt::format("  {}.pDrive : POINTER TO SM_DriveBasic.AXIS_REF := ADR({});\n",
                        each.variable, each.drive);
  return text + "END_VAR\n";
}

} // namespace

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

std::string tomlNumber(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos)
    text += ".0";
  return text;
}

std::optional<std::string> tomlNumber(std::string_view text) {
  const char *const end = text.data() + text.size();
  int64_t whole = 0;
  if (const auto [at, error] = std::from_chars(text.data(), end, whole);
      error == std::errc() && at == end)
    return fmt::format("{}", whole);
  double value = 0;
  const auto [at, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || at != end || !std::isfinite(value))
    return std::nullopt;
  return tomlNumber(value);
}

std::vector<ProjectFile> projectFiles(const Model &model, const ProjectSettings &settings) {
  std::vector<ProjectFile> files;
  std::map<std::string, size_t> taken;
  for (const Object &object : model.objects)
    files.push_back({pathOf(object, taken), object.text});
  if (!model.channels.empty())
    files.push_back({freePath("Inputs_Outputs", ".st", taken), variablesOf(model.channels)});
  if (!model.axisLinks.empty() && !settings.library)
    files.push_back({freePath("Axis_Links", ".st", taken), bindingsOf(model.axisLinks)});
  for (const KeptText &kept : model.kept)
    files.push_back({freePath(kKeptFolder + fileNameOf(kept.path), ".txt", taken), kept.text});
  files.push_back({"stride.toml", tomlOf(model, settings)});
  return files;
}

} // namespace stc::import
