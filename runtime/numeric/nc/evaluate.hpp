// Carries out expressions. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_EVALUATE_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_EVALUATE_HPP

#include "runtime/numeric/cnc/gcode_reader.hpp"
#include "runtime/numeric/nc/code.hpp"
#include "runtime/numeric/nc/token.hpp"

namespace stride::nc {

/// Values that an expression holds at once, at most: EVAL_STACK_SIZE.
inline constexpr int32_t kMostValues = 100;
/// Characters of all texts that it holds at once.
inline constexpr int32_t kTextBytes = 4096;

/// A value.
struct Value {
  double number; ///< Of a BOOL 0 or 1.
  int32_t text;  ///< Place in Evaluation::texts.
  int32_t length;
  ValueType type;
};

/// A local variable.
struct Local {
  uint8_t *place; ///< An LREAL, a BOOL as 0.0 or 1.0, or 255 characters and a 0.
  ValueType type;
};

/// What expressions can name.
struct Surroundings {
  const Local *locals;
  int32_t localCount;
  const cnc::VariableList *variables;
};

/// Values while expressions are carried out.
struct Evaluation {
  Value values[kMostValues];
  char texts[kTextBytes];
  int32_t count;
  int32_t used; ///< Of `texts`.
};

/// Carries out `size` bytes of instructions: the values that they leave are added to those of
/// the evaluation.
Error evaluate(Evaluation &evaluation, const uint8_t *code, int32_t size,
               const Surroundings &surroundings) noexcept;

/// The variable with this index as a word sees it: address and type. False: it is none.
bool variableAt(const cnc::VariableList *list, int32_t index, uint8_t type,
                cnc::GCodeWord &word) noexcept;

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_EVALUATE_HPP
