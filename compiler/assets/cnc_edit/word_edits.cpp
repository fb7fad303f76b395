// Changes of the text of CNC programs.

#include "compiler/assets/cnc_edit/word_edits.hpp"

#include "compiler/assets/cnc/nc_source.hpp"
#include "compiler/assets/cnc_edit/text_edits.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stc::gcode {

namespace {

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Greater numbers have more digits than are read exactly.
constexpr double kMostNumber = 1e12;

} // namespace

size_t numberPlace(std::string_view text, const CncWord &word) {
  size_t at = word.span.begin;
  while (at < word.span.end && (isLetter(text[at]) || text[at] == ' ' || text[at] == '\t'))
    ++at;
  return at;
}

bool isNothing(double way, double size) {
  constexpr double kNothing = 1e-12; // as a part of the numbers
  return std::abs(way) <= kNothing * std::max(1.0, std::abs(size));
}

void WordEdits::setNumber(const CncWord &word, const std::string &number) {
  const auto at = static_cast<uint32_t>(numberPlace(text_, word));
  changes_.push_back({{word.span.file, at, word.span.end}, number});
}

void WordEdits::insertAfter(const CncWord &word, const std::string &words) {
  changes_.push_back({{word.span.file, word.span.end, word.span.end}, " " + words});
}

std::string WordEdits::apply() {
  std::stable_sort(changes_.begin(), changes_.end(), [](const Edit &a, const Edit &b) {
    return a.span.begin != b.span.begin ? a.span.begin < b.span.begin : a.span.end < b.span.end;
  });
  return editedText(text_, changes_);
}

namespace {

/// A number with digits behind the point, less those that say nothing; there is one at least.
std::string shortened(std::string text) {
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.'))
    text.pop_back();
  return text == "-0" ? "0" : text;
}

} // namespace

std::string numberText(double value) { return shortened(fmt::format("{:.9f}", value)); }

std::string exactNumberText(double value) {
  constexpr int kMostDecimals = 12;
  constexpr int kDigits = 15; // that a double has
  const double size = std::abs(value);
  const int whole = size < 1 ? 0 : static_cast<int>(std::floor(std::log10(size))) + 1;
  return shortened(fmt::format("{:.{}f}", value, std::clamp(kDigits - whole, 1, kMostDecimals)));
}

const CncWord *wordOf(std::span<const CncWord> sentence, uint8_t letter) {
  const auto found = std::find_if(sentence.begin(), sentence.end(),
                                  [=](const CncWord &word) { return word.word.letter == letter; });
  return found != sentence.end() ? &*found : nullptr;
}

double roundedNumber(double value) { return std::stod(numberText(value)); }

bool isWritable(double value) { return std::abs(value) < kMostNumber; }

void refuseEdit(Span span, const std::string &message, const std::string &label,
                const std::string &help, Diagnostics &diagnostics) {
  diagnostics.report(Code::CncEdit, span, message, label).help(help);
}

std::optional<CncProgram> readForEdit(const SourceFile &file, Diagnostics &diagnostics) {
  if (needsNcLanguage(file.text())) {
    refuseEdit({file.id(), 0, 0}, "programs with expressions and subprograms cannot be changed",
               "in SoftMotion 3's language",
               "change them where their numbers are computed, or shift, turn and scale the "
               "coordinates with G54",
               diagnostics);
    return std::nullopt;
  }
  std::optional<CncProgram> program = readCnc(file, diagnostics);
  if (!program)
    return std::nullopt;
  Diagnostics found;
  checkCnc(*program, found);
  for (const Diagnostic &one : found.all())
    if (one.severity == Severity::Error)
      diagnostics.report(one.code, {}, one.message) = one;
  return found.hasErrors() ? std::nullopt : std::move(program);
}

} // namespace stc::gcode
