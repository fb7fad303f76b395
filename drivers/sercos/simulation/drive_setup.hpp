// What a simulated Sercos drive is made of.
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATION_DRIVE_SETUP_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATION_DRIVE_SETUP_HPP

#include "drivers/dummy/drive_parameters.hpp"
#include "drivers/sercos/simulation/device.hpp"

#include "st/DummyDrive/DUMMY_DRIVE_SIM.h"

#include <string_view>
#include <vector>

namespace stride::sercos::simulation {

/// What programs see of the simulation and disturb it with.
using DriveSim = ::st::DummyDrive::DUMMY_DRIVE_SIM;

/// What a unit of torque is, of the rated one: 0.1 %. [S-0-0086]
inline constexpr double kTorqueUnit = 0.001;

struct DriveSetup {
  DeviceSetup device{};
  dummy::DriveParameters drive{};
  double incrementsPerTurn = 1 << 20; ///< Of the mechanics, in a turn of the motor.
  double incrementsPerMetre = 1e7;    ///< Of the mechanics, for linear scaling.
  double ratedTorque = 1;             ///< 100.0 % of S-0-0080, S-0-0084. [Nm]
  /// IDNs that it has besides: those of the standard go before them.
  std::vector<IdnRow> more{};
};

// IDNs of the maker of the simulated devices.
inline constexpr Idn kSwitches =
    kProductBit | 1; ///< P-0-0001, bits 0 … 2: negative, positive, home.
inline constexpr Idn kIndexPosition = kProductBit | 2;   ///< P-0-0002: at the last index pulse.
inline constexpr Idn kIndexCount = kProductBit | 3;      ///< P-0-0003: index pulses so far; wraps.
inline constexpr Idn kDigitalOutputs = kProductBit | 16; ///< P-0-0016 of an I/O device.
inline constexpr Idn kDigitalInputs = kProductBit | 17;  ///< P-0-0017 of an I/O device.

/// Rows of a drive, besides those of communication.
std::vector<IdnRow> driveRows(const DriveSetup &setup);

} // namespace stride::sercos::simulation

#endif
