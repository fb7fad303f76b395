// Memory for variables of calls whose address ST takes, where a test calls tasks without the
// runtime, which would give it.
#pragma once

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
