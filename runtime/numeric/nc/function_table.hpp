// Functions and operators of expressions. Free of the C++ standard library: linked into every
// application. Source: SoftMotion 3's page "Expressions"; which functions are Stride's own:
// docs/cnc.md.
#ifndef STRIDE_RUNTIME_NUMERIC_NC_FUNCTION_TABLE_HPP
#define STRIDE_RUNTIME_NUMERIC_NC_FUNCTION_TABLE_HPP

#include "runtime/numeric/nc/code.hpp"
#include "runtime/numeric/nc/token.hpp"

namespace stride::nc {

inline constexpr int32_t kMostArguments = 3;

struct Function {
  const char *name; ///< In upper case.
  Op op;
  ValueType result;
  int32_t count;
  ValueType arguments[kMostArguments];
};

/// The function with this name; null: there is none.
const Function *functionOf(const ProgramLine &line, const Token &name) noexcept;

struct Infix {
  int32_t precedence; ///< Greater ones bind more.
  Op op;
  ValueType result;
  ValueType arguments; ///< Of both sides.
};

/// The operator between two values that the token is; null: none.
const Infix *infixOf(const ProgramLine &line, const Token &token) noexcept;

/// Whether a name means something in the language, so that nothing else can have it.
bool isReserved(const ProgramLine &line, const Token &name) noexcept;

} // namespace stride::nc

#endif // STRIDE_RUNTIME_NUMERIC_NC_FUNCTION_TABLE_HPP
