#include "drivers/sercos/protocol/timing.hpp"

#include <algorithm>
#include <array>

namespace stride::sercos {
namespace {

/// The largest of a member.
uint32_t most(std::span<const DriveTiming> drives, uint32_t DriveTiming::*member) {
  uint32_t result = 0;
  for (const DriveTiming &drive : drives)
    result = std::max(result, drive.*member);
  return result;
}

uint32_t shortestCycleFor(uint32_t neededUs) {
  constexpr std::array<uint32_t, 4> kShort = {62, 125, 250, 500};
  for (const uint32_t cycle : kShort)
    if (neededUs <= cycle)
      return cycle;
  const uint32_t cycle = (neededUs + 999) / 1000 * 1000;
  return isCycle(cycle) ? cycle : 0;
}

/// The ATs, one after the other; where the last one ends. [µs]
uint32_t placeAts(std::span<const DriveTiming> drives, uint32_t megabits,
                  std::span<DriveSlot> slots) {
  uint32_t end = 0;
  uint32_t recovery = 0;
  for (size_t i = 0; i < drives.size(); ++i) {
    const DriveTiming &drive = drives[i];
    const uint32_t earliest = i == 0 ? 0 : end + recovery + 2 * kJitterUs;
    const uint32_t start = std::max(drive.shortestAtStart + kJitterUs, earliest);
    slots[i].atStart = static_cast<uint16_t>(std::min<uint32_t>(start, UINT16_MAX));
    end = start + telegramUs(drive.atBytes, megabits);
    recovery = drive.atToAt;
  }
  return end;
}

} // namespace

RingTiming planRing(std::span<const DriveTiming> drives, uint32_t megabits, uint32_t cycleUs,
                    std::span<DriveSlot> slots) {
  RingTiming plan;
  for (size_t i = 0; i < drives.size(); ++i) {
    slots[i].placeInMdt = static_cast<uint16_t>(std::min<uint32_t>(1 + plan.mdtLength, UINT16_MAX));
    plan.mdtLength += drives[i].mdtBytes;
  }
  plan.mdtLength = std::max<uint32_t>(plan.mdtLength, 4); // the least that there is
  plan.mdtStart =
      placeAts(drives, megabits, slots) + most(drives, &DriveTiming::atToMdt) + 2 * kJitterUs;
  const uint32_t mdtEnd = plan.mdtStart + telegramUs(plan.mdtLength, megabits) + kJitterUs;
  const uint32_t mst = telegramUs(kMstDataBytes, megabits) + kJitterUs;
  const uint32_t feedback = most(drives, &DriveTiming::feedback);
  const uint32_t processed = mdtEnd + most(drives, &DriveTiming::processing) + 1;
  plan.neededUs =
      std::max({mdtEnd + most(drives, &DriveTiming::mdtToMst) + mst, processed, feedback});
  plan.shortestCycle = shortestCycleFor(plan.neededUs);
  plan.commandValid = cycleUs;
  plan.feedback = cycleUs > feedback ? cycleUs - feedback : 0;
  plan.fits = plan.neededUs <= cycleUs && cycleUs <= UINT16_MAX;
  return plan;
}

} // namespace stride::sercos
