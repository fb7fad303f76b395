// The times of the telegrams: the conditions that drives' manuals print, and a count by hand.
#include "drivers/sercos/protocol/timing.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

namespace stride::sercos {
namespace {

TEST(SercosTiming, BitsOfATelegram) {
  // Flags 16; address 8, data, checksum 16: 6/5 of them.
  EXPECT_EQ(telegramBits(1), 16U + 39U); // 32 bits and 7 stuffed
  EXPECT_EQ(telegramBits(0), 16U + 29U);
  EXPECT_EQ(telegramBits(8), 16U + 106U); // 88 and 18
  EXPECT_EQ(telegramUs(8, 2), 61U);
  EXPECT_EQ(telegramUs(8, 4), 31U); // 30.5
  EXPECT_EQ(telegramUs(8, 16), 8U); // 7.6
}

TEST(SercosTiming, Speeds) {
  for (uint32_t baud = 0; baud < 40; ++baud)
    EXPECT_EQ(isBaudRate(baud), baud == 2 || baud == 4 || baud == 8 || baud == 16);
  for (const uint32_t good : {62U, 125U, 250U, 500U, 1000U, 3000U, 65000U})
    EXPECT_TRUE(isCycle(good)) << good;
  for (const uint32_t bad : {0U, 61U, 63U, 124U, 375U, 750U, 999U, 1001U, 1500U, 66000U})
    EXPECT_FALSE(isCycle(bad)) << bad;
}

/// Four drives with positions, 3 ms and 2 MBit/s: the configuration of the manual's 11.2.
TEST(SercosTiming, FourDrives) {
  const std::vector<DriveTiming> drives(4, {.atBytes = 8, .mdtBytes = 8});
  std::vector<DriveSlot> slots(4);
  const RingTiming plan = planRing(drives, 2, 3000, slots);
  EXPECT_TRUE(plan.fits);
  EXPECT_EQ(plan.mdtLength, 32U);
  // 13; then 61 of the telegram, 4 to recover, 2 of trembling.
  EXPECT_EQ(slots[0].atStart, 13);
  EXPECT_EQ(slots[1].atStart, 80);
  EXPECT_EQ(slots[3].atStart, 214);
  EXPECT_EQ(slots[0].placeInMdt, 1);
  EXPECT_EQ(slots[3].placeInMdt, 25);
  EXPECT_EQ(plan.mdtStart, 214U + 61U + 12U + 2U);
  EXPECT_EQ(plan.commandValid, 3000U);
  EXPECT_EQ(plan.feedback, 2800U);
  // MDT: 16 + 280 + 56 bits: 176; MST: 55 bits: 28.
  EXPECT_EQ(plan.neededUs, 289U + 176U + 1U + 50U + 28U + 1U);
  EXPECT_EQ(plan.shortestCycle, 1000U);
  std::vector<DriveSlot> same(4);
  EXPECT_TRUE(planRing(drives, 2, 545, same).fits);
  EXPECT_FALSE(planRing(drives, 2, 544, same).fits) << "one microsecond is missing";
}

TEST(SercosTiming, TooMany) {
  const std::vector<DriveTiming> drives(254, {.atBytes = 36, .mdtBytes = 36});
  std::vector<DriveSlot> slots(254);
  const RingTiming plan = planRing(drives, 2, 10000, slots);
  EXPECT_FALSE(plan.fits);
  EXPECT_EQ(plan.shortestCycle, 0U) << "more than the 65 ms that S-0-0002 can say";
  EXPECT_FALSE(planRing(drives, 16, 13000, slots).fits);
  EXPECT_TRUE(planRing(drives, 16, 14000, slots).fits);
  const RingTiming none = planRing({}, 4, 1000, {});
  EXPECT_TRUE(none.fits);
  EXPECT_EQ(none.mdtLength, 4U);
}

RC_GTEST_PROP(SercosTiming, KeepsTheConditionsOfDrives, ()) {
  const auto any = [](uint32_t low, uint32_t high) { return *rc::gen::inRange(low, high + 1); };
  std::vector<DriveTiming> drives(any(1, 40));
  for (DriveTiming &drive : drives)
    drive = {any(2, 18) * 2, any(2, 18) * 2, any(0, 60), any(0, 60),
             any(0, 400),    any(0, 30),     any(0, 80), any(0, 120)};
  const uint32_t baud = 1U << any(1, 4);
  std::vector<DriveSlot> slots(drives.size());
  const uint32_t shortest = planRing(drives, baud, 1000, slots).shortestCycle;
  RC_PRE(shortest != 0U);
  const RingTiming plan = planRing(drives, baud, shortest, slots);
  RC_ASSERT(plan.fits);
  uint32_t end = 0;
  uint32_t place = 1;
  const uint32_t mdt = telegramUs(plan.mdtLength, baud);
  for (size_t i = 0; i < drives.size(); ++i) {
    const DriveTiming &drive = drives[i];
    RC_ASSERT(slots[i].atStart > drive.shortestAtStart);
    RC_ASSERT(slots[i].atStart > end);
    end = slots[i].atStart + telegramUs(drive.atBytes, baud);
    RC_ASSERT(end + drive.atToMdt < plan.mdtStart);
    RC_ASSERT(uint32_t{slots[i].placeInMdt} == place);
    place += drive.mdtBytes;
    RC_ASSERT(plan.mdtStart + mdt + drive.processing < plan.commandValid);
    RC_ASSERT(plan.mdtStart + mdt + drive.mdtToMst + telegramUs(1, baud) < shortest);
    RC_ASSERT(plan.feedback + drive.feedback <= shortest);
  }
  RC_ASSERT(place - 1 == plan.mdtLength);
}

} // namespace
} // namespace stride::sercos
