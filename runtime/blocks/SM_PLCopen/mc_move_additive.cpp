// MC_MoveAdditive: positioning by a distance from the commanded target.
#include "runtime/axis/run_command.hpp"

#include "st/SM_PLCopen/MC_MoveAdditive.h"

void st::SM_PLCopen::MC_MoveAdditive::body__(::stride::Ctx & /*ctx__*/) {
  namespace motion = ::stride::motion;
  motion::runCommand(stBlock, Execute != 0, Axis, [this](motion::Command &command) {
    command.eKind = motion::kind::kAdditive;
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
