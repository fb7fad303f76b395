// How much of a bus the drives of an axis group need. Pure arithmetic.
#ifndef STRIDE_DRIVERS_CAN_PLAN_BUS_LOAD_HPP
#define STRIDE_DRIVERS_CAN_PLAN_BUS_LOAD_HPP

#include "drivers/can/plan/pdo_plan.hpp"

#include <cstdint>
#include <span>

namespace stride::can {

/// Bits on the wire in each cycle in the worst case, of the synchronous PDOs of a drive.
uint32_t cyclicBits(const DrivePlan &plan);

/// What a cycle needs besides PDOs, in the worst case. [bit]
inline constexpr uint32_t kSyncBits = worstBits(0);
inline constexpr uint32_t kSdoBits = 2 * worstBits(8); ///< Request and answer.
inline constexpr uint32_t kHeartbeatBits = worstBits(1);
inline constexpr uint32_t kEmcyBits = worstBits(8);

/// Above this share of the cycle the rest has too little room: a warning; above 1 an error.
inline constexpr double kComfortableShare = 0.8;
inline constexpr uint32_t kMostSdosPerCycle = 4;

struct BusLoad {
  uint32_t bits = 0;          ///< SYNC and PDOs of a cycle. [bit]
  double share = 0;           ///< Of the cycle; 1: all of it.
  uint32_t shortestCycle = 0; ///< With kComfortableShare at most, in steps of 500 µs. [µs]
  uint32_t sdoPerCycle = 1;   ///< Requests that the rest has room for, 1 … kMostSdosPerCycle.

  [[nodiscard]] bool fits() const { return share <= 1.0; }
  [[nodiscard]] bool comfortable() const { return share <= kComfortableShare; }
};

/// SDOs that fit into a cycle besides so many bits, heartbeats and an emergency: 1 …
/// kMostSdosPerCycle.
uint32_t sdosThatFit(uint64_t bitsPerCycle, uint64_t taken);

/// `bitRate` in kBit/s, `cycle` in µs; both more than 0.
BusLoad busLoad(std::span<const DrivePlan> plans, uint32_t bitRate, uint32_t cycle);

} // namespace stride::can

#endif
