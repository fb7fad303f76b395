// Sentences of an array of words: what SMC_CNC_REF points at. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_GCODE_PROGRAM_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_GCODE_PROGRAM_HPP

#include "runtime/numeric/cnc/gcode_word.hpp"

namespace stride::cnc {

/// A sentence in an array of words.
struct SentenceWords {
  const GCodeWord *words; ///< Without kSkip and kEndOfSentence.
  int32_t count;
  int32_t line;
  bool skip;  ///< It begins with `/`.
  bool ended; ///< It is kEndOfProgram instead of a sentence.
};

/// The sentence that begins at index `position`. Returns the index after it; `position` itself
/// where the array ends before the sentence does.
int64_t sentenceAt(const GCodeWord *words, int64_t count, int64_t position,
                   SentenceWords &sentence) noexcept;

/// Where the first sentence with the number N begins; -1: there is none.
int64_t findSentence(const GCodeWord *words, int64_t count, int32_t number) noexcept;

/// Whether the sentence has this number.
bool hasNumber(const SentenceWords &sentence, int32_t number) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_GCODE_PROGRAM_HPP
