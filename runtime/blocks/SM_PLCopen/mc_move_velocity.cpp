// MC_MoveVelocity: motion at a velocity, without end.
#include "runtime/axis/run_command.hpp"

#include "st/SM_PLCopen/MC_MoveVelocity.h"

void st::SM_PLCopen::MC_MoveVelocity::body__(::stride::Ctx & /*ctx__*/) {
  namespace motion = ::stride::motion;
  motion::runCommand(stBlock, Execute != 0, Axis, [this](motion::Command &command) {
    command.eKind = motion::kind::kVelocity;
    command.fVelocity = Velocity;
    command.fAcceleration = Acceleration;
    command.fDeceleration = Deceleration;
    command.fJerk = Jerk;
    command.eBufferMode = BufferMode;
    command.eDirection = Direction;
  });
  InVelocity = stBlock.bDone;
  motion::showOutcome(*this);
}
