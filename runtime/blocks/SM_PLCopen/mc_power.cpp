// MC_Power: regulator and brake.
#include "runtime/app/ctx.h"
#include "runtime/axis/virtual_axis.hpp"

#include "st/SM_PLCopen/MC_Power.h"

namespace axis = ::stride::axis;

void st::SM_PLCopen::MC_Power::body__(::stride::Ctx &ctx__) {
  const bool failed = Error != 0;
  Status = 0;
  Error = 0;
  ErrorID = axis::error::kNone;
  Busy = 0;
  bRegulatorRealState = 0;
  bDriveStartRealState = 0;
  if (Axis == nullptr) {
    Error = Enable;
    ErrorID = Enable != 0 ? axis::error::kNoAxis : axis::error::kNone;
    return;
  }
  const bool acts = Enable != 0 && Axis->fTaskCycle > 0.0;
  if (acts) {
    Axis->bRegulatorOn = bRegulatorOn;
    Axis->bDriveStart = bDriveStart;
  }
  if (axis::isVirtual(*Axis))
    axis::serveVirtual(*Axis, ctx__.cycle);
  bRegulatorRealState = Axis->bRegulatorRealState;
  bDriveStartRealState = Axis->bDriveStartRealState;
  if (Enable == 0)
    return;
  if (!(Axis->fTaskCycle > 0.0)) {
    Error = 1;
    ErrorID = axis::error::kTaskCycleEmpty;
    if (!failed)
      axis::noteError(*Axis, ErrorID);
    return;
  }
  Status = bRegulatorRealState;
  Busy = bRegulatorRealState != bRegulatorOn || bDriveStartRealState != bDriveStart;
}
