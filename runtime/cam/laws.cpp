#include "runtime/cam/laws.hpp"

namespace stride::cam {

Point evaluateLaw(Law /*law*/, double /*parameter*/, double /*u*/) noexcept {
  return {0.0, 0.0, 0.0, 0.0};
}

} // namespace stride::cam
