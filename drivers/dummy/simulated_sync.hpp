// The SYNC of a simulated bus.
#ifndef STRIDE_DRIVERS_DUMMY_SIMULATED_SYNC_HPP
#define STRIDE_DRIVERS_DUMMY_SIMULATED_SYNC_HPP

#include "runtime/bus/axis_driver.hpp"
#include "runtime/bus/group_setup.hpp"

#include <cstdint>

namespace stride::dummy {

/// SYNC number n comes at offset + n * period of the program's time, unless it is lost.
class SimulatedSync {
public:
  explicit SimulatedSync(const bus::GroupSetup &setup);

  /// AxisDriver::waitSync.
  bus::SyncWake wait(int64_t afterNs, int64_t deadlineNs, bus::BusClock &clock);

  /// How long the SYNC that the present cycle should have had is missing; 0: it has come. [us]
  [[nodiscard]] uint32_t missingUs() const { return missingUs_; }

private:
  [[nodiscard]] int64_t timeOf(int64_t number) const { return offset_ + number * period_; }
  [[nodiscard]] bool isLost(int64_t number) const {
    return lost_ != 0 && number % lost_ == lost_ - 1;
  }
  [[nodiscard]] int64_t after(int64_t timeNs) const;

  int64_t period_; ///< [ns]
  int64_t offset_; ///< [ns]
  int64_t lost_;   ///< One of so many; 0: none.
  uint32_t missingUs_ = 0;
};

} // namespace stride::dummy

#endif
