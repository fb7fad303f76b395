// Changes of sentences that are carried out several times.

#include "compiler/assets/cnc_edit/repeated_edits.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stc::gcode {

namespace {

/// Rounded numbers may add up to so much in a loop. [u]
constexpr double kSame = 1e-6;

bool areSame(double a, double b) { return std::abs(a - b) <= kSame * std::max(1.0, std::abs(a)); }

} // namespace

void RepeatedEdits::begin(int64_t sentence) {
  now_ = &sentences_[sentence];
  ++now_->visits;
}

RepeatedEdits::Change *RepeatedEdits::find(const CncWord *word, char letter) {
  const auto found =
      std::find_if(now_->changes.begin(), now_->changes.end(), [=](const Change &change) {
        return change.word == word && change.letter == letter;
      });
  return found != now_->changes.end() ? &*found : nullptr;
}

bool RepeatedEdits::changed(const CncWord &word) const {
  return std::any_of(now_->changes.begin(), now_->changes.end(),
                     [&](const Change &change) { return change.word == &word; });
}

bool RepeatedEdits::inserted(char letter) const {
  return std::any_of(now_->changes.begin(), now_->changes.end(), [=](const Change &change) {
    return change.word == nullptr && change.letter == letter;
  });
}

std::optional<double> RepeatedEdits::repeat(Change &change, double value) const {
  change.visit = now_->visits;
  return areSame(change.value, value) ? std::optional(change.value) : std::nullopt;
}

double RepeatedEdits::note(const CncWord *word, char letter, double value) {
  const double read = roundedNumber(value);
  now_->changes.push_back({word, letter, read, now_->visits});
  return read;
}

std::optional<double> RepeatedEdits::setNumber(const CncWord &word, double value) {
  const char letter = static_cast<char>(word.word.letter);
  if (Change *change = find(&word, letter))
    return repeat(*change, value);
  if (isRepeated())
    return areSame(word.word.value, value) ? std::optional(word.word.value) : std::nullopt;
  edits_.setNumber(word, numberText(value));
  return note(&word, letter, value);
}

std::optional<double> RepeatedEdits::insertAfter(const CncWord &anchor, char letter, double value) {
  if (Change *change = find(nullptr, letter))
    return repeat(*change, value);
  if (isRepeated())
    return std::nullopt;
  edits_.insertAfter(anchor, letter + numberText(value));
  return note(nullptr, letter, value);
}

bool RepeatedEdits::keepFunction(const CncWord &anchor, int32_t function, bool write) {
  now_->severalFunctions =
      now_->severalFunctions || (now_->function >= 0 && now_->function != function);
  now_->function = function;
  if (write && !now_->functionWritten) {
    now_->functionWritten = true;
    edits_.insertAfter(anchor, fmt::format("G{}", function));
  }
  return !now_->functionWritten || !now_->severalFunctions;
}

bool RepeatedEdits::end() const {
  return std::all_of(now_->changes.begin(), now_->changes.end(),
                     [this](const Change &change) { return change.visit == now_->visits; });
}

} // namespace stc::gcode
