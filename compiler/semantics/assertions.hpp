#pragma once
// The functions of unit tests: ASSERT_TRUE … FAIL. All give BOOL, whether the demand is met; their
// last argument, a message, may be left out. They are builtins with numbers of their own.

#include "compiler/semantics/builtins.hpp"

namespace stc::ast {

inline constexpr std::uint16_t kFirstAssertion = 0x100;
constexpr Builtin assertion(unsigned number) {
  return static_cast<Builtin>(kFirstAssertion + number);
}

inline constexpr Builtin kAssertTrue = assertion(0);  ///< (condition)
inline constexpr Builtin kAssertFalse = assertion(1); ///< (condition)
inline constexpr Builtin kAssertEq = assertion(2);    ///< (actual, expected)
inline constexpr Builtin kAssertNe = assertion(3);
inline constexpr Builtin kAssertGt = assertion(4);
inline constexpr Builtin kAssertGe = assertion(5);
inline constexpr Builtin kAssertLt = assertion(6);
inline constexpr Builtin kAssertLe = assertion(7);
inline constexpr Builtin kAssertNear = assertion(8); ///< (actual, expected, tolerance): LREAL
inline constexpr Builtin kFail = assertion(9);       ///< () with a message that must be there

constexpr bool isAssertion(Builtin function) {
  return static_cast<std::uint16_t>(function) >= kFirstAssertion;
}

/// How many values stand in front of the message.
constexpr std::size_t assertedValues(Builtin function) {
  return function == kFail                                     ? 0
         : function == kAssertTrue || function == kAssertFalse ? 1
         : function == kAssertNear                             ? 3
                                                               : 2;
}

} // namespace stc::ast
