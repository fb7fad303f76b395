// Sentences of a program on their way from who reads them to who carries them out, and what the
// latter asks the former for: SMC_GSentenceQueue. Both are called in the same task. Free of the C++
// standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_SENTENCE_QUEUE_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_SENTENCE_QUEUE_HPP

#include "runtime/numeric/nc/code.hpp"
#include "runtime/numeric/nc/token.hpp"

namespace stride::nc {

/// Subprograms within each other at most: MAX_SUBPROGRAM_NESTING_DEPTH.
inline constexpr int32_t kMostNesting = 14;
/// Bytes for sentences.
inline constexpr int32_t kQueueBytes = 16384;

enum class SentenceKind : uint8_t {
  Words,
  Let,
  Header, ///< SUBPROGRAM
  Return,
  Call,
  DynamicCall,
  End, ///< Of the program or the subprogram.
};

/// How a word has its value.
enum class WordForm : uint8_t {
  Value,
  Variable,  ///< O: the variable itself, which the instructions name.
  Label,     ///< `L!`: the sentence can be jumped to.
  LabelJump, ///< `L?`
};

/// What every sentence begins with; its bytes follow.
struct SentenceHead {
  uint32_t size; ///< With the head.
  SentenceKind kind;
  bool skip;         ///< It begins with `/`.
  uint8_t nextState; ///< LineState at the beginning of the next line.
  uint8_t padding;
  int32_t line;    ///< From 0 on.
  uint32_t number; ///< N
  bool numbered;
  uint8_t more[7];
  int64_t next; ///< Where the next line begins, in bytes of the program.
};

/// Of Words: before its instructions.
struct WordHead {
  uint8_t code; ///< cnc::WordCode, or a letter.
  WordForm form;
  ValueType type;
  uint8_t padding;
  uint16_t column; ///< From 0 on.
  uint16_t size;   ///< Of the instructions.
};

/// What the interpreter asks the reader for.
enum class Request : uint8_t {
  None,
  Rewind, ///< The program from its beginning again: a jump.
  Call,   ///< The subprogram `name`; later the program goes on at `resume`.
  Return,
  Finish, ///< Nothing more.
};

/// Where a program goes on.
struct Resume {
  int64_t offset;
  int32_t line;
  uint8_t state; ///< LineState
};

/// Begins as SentenceQueue{}.
struct SentenceQueue {
  uint8_t *variables; ///< SMC_VARLIST; 0: none.
  Resume resume;
  uint32_t read;  ///< Where the next sentence begins.
  uint32_t count; ///< Bytes that are sentences.
  Error error;    ///< The reader has met one: nothing follows.
  Request request;
  bool whole;                ///< The first sentence is the program's first one.
  bool begun;                ///< There is a program.
  char name[kMostName + 1];  ///< Of the subprogram that is asked for.
  char title[kMostName + 1]; ///< Of the program.
  uint8_t bytes[kQueueBytes];
};

/// The head of the next sentence. False: there is none yet.
bool frontSentence(const SentenceQueue &queue, SentenceHead &head) noexcept;

/// The bytes behind its head.
inline const uint8_t *bodyOf(const SentenceQueue &queue) noexcept {
  return queue.bytes + queue.read + sizeof(SentenceHead);
}

inline void removeSentence(SentenceQueue &queue, const SentenceHead &head) noexcept {
  queue.read += head.size;
}

/// Room for a sentence at the end of the others; those that are gone may make room.
CodeWriter roomForSentence(SentenceQueue &queue, bool compact) noexcept;

/// No sentences.
void emptySentences(SentenceQueue &queue) noexcept;

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_SENTENCE_QUEUE_HPP
