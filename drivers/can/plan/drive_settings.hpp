// What stride.toml gives a drive besides the plan: objects that are written at start-up, and PDOs
// of its own. Texts, read for the compiler and for the master alike.
#ifndef STRIDE_DRIVERS_CAN_PLAN_DRIVE_SETTINGS_HPP
#define STRIDE_DRIVERS_CAN_PLAN_DRIVE_SETTINGS_HPP

#include "drivers/can/plan/pdo_plan.hpp"
#include "runtime/common/setup_parameters.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stride::can {

/// `[[….drive]]`'s `startup` and its tables `rpdo1` … `tpdo4`.
struct DriveSettings {
  std::vector<SdoWrite> startup;
  std::vector<Pdo> rpdos; ///< By their numbers; empty: those of the plan.
  std::vector<Pdo> tpdos;
  /// What cannot be read or cannot be: a sentence each, which names the entry.
  std::vector<std::string> errors;
};

/// `axis`: of the device that the drive is, as `axis` says.
DriveSettings driveSettings(uint8_t node, const common::SetupParameters &given, uint8_t axis = 0);

/// "6098h := 35", "2031h:2 := UINT#16#1F4"; the object is that of the device. False: `error` says
/// why.
bool parseStartUp(std::string_view text, SdoWrite &write, std::string &error, uint8_t axis = 0);

/// Who else decides about an object of the device, for messages; empty: nobody.
std::string_view ownerOf(Object object, uint8_t axis = 0);

/// Why a drive that is that axis has nothing to do with an object of the device; empty: it may.
std::string foreignAxis(Object object, uint8_t axis);

/// "607Ah", "6099h:1", "2031h:2:16": index, subindex, bits; the entry's object is that of the first
/// axis. False: `error` says why.
bool parseEntry(std::string_view text, PdoEntry &entry, std::string &error, uint8_t axis = 0);

} // namespace stride::can

#endif
