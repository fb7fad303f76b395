// The PDOs of all drives of a group and what they need of the bus, from the PLC configuration: for
// `stride check` and for the driver.
#ifndef STRIDE_DRIVERS_CAN_PLAN_GROUP_PLAN_HPP
#define STRIDE_DRIVERS_CAN_PLAN_GROUP_PLAN_HPP

#include "drivers/can/plan/bus_load.hpp"
#include "drivers/can/plan/drive_settings.hpp"
#include "drivers/can/plan/io_plan.hpp"
#include "drivers/can/plan/pdo_plan.hpp"
#include "runtime/bus/group_check.hpp"
#include "runtime/bus/group_setup.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stride::can {

/// Who sends SYNC (SyncProducer).
enum class SyncProducer : uint8_t { Master = 0, FirstDrive = 1, Device = 2 };

/// The node of the SYNC device.
inline constexpr uint8_t kSyncDevice = 127;

/// An encoder of the group: a node, or the second encoder of a drive.
struct EncoderPlan {
  static constexpr size_t kNode = static_cast<size_t>(-1);

  DrivePlan plan;
  std::vector<SdoWrite> startup;
  size_t drive = kNode; ///< Whose second encoder it is.
  std::string fault;    ///< Why it cannot be read; empty: nothing.
};

struct GroupPlan {
  SyncProducer sync = SyncProducer::Master;
  uint32_t bitRate = 1000; ///< [kBit/s]
  uint32_t cycle = 0;      ///< [µs]
  std::vector<PlanResult> drives;
  std::vector<DriveSettings> settings; ///< Of each drive.
  std::vector<std::string> faults;     ///< Of each drive: why it cannot start; empty: nothing.
  std::vector<EncoderPlan> encoders;
  std::vector<IoPlan> ios; ///< Their `fault` also says what other nodes make impossible.
  BusLoad load;
};

/// Which axis of its device a drive is.
uint8_t axisOfDrive(const bus::DriveSetup &drive);

/// The place of the first drive of the group that is the same device; its own: it is that.
size_t deviceOf(const bus::GroupSetup &setup, size_t drive);

/// BaudRate, or the usual one. [kBit/s]
uint32_t bitRateOf(const bus::GroupSetup &setup);

GroupPlan planGroup(const bus::GroupSetup &setup);

/// Gives the PDOs of further axes of devices identifiers that nobody else of the group has.
void addCobIds(const bus::GroupSetup &setup, GroupPlan &plan);

/// Appends what is wrong with a group, or not good (DriverSchema::check).
void checkGroup(const bus::GroupSetup &setup, bus::GroupFindings &findings);

/// PDOs, their bits and the share of the bus, as text, and a concise DCF for each drive
/// (DriverSchema::plan).
bus::GroupPlanText describeGroup(const bus::GroupSetup &setup);

/// The place of a drive in the group; their number: there is none of that name.
size_t driveNamed(const bus::GroupSetup &setup, std::string_view name);

/// "1.5 ms", "21.7 %".
std::string milliseconds(uint32_t us);
std::string percent(double share);

} // namespace stride::can

#endif
