#include "runtime/numeric/cnc/gcode_text.hpp"

#include "runtime/iec/text.h"

#include <stddef.h>

namespace stride::cnc {
namespace {

/// The word with its value. How many characters.
int32_t wordText(const GCodeWord &word, char *text) noexcept {
  int32_t length = lettersOf(word.letter, text);
  if (length > 2)
    text[length++] = ' ';
  if (static_cast<VariableType>(word.variables) == VariableType::Structure) {
    __builtin_memcpy(text + length, "$", 1);
    return length + 1;
  }
  length += static_cast<int32_t>(text::formatLreal(text + length, valueOf(word)));
  // Whole numbers as programs have them.
  if (text[length - 1] == '0' && text[length - 2] == '.')
    length -= 2;
  return length;
}

} // namespace

void sentenceText(const SentenceWords &sentence, char *text, int32_t room) noexcept {
  int32_t length = 0;
  if (sentence.skip && room > 1)
    text[length++] = '/';
  char word[kMostLetters + 2 + text::kBufferSize];
  for (int32_t i = 0; i < sentence.count; ++i) {
    const int32_t size = wordText(sentence.words[i], word);
    const int32_t gap = i == 0 ? 0 : 1;
    if (length + gap + size >= room)
      break;
    if (gap == 1)
      text[length++] = ' ';
    __builtin_memcpy(text + length, word, static_cast<size_t>(size));
    length += size;
  }
  text[length] = 0;
}

} // namespace stride::cnc
