// Path processors, SMC_CheckVelocities and the interpolators with any queues and objects whatever:
// an error or a path, never anything else.
#include "tests/fuzz/path_chain.hpp"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  constexpr size_t kMost = 2048;
  if (size > kMost)
    return 0;
  if (const std::string fault = stride::fuzz::runPathChain(data, size); !fault.empty()) {
    std::fprintf(stderr, "%s\n", fault.c_str());
    std::abort();
  }
  return 0;
}
