// MC_SetOverride: factors on the limits of an axis's commands.
#include "runtime/axis/command.hpp"

#include "st/SM_PLCopen/MC_SetOverride.h"

namespace {

/// Not so with NaN.
bool isFactor(double x) noexcept { return x >= 0.0 && x <= 1.0; }

} // namespace

void st::SM_PLCopen::MC_SetOverride::body__(::stride::Ctx & /*ctx__*/) {
  namespace error = ::stride::axis::error;
  ErrorID = error::kNone;
  if (Enable != 0 && Axis == nullptr)
    ErrorID = error::kNoAxis;
  else if (Enable != 0 && !(isFactor(VelFactor) && isFactor(AccFactor) && isFactor(JerkFactor) &&
                            AccFactor > 0.0 && JerkFactor > 0.0))
    ErrorID = error::kOverride;
  Error = ErrorID != error::kNone;
  Busy = Enabled = Enable != 0 && Error == 0;
  if (Enabled == 0 || (Axis->fVelocityFactor == VelFactor &&
                       Axis->fAccelerationFactor == AccFactor && Axis->fJerkFactor == JerkFactor))
    return;
  Axis->fVelocityFactor = VelFactor;
  Axis->fAccelerationFactor = AccFactor;
  Axis->fJerkFactor = JerkFactor;
  ++Axis->ulOverrideCount;
  ::stride::motion::applyOverrides(*Axis);
}
