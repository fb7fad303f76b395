// MC_MoveRelative: positioning by a distance.
#include "runtime/axis/run_command.hpp"

#include "st/SM_PLCopen/MC_MoveRelative.h"

void st::SM_PLCopen::MC_MoveRelative::body__(::stride::Ctx & /*ctx__*/) {
  namespace motion = ::stride::motion;
  motion::runCommand(stBlock, Execute != 0, Axis, [this](motion::Command &command) {
    command.eKind = motion::kind::kRelative;
    command.fPosition = Distance;
    command.fVelocity = Velocity;
    command.fAcceleration = Acceleration;
    command.fDeceleration = Deceleration;
    command.fJerk = Jerk;
    command.eBufferMode = BufferMode;
  });
  Done = stBlock.bDone;
  motion::showOutcome(*this);
}
