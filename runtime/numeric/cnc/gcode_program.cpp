#include "runtime/numeric/cnc/gcode_program.hpp"

namespace stride::cnc {

int64_t sentenceAt(const GCodeWord *words, int64_t count, int64_t position,
                   SentenceWords &sentence) noexcept {
  sentence = {};
  int64_t at = position;
  if (at < count && words[at].letter == kEndOfProgram) {
    sentence.ended = true;
    return at + 1;
  }
  if (at < count && words[at].letter == kSkip) {
    sentence.skip = true;
    ++at;
  }
  sentence.words = words + at;
  for (; at < count; ++at)
    if (words[at].letter == kEndOfSentence) {
      sentence.count = static_cast<int32_t>(words + at - sentence.words);
      sentence.line = words[at].integer;
      return at + 1;
    }
  return position;
}

bool hasNumber(const SentenceWords &sentence, int32_t number) noexcept {
  for (int32_t i = 0; i < sentence.count; ++i)
    if (sentence.words[i].letter == 'N')
      return sentence.words[i].integer == number;
  return false;
}

int64_t findSentence(const GCodeWord *words, int64_t count, int32_t number) noexcept {
  SentenceWords sentence;
  int64_t at = 0;
  while (at < count) {
    const int64_t next = sentenceAt(words, count, at, sentence);
    if (next == at)
      break;
    if (hasNumber(sentence, number))
      return at;
    at = next;
  }
  return -1;
}

} // namespace stride::cnc
