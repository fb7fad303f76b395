// What the master is told about a drive.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_DRIVE_CONFIG_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_DRIVE_CONFIG_HPP

#include "drivers/sercos/plan/drive_settings.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace stride::sercos {

/// At least one. `seconds` and `cycle` in [s].
inline uint32_t cyclesOf(double seconds, double cycle) {
  constexpr double kMost = 4e9;
  const double cycles = cycle > 0 ? seconds / cycle + 0.5 : 1;
  return static_cast<uint32_t>(std::clamp(cycles, 1.0, kMost));
}

struct DriveConfig {
  uint8_t address = 1;  ///< wDriveId.
  double cycle = 0.003; ///< [s]
  DriveSettings settings;
  std::vector<IdnValue> file;     ///< Of its parameter file: written as soon as a phase allows it.
  bool rotary = false;            ///< Else linear.
  double period = 0;              ///< Of a rotary axis. [inc]
  double torqueRated = 100;       ///< What 100 % are. [Nm]
  bool homesItself = true;        ///< S-0-0148 makes the reference run of MC_Home.
  uint8_t probeInputs = 0;        ///< Bit n: input n of DriveStatus.
  uint32_t serviceTimeout = 10;   ///< For a step of the service channel. [telegrams]
  uint32_t commandTimeout = 1000; ///< For S-0-0127 and S-0-0128. [cycles]
  uint32_t powerTimeout = 600;    ///< [cycles]
  uint32_t modeTimeout = 200;     ///< [cycles]
};

/// Modes that the drive can be switched between, in the order of S-0-0032, S-0-0033, S-0-0034:
/// controller modes; 0: there is none.
struct ModeList {
  std::array<uint8_t, 3> modes{};

  /// The place of a controller mode; their number: it is not among them.
  [[nodiscard]] size_t placeOf(uint8_t controllerMode) const {
    return static_cast<size_t>(std::find(modes.begin(), modes.end(), controllerMode) -
                               modes.begin());
  }
};

/// Positions first, then velocities, then torques, as far as command values allow them.
inline ModeList modeListOf(uint8_t controllerModes) {
  ModeList list;
  size_t count = 0;
  for (const uint8_t mode : {kPositionControl, kVelocityControl, kTorqueControl})
    if ((controllerModes >> mode & 1U) != 0)
      list.modes[count++] = mode;
  return list;
}

} // namespace stride::sercos

#endif
