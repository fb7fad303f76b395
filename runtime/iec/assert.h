// ASSERT_TRUE, ASSERT_EQ, …: what a test demands. A demand that is not met is told to the host, and
// the program goes on.
// Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_ASSERT_H
#define STRIDE_RUNTIME_IEC_ASSERT_H

#include "runtime/iec/convert.h"
#include "runtime/iec/ctx.h"
#include "runtime/iec/strings.h"
#include "runtime/iec/types.h"

namespace stride {

/// Severity of HostApi::log for a demand that is not met: the text is FailedAssertion::summary.
inline constexpr uint32_t kAssertionFailed = 16;

/// What the host is told. Texts are UTF-8 with a NUL.
struct FailedAssertion {
  char summary[1200]; ///< everything in one line
  char actual[320];
  char expected[400];
  char message[256]; ///< empty: none was given
  const char *function;
  const char *file;
  uint32_t line;
  uint32_t col;
};

/// What is demanded of the actual value.
enum class Demand : uint32_t { Equal, NotEqual, Greater, GreaterEqual, Less, LessEqual };

/// Where, and what the user says to it.
struct AssertionPlace {
  const char *function;
  const char *message; ///< Latin-1; null: nothing
  const char *file;
  uint32_t line;
  uint32_t col;
};

/// A value to be shown.
struct AssertionValue {
  Kind kind;
  const void *value;    ///< STRING, WSTRING: the characters
  uint32_t capacity;    ///< STRING, WSTRING: at most so many
  const char *spelling; ///< an enumerator; null: the value
};

/// Words the failure and tells the host.
__attribute__((cold)) void assertionFailed(Ctx &ctx, Demand demand, const AssertionValue &actual,
                                           const AssertionValue &expected,
                                           const AssertionPlace &place);
/// ASSERT_NEAR.
__attribute__((cold)) void nearFailed(Ctx &ctx, LREAL actual, LREAL expected, LREAL tolerance,
                                      const AssertionPlace &place);
/// FAIL.
__attribute__((cold)) BOOL failTest(Ctx &ctx, const AssertionPlace &place);

namespace detail {
template <class T> inline bool holds(Demand demand, T a, T b) {
  switch (demand) {
  case Demand::Equal:
    return a == b;
  case Demand::NotEqual:
    return a != b;
  case Demand::Greater:
    return a > b;
  case Demand::GreaterEqual:
    return a >= b;
  case Demand::Less:
    return a < b;
  case Demand::LessEqual:
    return a <= b;
  }
  return false;
}
} // namespace detail

/// ASSERT_EQ and the like, and with a BOOL ASSERT_TRUE; `names` spells enumerators.
template <Kind K, class T, class U>
inline BOOL assertValues(Ctx &ctx, Demand demand, const T &actualValue, const U &expectedValue,
                         const char *(*names)(LINT), const AssertionPlace &place) {
  const auto actual = static_cast<KindType<K>>(actualValue);
  const auto expected = static_cast<KindType<K>>(expectedValue);
  if (detail::holds(demand, actual, expected)) [[likely]]
    return true;
  assertionFailed(
      ctx, demand, {K, &actual, 0, names != nullptr ? names(static_cast<LINT>(actual)) : nullptr},
      {K, &expected, 0, names != nullptr ? names(static_cast<LINT>(expected)) : nullptr}, place);
  return false;
}

template <Kind K, template <uint32_t> class S, uint32_t N, uint32_t M>
inline BOOL assertTexts(Ctx &ctx, Demand demand, const S<N> &actual, const S<M> &expected,
                        const AssertionPlace &place) {
  if (detail::holds(demand, compare(actual, expected), 0)) [[likely]]
    return true;
  assertionFailed(ctx, demand, {K, actual.s, N, nullptr}, {K, expected.s, M, nullptr}, place);
  return false;
}

inline BOOL assertNear(Ctx &ctx, LREAL actual, LREAL expected, LREAL tolerance,
                       const AssertionPlace &place) {
  // Written so that NaN fails, and equal infinities do not.
  if (actual == expected || (actual - expected <= tolerance && expected - actual <= tolerance))
    return true;
  nearFailed(ctx, actual, expected, tolerance, place);
  return false;
}

} // namespace stride

#endif
