#include "compiler/syntax/st_text.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace stc {

namespace {

// Sorted.
constexpr std::array<std::string_view, 83> kReserved = {
    "and",        "array",         "at",           "bool",
    "by",         "byte",          "case",         "constant",
    "date",       "date_and_time", "dint",         "do",
    "dt",         "dword",         "else",         "elsif",
    "end_case",   "end_for",       "end_function", "end_function_block",
    "end_if",     "end_program",   "end_repeat",   "end_struct",
    "end_type",   "end_var",       "end_while",    "exit",
    "false",      "for",           "function",     "function_block",
    "if",         "int",           "ldate",        "ldt",
    "lint",       "lreal",         "ltime",        "ltod",
    "lword",      "mod",           "not",          "of",
    "or",         "persistent",    "pointer",      "program",
    "real",       "reference",     "repeat",       "retain",
    "return",     "sint",          "string",       "struct",
    "then",       "time",          "time_of_day",  "to",
    "tod",        "true",          "type",         "udint",
    "uint",       "ulint",         "until",        "usint",
    "var",        "var_access",    "var_config",   "var_external",
    "var_global", "var_in_out",    "var_input",    "var_inst",
    "var_output", "var_stat",      "var_temp",     "while",
    "word",       "wstring",       "xor"};

} // namespace

bool isReservedWord(std::string_view text) {
  const std::string lower = lowerCase(text);
  return std::binary_search(kReserved.begin(), kReserved.end(), lower);
}

bool isIdentifier(std::string_view text) {
  const auto letter = [](char c) {
    return (lowerCase(c) >= 'a' && lowerCase(c) <= 'z') || c == '_';
  };
  if (text.empty() || !letter(text.front()) || isReservedWord(text) ||
      text.find("__") != std::string_view::npos)
    return false;
  return std::all_of(text.begin(), text.end(),
                     [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

std::string realLiteral(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find('.') == std::string::npos) {
    const size_t exponent = text.find('e');
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
  }
  return text;
}

std::string stringLiteral(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '$')
      result += '$';
    result += c;
  }
  return result + "'";
}

std::string_view sectionName(ast::Section section) {
  switch (section) {
  case ast::Section::Input:
    return "VAR_INPUT";
  case ast::Section::Output:
    return "VAR_OUTPUT";
  case ast::Section::InOut:
    return "VAR_IN_OUT";
  case ast::Section::Stat:
    return "VAR_STAT";
  default:
    return "VAR";
  }
}

} // namespace stc
