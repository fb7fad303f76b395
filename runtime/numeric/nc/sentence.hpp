// Reads lines: what the sentences, declarations and calls of a program say. Free of the C++
// standard library: linked into every application. Source: SoftMotion 3's pages on its NC language.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_SENTENCE_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_SENTENCE_HPP

#include "runtime/numeric/nc/expression.hpp"
#include "runtime/numeric/nc/sentence_queue.hpp"

namespace stride::nc {

/// How far a program has come.
enum class Phase : uint8_t {
  Start,        ///< Nothing yet.
  Declarations, ///< SUBPROGRAM or LET has been.
  Body,
  Ended, ///< END_SUBPROGRAM has been.
};

/// A program that is being read. Begins as Program{}.
struct Program {
  Scope scope;
  Phase phase;
  bool sub;                 ///< A subprogram: `name`.
  bool titled;              ///< `%` has been.
  char name[kMostName + 1]; ///< In any case; of a subprogram.
};

/// What a line has given.
enum class LineResult : uint8_t {
  Nothing, ///< It is empty.
  Sentence,
  Title,  ///< `%`: the rest of the line.
  Finish, ///< The second `%`: what follows does not count.
  Wrong,  ///< `error`
};

/// What reading a line works on.
struct LineTask {
  const ProgramLine &line;
  Symbols &symbols;
  Program &program;
  const cnc::VariableList *variables;
  CodeWriter &code; ///< Where the sentence goes, with its head.
  Error error;
  int32_t errorAt; ///< Index of the character.
};

/// Reads a line. Where the sentence does not fit (CodeWriter::size > capacity), nothing has been
/// declared.
LineResult readSentence(LineTask &task) noexcept;

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_SENTENCE_HPP
