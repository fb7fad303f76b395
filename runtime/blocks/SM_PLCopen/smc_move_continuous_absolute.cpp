// SMC_MoveContinuousAbsolute: to a position and on from there at a velocity.
#include "runtime/axis/run_command.hpp"

#include "st/SM_PLCopen/SMC_MoveContinuousAbsolute.h"

void st::SM_PLCopen::SMC_MoveContinuousAbsolute::body__(::stride::Ctx & /*ctx__*/) {
  namespace motion = ::stride::motion;
  motion::runCommand(stBlock, Execute != 0, Axis, [this](motion::Command &command) {
    command.eKind = motion::kind::kContinuousAbsolute;
    command.fPosition = Position;
    command.fVelocity = Velocity;
    command.fEndVelocity = EndVelocity;
    command.eEndDirection = EndVelocityDirection;
    command.fAcceleration = Acceleration;
    command.fDeceleration = Deceleration;
    command.fJerk = Jerk;
    command.eBufferMode = BufferMode;
    command.eDirection = Direction;
  });
  InEndVelocity = stBlock.bDone;
  motion::showOutcome(*this);
}
