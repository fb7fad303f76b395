// What stride.toml says of a drive on a Sercos ring.
#ifndef STRIDE_DRIVERS_SERCOS_PLAN_DRIVE_SETTINGS_HPP
#define STRIDE_DRIVERS_SERCOS_PLAN_DRIVE_SETTINGS_HPP

#include "drivers/sercos/plan/cyclic_plan.hpp"
#include "drivers/sercos/plan/idn_value.hpp"
#include "drivers/sercos/plan/profile_check.hpp"
#include "runtime/common/setup_parameters.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stride::sercos {

/// The lists of parameters: phase 2, phase 3, start of phase 4.
inline constexpr size_t kLists = 3;

struct DriveSettings {
  bool io = false; ///< Device type "io".
  CyclicPlan cyclic;
  std::array<std::vector<IdnValue>, kLists> lists;
  std::vector<Idn> locked; ///< Never written by the driver.
  PackProfile profile = PackProfile::None;
  std::vector<std::string> errors; ///< What of it cannot be so.
};

/// `secondEncoder`: position feedback value 2 (S-0-0053) comes in each cycle, too.
DriveSettings driveSettings(const common::SetupParameters &given, bool secondEncoder = false);

/// Whether the driver itself writes an IDN from the times of the ring and the telegrams.
bool isOwnedByDriver(Idn idn);

} // namespace stride::sercos

#endif
