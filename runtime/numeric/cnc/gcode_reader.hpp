// A program that comes in pieces: bytes become words in memory of the user, whole sentences, from
// which a decoder takes them. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_GCODE_READER_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_GCODE_READER_HPP

#include "runtime/numeric/cnc/gcode_scanner.hpp"

namespace stride::cnc {

/// A variable that a program may name: SMC_SingleVar.
struct NamedVariable {
  char name[kMostName + 1]; ///< Ends with 0.
  int16_t type;             ///< VariableType
  uint8_t *address;         ///< 0: the value is one of the next two.
  int32_t integer;
  float real;
};

/// SMC_VARLIST.
struct VariableList {
  uint16_t count;
  NamedVariable *first;
};

/// Gives a word the address and the type of the variable with this name, in any case. False: there
/// is none, or it is of no type that a program can use.
bool resolveVariable(const VariableList &list, const char *name, GCodeWord &word) noexcept;

/// Memory for words, and which of them a decoder may read: from `read` up to `count`.
struct WordMemory {
  GCodeWord *words;
  uint32_t capacity;
  uint32_t *read;
  uint32_t *count;
  char *title; ///< For the name of the program, kMostName characters and a 0.
};

/// What a reader keeps: SMC_GCODE_READER. Begins as Reader{}.
struct Reader {
  Scanner scanner;
  uint32_t written; ///< Words in the memory, with those of a sentence that is not complete.
  bool ended;       ///< kEndOfProgram has been written.
};

enum class ReadResult : uint8_t {
  More,     ///< All bytes are used up.
  Full,     ///< The decoder has to take sentences first.
  Ended,    ///< The program is complete.
  TooSmall, ///< A sentence does not fit into the memory.
  Wrong,    ///< The text is no G-code: Scanner::error.
  Variable, ///< There is no such variable: Scanner::name.
};

/// Reads on; `used` is how many of the bytes it has taken. `end`: these bytes are the last ones.
ReadResult readWords(Reader &reader, const WordMemory &memory, const VariableList *variables,
                     const uint8_t *bytes, int64_t count, bool end, int64_t &used) noexcept;

/// Writes a word of its own before the program, such as F.
bool putWord(Reader &reader, const WordMemory &memory, uint8_t letter, double value) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_GCODE_READER_HPP
