// MC_Jog: motion at a velocity while a key is pressed.
#include "runtime/axis/run_keys.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_DriveBasic/MC_Direction.h"
#include "st/SM_PLCopen/MC_Jog.h"

void st::SM_PLCopen::MC_Jog::body__(::stride::Ctx & /*ctx__*/) {
  namespace motion = ::stride::motion;
  const int16_t way = motion::wayOfKeys(JogForward != 0, JogBackward != 0);
  motion::runKeys(stJog, stBlock, way, Axis, [this](motion::Command &command, int16_t towards) {
    command.eKind = motion::kind::kVelocity;
    // A velocity command may ask for 0; a key that does not move the axis is a mistake.
    command.fVelocity = ::stride::exact::isPositive(Velocity) ? Velocity : -1.0;
    command.fAcceleration = Acceleration;
    command.fDeceleration = Deceleration;
    command.fJerk = Jerk;
    command.eDirection = towards; // MC_Direction.positive and negative
  });
  motion::showKeys(*this);
}
