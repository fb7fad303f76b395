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
  const uint64_t rest = room > needed ? (room - needed) / 1000 : 0;
  constexpr uint64_t kReserved = kHeartbeatBits + kEmcyBits;
  const uint64_t sdos = rest > kReserved ? (rest - kReserved) / kSdoBits : 0;
  load.sdoPerCycle = static_cast<uint32_t>(std::clamp<uint64_t>(sdos, 1, kMostSdosPerCycle));
  return load;
}

} // namespace stride::can
