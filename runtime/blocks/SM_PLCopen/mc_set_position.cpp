// MC_SetPosition: shifts the zero point of an axis.
#include "runtime/axis/shift_position.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_PLCopen/MC_SetPosition.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
using Block = ::st::SM_PLCopen::MC_SetPosition;
using axis::AxisRef;

constexpr double kLinearRange = 0x1p46;

/// An SMC_ERROR.
int16_t setPosition(const Block &block, AxisRef &ref) noexcept {
  if (ref.bRealDrive != 0 && ref.wCommunicationState != axis::kNormalOperation)
    return axis::error::kNotReady;
  const double target = block.Mode != 0 ? ref.fSetPosition + block.Position : block.Position;
  if (!exact::isfinite(target))
    return axis::error::kOutOfRange;
  if (axis::isRotary(ref)) {
    const double place = stride::numeric::wrapPosition(target, ref.fPositionPeriod);
    axis::shiftPosition(ref, place - ref.fSetPosition);
    ref.fSetPosition = place;
    return axis::error::kNone;
  }
  const double increments = target * static_cast<double>(ref.dwRatioTechUnitsDenom) /
                            static_cast<double>(ref.iRatioTechUnitsNum);
  if (!(exact::fabs(increments) < kLinearRange))
    return axis::error::kOutOfRange;
  axis::shiftPosition(ref, target - ref.fSetPosition);
  ref.fSetPosition = target;
  return axis::error::kNone;
}

} // namespace

void st::SM_PLCopen::MC_SetPosition::body__(::stride::Ctx & /*ctx__*/) {
  const bool rising = Execute != 0 && bExecuteOld == 0;
  bExecuteOld = Execute;
  if (rising) {
    ErrorID = Axis == nullptr ? axis::error::kNoAxis : setPosition(*this, *Axis);
    Error = ErrorID != axis::error::kNone;
    Done = Error == 0;
    if (Error != 0 && Axis != nullptr)
      axis::noteError(*Axis, ErrorID);
  } else if (Execute == 0) {
    Done = 0;
    Error = 0;
    ErrorID = axis::error::kNone;
  }
  Busy = 0;
}
