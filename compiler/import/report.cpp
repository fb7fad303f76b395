#include "compiler/import/report.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stc::import {

namespace {

/// One line whatever the imported files hold: their texts make no headings and no links.
std::string lineOf(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += static_cast<unsigned char>(c) < ' ' || c == 0x7f ? ' ' : c;
  return result;
}

std::string placeOf(const Origin &origin) {
  return lineOf(fmt::format("{}:{}", origin.file, origin.line));
}

std::string heading(std::string_view title, size_t count) {
  return fmt::format("\n## {}: {}\n\n", title, count);
}

std::string section(std::string_view title, const std::vector<Remark> &remarks) {
  if (remarks.empty())
    return {};
  std::string text = heading(title, remarks.size());
  for (const Remark &each : remarks)
    text +=
        fmt::format("- {}: {}: {}\n", placeOf(each.origin), lineOf(each.object), lineOf(each.text));
  return text;
}

std::string checkSection(const std::vector<CheckCount> &checked) {
  size_t errors = 0;
  size_t warnings = 0;
  for (const CheckCount &each : checked) {
    errors += each.errors;
    warnings += each.warnings;
  }
  if (errors + warnings == 0)
    return "\n## Check: no errors\n";
  std::string text =
      fmt::format("\n## Check: errors {}, warnings {}\n\n`stride check` shows them all, `stride "
                  "explain CODE` says what to do.\n\n| code | errors | warnings | meaning |\n"
                  "|---|---|---|---|\n",
                  errors, warnings);
  for (const CheckCount &each : checked)
    text += fmt::format("| {} | {} | {} | {} |\n", each.code, each.errors, each.warnings,
                        lineOf(each.title));
  text += errors == 0 ? "" : "\n";
  for (const CheckCount &each : checked)
    for (const std::string &place : each.places)
      if (each.errors != 0)
        text += fmt::format("- {}: {}\n", each.code, lineOf(place));
  return text;
}

std::string addressSection(const std::vector<MovedAddress> &addresses) {
  if (addresses.empty())
    return {};
  std::string text = heading("Addresses that changed", addresses.size());
  text += "| there | here |\n|---|---|\n";
  for (const MovedAddress &each : addresses)
    text += fmt::format("| {} | {} |\n", lineOf(each.from), lineOf(each.to));
  return text;
}

std::string parametersOf(const std::string &owner, const std::vector<Parameter> &parameters) {
  std::string text;
  for (const Parameter &each : parameters)
    if (each.certainty != Certainty::Sure)
      text += fmt::format("- {}: {} = {}: {}{}\n", lineOf(owner), each.key, lineOf(each.value),
                          each.certainty == Certainty::Guessed ? "guessed, check it"
                                                               : "not imported, fill it in",
                          each.source.empty() ? "" : " (" + lineOf(each.source) + ")");
  return text;
}

/// Values that the import is not sure of.
std::string driveSection(const std::vector<BusSetup> &buses) {
  std::string text;
  for (const BusSetup &bus : buses)
    for (const DriveGroupSetup &group : bus.groups) {
      text += parametersOf(group.name, group.parameters);
      for (const DriveSetup &drive : group.drives)
        text += parametersOf(drive.name, drive.parameters);
      for (const DriveSetup &encoder : group.encoders)
        text += parametersOf(encoder.name, encoder.parameters);
    }
  const auto count = static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
  return text.empty() ? text : heading("Parameters of drives to look at", count) + text;
}

std::vector<std::string> notesOf(const Model &model) {
  std::vector<std::string> notes = model.notes;
  if (!model.assumedEncoding.empty())
    notes.push_back(fmt::format(
        "{} of {} files do not say their encoding and were read as Windows-1252; the first is {}. "
        "If letters in comments and texts are wrong, import again with --encoding (cp1251, cp850, "
        "latin1, …).",
        model.assumedEncoding.size(), model.files, model.assumedEncoding.front()));
  return notes;
}

std::string notesSection(const Model &model) {
  const std::vector<std::string> notes = notesOf(model);
  if (notes.empty())
    return {};
  std::string text = heading("To look at", notes.size());
  for (const std::string &each : notes)
    text += fmt::format("- {}\n", lineOf(each));
  return text;
}

std::string convertedSection(const Model &model, const ProjectSettings &settings,
                             const std::vector<ProjectFile> &files) {
  std::string text;
  size_t count = model.objects.size();
  for (size_t i = 0; i < model.objects.size(); ++i)
    text += fmt::format("- {}: {}: {}\n", placeOf(model.objects[i].origin),
                        lineOf(model.objects[i].name), files[i].path);
  const auto add = [&](const Origin &origin, std::string_view what, const std::string &name) {
    text += fmt::format("- {}: {} {}: stride.toml\n", placeOf(origin), what, lineOf(name));
    ++count;
  };
  if (!settings.library) {
    for (const Task &task : model.tasks)
      add(task.origin, "task", task.name);
    for (const BusSetup &bus : model.buses)
      for (const DriveGroupSetup &group : bus.groups)
        for (const DriveSetup &drive : group.drives)
          add(drive.origin, "drive", drive.name);
    for (const ManifestSection &section : model.sections)
      add(section.origin, "section", section.name);
  }
  for (const IoChannel &each : model.channels) {
    text += fmt::format("- {}: channel {} at {}\n", placeOf(each.origin), lineOf(each.name),
                        each.address);
    ++count;
  }
  return heading("Converted", count) + text;
}

std::string keptSection(const std::vector<ProjectFile> &files) {
  std::string text;
  size_t count = 0;
  for (const ProjectFile &each : files)
    if (each.path.starts_with(kKeptFolder)) {
      text += fmt::format("- {}\n", each.path);
      ++count;
    }
  return text.empty() ? text : heading("Kept as text", count) + text;
}

} // namespace

size_t toLookAt(const Model &model) {
  const std::string drives = driveSection(model.buses);
  return notesOf(model).size() +
         static_cast<size_t>(std::count(drives.begin(), drives.end(), '\n')) -
         (drives.empty() ? 0 : 3); // the heading
}

std::string reportOf(const Model &model, const ProjectSettings &settings,
                     const std::vector<ProjectFile> &files,
                     const std::vector<CheckCount> &checked) {
  return fmt::format("# Import of {}\n", lineOf(settings.name)) +
         section("Files that could not be read", model.unreadable) +
         section("Left out", model.leftOut) + checkSection(checked) + notesSection(model) +
         driveSection(model.buses) + section("Changed", model.changed) +
         addressSection(model.addresses) + convertedSection(model, settings, files) +
         keptSection(files);
}

} // namespace stc::import
