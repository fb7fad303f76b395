// Carries out the sentences of a program of SoftMotion 3's language: expressions, local variables,
// jumps and calls here; what words say, by the decoder of G-code. Free of the C++ standard library:
// linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_INTERPRETER_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_INTERPRETER_HPP

#include "runtime/numeric/cnc/decoder.hpp"
#include "runtime/numeric/nc/evaluate.hpp"
#include "runtime/numeric/nc/sentence_queue.hpp"
#include "runtime/numeric/nc/symbols.hpp"

namespace stride::nc {

/// Memory for the values of local variables: 8 bytes each, 256 for a STRING.
inline constexpr int32_t kValueBytes = 16384;

/// Where the value of a local variable is.
struct Slot {
  uint16_t place; ///< In Interpreter::values.
  ValueType type;
  uint8_t padding;
};

/// The local variables of a program: its parameters and then its own.
struct Frame {
  int32_t place; ///< Where its values begin.
  int32_t count;
  Slot slots[kMostLocals];
};

/// All that an interpreter keeps besides the decoder. Begins as Interpreter{}.
struct Interpreter {
  Frame frames[kMostNesting + 1];
  int32_t level;
  int32_t used;                       ///< Bytes of `values`.
  double label;                       ///< See `skipping`.
  uint16_t callers[kMostNesting + 1]; ///< Of each level: a number of the program. The user's.
  uint32_t target;                    ///< See `looking`.
  bool looking;                       ///< For the sentence with the number `target`.
  bool skipping;                      ///< Up to the sentence with `label`.
  uint8_t values[kValueBytes];
};

enum class Outcome : uint8_t {
  Idle,     ///< There is no sentence yet.
  Carried,  ///< `decoded` is what it has given.
  Finished, ///< The program is complete: `decoded` has what was held back.
  Wrong,    ///< `error`, or, if that is None, decoded.error.
};

/// What a call has given.
struct Carried {
  cnc::Decoded decoded;
  cnc::GCodeWord words[cnc::kMostWords]; ///< Of the sentence, with values.
  int32_t count;
  int32_t line;   ///< From 0 on.
  int32_t column; ///< Of the error, from 0 on.
  Error error;
  bool skip; ///< The sentence begins with `/`.
};

/// The beginning of a program.
void startInterpreter(Interpreter &interpreter) noexcept;

/// Carries out one sentence. `suppress`: those that begin with `/` are passed over.
Outcome interpret(Interpreter &interpreter, cnc::Decoder &decoder, SentenceQueue &queue,
                  bool suppress, Carried &carried) noexcept;

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_INTERPRETER_HPP
