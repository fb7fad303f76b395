// Lines of a program of SoftMotion 3's language, without comments; bytes may come in pieces of any
// size. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_PROGRAM_LINE_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_PROGRAM_LINE_HPP

#include "runtime/numeric/nc/nc_error.hpp"

namespace stride::nc {

/// Characters of a line at most, without comments.
inline constexpr int32_t kMostLine = 2047;

enum class LineState : uint8_t {
  Code,
  Text,        ///< Between quotes.
  Variable,    ///< Between dollar signs.
  Comment,     ///< `( … )`, or `(* … *)` over any number of lines.
  Star,        ///< Of such a comment: the last character was `*`.
  LineComment, ///< `//`
  Name,        ///< `%`: all counts.
  Rest,        ///< After an error.
};

/// A line as far as it has come. Trivially copyable; begins as ProgramLine{}.
struct ProgramLine {
  int64_t offset; ///< Bytes of the program that have been taken.
  int64_t begin;  ///< Where the line begins.
  int32_t number; ///< From 0 on.
  int32_t length; ///< Of `text`.
  int32_t errorColumn;
  Error error;
  LineState state;
  bool carriageReturn; ///< The last byte was one.
  char text[kMostLine + 1];
  uint16_t column[kMostLine + 1]; ///< Of each character, from 0 on; the last one: where it ends.
};

enum class LineEvent : uint8_t {
  None,  ///< All bytes are used up.
  Line,  ///< `text` is complete.
  Error, ///< `error`; the rest of the line is passed over.
};

/// Reads on; `used` is how many of the bytes it has taken. `parentheses`: `( … )` are comments,
/// else `(* … *)`.
LineEvent readLine(ProgramLine &line, bool parentheses, const uint8_t *bytes, int64_t count,
                   int64_t &used) noexcept;

/// At the end of the program: what the last line without an end still has.
LineEvent endLine(ProgramLine &line) noexcept;

/// After LineEvent::Line: begins the next one.
void nextLine(ProgramLine &line) noexcept;

/// After LineEvent::Line: what resumeLine needs besides the offset and the number of the next line.
uint8_t stateOf(const ProgramLine &line) noexcept;

/// Begins at a line in the midst of the program.
void resumeLine(ProgramLine &line, int64_t offset, int32_t number, uint8_t state) noexcept;

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_PROGRAM_LINE_HPP
