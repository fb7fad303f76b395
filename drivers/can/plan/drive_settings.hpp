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

DriveSettings driveSettings(uint8_t node, const common::SetupParameters &given);

/// "6098h := 35", "2031h:2 := UINT#16#1F4". False: `error` says why.
bool parseStartUp(std::string_view text, SdoWrite &write, std::string &error);

/// Who else decides about an object, for messages; empty: nobody.
std::string_view ownerOf(Object object);

/// "607Ah", "6099h:1", "2031h:2:16": index, subindex, bits. False: `error` says why.
bool parseEntry(std::string_view text, PdoEntry &entry, std::string &error);

} // namespace stride::can

#endif
