#include "runtime/axis/run_keys.hpp"

namespace stride::motion {

void brakeByKeys(JogState &jog, BlockState &block, AxisRef &ref) noexcept {
  if (!keep(block, ref))
    return;
  jog.bBraking = 1;
  Command halt = {};
  halt.eKind = kind::kHalt;
  halt.fDeceleration = jog.fDeceleration;
  halt.fJerk = jog.fJerk;
  startCommand(block, ref, halt);
}

} // namespace stride::motion
