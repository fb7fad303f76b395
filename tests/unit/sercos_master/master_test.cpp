// Phases 0 to 4 and what refuses each of them.
#include "tests/unit/sercos_master/master_scene.hpp"

#include <gmock/gmock-matchers.h>

namespace stride::sercos::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

using MasterTest = MasterScene;

TEST_F(MasterTest, ComesUpToPhase4) {
  config.light = 40;
  add(11);
  add(5);
  make();
  EXPECT_EQ(ring->megabits, 4);
  EXPECT_EQ(ring->light, 40);
  for (int i = 0; i < 10; ++i) // in the first one nobody had asked yet
    cycle();
  EXPECT_EQ(master->actualPhase(), Phase::Zero);
  EXPECT_EQ(last, 8);
  cycle();
  EXPECT_EQ(master->actualPhase(), Phase::One); // ten MSTs have come back
  uint16_t before = 0;
  while (master->actualPhase() != Phase::Four) {
    cycle();
    ASSERT_GE(last, before);
    before = last;
  }
  EXPECT_TRUE(start()) << text;
  EXPECT_EQ(master->actualPhase(), Phase::Four);
  EXPECT_EQ(ring->phase, 4);
  // In phase 1 the drives first, then all other addresses.
  ASSERT_GT(ring->asked.size(), 250U);
  EXPECT_EQ(ring->asked[0], 11);
  EXPECT_EQ(std::count(ring->asked.begin(), ring->asked.end(), 254), 1);
  EXPECT_EQ(std::count(ring->asked.begin(), ring->asked.end(), 7), 1);
  const bus::DriveStatus status = master->drive(1).status();
  EXPECT_TRUE(status.communication);
  EXPECT_EQ(status.position, 5000U);
  EXPECT_FALSE(status.regulatorOn);
}

TEST_F(MasterTest, WritesTheTimesOfTheRing) {
  add(1);
  add(2);
  drives[0].blocks[3].data = word(20); // t1min
  drives[1].blocks[4].data = word(30); // tATMT
  make();
  ASSERT_TRUE(start()) << text;
  // At 4 MBit/s 8 bytes of data are 8 + 64 + 16 bits, a fifth more by stuffing, and two flags: 122
  // bits, 31 us. The second AT begins after the first and the trembling of both.
  EXPECT_TRUE(wrote(0, "S2=2000"));
  EXPECT_TRUE(wrote(0, "S1=2000"));
  EXPECT_TRUE(wrote(0, "S15=4"));
  EXPECT_TRUE(wrote(0, "S6=21"));
  const auto second = drives[1].value(6);
  EXPECT_GE(second, 21 + 31);
  EXPECT_LE(second, 21 + 31 + 15);
  EXPECT_GE(drives[1].value(89), second + 31 + 30);
  EXPECT_EQ(drives[0].value(89), drives[1].value(89));
  EXPECT_TRUE(wrote(0, "S9=1"));
  EXPECT_TRUE(wrote(1, "S9=9"));
  EXPECT_TRUE(wrote(1, "S10=16"));
  EXPECT_EQ(drives[0].value(8), 2000);
  EXPECT_EQ(drives[0].value(7), 1900); // S-0-0005 before the end
  // Then the check of phase 3, with its end; scaling and mode come after it.
  const std::vector<std::string> &all = drives[0].written;
  const auto at = [&all](const char *line) {
    return std::find(all.begin(), all.end(), line) - all.begin();
  };
  EXPECT_LT(at("S10=16"), at("S127=3"));
  EXPECT_EQ(all[static_cast<size_t>(at("S127=3")) + 1], "S127=0");
  EXPECT_LT(at("S127=0"), at("S76=1"));
  EXPECT_LT(at("S76=1"), at("S32=11"));
  EXPECT_LT(at("S32=11"), at("S128=3"));
  EXPECT_LT(at("S128=0"), at("S99=3"));
}

