#include "compiler/toml/schema.hpp"

#include "compiler/source/suggest.hpp"
#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/st_text.hpp"
#include "compiler/toml/interval.hpp"

#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace stc {

namespace {

// "POS, VEL -> POS, VEL" and "pos,vel->pos,vel" are the same choice.
std::string canonical(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\t')
      result += lowerCase(c);
  return result;
}

std::string formatNumber(double value) {
  return std::floor(value) == value && std::fabs(value) < 1e15 ? fmt::format("{:.0f}", value)
                                                               : fmt::format("{}", value);
}

std::string listChoices(const Parameter &parameter) {
  std::string result;
  for (const Choice &choice : parameter.choices)
    result += fmt::format("{}\"{}\"", result.empty() ? "" : ", ", choice.name);
  return result;
}

std::string_view expectation(ParameterType type) {
  switch (type) {
  case ParameterType::Text:
  case ParameterType::Identifier:
  case ParameterType::DriveName:
  case ParameterType::Choice:
    return "text in quotes";
  case ParameterType::Boolean:
    return "`true` or `false`";
  case ParameterType::Integer:
    return "an integer";
  case ParameterType::Real:
    return "a number";
  case ParameterType::Interval:
    return "a duration in quotes, such as \"3ms\" or \"T#3ms\"";
  case ParameterType::NameList:
    return "a list of names, such as [\"PLC_PRG\"]";
  }
  return "";
}

bool hasType(ParameterType type, const TomlNode &value) {
  switch (type) {
  case ParameterType::Text:
  case ParameterType::Identifier:
  case ParameterType::DriveName:
  case ParameterType::Interval:
    return value.kind == TomlKind::String;
  case ParameterType::Choice:
    return value.kind == TomlKind::String || value.kind == TomlKind::Integer;
  case ParameterType::Boolean:
    return value.kind == TomlKind::Boolean;
  case ParameterType::Integer:
    return value.kind == TomlKind::Integer;
  case ParameterType::Real:
    return value.kind == TomlKind::Integer || value.kind == TomlKind::Floating;
  case ParameterType::NameList:
    if (value.kind != TomlKind::Array)
      return false;
    for (const TomlNode &element : value.children)
      if (element.kind != TomlKind::String)
        return false;
    return true;
  }
  return false;
}

// Checks one value against its parameter; the first thing wrong is reported.
class ValueChecker {
public:
  ValueChecker(const Parameter &parameter, const TomlNode &value, Diagnostics &diagnostics)
      : parameter_(parameter), value_(value), diagnostics_(diagnostics) {}

  bool check() {
    if (!hasType(parameter_.type, value_))
      return reportType();
    switch (parameter_.type) {
    case ParameterType::Text:
      return !value_.text.empty() || parameter_.name == "sTask" || reportEmpty();
    case ParameterType::Identifier:
    case ParameterType::DriveName:
      return (isIdentifier(value_.text) && value_.text.size() <= kMaxName) || reportIdentifier();
    case ParameterType::Integer:
    case ParameterType::Real:
      return checkRange(value_.floating);
    case ParameterType::Choice:
      return findChoice(parameter_, value_) || reportChoice();
    case ParameterType::Interval:
      return checkInterval();
    case ParameterType::NameList:
      return !value_.children.empty() || reportEmpty();
    case ParameterType::Boolean:
      break;
    }
    return true;
  }

private:
  bool reportType() {
    Diagnostic &d = diagnostics_.report(
        Code::ConfigWrongType, value_.span,
        fmt::format("`{}` must be {}", parameter_.name, expectation(parameter_.type)),
        fmt::format("this is {}", describe(value_)));
    if (parameter_.type == ParameterType::Boolean && value_.kind == TomlKind::String)
      d.help("write it without quotes");
    else if (parameter_.type == ParameterType::Boolean && value_.kind == TomlKind::Integer)
      d.help(value_.integer != 0 ? "write `true`" : "write `false`");
    else if (value_.kind == TomlKind::String &&
             (parameter_.type == ParameterType::Integer || parameter_.type == ParameterType::Real))
      d.help("numbers stand without quotes");
    else if (parameter_.type == ParameterType::NameList && value_.kind == TomlKind::String)
      d.help(fmt::format("write [\"{}\"]", value_.text));
    return false;
  }

