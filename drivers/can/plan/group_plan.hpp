// The PDOs of all drives of a group and what they need of the bus, from the PLC configuration: for
// `stride check` and for the driver.
#ifndef STRIDE_DRIVERS_CAN_PLAN_GROUP_PLAN_HPP
#define STRIDE_DRIVERS_CAN_PLAN_GROUP_PLAN_HPP

#include "drivers/can/plan/bus_load.hpp"
#include "drivers/can/plan/pdo_plan.hpp"
#include "runtime/bus/group_check.hpp"
#include "runtime/bus/group_setup.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stride::can {

/// Who sends SYNC (SyncProducer).
enum class SyncProducer : uint8_t { Master = 0, FirstDrive = 1, Device = 2 };

/// The node of the SYNC device.
inline constexpr uint8_t kSyncDevice = 127;

struct GroupPlan {
  SyncProducer sync = SyncProducer::Master;
  uint32_t bitRate = 1000; ///< [kBit/s]
  uint32_t cycle = 0;      ///< [µs]
  std::vector<PlanResult> drives;
  std::vector<std::string> faults; ///< Of each drive: why it cannot start; empty: nothing.
  BusLoad load;
};

GroupPlan planGroup(const bus::GroupSetup &setup);

/// Appends what is wrong with a group, or not good (DriverSchema::check).
void checkGroup(const bus::GroupSetup &setup, bus::GroupFindings &findings);

} // namespace stride::can

#endif
