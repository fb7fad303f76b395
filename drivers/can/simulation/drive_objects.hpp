// The objects of a simulated drive. [CiA 402]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_DRIVE_OBJECTS_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_DRIVE_OBJECTS_HPP

#include "drivers/can/simulation/canopen_node.hpp"

#include <array>
#include <cstdint>

namespace stride::can::simulation {

// Modes of operation, 6060h.
inline constexpr int8_t kProfileVelocity = 3;
inline constexpr int8_t kProfileTorque = 4;
inline constexpr int8_t kHomingMode = 6;
inline constexpr int8_t kInterpolatedPosition = 7;
inline constexpr int8_t kSyncPosition = 8;
inline constexpr int8_t kSyncVelocity = 9;
inline constexpr int8_t kSyncTorque = 10;

// What a device that is several drives has for each. [CiA 301, logical devices; CiA 402]
inline constexpr uint16_t kProfileObjects = 0x6000;
inline constexpr uint16_t kAxisObjects = 0x0800;
inline constexpr uint16_t kAxisPdos = 64;

/// 6065h: the following error is not watched.
inline constexpr uint64_t kNoWindow = 0xFFFFFFFF;

struct Drive402Setup;

/// Everything about the device; with a number of PDOs of each direction of four for each axis.
DeviceRows driveRows(const Drive402Setup &setup);

/// Bits of 6502h for the modes of a drive, with torque or without.
uint32_t supportedModes(bool torque);

/// The objects of an axis, as if it were the first one.
struct AxisObjects {
  Dictionary &all;
  uint16_t shift = 0;

  [[nodiscard]] Entry &at(uint16_t index, uint8_t sub = 0) const {
    return all.at(static_cast<uint16_t>(index + shift), sub);
  }
};

/// The objects that are in use all the time.
struct DriveObjects {
  explicit DriveObjects(const AxisObjects &d);

  Entry &errorCode;
  Entry &controlword;
  Entry &statusword;
  Entry &mode;
  Entry &modeDisplay;
  Entry &positionDemand;
  Entry &positionInternal;
  Entry &position;
  Entry &followingWindow;
  Entry &followingTime;
  Entry &velocityDemand;
  Entry &velocity;
  Entry &targetTorque;
  Entry &torqueDemand;
  Entry &torque;
  Entry &current;
  Entry &targetPosition;
  Entry &lowestPosition;
  Entry &highestPosition;
  Entry &acceleration;
  Entry &deceleration;
  Entry &quickDeceleration;
  Entry &torqueSlope;
  Entry &positionOffset;
  Entry &velocityOffset;
  Entry &torqueOffset;
  Entry &probeFunction;
  Entry &probeStatus;
  std::array<Entry *, 4> probePosition;
  Entry &interpolationData;
  Entry &interpolationTime;
  Entry &interpolationExponent;
  Entry &followingError;
  Entry &inputs;
  Entry &targetVelocity;
  Entry &abortOption;
  Entry &quickStopOption;
  Entry &shutdownOption;
  Entry &disableOption;
  Entry &haltOption;
  Entry &faultOption;
  Entry &homingMethod;
  Entry &homingFast;
  Entry &homingSlow;
  Entry &homingAcceleration;
  Entry &homeOffset;
  Entry &outputs;
  Entry &outputMask;
  Entry &mostTorque;
  Entry &secondPosition;
  Entry &supportedModes;
};

} // namespace stride::can::simulation

#endif
