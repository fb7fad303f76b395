// Reads expressions: tokens in, instructions out, with all types known. Free of the C++ standard
// library: linked into every application.
// Source: SoftMotion 3's page "Expressions".
#ifndef STRIDE_RUNTIME_NUMERIC_NC_EXPRESSION_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_EXPRESSION_HPP

#include "runtime/numeric/nc/code.hpp"
#include "runtime/numeric/nc/symbols.hpp"

namespace stride::nc {

/// Brackets and functions within each other at most.
inline constexpr int32_t kMostDepth = 40;

/// A line being read.
struct Parser {
  const ProgramLine &line;
  const Symbols &symbols;
  const Scope &scope;
  const cnc::VariableList *variables;
  CodeWriter &code;
  int32_t at; ///< Index of what comes next.
  int32_t depth;
  bool locals; ///< Local variables are allowed.
  Error error;
  int32_t errorAt; ///< Index of the character.
};

/// Sets the error, once. Always false.
bool fail(Parser &parser, Error error, int32_t at) noexcept;

inline Token peek(const Parser &parser) noexcept { return tokenAt(parser.line, parser.at); }

/// Reads an expression and what its value is; it ends before the first token that cannot belong
/// to it.
bool readExpression(Parser &parser, ValueType &type) noexcept;

/// Reads a number, a name or the like without an operator behind it.
bool readTerm(Parser &parser, ValueType &type) noexcept;

/// The instruction that brings the value of a variable or a local variable.
bool readReference(Parser &parser, const Token &token, ValueType &type) noexcept;

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_EXPRESSION_HPP