TEST_F(MasterTest, RotaryDrivesGoRoundAtTheirPeriod) {
  DriveConfig &drive = add(1);
  drive.rotary = true;
  drive.period = 65536;
  make();
  ASSERT_TRUE(start()) << text;
  EXPECT_TRUE(wrote(0, "S76=138")); // rotational, own resolution, modulo
  EXPECT_TRUE(wrote(0, "S79=0,1"));
  EXPECT_TRUE(wrote(0, "S103=0,1"));
  EXPECT_TRUE(wrote(0, "S44=2"));
}

TEST_F(MasterTest, ListsAndWhatIsLocked) {
  DriveConfig &drive = add(1);
  std::string error;
  for (size_t i = 0; i < kLists; ++i) {
    IdnValue value;
    ASSERT_TRUE(parseIdnValue(i == 2 ? "S-0-0095 := 'x'" : "S-0-0077 := " + std::to_string(70 + i),
                              value, error));
    drive.settings.lists[i].push_back(value);
  }
  drive.settings.locked = {76, 6};
  make();
  ASSERT_TRUE(start()) << text;
  EXPECT_FALSE(wrote(0, "S76=1"));
  EXPECT_EQ(drives[0].value(6), 0);
  const std::vector<std::string> &all = drives[0].written;
  const auto at = [&all](const char *line) {
    return std::find(all.begin(), all.end(), line) - all.begin();
  };
  EXPECT_LT(at("S77=70"), at("S127=3"));
  EXPECT_LT(at("S127=0"), at("S77=71"));
  EXPECT_LT(at("S77=71"), at("S128=3"));
  EXPECT_LT(at("S128=0"), at("S95=120"));
  EXPECT_LT(at("S95=120"), static_cast<ptrdiff_t>(all.size()));
}

TEST_F(MasterTest, AFileIsWrittenWhenAPhaseAllowsIt) {
  DriveConfig &drive = add(1);
  drive.file = {{500, {7}, "", false}, {501, {8}, "", false}, {502, {9}, "", false}};
  make();
  drives[0].blocks[500] = block2(0);
  drives[0].blocks[501] = {0x10110001, {0, 0}, "", 0, 0}; // not in phase 2
  drives[0].blocks[502] = {0x30110001, {0, 0}, "", 0, 0}; // in phase 4 only
  ASSERT_TRUE(start()) << text;
  const std::vector<std::string> &all = drives[0].written;
  const auto at = [&all](const char *line) {
    return std::find(all.begin(), all.end(), line) - all.begin();
  };
  EXPECT_LT(at("S500=7"), at("S127=3"));
  EXPECT_LT(at("S127=0"), at("S501=8"));
  EXPECT_LT(at("S501=8"), at("S128=3"));
  EXPECT_LT(at("S128=0"), at("S502=9"));
  EXPECT_EQ(std::count(all.begin(), all.end(), "S500=7"), 1);
}

TEST_F(MasterTest, Phase0NeedsAClosedRing) {
  add(1);
  make();
  ring->open = true;
  EXPECT_FALSE(start());
  EXPECT_THAT(text, HasSubstr("open"));
  EXPECT_EQ(master->actualPhase(), Phase::Zero);
  ring->open = false;
  ring->distorted = true;
  resetAll();
  EXPECT_FALSE(start());
  EXPECT_THAT(text, AllOf(HasSubstr("distorted"), HasSubstr("4 MBit/s")));
  ring->distorted = false;
  resetAll();
  for (int i = 0; i < 30; ++i) { // nine are not ten
    ring->loseMsts = i % 10 == 9 ? 1 : 0;
    cycle();
  }
  EXPECT_EQ(master->actualPhase(), Phase::Zero);
  EXPECT_TRUE(start()) << text;
}

