#include "drivers/dummy/simulated_sync.hpp"

#include "runtime/iec/math.h"

namespace stride::dummy {
namespace {

int64_t nanoseconds(double seconds) {
  return static_cast<int64_t>(stride::floor(seconds * 1e9 + 0.5));
}

} // namespace

SimulatedSync::SimulatedSync(const bus::GroupSetup &setup)
    : period_(nanoseconds(setup.cycleSeconds)),
      offset_(nanoseconds(setup.parameters.number("simulation.sync_offset"))),
      lost_(static_cast<int64_t>(setup.parameters.number("simulation.sync_lost"))) {
  if (period_ <= 0)
    period_ = 1;
}

/// Number of the first one after that time that is not lost.
int64_t SimulatedSync::after(int64_t timeNs) const {
  const int64_t number = timeNs < offset_ ? 0 : (timeNs - offset_) / period_ + 1;
  return isLost(number) ? number + 1 : number; // at least every other one comes
}

bus::SyncWake SimulatedSync::wait(int64_t afterNs, int64_t deadlineNs, bus::BusClock &clock) {
  const int64_t first = after(afterNs);
  const int64_t now = clock.nowNs();
  missingUs_ = 0;
  if (timeOf(first) > now) {
    if (timeOf(first) > deadlineNs) {
      clock.sleepUntil(deadlineNs);
      missingUs_ = static_cast<uint32_t>((deadlineNs - (afterNs < 0 ? 0 : afterNs)) / 1000);
      return {deadlineNs};
    }
    clock.sleepUntil(timeOf(first));
    return {timeOf(first), true};
  }
  // Some have come meanwhile.
  int64_t last = (now - offset_) / period_;
  if (isLost(last))
    --last;
  const int64_t lostBetween = lost_ == 0 ? 0 : last / lost_ - first / lost_;
  return {timeOf(last), true, static_cast<uint64_t>(last - first - lostBetween)};
}

} // namespace stride::dummy
