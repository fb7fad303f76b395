// MC_Power: regulator and brake.
#include "runtime/axis/axis_ref.hpp"

#include "st/SM_PLCopen/MC_Power.h"

namespace axis = ::stride::axis;

void st::SM_PLCopen::MC_Power::body__(::stride::Ctx & /*ctx__*/) {
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
  bRegulatorRealState = Axis->bRegulatorRealState;
  bDriveStartRealState = Axis->bDriveStartRealState;
  if (Enable == 0)
    return;
  if (!(Axis->fTaskCycle > 0.0)) {
    Error = 1;
    ErrorID = axis::error::kTaskCycleEmpty;
    axis::noteError(*Axis, ErrorID);
    return;
  }
  Axis->bRegulatorOn = bRegulatorOn;
  Axis->bDriveStart = bDriveStart;
  Status = bRegulatorRealState != 0 && bDriveStartRealState != 0;
  Busy = bRegulatorRealState != bRegulatorOn || bDriveStartRealState != bDriveStart;
}
