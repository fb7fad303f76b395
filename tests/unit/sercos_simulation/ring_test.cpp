// The ring: light, speeds, telegrams that are lost, wrong, or in each other's way.
#include "tests/unit/sercos_simulation/ring_master.hpp"

namespace stride::sercos::simulation {
namespace {

struct Four {
  Four() {
    constexpr uint8_t kAddresses[] = {9, 2, 200, 254}; // not in the order of the ring
    for (const uint8_t address : kAddresses) {
      drives.push_back(std::make_unique<SimulatedDrive>(plainDrive(address)));
      master.ring.attach(*drives.back());
      master.records[address];
    }
  }
  RingMaster master;
  std::vector<std::unique_ptr<SimulatedDrive>> drives;
};

TEST(SercosRing, FourDrivesMove) {
  Four four;
  RingMaster &master = four.master;
  master.toPhase4();
  EXPECT_EQ(master.answers.count, 4U);
  int32_t target = 777;
  for (const auto &[address, record] : master.records) {
    master.powerOn(address);
    master.setTarget(address, target += 111);
  }
  master.cycle(3);
  target = 777;
  for (const auto &[address, record] : master.records)
    EXPECT_EQ(master.actual(address), target += 111);
}

TEST(SercosRing, WhereItIsOpen) {
  for (size_t before = 0; before <= 4; ++before) {
    Four four;
    RingMaster &master = four.master;
    master.toPhase4();
    master.ring.faults() = {.open = true, .openBefore = before};
    master.cycle(5);
    EXPECT_FALSE(master.answers.light);
    EXPECT_FALSE(master.answers.mstReturned);
    EXPECT_EQ(master.answers.count, 0U);
    for (size_t i = 0; i < 4; ++i)
      EXPECT_EQ(four.drives[i]->phase(), i < before ? Phase::Four : Phase::Zero) << before;
    master.ring.faults().open = false;
    master.toPhase4();
    EXPECT_EQ(master.answers.count, 4U) << "mended";
  }
}

TEST(SercosRing, ADriveWithoutSupplyOpensIt) {
  Four four;
  RingMaster &master = four.master;
  master.toPhase4();
  four.drives[1]->faults().off = true;
  master.cycle(5);
  EXPECT_FALSE(master.answers.light);
  EXPECT_EQ(four.drives[0]->phase(), Phase::Four);
  EXPECT_EQ(four.drives[1]->phase(), Phase::Zero);
  EXPECT_EQ(four.drives[2]->phase(), Phase::Zero);
}

TEST(SercosRing, ADriveThatLeavesDoesNot) {
  Four four;
  RingMaster &master = four.master;
  master.toPhase4();
  four.drives[1]->faults().leaves = true;
  master.cycle(5);
  EXPECT_TRUE(master.answers.mstReturned);
  EXPECT_EQ(master.answers.count, 3U);
  EXPECT_EQ(four.drives[1]->phase(), Phase::Zero);
}

TEST(SercosRing, LostAndDistorted) {
  Four four;
  RingMaster &master = four.master;
  master.toPhase4();
  four.drives[2]->faults().loseAts = 3;
  for (const size_t count : {3U, 3U, 3U, 4U}) {
    master.cycle();
    EXPECT_EQ(master.answers.count, count);
  }
  four.drives[2]->faults().distortAts = 1;
  master.cycle();
  EXPECT_EQ(master.answers.count, 4U);
  EXPECT_TRUE(master.answers.telegrams[2].distorted);
  EXPECT_FALSE(master.answers.telegrams[1].distorted);
  master.cycle();
  EXPECT_FALSE(master.answers.telegrams[2].distorted);
  master.ring.faults().distortMsts = 1;
  master.cycle();
  EXPECT_FALSE(master.answers.mstReturned);
  EXPECT_TRUE(master.answers.mstDistorted);
  EXPECT_EQ(master.answers.count, 0U);
  master.cycle();
  EXPECT_EQ(master.answers.count, 4U);
  master.ring.faults().loseMsts = 2;
  master.cycle(2);
  EXPECT_FALSE(master.answers.mstDistorted);
  for (const auto &drive : four.drives)
    EXPECT_EQ(drive->phase(), Phase::Zero);
}

TEST(SercosRing, LightAndSpeed) {
  Four four;
  RingMaster &master = four.master;
  master.ring.faults().leastLight = 30;
  master.ring.setLight(29);
  master.cycle(3);
  EXPECT_FALSE(master.answers.light);
  master.ring.setLight(30);
  master.cycle();
  EXPECT_TRUE(master.answers.mstReturned);
  master.ring.setLight(0);
  master.ring.faults().leastLight = 0;
  master.cycle();
  EXPECT_FALSE(master.answers.light) << "off is off";
  master.ring.setLight(100);
  four.drives[3]->faults().baudRate = 4;
  master.toPhase1();
  EXPECT_EQ(master.records[254].seen, 0U);
  EXPECT_EQ(four.drives[3]->phase(), Phase::Zero);
  EXPECT_EQ(four.drives[2]->phase(), Phase::One);
  master.ring.setBaudRate(4);
  four.drives[0]->faults().baudRate = 4;
  master.toPhase1();
  EXPECT_EQ(four.drives[3]->phase(), Phase::One);
}

TEST(SercosRing, TelegramsInEachOthersWay) {
  Four four;
  RingMaster &master = four.master;
  master.toPhase2();
  master.writeTimes();
  const int64_t start = four.drives[0]->list().value(6);
  ASSERT_EQ(master.write(2, 6, start - 30), 0);
  master.check(127);
  master.phase = 3;
  master.cycle(2);
  ASSERT_EQ(master.answers.count, 4U);
  EXPECT_TRUE(master.answers.telegrams[0].distorted);
  EXPECT_TRUE(master.answers.telegrams[1].distorted);
  EXPECT_FALSE(master.answers.telegrams[2].distorted);
}

TEST(SercosRing, TwinsSpoilEachOtherFromPhase3On) {
  Four four;
  RingMaster &master = four.master;
  SimulatedDrive twin(plainDrive(9));
  master.ring.attach(twin);
  master.toPhase2();
  master.writeTimes();
  master.check(127);
  master.phase = 3;
  master.cycle(2);
  EXPECT_EQ(master.answers.count, 5U);
  EXPECT_TRUE(master.answers.telegrams[0].distorted);
  EXPECT_TRUE(master.answers.telegrams[4].distorted);
}

TEST(SercosRing, RunsAreTheSameToTheBit) {
  const auto run = [] {
    Four four;
    RingMaster &master = four.master;
    master.toPhase4();
    uint64_t hash = 14695981039346656037U;
    for (int i = 0; i < 300; ++i) {
      for (auto &[address, record] : master.records) {
        master.setControl(address, i > 5 ? 0xE000 : 0);
        master.setTarget(address, 777 + i * (address % 7));
      }
      if (i == 200)
        four.drives[1]->faults().loseAts = 3;
      master.cycle();
      for (const DriveTelegram &at : master.answers.ats())
        for (const uint8_t byte : at.bytes())
          hash = (hash ^ byte) * 1099511628211U;
    }
    return hash;
  };
  EXPECT_EQ(run(), run());
}

} // namespace
} // namespace stride::sercos::simulation