  bool reportEmpty() {
    diagnostics_.report(Code::ConfigOutOfRange, value_.span,
                        fmt::format("`{}` must not be empty", parameter_.name), "nothing in it");
    return false;
  }

  bool reportIdentifier() {
    if (value_.text.size() > kMaxName) {
      diagnostics_
          .report(Code::NameTooLong, value_.span,
                  fmt::format("this name has {} characters", value_.text.size()))
          .note(fmt::format("a name has at most {} characters", kMaxName));
      return false;
    }
    diagnostics_
        .report(Code::ConfigBadName, value_.span,
                fmt::format("`{}` cannot be a name in Structured Text", value_.text),
                isReservedWord(value_.text) ? "a word of the language" : "not an identifier")
        .help(
            "a name begins with a letter or `_` and continues with letters, digits and single `_`");
    return false;
  }

  bool checkRange(double value) {
    if (value >= parameter_.low && value <= parameter_.high)
      return true;
    const std::string unit = parameter_.unit.empty() ? "" : fmt::format(" {}", parameter_.unit);
    std::string message;
    std::string label;
    if (parameter_.type == ParameterType::Real && !std::isfinite(value)) {
      message = fmt::format("`{}` must be a finite number", parameter_.name);
      label = "not finite";
    } else if (parameter_.type == ParameterType::Real && parameter_.low == 0 &&
               parameter_.high > 1e300) {
      message = fmt::format("`{}` must not be negative", parameter_.name);
      label = "negative";
    } else if (parameter_.type == ParameterType::Real && parameter_.high > 1e300) {
      message = fmt::format("`{}` must be greater than 0{}", parameter_.name, unit);
      label = "not positive";
    } else {
      message = fmt::format("`{}` must be in {} … {}{}", parameter_.name,
                            formatNumber(parameter_.low), formatNumber(parameter_.high), unit);
      label = value < parameter_.low ? "too small" : "too large";
    }
    diagnostics_.report(Code::ConfigOutOfRange, value_.span, std::move(message), std::move(label));
    return false;
  }

  bool reportChoice() {
    if (value_.kind == TomlKind::Integer) {
      std::string values;
      for (const Choice &choice : parameter_.choices)
        values +=
            fmt::format("{}{} = \"{}\"", values.empty() ? "" : ", ", choice.value, choice.name);
      diagnostics_
          .report(Code::ConfigUnknownChoice, value_.span,
                  fmt::format("`{}` has no choice {}", parameter_.name, value_.integer),
                  "unknown value")
          .note("possible: " + values);
      return false;
    }
    Diagnostic &d = diagnostics_.report(
        Code::ConfigUnknownChoice, value_.span,
        fmt::format("`{}` has no choice \"{}\"", parameter_.name, value_.text), "unknown choice");
    if (parameter_.choices.size() == 1 && parameter_.choices[0].name == "error")
      d.help(fmt::format("`{}` is an error, and errors cannot be lowered", parameter_.name));
    std::vector<std::string_view> names;
    for (const Choice &choice : parameter_.choices)
      names.push_back(choice.name);
    if (const std::string_view near = nearest(value_.text, names); !near.empty())
      d.help(fmt::format("did you mean \"{}\"?", near));
    d.note("possible: " + listChoices(parameter_));
    return false;
  }

  bool checkInterval() {
    const std::optional<int64_t> interval = parseInterval(value_.text);
    if (!interval) {
      diagnostics_
          .report(Code::ConfigBadInterval, value_.span,
                  fmt::format("\"{}\" is not a duration", value_.text), "cannot be read")
          .help("write it as \"3ms\", \"1s500ms\", \"250us\", or as a TIME literal: \"T#3ms\"");
      return false;
    }
    if (const auto value = static_cast<double>(*interval);
        value < parameter_.low || value > parameter_.high) {
      diagnostics_.report(Code::ConfigOutOfRange, value_.span,
                          fmt::format("`{}` must be in {} … {}", parameter_.name,
                                      formatInterval(static_cast<int64_t>(parameter_.low)),
                                      formatInterval(static_cast<int64_t>(parameter_.high))),
                          value < parameter_.low ? "too short" : "too long");
      return false;
    }
    return true;
  }

