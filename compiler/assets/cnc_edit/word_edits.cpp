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

void WordEdits::setNumber(const CncWord &word, const std::string &number) {
  size_t at = word.span.begin;
  const size_t end = word.span.end;
  while (at < end && (isLetter(text_[at]) || text_[at] == ' ' || text_[at] == '\t'))
    ++at;
  changes_.push_back({{word.span.file, static_cast<uint32_t>(at), word.span.end}, number});
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

std::string numberText(double value) {
  std::string text = fmt::format("{:.9f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.'))
    text.pop_back();
  return text == "-0" ? "0" : text;
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
