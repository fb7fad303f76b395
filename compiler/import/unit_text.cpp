#include "compiler/import/unit_text.hpp"

#include "compiler/import/exp_lines.hpp"
#include "compiler/import/st_scan.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

namespace stc::import {

namespace {

/// Words that a declaration begins with.
constexpr std::array<std::string_view, 7> kDeclared = {
    "PROGRAM", "FUNCTION_BLOCK", "FUNCTION", "INTERFACE", "CLASS", "METHOD", "PROPERTY"};

void addLines(std::string &out, std::string_view text) {
  out += text;
  if (!text.empty() && text.back() != '\n')
    out += '\n';
}

bool isBlank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

/// The head of an accessor: `GET` with what its declaration holds (PRIVATE, variables).
std::string headOf(const Unit &unit) {
  switch (unit.kind) {
  case UnitKind::Get:
    return "GET " + unit.declaration;
  case UnitKind::Set:
    return "SET " + unit.declaration;
  case UnitKind::Action:
    return fmt::format("ACTION {}\n", unit.name);
  default:
    return unit.declaration;
  }
}

/// The word after END_; empty when the declaration does not begin as one.
std::string keywordOf(const Unit &unit) {
  switch (unit.kind) {
  case UnitKind::Get:
    return "GET";
  case UnitKind::Set:
    return "SET";
  case UnitKind::Action:
    return "ACTION";
  default:
    const std::string word = firstKeyword(unit.declaration);
    return std::ranges::find(kDeclared, word) == kDeclared.end() ? std::string() : word;
  }
}

bool addUnit(const Unit &unit, std::string &out, std::string &problem) {
  const std::string keyword = keywordOf(unit);
  if (keyword.empty()) {
    problem = fmt::format("the declaration of {} does not begin with a word such as FUNCTION_BLOCK",
                          unit.name);
    return false;
  }
  addLines(out, headOf(unit));
  if (!unit.notImported.empty())
    out += fmt::format("{{error 'body not imported: {}'}}\n", quotedForSt(unit.notImported));
  else if (!isBlank(unit.body))
    addLines(out, unit.body);
  for (const Unit &member : unit.members) {
    if (member.kind != UnitKind::Get && member.kind != UnitKind::Set)
      out += '\n';
    if (!addUnit(member, out, problem))
      return false;
  }
  out += fmt::format("END_{}\n", keyword);
  return true;
}

} // namespace

std::string textOf(const Unit &unit, std::string &problem) {
  std::string out;
  problem.clear();
  return addUnit(unit, out, problem) ? out : std::string();
}

void reportLinks(const std::string &file, const std::string &object, std::string_view text,
                 size_t line, Model &model) {
  for (const std::string_view each : linesOf(text)) {
    const std::string lower = stride::common::lowerCase(each);
    if (lower.find("'tclinkto'") != std::string::npos ||
        lower.find("'tclinktooslog'") != std::string::npos)
      model.leftOut.push_back(
          {{file, line},
           object,
           fmt::format("the link to hardware is not followed: `{}`", trimmed(each))});
    ++line;
  }
}

} // namespace stc::import
