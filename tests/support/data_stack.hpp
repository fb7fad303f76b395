// Memory for variables of calls whose address ST takes, where a test calls tasks without the
// runtime, which would give it.
#ifndef STRIDE_TESTS_SUPPORT_DATA_STACK_HPP
#define STRIDE_TESTS_SUPPORT_DATA_STACK_HPP

#include "runtime/iec/ctx.h"

#include <array>

namespace stride::test {

class DataStack {
public:
  void giveTo(Ctx &ctx) {
    ctx.dataTop = bytes_.data();
    ctx.dataEnd = bytes_.data() + bytes_.size();
  }

private:
  alignas(16) std::array<char, 1 << 16> bytes_{};
};

} // namespace stride::test

#endif // STRIDE_TESTS_SUPPORT_DATA_STACK_HPP
