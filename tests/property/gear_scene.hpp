// A master and a slave without a drive, cycle by cycle. The master's positions are whole numbers of
// ticks, so that what a slave must do can be computed without rounding.
#ifndef STRIDE_TESTS_PROPERTY_GEAR_SCENE_HPP
#define STRIDE_TESTS_PROPERTY_GEAR_SCENE_HPP

#include "runtime/app/ctx.h"
#include "runtime/axis/axis_ref.hpp"

#include "tests/support/fresh.hpp"

#include <cmath>
#include <cstdint>

namespace stride::test {

__extension__ using Wide = __int128;

inline constexpr double kGearCycle = 0.001;
inline constexpr double kTick = 1.0 / 1024;

inline axis::AxisRef poweredAxis(double period) {
  auto ref = fresh<axis::AxisRef>();
  ref.bCommunication = 1;
  ref.wCommunicationState = axis::kNormalOperation;
  ref.bRegulatorOn = ref.bDriveStart = ref.bRegulatorRealState = ref.bDriveStartRealState = 1;
  ref.fTaskCycle = kGearCycle;
  ref.iMovementType = period > 0 ? 0 : 1;
  if (period > 0)
    ref.fPositionPeriod = period;
  ref.nAxisState = axis::state::kStandstill;
  return ref;
}

/// The rest of `a` in 0 <= rest < b.
inline Wide positiveRest(Wide a, Wide b) {
  const Wide rest = a % b;
  return rest < 0 ? rest + b : rest;
}

/// A master that is moved by whole ticks.
struct TickMaster {
  axis::AxisRef ref;
  int64_t period; ///< In ticks; 0: linear.
  int64_t ticks = 0;

  explicit TickMaster(int64_t thePeriod)
      : ref(poweredAxis(static_cast<double>(thePeriod) * kTick)), period(thePeriod) {}

  void show() {
    ref.fSetPosition = static_cast<double>(
                           period > 0 ? static_cast<int64_t>(positiveRest(ticks, period)) : ticks) *
                       kTick;
  }

  /// One cycle further. The velocity is the mean one, so that turns can be counted.
  void step(int64_t way) {
    ticks += way;
    show();
    const double velocity = static_cast<double>(way) * kTick / kGearCycle;
    ref.fSetAcceleration = (velocity - ref.fSetVelocity) / kGearCycle;
    ref.fSetVelocity = velocity;
  }
};

} // namespace stride::test

#endif
