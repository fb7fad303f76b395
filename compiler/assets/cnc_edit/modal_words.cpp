// Words that hold until another one says something else.

#include "compiler/assets/cnc_edit/modal_words.hpp"

#include "compiler/assets/cnc_edit/word_edits.hpp"

#include <cmath>
#include <fmt/format.h>

namespace stc::gcode {

namespace {

using namespace stride::cnc;

constexpr unsigned kCodeBits = 8;
constexpr unsigned kUp = 1;   ///< Accelerations.
constexpr unsigned kDown = 2; ///< Decelerations.

ModalKey keyOf(uint8_t code, unsigned which) {
  return static_cast<ModalKey>(code | which << kCodeBits);
}

std::string lettersOfCode(uint8_t code) {
  char letters[kMostLetters];
  return {letters, static_cast<size_t>(lettersOf(code, letters))};
}

bool isAcceleration(uint8_t code) {
  return code == 'E' || code == kRapidAcceleration ||
         (code >= kFirstAccelerationLimit && code < kFirstAccelerationLimit + kLimitedAxes);
}

/// Words whose value 0 is the default.
bool isOffByZero(uint8_t code) {
  return code == 'D' || (code >= kFirstVelocityLimit && code != kProbe);
}

} // namespace

ModalKey keyOfDistance(bool softMotion3, ModalKey which) {
  return keyOf('D', softMotion3 ? which : 0);
}

ModalSetting settingOf(const CncWord &word, int32_t function, bool softMotion3) {
  const uint8_t code = word.word.letter;
  const bool variable = !word.variable.empty();
  const double value = word.word.value;
  ModalSetting setting;
  setting.text =
      lettersOfCode(code) + (variable ? "$" + word.variable + "$" : exactNumberText(value));
  if (code == 'F' || (code >= kFirstVelocityLimit && code < kFirstAccelerationLimit) ||
      (code >= kFirstPeriod && code <= kRapidVelocity)) {
    setting.keys = {keyOf(code, 0)};
  } else if (isAcceleration(code)) {
    setting.unknown = variable;
    if (value >= 0)
      setting.keys.push_back(keyOf(code, kUp));
    if (value <= 0)
      setting.keys.push_back(keyOf(code, kDown));
  } else if (code == 'S') {
    setting.unknown = variable;
    setting.keys = {keyOf(code, static_cast<unsigned>(std::abs(word.word.integer)) & 0xFFU)};
    if (value < 0)
      setting.text.clear();
  } else if (code == 'D') {
    const bool ofTool = function == 41 || function == 42;
    if (!softMotion3 || function != 40)
      setting.keys = {keyOfDistance(softMotion3, ofTool ? kTool : kCorner)};
  }
  if (!variable && value == 0 && isOffByZero(code))
    setting.text.clear();
  return setting;
}

const CncWord *readModal(const EditSentence &sentence, int32_t function, bool softMotion3,
                         ModalState &state) {
  for (size_t i = sentence.words.size(); i-- > 0;) { // from right to left, as the decoder does
    const ModalSetting setting = settingOf(sentence.words[i], function, softMotion3);
    if (setting.unknown)
      return &sentence.words[i];
    for (const ModalKey key : setting.keys) {
      if (setting.text.empty())
        state.erase(key);
      else
        state[key] = setting.text;
    }
  }
  return nullptr;
}

std::string defaultWord(ModalKey key) {
  const auto code = static_cast<uint8_t>(key & 0xFFU);
  if (code == 'F' || code == 'E')
    return {}; // what the application says
  if (code == 'S')
    return fmt::format("S-{}", key >> kCodeBits);
  return isAcceleration(code) ? std::string() : lettersOfCode(code) + "0";
}

} // namespace stc::gcode