TEST_F(MasterTest, Phase1FindsWhoIsMissing) {
  add(1);
  add(9);
  absent = {9};
  make();
  EXPECT_FALSE(start());
  EXPECT_EQ(text, "9: address 9 does not answer: is the drive on, with this address?");
  EXPECT_EQ(ended[0], bus::StartUp::Busy); // the other one is not to blame
}

TEST_F(MasterTest, Phase1FindsDoubleAddresses) {
  add(1);
  make();
  ScriptedDrive twin(1);
  ring->drives.push_back(&twin);
  EXPECT_FALSE(start());
  EXPECT_THAT(text, HasSubstr("two drives have this address"));
  ring->drives.pop_back();
  drives[0].distorts = true;
  resetAll();
  EXPECT_FALSE(start());
  EXPECT_THAT(text, HasSubstr("distorted"));
}

TEST_F(MasterTest, Phase1FindsForeignAddresses) {
  add(1);
  make();
  ScriptedDrive last(254);
  ScriptedDrive first(2);
  ring->drives.push_back(&last);
  ring->drives.push_back(&first);
  EXPECT_TRUE(start()) << text;
  EXPECT_THAT(host.said, ElementsAre(StartsWith("address 2 answers and is not configured"),
                                     StartsWith("address 254 answers")));
}

TEST_F(MasterTest, Phase2RefusesValues) {
  add(3);
  drives[0].blocks[89].refusal = 0x7007;
  make();
  EXPECT_FALSE(start());
  EXPECT_THAT(text, AllOf(StartsWith("3: phase 2, S-0-0089 := "),
                          HasSubstr("above the maximum (16#7007)")));
  EXPECT_EQ(ring->phase, 2);
  cycle();
  EXPECT_EQ(ring->phase, 0);
}

TEST_F(MasterTest, Phase2ChecksWithTheCommand127) {
  add(3);
  drives[0].blocks[127].state = 15;
  drives[0].blocks[21].data = words({6, 32768 + 5});
  make();
  EXPECT_FALSE(start());
  EXPECT_EQ(
      text,
      "3: phase 2, S-0-0127: the drive refuses the next phase, invalid are S-0-0006, P-0-0005");
  drives[0].blocks[127].state = 7; // it runs and runs
  config.drives[0].commandTimeout = 50;
  make();
  ended.clear();
  last = 0;
  EXPECT_FALSE(start());
  EXPECT_EQ(text, "3: phase 2, S-0-0127: the command does not end");
}

TEST_F(MasterTest, Phase2NeedsDataOfTheRightLength) {
  add(3);
  drives[0].blocks[51] = block2(0);
  make();
  EXPECT_FALSE(start());
  EXPECT_THAT(text, AllOf(StartsWith("3: phase 2, S-0-0051"), HasSubstr("4 bytes")));
}

TEST_F(MasterTest, Phase2NeedsTimesThatFit) {
  add(3);
  drives[0].blocks[88].data = word(1900);
  make();
  EXPECT_FALSE(start());
  EXPECT_THAT(text, HasSubstr("us of the cycle of 2000 us"));
}

TEST_F(MasterTest, Phase2NeedsTheServiceChannel) {
  add(3);
  add(4);
  drives[1].mute = true;
  make();
  EXPECT_FALSE(start());
  EXPECT_EQ(text, "4: phase 2, S-0-0003: the service channel does not answer");
}

TEST_F(MasterTest, Phase3NeedsTelegrams) {
  add(3);
  drives[0].feedback = {1, 2}; // too short
  make();
  EXPECT_FALSE(start());
  EXPECT_EQ(text, "3: address 3 sends no telegram");
}

TEST_F(MasterTest, Phase3ChecksWithTheCommand128) {
  add(3);
  drives[0].blocks[128].state = 15;
  drives[0].blocks[22].data = words({104});
  make();
  EXPECT_FALSE(start());
  EXPECT_EQ(text, "3: phase 3, S-0-0128: the drive refuses the next phase, invalid are S-0-0104");
}

