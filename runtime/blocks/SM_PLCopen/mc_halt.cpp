// MC_Halt: brakes to rest; other commands may take over.
#include "runtime/axis/run_command.hpp"

#include "st/SM_PLCopen/MC_Halt.h"

void st::SM_PLCopen::MC_Halt::body__(::stride::Ctx & /*ctx__*/) {
  namespace motion = ::stride::motion;
  motion::runCommand(stBlock, Execute != 0, Axis, [this](motion::Command &command) {
    command.eKind = motion::kind::kHalt;
    command.fDeceleration = Deceleration;
    command.fJerk = Jerk;
    command.eBufferMode = BufferMode;
  });
  Done = stBlock.bDone;
  motion::showOutcome(*this);
}
