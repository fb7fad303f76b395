// Values of the types that the compiler has made from the standard library.
#ifndef STRIDE_TESTS_SUPPORT_FRESH_HPP
#define STRIDE_TESTS_SUPPORT_FRESH_HPP

#include "runtime/app/ctx.h"

namespace stride::test {

/// A value as an application would have it: zeroed, then with its defaults.
template <class T> T fresh() {
  T value{};
  Ctx ctx{};
  value.init__(ctx);
  return value;
}

} // namespace stride::test

#endif
