// SMC_MoveContinuousRelative: by a distance and on from there at a velocity.
#include "runtime/axis/run_command.hpp"

#include "st/SM_PLCopen/SMC_MoveContinuousRelative.h"

void st::SM_PLCopen::SMC_MoveContinuousRelative::body__(::stride::Ctx & /*ctx__*/) {
  namespace motion = ::stride::motion;
  motion::runCommand(stBlock, Execute != 0, Axis, [this](motion::Command &command) {
    command.eKind = motion::kind::kContinuousRelative;
    command.fPosition = Distance;
    command.fVelocity = Velocity;
    command.fEndVelocity = EndVelocity;
    command.eEndDirection = EndVelocityDirection;
    command.fAcceleration = Acceleration;
    command.fDeceleration = Deceleration;
    command.fJerk = Jerk;
    command.eBufferMode = BufferMode;
    command.bAdaptEndVelocity = AdaptEndVelToAvoidOvershoot;
  });
  InEndVelocity = stBlock.bDone;
  motion::showOutcome(*this);
}
