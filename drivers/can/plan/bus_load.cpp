#include "drivers/can/plan/bus_load.hpp"

#include <algorithm>

namespace stride::can {
namespace {

constexpr uint64_t kStep = 500; // µs

uint32_t synchronousBits(std::span<const Pdo> pdos) {
  uint32_t bits = 0;
  for (const Pdo &pdo : pdos)
    if (pdo.synchronous())
      bits += worstBits(pdo.length());
  return bits;
}

} // namespace

uint32_t cyclicBits(const DrivePlan &plan) {
  return synchronousBits(plan.receivedByDrive()) + synchronousBits(plan.sentByDrive());
}

BusLoad busLoad(std::span<const DrivePlan> plans, uint32_t bitRate, uint32_t cycle) {
  BusLoad load;
  load.bits = kSyncBits;
  for (const DrivePlan &plan : plans)
    load.bits += cyclicBits(plan);
  // 1 kBit/s is a bit in 1000 µs. Whole numbers, so that exactly 80 % are 80 %.
  const uint64_t room = uint64_t{bitRate} * cycle; // [bit/1000]
  const uint64_t needed = uint64_t{load.bits} * 1000;
  load.share = static_cast<double>(needed) / static_cast<double>(room);
  const uint64_t perStep = bitRate * kStep * 4; // comfortable: four fifths
  const uint64_t steps = (needed * 5 + perStep - 1) / perStep;
  load.shortestCycle = static_cast<uint32_t>(std::min<uint64_t>(steps * kStep, UINT32_MAX));
  load.sdoPerCycle = sdosThatFit(room / 1000, load.bits);
  return load;
}

uint32_t sdosThatFit(uint64_t bitsPerCycle, uint64_t taken) {
  constexpr uint64_t kReserved = kHeartbeatBits + kEmcyBits;
  const uint64_t rest = bitsPerCycle > taken + kReserved ? bitsPerCycle - taken - kReserved : 0;
  return static_cast<uint32_t>(std::clamp<uint64_t>(rest / kSdoBits, 1, kMostSdosPerCycle));
}

} // namespace stride::can
