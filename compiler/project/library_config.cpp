#include "compiler/project/library_config.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace stc {

namespace {

/// A parameter with its place; of one that is absent or wrong both are empty.
ConfigName valueOf(const CheckedSection &section, std::string_view name) {
  const TomlNode *value = section.get(name);
  return value != nullptr ? ConfigName{value->text, value->span} : ConfigName{};
}

/// The version without the sign before it.
std::string_view numbersOf(std::string_view request) {
  return request.substr(request.starts_with('=') ? 1 : 0);
}

/// A value as ST writes it; nothing for tables, lists and what TOML has beyond ST.
std::optional<std::string> asSt(const TomlNode &value) {
  switch (value.kind) {
  case TomlKind::String:
    return value.text;
  case TomlKind::Integer:
    return fmt::format("{}", value.integer);
  case TomlKind::Floating: {
    std::string text = fmt::format("{}", value.floating);
    if (text.find_first_of(".en") == std::string::npos)
      text += ".0";
    return text;
  }
  case TomlKind::Boolean:
    return std::string(value.boolean ? "TRUE" : "FALSE");
  default:
    return std::nullopt;
  }
}

void readValue(const TomlNode &value, const std::string &list, LibraryUse &use,
               Diagnostics &diagnostics) {
  if (value.kind == TomlKind::Table && list.empty()) {
    for (const TomlNode &member : value.children)
      readValue(member, value.key, use, diagnostics);
    return;
  }
  if (std::optional<std::string> text = asSt(value))
    use.parameters.push_back({list,
                              {value.key, value.keySpan},
                              std::move(*text),
                              value.span,
                              value.kind == TomlKind::String});
  else
    diagnostics
        .report(Code::LibraryParameter, value.span,
                fmt::format("`{}` cannot have this value", value.key),
                fmt::format("this is {}", describe(value)))
        .help("a parameter is a number, `true` or `false`, or a text");
}

} // namespace

std::optional<Version> parseVersion(std::string_view text) {
  Version version{};
  const char *at = text.data();
  const char *end = at + text.size();
  for (uint32_t &part : version) {
    const auto [rest, error] = std::from_chars(at, end, part);
    if (error != std::errc() || rest == at)
      return std::nullopt;
    if (rest == end)
      return version;
    if (*rest != '.')
      return std::nullopt;
    at = rest + 1;
  }
  return std::nullopt;
}

bool fits(const Version &version, std::string_view request) {
  if (request.empty() || request == "*")
    return true;
  const std::optional<Version> wanted = parseVersion(numbersOf(request));
  if (!wanted || version < *wanted)
    return false;
  if (request.starts_with('='))
    return version == *wanted;
  const auto leading =
      std::find_if(wanted->begin(), wanted->end(), [](uint32_t part) { return part != 0; });
  if (leading == wanted->end())
    return true;
  return std::equal(wanted->begin(), leading + 1, version.begin());
}

std::string about(const LibraryInfo &info) {
  std::string text =
      fmt::format("{} {}", info.title.empty() ? info.name.text : info.title, info.version.text);
  if (!info.company.empty())
    text += ", " + info.company;
  if (!info.license.empty())
    text += ", licence " + info.license;
  text += ".";
  if (!info.description.empty())
    text += "\n\n" + info.description;
  return text;
}

LibraryInfo readLibraryInfo(const CheckedSection &section, Diagnostics &diagnostics) {
  LibraryInfo info;
  info.name = nameOf(section);
  info.version = valueOf(section, "version");
  if (const std::optional<Version> number = parseVersion(info.version.text))
    info.number = *number;
  else if (!info.version.text.empty())
    diagnostics
        .report(Code::LibraryVersion, info.version.span,
                fmt::format("`{}` is not a version", info.version.text), "cannot be read")
        .help("a version is one to four numbers: \"1.2.0\"");
  info.nameSpace = valueOf(section, "namespace");
  if (info.nameSpace.text.empty())
    info.nameSpace = info.name;
  info.title = section.text("title");
  info.description = section.text("description");
  info.company = section.text("company");
  info.license = section.text("license");
  info.qualifiedOnly = section.boolean("qualified_only", false);
  return info;
}

LibraryUse readLibraryUse(const CheckedSection &section, Diagnostics &diagnostics) {
  LibraryUse use;
  use.name = nameOf(section);
  use.path = valueOf(section, "path");
  use.version = valueOf(section, "version");
  use.nameSpace = valueOf(section, "namespace");
  use.section = section.table().span;
  if (const std::string &wanted = use.version.text;
      !wanted.empty() && wanted != "*" && !parseVersion(numbersOf(wanted))) {
    diagnostics
        .report(Code::LibraryVersion, use.version.span,
                fmt::format("`{}` is not a version", wanted), "cannot be read")
        .help("write \"1.2\" for version 1.2 or a later one that fits, \"=1.2.3\" for that one, "
              "\"*\" for any");
    use.version = {};
  }
  for (const CheckedSection &values : section.sections("parameters", diagnostics))
    for (const TomlNode &value : values.table().children)
      readValue(value, {}, use, diagnostics);
  return use;
}

} // namespace stc
