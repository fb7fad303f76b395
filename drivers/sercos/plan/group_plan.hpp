// The telegrams of all drives of a ring and their times, from the PLC configuration: for `stride
// check` and for the driver.
#ifndef STRIDE_DRIVERS_SERCOS_PLAN_GROUP_PLAN_HPP
#define STRIDE_DRIVERS_SERCOS_PLAN_GROUP_PLAN_HPP

#include "drivers/sercos/plan/drive_settings.hpp"
#include "drivers/sercos/protocol/timing.hpp"
#include "runtime/bus/group_check.hpp"
#include "runtime/bus/group_setup.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stride::sercos {

/// An encoder of the group: the second one of a drive.
struct EncoderPlan {
  size_t drive = 0;  ///< Whose; as many as there are drives: it has none.
  std::string fault; ///< Why it cannot be read; empty: nothing.
};

struct GroupPlan {
  uint32_t megabits = 2; ///< [MBit/s]
  uint32_t cycle = 0;    ///< [µs]
  uint32_t light = 0;    ///< wParam2, LedBrightness.
  std::vector<DriveSettings> drives;
  std::vector<std::string> faults; ///< Of each drive: why it cannot start; empty: nothing.
  std::vector<EncoderPlan> encoders;
  std::string fault; ///< Of the ring as a whole.
  RingTiming timing; ///< With what drives have usually; start-up asks them.
};

GroupPlan planGroup(const bus::GroupSetup &setup);

/// Appends what is wrong with a group, or not good (DriverSchema::check).
void checkGroup(const bus::GroupSetup &setup, bus::GroupFindings &findings);

/// Telegrams and their times, as text (DriverSchema::plan).
bus::GroupPlanText describeGroup(const bus::GroupSetup &setup);

} // namespace stride::sercos

#endif
