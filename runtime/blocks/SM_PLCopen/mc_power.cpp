// MC_Power: regulator and brake.
#include "runtime/app/ctx.h"
#include "runtime/axis/virtual_axis.hpp"

#include "st/SM_PLCopen/MC_Power.h"

namespace axis = ::stride::axis;

void st::SM_PLCopen::MC_Power::body__(::stride::Ctx &ctx__) {
  if (Axis == nullptr) {
    Status = 0;
    Busy = 0;
    bRegulatorRealState = 0;
    bDriveStartRealState = 0;
    Error = Enable;
    ErrorID = Enable != 0 ? axis::error::kNoAxis : axis::error::kNone;
    return;
  }
  axis::AxisRef &ref = *Axis;
  const bool enabled = Enable != 0;
  const bool failed = enabled && !(ref.fTaskCycle > 0.0);
  const bool acts = enabled && !failed;
  if (acts) {
    ref.bRegulatorOn = bRegulatorOn;
    ref.bDriveStart = bDriveStart;
  }
  if (axis::isVirtual(ref))
    axis::serveVirtual(ref, ctx__.cycle);
  const auto regulator = ref.bRegulatorRealState;
  const auto brake = ref.bDriveStartRealState;
  bRegulatorRealState = regulator;
  bDriveStartRealState = brake;
  Status = acts ? regulator : ::stride::BOOL{0};
  Busy = acts && (regulator != bRegulatorOn || brake != bDriveStart);
  if (failed && Error == 0)
    axis::noteError(ref, axis::error::kTaskCycleEmpty);
  Error = failed;
  ErrorID = failed ? axis::error::kTaskCycleEmpty : axis::error::kNone;
}
