// Words of a G-code program as programs share them: SMC_GCODE_WORD. SMC_CNC_REF is an array of
// them, which the compiler or SMC_ReadNCFile writes and SMC_NCDecoder reads. Free of the C++
// standard library: linked into every application.
//
// A sentence is its words in the order of the text, then kEndOfSentence with the line of the text
// (from 1 on) in `integer`. A sentence that can be suppressed begins with kSkip. N is a word like
// others. Letters are upper case; words of more letters have the codes of WordCode.
// Source: SoftMotion V2.3 manual, section 6.6; codes from 128 on are Stride's own.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_GCODE_WORD_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_GCODE_WORD_HPP

#include <stdint.h>

namespace stride::cnc {

/// SMC_GCODE_WORD.byLetter besides A to Z.
enum WordCode : uint8_t {
  kNoWord = 0,
  kEndOfProgram = 4,   ///< Of what SMC_ReadNCFile hands on piece by piece.
  kEndOfSentence = 10, ///< `integer`: the line.
  kSkip = '/',
  // FZ, FA … and EZ, EA …: limits of an axis, in the order of PathObject::limits.
  kFirstVelocityLimit = 0x80,
  kFirstAccelerationLimit = 0x90,
  // PA, PB …: periods of axes, in the same order; there is no PZ.
  kFirstPeriod = 0xA0,
  kRapidVelocity = 0xB0,     ///< FF
  kRapidAcceleration = 0xB1, ///< EF
  kProbe = 0xB2,             ///< PROBE
};

/// How many axes have limits of their own: Z, A, B, C, P, Q, U, V, W.
inline constexpr int32_t kLimitedAxes = 9;

/// SMC_GCODE_WORD.byVarType: what `address` leads to.
enum class VariableType : uint8_t {
  None = 0,
  Int = 1,
  Byte = 2,
  Word = 3,
  Dint = 4,
  Dword = 5,
  Real = 6,
  Structure = 11, ///< SMC_M_PARAMETERS
  Sint = 14,
  Usint = 15,
  Uint = 16,
  Udint = 17,
  Lreal = 22,
};

/// SMC_GCODE_WORD.
struct GCodeWord {
  uint8_t letter;    ///< A to Z, or a WordCode.
  double value;      ///< Of a number.
  int32_t integer;   ///< The same without its fraction, at the ends of the range at most.
  uint8_t *address;  ///< Of a variable; 0: the word has a number.
  uint8_t variables; ///< VariableType, where there is an address.
};

/// The value of a word now: the number, or what the variable has. NaN for a structure.
double valueOf(const GCodeWord &word) noexcept;

/// Writes to the word's variable, rounded and limited to what its type holds. False: it has no
/// variable, or one that holds no number.
bool assignTo(const GCodeWord &word, double value) noexcept;

/// The value without its fraction, at the ends of the range at most; 0 for NaN.
int32_t wholePart(double value) noexcept;

/// Whether there is a word with this code, but for kEndOfSentence and the like.
bool isWord(uint8_t code) noexcept;

/// Whether the word takes whole numbers only: G, H, M, N, S, PROBE.
bool wantsWhole(uint8_t code) noexcept;

/// Longest text of a word's letters.
inline constexpr int32_t kMostLetters = 5;

/// Writes the letters of a word's code, at most kMostLetters, without a 0 at the end. How many.
int32_t lettersOf(uint8_t code, char *text) noexcept;

/// The code of 1 to kMostLetters letters in upper case; kNoWord if there is no such word.
uint8_t codeOf(const char *letters, int32_t count) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_GCODE_WORD_HPP
