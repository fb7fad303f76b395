#include "compiler/assets/dxf/pairs.hpp"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace stc::dxf {

namespace {

constexpr int32_t kLeastCode = -5;
constexpr int32_t kMostCode = 1071;

std::string_view withoutBlanks(std::string_view text) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && isBlank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back()))
    text.remove_suffix(1);
  return text;
}

/// All of a text as a number.
template <class T> bool parse(std::string_view text, T &value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// So much of a value as a message shows.
std::string shown(std::string_view value) {
  constexpr size_t kMost = 40;
  return value.size() <= kMost ? std::string(value) : std::string(value.substr(0, kMost)) + "…";
}

} // namespace

void Faults::report(Span where, const std::string &message, const std::string &label,
                    const std::string &help) {
  if (!any_)
    diagnostics_.report(Code::DxfText, where, message, label).help(help);
  any_ = true;
}

std::string_view Pairs::line() {
  const size_t end = std::min(text_.find('\n', at_), text_.size());
  const std::string_view result = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  return result;
}

Span Pairs::here() const {
  const auto at = static_cast<uint32_t>(at_);
  return {file_.id(), at, at};
}

std::optional<Pair> Pairs::next() {
  if (faults_.any() || at_ >= text_.size())
    return std::nullopt;
  const auto spanOf = [&](std::string_view part) {
    const auto begin = static_cast<uint32_t>(part.data() - text_.data());
    return Span{file_.id(), begin, begin + static_cast<uint32_t>(part.size())};
  };
  Pair pair;
  const std::string_view code = withoutBlanks(line());
  if (!parse(code, pair.code) || pair.code < kLeastCode || pair.code > kMostCode) {
    faults_.report(spanOf(code), fmt::format("`{}` is no group code", shown(code)),
                   "a number from -5 to 1071 has to stand in this line",
                   "a drawing is lines in pairs, a group code and its value: save it as ASCII DXF "
                   "again");
    return std::nullopt;
  }
  if (at_ >= text_.size()) {
    faults_.report(spanOf(code), "the file ends after a group code", "its value is missing",
                   "the file is not complete: save the drawing again");
    return std::nullopt;
  }
  pair.value = withoutBlanks(line());
  pair.span = spanOf(pair.value);
  return pair;
}

double numberOf(const Pair &pair, Faults &faults) {
  double value = 0;
  if (parse(pair.value, value) && std::abs(value) <= kMostNumber)
    return value;
  faults.report(pair.span,
                fmt::format("`{}` is no number that is possible here", shown(pair.value)),
                fmt::format("the value of group code {}", pair.code),
                "numbers are finite, and 1e9 at most: correct the drawing");
  return 0;
}

int32_t integerOf(const Pair &pair, Faults &faults) {
  int32_t value = 0;
  if (parse(pair.value, value))
    return value;
  faults.report(pair.span,
                fmt::format("`{}` is no whole number that is possible here", shown(pair.value)),
                fmt::format("the value of group code {}", pair.code), "correct the drawing");
  return 0;
}

} // namespace stc::dxf