  const Parameter &parameter_;
  const TomlNode &value_;
  Diagnostics &diagnostics_;
};

const SectionSchema *findSection(const SectionSchema &schema, std::string_view name) {
  for (const SectionSchema *section : schema.sections)
    if (section->name == name)
      return section;
  return nullptr;
}

std::string header(const SectionSchema &section) {
  return section.list ? fmt::format("[[{}]]", section.path) : fmt::format("[{}]", section.path);
}

// The section anywhere below `schema` that knows the parameter, to say where a misplaced one
// belongs.
const SectionSchema *ownerOf(const SectionSchema &schema, std::string_view name) {
  if (findParameter(schema, name) != nullptr)
    return &schema;
  for (const SectionSchema *section : schema.sections)
    if (const SectionSchema *owner = ownerOf(*section, name))
      return owner;
  return nullptr;
}

void reportUnknown(const TomlNode &member, const SectionSchema &schema, const SectionSchema &file,
                   Diagnostics &diagnostics) {
  std::vector<std::string_view> names;
  for (const Parameter &parameter : schema.parameters)
    names.push_back(parameter.name);
  for (const SectionSchema *section : schema.sections)
    names.push_back(section->name);
  const bool top = schema.name.empty() && schema.parameters.empty();
  Diagnostic &d =
      diagnostics.report(Code::ConfigUnknownKey, member.keySpan,
                         top ? fmt::format("{} has no section `{}`", schema.what, member.key)
                         : schema.name == "diagnostics"
                             ? fmt::format("there is no diagnostic `{}`", member.key)
                             : fmt::format("{} has no parameter `{}`", schema.what, member.key),
                         "unknown");
  const std::string_view near = nearest(member.key, names);
  if (!near.empty() && equalIgnoringCase(near, member.key))
    d.help(fmt::format("write `{}`: upper and lower case count here", near));
  else if (!near.empty())
    d.help(fmt::format("did you mean `{}`?", near));
  else if (const SectionSchema *owner = ownerOf(file, member.key);
           owner != nullptr && owner != &schema)
    d.help(fmt::format("`{}` belongs into {}", member.key, header(*owner)));
  if (near.empty() && schema.name == "diagnostics")
    d.help("`stride explain --list` shows all codes and names");
  if (near.empty() && names.size() <= 6) {
    std::string all;
    for (const std::string_view name : names)
      all += fmt::format("{}`{}`", all.empty() ? "" : ", ", name);
    d.note("known here: " + all);
  }
}

bool checkSectionKind(const TomlNode &member, const SectionSchema &section,
                      Diagnostics &diagnostics) {
  const bool good = section.list ? member.arrayOfTables : member.kind == TomlKind::Table;
  if (good)
    return true;
  diagnostics
      .report(Code::ConfigWrongType, member.keySpan,
              section.list ? fmt::format("`{}` must be a list of tables", section.name)
                           : fmt::format("`{}` must be a table", section.name),
              fmt::format("this is {}", describe(member)))
      .help(fmt::format("write the header as {}", header(section)));
  return false;
}

} // namespace

const Parameter *findParameter(const SectionSchema &schema, std::string_view name) {
  for (const Parameter &parameter : schema.parameters)
    if (parameter.name == name)
      return &parameter;
  return nullptr;
}

std::optional<int64_t> findChoice(const Parameter &parameter, const TomlNode &value) {
  for (const Choice &choice : parameter.choices)
    if (value.kind == TomlKind::Integer ? choice.value == value.integer
                                        : canonical(choice.name) == canonical(value.text))
      return choice.value;
  // In the dialogs of V2.3 CONFIGURABLE is the seventh choice, in AXIS_REF it is 0.
  if (value.kind == TomlKind::Integer && parameter.name == "wControlType" && value.integer == 7)
    return 0;
  // Cyclic data may be any parameter number of AXIS_REF.
  if (value.kind == TomlKind::Integer && parameter.name.starts_with("wCyclicData") &&
      value.integer >= 0 && value.integer <= 65535)
    return value.integer;
  return std::nullopt;
}

