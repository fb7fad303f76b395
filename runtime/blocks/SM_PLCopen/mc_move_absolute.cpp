// MC_MoveAbsolute: positioning on linear and rotary axes.
#include "runtime/axis/run_command.hpp"

#include "st/SM_PLCopen/MC_MoveAbsolute.h"

void st::SM_PLCopen::MC_MoveAbsolute::body__(::stride::Ctx & /*ctx__*/) {
  namespace motion = ::stride::motion;
  motion::runCommand(stBlock, Execute != 0, Axis, [this](motion::Command &command) {
    command.eKind = motion::kind::kAbsolute;
    command.fPosition = Position;
    command.fVelocity = Velocity;
    command.fAcceleration = Acceleration;
    command.fDeceleration = Deceleration;
    command.fJerk = Jerk;
    command.eBufferMode = BufferMode;
    command.eDirection = Direction;
  });
  Done = stBlock.bDone;
  motion::showOutcome(*this);
}
