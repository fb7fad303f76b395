// SMC_NoteFBError: for blocks written in ST.
#include "runtime/axis/axis_ref.hpp"

#include "st/SM_DriveBasic/SMC_NoteFBError.h"

::stride::BOOL st::SM_DriveBasic::SMC_NoteFBError(::stride::Ctx & /*ctx__*/, AXIS_REF &Axis,
                                                  ::st::SM_Error::SMC_ERROR ErrorID) {
  ::stride::axis::noteError(Axis, ErrorID);
  return 1;
}