CheckedSection::CheckedSection(const TomlNode &table, const SectionSchema &schema,
                               Diagnostics &diagnostics, const SectionSchema *file)
    : table_(&table), schema_(&schema), file_(file != nullptr ? file : &schema) {
  for (const TomlNode &member : table.children) {
    if (const Parameter *parameter = findParameter(schema, member.key)) {
      if (ValueChecker(*parameter, member, diagnostics).check())
        values_.push_back(&member);
    } else if (const SectionSchema *section = findSection(schema, member.key)) {
      if (checkSectionKind(member, *section, diagnostics))
        values_.push_back(&member);
    } else if (schema.open) {
      values_.push_back(&member);
    } else {
      reportUnknown(member, schema, *file_, diagnostics);
    }
  }
  for (const Parameter &parameter : schema.parameters)
    if (parameter.required && !has(parameter.name))
      diagnostics
          .report(Code::ConfigMissingKey, table.span,
                  fmt::format("{} needs `{}`", schema.what, parameter.name),
                  fmt::format("`{}` is missing", parameter.name))
          .help(fmt::format("add `{} = …`: {}", parameter.name, expectation(parameter.type)));
  for (const Foreign &foreign : schema.foreign) {
    const TomlNode *value = get(foreign.name);
    if (value == nullptr)
      continue;
    diagnostics.report(Code::ConfigWithoutEffect, value->keySpan,
                       fmt::format("`{}` has no effect here", foreign.name), foreign.reason);
    std::erase(values_, value);
  }
}

const TomlNode *CheckedSection::get(std::string_view name) const {
  for (const TomlNode *value : values_)
    if (value->key == name)
      return value;
  return nullptr;
}

int64_t CheckedSection::integer(std::string_view name, int64_t otherwise) const {
  const TomlNode *value = get(name);
  return value != nullptr ? value->integer : otherwise;
}

double CheckedSection::real(std::string_view name, double otherwise) const {
  const TomlNode *value = get(name);
  return value != nullptr ? value->floating : otherwise;
}

bool CheckedSection::boolean(std::string_view name, bool otherwise) const {
  const TomlNode *value = get(name);
  return value != nullptr ? value->boolean : otherwise;
}

std::string CheckedSection::text(std::string_view name, std::string_view otherwise) const {
  const TomlNode *value = get(name);
  return value != nullptr ? value->text : std::string(otherwise);
}

int64_t CheckedSection::choice(std::string_view name, int64_t otherwise) const {
  const TomlNode *value = get(name);
  return value != nullptr ? findChoice(*findParameter(*schema_, name), *value).value_or(otherwise)
                          : otherwise;
}

int64_t CheckedSection::integer(std::string_view name) const {
  return integer(name, static_cast<int64_t>(findParameter(*schema_, name)->otherwise.number));
}

double CheckedSection::real(std::string_view name) const {
  return real(name, findParameter(*schema_, name)->otherwise.number);
}

bool CheckedSection::boolean(std::string_view name) const {
  return boolean(name, findParameter(*schema_, name)->otherwise.number != 0);
}

int64_t CheckedSection::choice(std::string_view name) const {
  return choice(name, static_cast<int64_t>(findParameter(*schema_, name)->otherwise.number));
}

std::span<const TomlNode> CheckedSection::tables(std::string_view name) const {
  const TomlNode *value = get(name);
  return value != nullptr ? std::span<const TomlNode>(value->children)
                          : std::span<const TomlNode>();
}

std::vector<CheckedSection> CheckedSection::sections(std::string_view name,
                                                     Diagnostics &diagnostics) const {
  std::vector<CheckedSection> result;
  const TomlNode *value = get(name);
  const SectionSchema *section = findSection(*schema_, name);
  if (value == nullptr || section == nullptr)
    return result;
  if (!section->list) {
    result.emplace_back(*value, *section, diagnostics, file_);
    return result;
  }
  for (const TomlNode &element : value->children)
    result.emplace_back(element, *section, diagnostics, file_);
  return result;
}

ConfigName nameIn(const CheckedSection &section, std::string_view parameter) {
  const TomlNode *value = section.get(parameter);
  return value != nullptr ? ConfigName{value->text, value->span} : ConfigName{};
}

ConfigName nameOf(const CheckedSection &section) {
  const TomlNode *name = section.get("name");
  return name != nullptr ? ConfigName{name->text, name->span} : ConfigName{};
}

bool Unique::add(const std::string &key, Span where, const std::string &message) {
  const auto [first, isNew] = seen_.try_emplace(key, where);
  if (!isNew)
    diagnostics_.report(code_, where, message, "used again here")
        .label(first->second, "first used here");
  return isNew;
}

void withoutEffect(Diagnostics &diagnostics, const CheckedSection &section, std::string_view name,
                   std::string_view reason) {
  diagnostics.report(Code::ConfigWithoutEffect, section.get(name)->keySpan,
                     fmt::format("`{}` has no effect here", name),
                     fmt::format("counts {}", reason));
}

} // namespace stc
