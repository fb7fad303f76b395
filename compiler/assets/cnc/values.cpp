#include "compiler/assets/cnc/values.hpp"

#include "compiler/assets/cnc/internal.hpp"
#include "runtime/common/edit_distance.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace stc {

namespace {

bool sameName(std::string_view a, std::string_view b) { return lowerCase(a) == lowerCase(b); }

/// All of the text as a finite number.
std::optional<double> numberOf(std::string_view text) {
  if (text.starts_with('+'))
    text.remove_prefix(1);
  double value = 0;
  const char *const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// The names of the variables that a program changes (O of G36 and G37).
std::set<std::string> changedBy(const CncProgram &program) {
  std::set<std::string> changed;
  for (const CncWord &word : program.words)
    if (word.word.letter == 'O' && !word.variable.empty())
      changed.insert(lowerCase(word.variable));
  return changed;
}

} // namespace

std::string CncValues::add(std::string_view text) {
  const size_t sign = text.find('=');
  if (sign == 0 || sign == std::string_view::npos)
    return fmt::format("`{}` is not NAME=VALUE", text);
  auto value = std::make_unique<CncValue>();
  value->name = text.substr(0, sign);
  value->text = text.substr(sign + 1);
  std::string &said = value->text;
  const auto isSame = [&](const auto &other) { return sameName(other->name, value->name); };
  if (std::any_of(values_.begin(), values_.end(), isSame))
    return fmt::format("`{}` has two values", value->name);
  if (said.size() >= 2 && said.front() == '\'' && said.back() == '\'') {
    said = said.substr(1, said.size() - 2);
  } else {
    value->number = numberOf(said);
    if (sameName(said, "TRUE") || sameName(said, "FALSE"))
      value->truth = sameName(said, "TRUE");
  }
  values_.push_back(std::move(value));
  return {};
}

CncValue *CncValues::find(std::string_view name) {
  if (std::find(known_.begin(), known_.end(), name) == known_.end())
    known_.emplace_back(name);
  for (const auto &value : values_)
    if (sameName(value->name, name)) {
      value->used = true;
      return value.get();
    }
  return nullptr;
}

std::string CncValues::unknown() const {
  const auto lost =
      std::find_if(values_.begin(), values_.end(), [](const auto &value) { return !value->used; });
  if (lost == values_.end())
    return {};
  const std::string &name = (*lost)->name;
  constexpr size_t kNear = 2;
  size_t least = kNear + 1;
  std::string help =
      known_.empty() ? "it has none" : fmt::format("it has {}", fmt::join(known_, ", "));
  for (const std::string &one : known_)
    if (const size_t edits = stride::common::editDistance(name, one, kNear); edits < least) {
      least = edits;
      help = fmt::format("did you mean `{}`?", one);
    }
  return fmt::format("--set: the program has no variable `{}`: {}", name, help);
}

void setVariables(CncProgram &program, CncValues &values, Diagnostics &diagnostics) {
  const std::set<std::string> changed = changedBy(program);
  bool isM = false;
  for (CncWord &word : program.words) {
    isM = word.word.letter == 'M' || (isM && word.word.letter != stride::cnc::kEndOfSentence);
    if (word.variable.empty())
      continue;
    const CncValue *const value = values.find(word.variable);
    if (value == nullptr)
      continue;
    const bool parameters = isM && word.word.letter == 'O';
    if (!value->number || parameters) {
      diagnostics.report(Code::CncVariable, word.span,
                         fmt::format("`{}` cannot be set to `{}`", word.variable, value->text),
                         parameters ? "this is an SMC_M_PARAMETERS" : "a number is needed here");
      continue;
    }
    if (changed.count(lowerCase(word.variable)) != 0) {
      word.initial = CncInitial{*value->number, {}};
      continue;
    }
    word.word.value = *value->number;
    word.word.integer = stride::cnc::wholePart(*value->number);
    word.variable.clear();
  }
}

} // namespace stc
