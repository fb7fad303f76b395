// Reads G-code: bytes in, words out. It keeps its place between any two bytes, so that programs may
// come in pieces of any size. Free of the C++ standard library: linked into every application.
//
// The language: docs/cnc.md. Source: SoftMotion V2.3 manual, section 3.2.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_GCODE_SCANNER_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_GCODE_SCANNER_HPP

#include "runtime/numeric/cnc/exponent.hpp"
#include "runtime/numeric/cnc/gcode_error.hpp"
#include "runtime/numeric/cnc/gcode_word.hpp"

namespace stride::cnc {

/// Characters of a name at most: of a program, of a variable.
inline constexpr int32_t kMostName = 80;
/// Characters of a number at most.
inline constexpr int32_t kMostDigits = 40;

enum class ScanEvent : uint8_t {
  None,          ///< All bytes are used up.
  Word,          ///< Scanner::word; of a variable `name`.
  EndOfSentence, ///< The line had words.
  ProgramName,   ///< `%`: `name`, which may be empty.
  EndOfProgram,  ///< The second `%`: what follows does not count.
  Error,         ///< Scanner::error; the rest of the line is passed over.
};

/// Where it is in the line.
enum class ScanState : uint8_t {
  Start, ///< Of a line.
  Between,
  Slash,
  Letters,
  AfterLetters,
  Number,
  Variable,
  Comment,
  Name,
  Rest, ///< What is passed over up to the end of the line.
  Ended,
};

/// All that it keeps. Trivially copyable; begins as Scanner{}.
struct Scanner {
  GCodeWord word;      ///< The last one, without an address.
  int64_t offset;      ///< How many bytes have been read.
  int64_t wordOffset;  ///< Of the last word, or of the error.
  int64_t lastLine;    ///< Where the line begins.
  int64_t mantissa;    ///< Of a number, as far as it is exact.
  int32_t line;        ///< The line, from 0 on.
  int32_t count;       ///< Of `name`, `digits` or `letters`, whichever is being read.
  int32_t decimals;    ///< Digits after the point; -1: there is no point.
  GCodeError error;    ///< What was wrong last.
  ScanState state;     ///< Of this line.
  bool inSentence;     ///< The line has words.
  bool begun;          ///< There has been a sentence, or a name.
  bool carriageReturn; ///< The last byte was one.
  bool variable;       ///< The last word has a variable: `name`.
  bool lowerCase;      ///< The letter of the last word is small.
  bool endsInDigit;    ///< The last byte was the last one of a number.
  Exponent exponent;   ///< What the word may be instead.
  char letters[kMostLetters];
  char digits[kMostDigits];
  char name[kMostName + 1]; ///< Of the variable or of the program; ends with 0.
};

/// Reads on. `used` is how many of the bytes it has taken; the others belong to what comes after
/// the event.
ScanEvent scan(Scanner &scanner, const uint8_t *bytes, int64_t count, int64_t &used) noexcept;

/// At the end of the text: what the last line without an end still has. To be called until None.
ScanEvent scanEnd(Scanner &scanner) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_GCODE_SCANNER_HPP
