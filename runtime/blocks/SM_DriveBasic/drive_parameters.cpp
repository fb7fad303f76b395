// The way to a drive's own parameters for blocks written in ST.
#include "runtime/axis/parameter_channel.hpp"

#include "st/SM_DriveBasic/SMC_AskDrive.h"
#include "st/SM_DriveBasic/SMC_DriveAnswer.h"
#include "st/SM_DriveBasic/SMC_LeaveDrive.h"

namespace axis = ::stride::axis;

namespace st::SM_DriveBasic {

::stride::UDINT SMC_AskDrive(::stride::Ctx & /*ctx__*/, AXIS_REF &Axis, ::stride::BYTE byKind,
                             ::stride::DINT diNumber, ::stride::BYTE byForm, ::stride::LREAL fValue,
                             ::stride::DWORD dwValue) {
  return axis::askDrive(Axis, static_cast<axis::ChannelKind>(byKind), diNumber,
                        static_cast<axis::ChannelForm>(byForm), fValue, dwValue);
}

::stride::INT SMC_DriveAnswer(::stride::Ctx & /*ctx__*/, AXIS_REF &Axis, ::stride::UDINT udiClaim) {
  return static_cast<int16_t>(axis::pollDrive(Axis, udiClaim));
}

::stride::BOOL SMC_LeaveDrive(::stride::Ctx & /*ctx__*/, AXIS_REF &Axis, ::stride::UDINT udiClaim) {
  axis::leaveDrive(Axis, udiClaim);
  return 1;
}

} // namespace st::SM_DriveBasic
