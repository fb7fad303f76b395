// A cam's curve for blocks written in ST.
#include "runtime/axis/cam/cam_ref.hpp"

#include "st/SM_PLCopen/SMC_CAMValue.h"

namespace st::SM_PLCopen {

::stride::LREAL SMC_CAMValue(::stride::Ctx & /*ctx__*/, ::st::SM_DriveBasic::MC_CAM_REF &CAM,
                             ::stride::LREAL dX, ::stride::BYTE byCurve, ::stride::BOOL bPeriodic) {
  const ::stride::cam::Curve curve = ::stride::cam::curveOf(CAM);
  if (curve.data == nullptr)
    return 0.0;
  uint32_t index = 0;
  const ::stride::cam::Point point = ::stride::cam::evaluateCurve(curve, dX, bPeriodic != 0, index);
  return byCurve == 0 ? point.y : byCurve == 1 ? point.v : point.a;
}

} // namespace st::SM_PLCopen
