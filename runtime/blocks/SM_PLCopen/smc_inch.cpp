// SMC_Inch: a step for each press of a key.
#include "runtime/axis/run_keys.hpp"

#include "st/SM_PLCopen/SMC_Inch.h"

void st::SM_PLCopen::SMC_Inch::body__(::stride::Ctx & /*ctx__*/) {
  namespace motion = ::stride::motion;
  const int16_t way = motion::wayOfKeys(InchForward != 0, InchBackward != 0);
  motion::runKeys(stJog, stBlock, way, Axis, [this](motion::Command &command, int16_t towards) {
    command.eKind = motion::kind::kRelative;
    command.fPosition = towards * Distance;
    // A step backward by the key for forward is a mistake.
    command.fVelocity = Distance >= 0.0 ? Velocity : -1.0;
    command.fAcceleration = Acceleration;
    command.fDeceleration = Deceleration;
    command.fJerk = Jerk;
  });
  motion::showKeys(*this);
}
