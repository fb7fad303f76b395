// Reads programs of SoftMotion 3's language, which may come in pieces of any size, and the
// subprograms that they call; puts their sentences into a queue. Free of the C++ standard library:
// linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_READER_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_READER_HPP

#include "runtime/numeric/nc/sentence.hpp"

namespace stride::nc {

/// All that a reader keeps. Trivially copyable; made by beginReading.
struct Reader {
  ProgramLine line;
  Symbols symbols;
  Program programs[kMostNesting + 1]; ///< The main program, and those that call each other.
  Resume resumes[kMostNesting + 1];   ///< Where each goes on after a call.
  int32_t level;                      ///< Of the one that is being read.
  int32_t errorLine;                  ///< From 0 on.
  int32_t errorColumn;                ///< From 0 on.
  Error error;
  bool waiting; ///< A line is complete, but the queue had no room.
  bool ended;   ///< The present program has been read.
};

/// How a program is to be read.
struct ReadSettings {
  const cnc::VariableList *variables;
  bool parentheses; ///< `( … )` are comments.
};

enum class ReadState : uint8_t {
  More,  ///< All bytes are used up.
  Full,  ///< The sentences have to be taken first.
  Ended, ///< The program is complete.
  Wrong, ///< Reader::error; the queue knows it, too.
};

/// Begins a main program. `keep`: the queue's sentences stay.
void beginReading(Reader &reader, SentenceQueue &queue, bool keep) noexcept;

/// A sentence of numbers of one's own, before those of the program.
bool putSentence(SentenceQueue &queue, const uint8_t *codes, const double *values,
                 int32_t count) noexcept;

/// Reads on; `used` is how many of the bytes it has taken. `end`: these bytes are the last ones.
ReadState readProgram(Reader &reader, SentenceQueue &queue, const ReadSettings &settings,
                      const uint8_t *bytes, int64_t count, bool end, int64_t &used) noexcept;

// What the queue asks for; the caller then gives bytes from the offset on that is returned.

/// The present program from its beginning.
int64_t rewindProgram(Reader &reader, SentenceQueue &queue) noexcept;
/// The subprogram SentenceQueue::name. -1: they call each other too often; see Reader::error.
int64_t enterSubprogram(Reader &reader, SentenceQueue &queue) noexcept;
/// The program that has called.
int64_t leaveSubprogram(Reader &reader, SentenceQueue &queue) noexcept;

/// The program ends with this error.
void breakReading(Reader &reader, SentenceQueue &queue, Error error) noexcept;

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_READER_HPP
