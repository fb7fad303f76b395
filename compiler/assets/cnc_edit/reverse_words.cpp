// Modes and modal words of a CNC program that is reversed.

#include "compiler/assets/cnc_edit/reverse_words.hpp"

#include "compiler/assets/cnc_edit/word_edits.hpp"

#include <fmt/format.h>
#include <set>

namespace stc::gcode {

namespace {

/// What a mode is on the way back: tools are on the other side.
int32_t turnedMode(int32_t topic, int32_t function) {
  return topic == kToolMode && function != 40 ? 83 - function : function;
}

} // namespace

void ReverseWords::refuse(size_t sentence, const std::string &message, const std::string &label,
                          const std::string &help) {
  refuseEdit(trace_.sentences[sentence].words.front().span, message, label, help, diagnostics_);
}

void ReverseWords::keep(size_t sentence) {
  modal_ = plan_.modal[planned(sentence).modalAfter];
  modes_ = plan_.modes[planned(sentence).modesAfter];
}

void ReverseWords::setMode(int32_t topic, int32_t function) {
  if (function == modeOf({}, topic))
    modes_.erase(topic);
  else
    modes_[topic] = function;
}

void ReverseWords::write(SentenceText &line, size_t sentence, const ModalState &wanted,
                         bool noDistance) {
  const int32_t function =
      planned(sentence).kind == SentenceKind::Mode ? planned(sentence).function : -1;
  std::set<ModalKey> said;
  for (const CncWord &word : trace_.sentences[sentence].words) {
    const ModalSetting setting = settingOf(word, function, softMotion3_);
    const bool leaves = noDistance && word.word.letter == 'D';
    if (setting.keys.empty() && !leaves)
      continue;
    const auto value = leaves ? wanted.end() : wanted.find(setting.keys.front());
    if (value == wanted.end() || setting.keys.size() > 1 || !said.insert(value->first).second) {
      line.remove(word);
      continue;
    }
    if (value->second != setting.text)
      line.replace(word, value->second);
    modal_[value->first] = value->second;
  }
}

void ReverseWords::writeWords(SentenceText &line, size_t sentence, bool says) {
  write(line, sentence, says ? plan_.modal[planned(sentence).modalBefore] : ModalState{}, false);
}

void ReverseWords::writeMotion(SentenceText &line, size_t sentence) {
  write(line, sentence, plan_.modal[planned(sentence).modalAfter], false);
  for (const std::string &word : missingWords(sentence))
    line.append(word);
}

std::string ReverseWords::missingDistance(int32_t topic, int32_t function,
                                          const ModalState &wanted) {
  const bool isTool = topic == kToolMode;
  if ((!isTool && topic != kCornerMode) || function == modeOf({}, topic))
    return {};
  const ModalKey key = keyOfDistance(softMotion3_, isTool ? kTool : kCorner);
  const auto value = wanted.find(key);
  if (value == wanted.end())
    return {};
  modal_[key] = value->second;
  return value->second;
}

void ReverseWords::writeMode(SentenceText &line, size_t sentence) {
  const PlannedSentence &now = planned(sentence);
  const std::span<const CncWord> words = trace_.sentences[sentence].words;
  const ModalState &wanted = plan_.modal[now.modalBefore];
  const int32_t function = turnedMode(now.topic, modeOf(plan_.modes[now.modesBefore], now.topic));
  const bool isFeature = now.topic >= kFeatureMode && now.topic < kSmoothMode;
  const bool parameters =
      isFeature && (wordOf(words, 'I') != nullptr || wordOf(words, 'J') != nullptr ||
                    wordOf(words, 'K') != nullptr);
  if (now.function == 16 || function == 16 || parameters)
    return refuse(sentence, "what held before this sentence cannot be written by it",
                  parameters ? "with parameters" : "a plane by its normal",
                  "say it once, at the beginning of the program");
  if (function != now.function)
    line.setNumber(*wordOf(words, 'G'), std::to_string(function));
  write(line, sentence, wanted, now.topic == kToolMode || now.topic == kCornerMode);
  if (const std::string distance = missingDistance(now.topic, function, wanted); !distance.empty())
    line.append(distance);
  setMode(now.topic, function);
}

std::vector<std::string> ReverseWords::missingModes(size_t sentence) {
  const ModeState &needed = plan_.modes[planned(sentence).modesAfter];
  std::set<int32_t> topics;
  for (const ModeState *state : {&needed, &std::as_const(modes_)})
    for (const auto &[topic, function] : *state)
      topics.insert(topic);
  std::vector<std::string> lines;
  for (const int32_t topic : topics) {
    const int32_t wanted = turnedMode(topic, modeOf(needed, topic));
    if (wanted == mode(topic))
      continue;
    if (wanted == 16)
      refuse(sentence, "this motion needs a plane that is given by its normal", "not chosen before",
             "choose it at the beginning of the program");
    std::string words = fmt::format("G{}", wanted);
    if (topic >= kSmoothMode)
      words += fmt::format(" L{}", topic - kSmoothMode);
    else if (topic >= kFeatureMode)
      words += fmt::format(" O{}", topic - kFeatureMode);
    if (const std::string distance =
            missingDistance(topic, wanted, plan_.modal[planned(sentence).modalAfter]);
        !distance.empty())
      words += " " + distance;
    lines.push_back(std::move(words));
    setMode(topic, wanted);
  }
  return lines;
}

std::vector<std::string> ReverseWords::missingWords(size_t sentence) {
  const ModalState &wanted = plan_.modal[planned(sentence).modalAfter];
  const ModeState &modes = plan_.modes[planned(sentence).modesAfter];
  const bool isNeeded =
      modeOf(modes, kCornerMode) != 50 || (!softMotion3_ && modeOf(modes, kToolMode) != 40);
  std::set<ModalKey> keys;
  for (const ModalState *state : {&wanted, &std::as_const(modal_)})
    for (const auto &[key, text] : *state)
      keys.insert(key);
  if (!isNeeded)
    keys.erase(keyOfDistance(softMotion3_, kCorner));
  if (softMotion3_) // only the sentence with G41 or G42 says it
    keys.erase(keyOfDistance(softMotion3_, kTool));
  std::vector<std::string> words;
  for (const ModalKey key : keys) {
    const auto now = modal_.find(key);
    const auto then = wanted.find(key);
    if (then != wanted.end() && (now == modal_.end() || now->second != then->second)) {
      words.push_back(then->second);
      modal_[key] = then->second;
    } else if (then == wanted.end() && now != modal_.end()) {
      words.push_back(defaultWord(key));
      if (words.back().empty())
        refuse(sentence, "no word says what holds for this motion", "a default that others replace",
               "say F and E at the beginning of the program");
      modal_.erase(now);
    }
  }
  return words;
}

} // namespace stc::gcode
