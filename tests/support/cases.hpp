// How many random cases a property test takes.
#ifndef STRIDE_TESTS_SUPPORT_CASES_HPP
#define STRIDE_TESTS_SUPPORT_CASES_HPP

#include <algorithm>
#include <cstdlib>

namespace stride::test {

/// How many of these random cases a test takes, at least one: a tenth where everything is
/// instrumented; of those a fourth with STRIDE_CASES_SHARE=4 in the environment, as in CI.
inline int casesOf(int cases) {
#ifdef __SANITIZE_ADDRESS__
  constexpr int kInstrumented = 10;
#else
  constexpr int kInstrumented = 1;
#endif
  const char *const text = std::getenv("STRIDE_CASES_SHARE");
  const int share = text != nullptr ? std::max(std::atoi(text), 1) : 1;
  return std::max(cases / kInstrumented / share, 1);
}

} // namespace stride::test

#endif