TEST_F(MasterTest, Phase3TakesPositionsWithLagWhereThereIsNoOtherMode) {
  add(3);
  drives[0].blocks[32].refusal = 0x7008;
  make();
  EXPECT_FALSE(start());
  EXPECT_TRUE(wrote(0, "S32=11"));
  EXPECT_TRUE(wrote(0, "S32=3"));
  EXPECT_THAT(text, StartsWith("3: phase 3, S-0-0032 := 3: "));
}

TEST_F(MasterTest, SecondaryModesMayBeMissing) {
  DriveConfig &drive = add(3);
  CyclicWish wish;
  wish.controlType = 0;
  wish.send = {1100, 1160, 0};
  wish.receive = {1101, 0, 0};
  std::vector<std::string> errors;
  drive.settings.cyclic = planCyclic(wish, errors);
  drives[0].length = 10;
  drives[0].blocks[33].refusal = 0x7008;
  make();
  EXPECT_TRUE(start()) << text;
  EXPECT_TRUE(wrote(0, "S16=51"));
  EXPECT_TRUE(wrote(0, "S24=47,80"));
  EXPECT_TRUE(wrote(0, "S33=1"));
  EXPECT_EQ(master->drive(0).axis().controllerModes(), 1 << 3);
}

TEST_F(MasterTest, Phase4ChecksThePackProfile) {
  DriveConfig &drive = add(3);
  drive.settings.profile = PackProfile::BasicB;
  make();
  EXPECT_FALSE(start());
  EXPECT_THAT(text, HasSubstr("the Pack Profile is not met: the drive has no S-0-0011"));
}

TEST_F(MasterTest, CommandedPhaseIsTheLast) {
  add(1);
  make();
  master->commandPhase(Phase::Two);
  EXPECT_FALSE(start(3000));
  EXPECT_EQ(master->actualPhase(), Phase::Two);
  master->commandPhase(Phase::Four);
  EXPECT_TRUE(start()) << text;
  master->commandPhase(Phase::Zero);
  cycle();
  EXPECT_EQ(master->actualPhase(), Phase::Zero);
  EXPECT_FALSE(master->drive(0).status().communication);
}

/// Who leads the ring may take his time, and so may who starts its first drive.
TEST_F(MasterTest, PatienceBeginsWhenTheRingIsWanted) {
  add(1);
  make();
  master->commandPhase(Phase::Zero);
  for (int i = 0; i < 1500; ++i) // 3 s
    cycle();
  EXPECT_EQ(ended[0], bus::StartUp::Busy) << text;
  master->commandPhase(Phase::Four);
  EXPECT_TRUE(start()) << text;
  resetAll();
  for (int i = 0; i < 1500; ++i) { // nobody calls init
    master->executeStart();
    master->executeEnd();
  }
  EXPECT_TRUE(start()) << text;
  // Without a ring the patience is as long as ever.
  resetAll();
  ring->open = true;
  EXPECT_FALSE(start());
  EXPECT_THAT(text, HasSubstr("there is no light"));
}

TEST_F(MasterTest, AllocatesNothing) {
  add(1);
  add(2);
  make();
  ended.resize(2);
  cycle();
  const size_t before = stride::test::allocations() - ring->allocations;
  ring->asked.reserve(1000);
  const size_t reserved = stride::test::allocations() - ring->allocations;
  bus::Message message;
  uint16_t progress = 0;
  for (int i = 0; i < 1500; ++i) {
    master->executeStart();
    (void)master->init(0, progress, message);
    (void)master->init(1, progress, message);
    master->executeEnd();
  }
  EXPECT_EQ(master->actualPhase(), Phase::Four);
  EXPECT_EQ(stride::test::allocations() - ring->allocations, reserved);
  EXPECT_LE(reserved, before + 1); // AddressSanitizer has an operator new of its own
}

} // namespace
} // namespace stride::sercos::test
