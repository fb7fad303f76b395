// The way up through the phases, and every reason to stay below.
#include "tests/unit/sercos_simulation/ring_master.hpp"

#include <algorithm>

namespace stride::sercos::simulation {
namespace {

TEST(SercosPhases, AllTheWayUp) {
  DriveScene scene;
  scene.master.toPhase4();
  EXPECT_EQ(scene.drive.phase(), Phase::Four);
  EXPECT_FALSE(scene.drive.hasError());
  EXPECT_EQ(scene.master.records[3].status >> 14U, 2U) << "main power, no torque";
  EXPECT_EQ(scene.master.actual(3), 777);
  EXPECT_EQ(scene.drive.list().value(14), 4);
}

TEST(SercosPhases, AnswersOnlyWhenAsked) {
  DriveScene scene;
  scene.master.phase = 0;
  scene.master.cycle(12);
  EXPECT_TRUE(scene.master.answers.mstReturned);
  EXPECT_TRUE(scene.master.answers.light);
  EXPECT_EQ(scene.master.answers.count, 0U);
  scene.master.phase = 1;
  scene.master.asked = 4;
  scene.master.cycle(3);
  EXPECT_EQ(scene.master.answers.count, 0U);
  scene.master.asked = 3;
  scene.master.cycle();
  ASSERT_EQ(scene.master.answers.count, 1U);
  EXPECT_EQ(scene.master.answers.telegrams[0].address, 3);
  EXPECT_EQ(scene.master.answers.telegrams[0].length, 4);
}

TEST(SercosPhases, TwoWithOneAddressBothAnswer) {
  DriveScene scene;
  SimulatedDrive twin(plainDrive(3));
  scene.master.ring.attach(twin);
  scene.master.toPhase1();
  EXPECT_EQ(scene.master.answers.count, 2U);
  EXPECT_EQ(scene.master.records[3].seen, 2U);
}

TEST(SercosPhases, AForeignAddressIsFoundWhereItIs) {
  DriveScene scene;
  scene.drive.setAddress(9);
  scene.master.toPhase1();
  EXPECT_EQ(scene.master.answers.count, 0U) << "missing";
  scene.master.asked = 9;
  scene.master.cycle(2);
  EXPECT_EQ(scene.master.answers.count, 1U);
  scene.drive.faults().answersAs = 77;
  scene.master.cycle();
  EXPECT_EQ(scene.master.answers.telegrams[0].address, 77);
}

struct Refusal {
  uint8_t from;
  uint8_t to;
  uint16_t bit; ///< Of S-0-0014.
};

class SercosRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(SercosRefusal, EndsInPhase0) {
  const Refusal &refusal = GetParam();
  DriveScene scene;
  switch (refusal.from) {
  case 1:
    scene.master.toPhase1();
    break;
  case 2:
    scene.master.toPhase2();
    break;
  case 3:
    scene.master.toPhase3();
    break;
  case 4:
    scene.master.toPhase4();
    break;
  default:
    scene.master.cycle(10);
  }
  ASSERT_EQ(static_cast<uint8_t>(scene.drive.phase()), refusal.from);
  scene.master.phase = refusal.to;
  scene.master.cycle();
  EXPECT_EQ(scene.drive.phase(), Phase::Zero);
  EXPECT_EQ(scene.drive.list().value(14), refusal.bit);
  EXPECT_EQ(scene.drive.list().value(11), 0x1000) << "communication";
}

INSTANTIATE_TEST_SUITE_P(All, SercosRefusal,
                         testing::Values(Refusal{0, 2, 0x40}, Refusal{0, 4, 0x40},
                                         Refusal{1, 3, 0x40}, Refusal{2, 4, 0x40},
                                         Refusal{2, 1, 0x80}, Refusal{3, 2, 0x80},
                                         Refusal{4, 3, 0x80}, Refusal{4, 1, 0x80},
                                         Refusal{2, 3, 0x100}, Refusal{3, 4, 0x100},
                                         Refusal{1, 5, 0x20}, Refusal{4, 7, 0x20}));

TEST(SercosPhases, BackTo0IsNoError) {
  DriveScene scene;
  scene.master.toPhase4();
  scene.master.phase = 0;
  scene.master.cycle();
  EXPECT_EQ(scene.drive.phase(), Phase::Zero);
  EXPECT_FALSE(scene.drive.hasError());
  scene.master.toPhase4();
  EXPECT_EQ(scene.drive.phase(), Phase::Four) << "and up again";
}

TEST(SercosPhases, TwoMissedMstsAreOneTooMany) {
  DriveScene scene;
  scene.master.toPhase4();
  scene.drive.faults().loseMsts = 1;
  scene.master.cycle(3);
  EXPECT_EQ(scene.drive.phase(), Phase::Four);
  EXPECT_EQ(scene.drive.list().value(28), 1);
  for (int i = 0; i < 5; ++i) { // never two in a row
    scene.drive.faults().loseMsts = 1;
    scene.master.cycle(2);
  }
  EXPECT_EQ(scene.drive.phase(), Phase::Four);
  scene.drive.faults().loseMsts = 2;
  scene.master.cycle(1);
  EXPECT_EQ(scene.drive.phase(), Phase::Four);
  EXPECT_EQ(scene.master.answers.count, 0U) << "without an MST it does not know when to send";
  scene.master.sendMst = false;
  scene.master.cycle(1);
  EXPECT_EQ(scene.drive.phase(), Phase::Zero);
  EXPECT_EQ(scene.drive.list().value(14), 0x08);
}

TEST(SercosPhases, TwoMissedMdts) {
  DriveScene scene;
  scene.master.toPhase4();
  scene.drive.faults().loseMdts = 1;
  scene.master.cycle(3);
  EXPECT_EQ(scene.drive.phase(), Phase::Four);
  EXPECT_EQ(scene.drive.list().value(29), 1);
  scene.drive.faults().loseMdts = 2;
  scene.master.cycle(2);
  EXPECT_EQ(scene.drive.phase(), Phase::Zero);
  EXPECT_EQ(scene.drive.list().value(14), 0x10);
}

TEST(SercosPhases, AnotherCycleThanAgreedIsNone) {
  DriveScene scene;
  scene.master.toPhase4();
  scene.master.periodNs = 2'400'000;
  scene.master.cycle(10);
  EXPECT_EQ(scene.drive.phase(), Phase::Four) << "a fifth is not much";
  scene.master.periodNs = 4'000'000;
  scene.master.cycle(2);
  EXPECT_EQ(scene.drive.phase(), Phase::Zero);
}

TEST(SercosPhases, AnMdtOfAnotherLengthIsNone) {
  DriveScene scene;
  scene.master.toPhase4();
  scene.master.mdtLength += 2;
  scene.master.cycle(2);
  EXPECT_EQ(scene.drive.phase(), Phase::Zero);
  EXPECT_EQ(scene.drive.list().value(14), 0x10);
}

TEST(SercosPhases, ErrorsStayUntilTheyAreReset) {
  DriveScene scene;
  scene.master.cycle(10);
  scene.master.phase = 3;
  scene.master.cycle();
  ASSERT_TRUE(scene.drive.hasError());
  scene.master.toPhase4();
  EXPECT_EQ(scene.master.records[3].status & 0xE000U, 0x2000U) << "class 1, not ready";
  EXPECT_EQ(scene.master.read(3, 95, 7, 0).text(), "communication error, see S-0-0014");
  EXPECT_EQ(scene.master.read(3, 14).number(), 0x44);
  EXPECT_EQ(scene.master.command(3, 99), 3);
  EXPECT_EQ(scene.master.records[3].status & 0xE000U, 0x8000U);
  EXPECT_EQ(scene.master.read(3, 14).number(), 4);
  EXPECT_EQ(scene.master.read(3, 11).number(), 0);
  EXPECT_EQ(scene.master.read(3, 95, 7, 0).text(), "ready");
}

// ---- S-0-0127

TEST(SercosCheck3, AsksForAllThatWasNotGiven) {
  DriveScene scene;
  scene.master.toPhase2();
  EXPECT_EQ(scene.master.command(3, 127), 15);
  EXPECT_EQ(scene.master.ids(3, 21), (std::vector<Idn>{1, 2, 6, 7, 8, 9, 10, 15, 89}));
  EXPECT_EQ(scene.master.ids(3, 18), (std::vector<Idn>{1, 2, 6, 7, 8, 9, 10, 15, 89}));
  scene.master.writeTimes();
  EXPECT_EQ(scene.master.command(3, 127), 3);
  EXPECT_TRUE(scene.master.ids(3, 21).empty());
  // Written again: checked again.
  EXPECT_EQ(scene.master.write(3, 6, 25), 0);
  scene.master.phase = 3;
  scene.master.cycle();
  EXPECT_EQ(scene.drive.list().value(14), 0x100);
}

TEST(SercosCheck3, AgainAfterPhase0) {
  DriveScene scene;
  scene.master.toPhase3();
  scene.master.toPhase2();
  EXPECT_EQ(scene.master.command(3, 127), 15) << "what was given is forgotten";
}

struct Wrong {
  Idn idn;
  int64_t value;
  Idn blamed;
};

class SercosWrongTime : public testing::TestWithParam<Wrong> {};

/// With 2 ms at 2 MBit/s, t1 = 20, AT 61 µs, t2 = 20 + 63 + 10 + 20, MDT 37 or so.
TEST_P(SercosWrongTime, IsBlamed) {
  const Wrong &wrong = GetParam();
  DriveScene scene;
  scene.master.toPhase2();
  scene.master.writeTimes();
  ASSERT_EQ(scene.master.write(3, wrong.idn, wrong.value), 0);
  EXPECT_EQ(scene.master.command(3, 127), wrong.blamed == 0 ? 3 : 15);
  const std::vector<Idn> invalid = scene.master.ids(3, 21);
  const bool blamed = std::find(invalid.begin(), invalid.end(), wrong.blamed) != invalid.end();
  EXPECT_EQ(blamed, wrong.blamed != 0);
  EXPECT_EQ(invalid.empty(), wrong.blamed == 0);
}

INSTANTIATE_TEST_SUITE_P(All, SercosWrongTime,
                         testing::Values(Wrong{1, 4000, 0}, Wrong{1, 3000, 1}, Wrong{1, 1000, 1},
                                         Wrong{2, 1500, 2}, Wrong{2, 4000, 1}, Wrong{6, 13, 0},
                                         Wrong{6, 12, 6}, Wrong{6, 60, 6}, Wrong{7, 1800, 0},
                                         Wrong{7, 1801, 7}, Wrong{8, 2001, 8}, Wrong{8, 150, 8},
                                         Wrong{9, 2, 9}, Wrong{9, 3, 9}, Wrong{10, 9, 10},
                                         Wrong{10, 10, 0}, Wrong{10, 6, 9}, Wrong{15, 7, 0},
                                         Wrong{15, 0x14, 15}, Wrong{15, 5, 9}, Wrong{15, 12, 0},
                                         Wrong{89, 80, 6}, Wrong{89, 1950, 89}));

TEST(SercosCheck3, ListsOfTheApplicationTelegram) {
  DriveScene scene;
  scene.master.toPhase2();
  scene.master.writeTimes(32, 8, 7);
  EXPECT_EQ(scene.master.writeIds(3, 16, {51, 40, 84}), 0);
  EXPECT_EQ(scene.master.writeIds(3, 24, {47, 80}), 0);
  EXPECT_EQ(scene.master.command(3, 127), 3);
  EXPECT_EQ(scene.master.writeIds(3, 16, {51, 36, 79}), 0) << "it is known, but";
  EXPECT_EQ(scene.master.command(3, 127), 15);
  EXPECT_EQ(scene.master.ids(3, 21), (std::vector<Idn>{16}));
  EXPECT_EQ(scene.master.writeIds(3, 16, {51, 51}), 0);
  EXPECT_EQ(scene.master.command(3, 127), 15) << "twice";
  EXPECT_EQ(scene.master.writeIds(3, 16, {51, 9999}), 0x7008) << "it is not known";
  EXPECT_EQ(scene.master.writeIds(3, 16, {51, 40, 84, 53, 130, 131, 132, 133}), 0);
  EXPECT_EQ(scene.master.command(3, 127), 3) << "eight are allowed";
  EXPECT_EQ(scene.master.writeIds(3, 16, {51, 40, 84, 53, 130, 131, 132, 133, 189}), 0x7003);
  EXPECT_EQ(scene.master.writeIds(3, 24, {51}), 0);
  EXPECT_EQ(scene.master.command(3, 127), 15);
  EXPECT_EQ(scene.master.ids(3, 21), (std::vector<Idn>{24})) << "feedback is no command";
}

TEST(SercosCheck3, TheSimulationCanFail) {
  DriveScene scene;
  scene.master.toPhase2();
  scene.master.writeTimes();
  scene.drive.faults().failPhase3 = true;
  EXPECT_EQ(scene.master.command(3, 127), 15);
  EXPECT_TRUE(scene.master.ids(3, 21).empty());
}

// ---- S-0-0128

TEST(SercosCheck4, TheModeHasToBeGivenAndItsCommandToCome) {
  DriveScene scene;
  scene.master.toPhase3();
  EXPECT_EQ(scene.master.command(3, 128), 15);
  EXPECT_EQ(scene.master.ids(3, 22), (std::vector<Idn>{32}));
  EXPECT_EQ(scene.master.write(3, 32, 2), 0) << "velocities, but positions come";
  EXPECT_EQ(scene.master.command(3, 128), 15);
  EXPECT_EQ(scene.master.write(3, 32, 1), 0x7008) << "ideal mechanics have no torque";
  EXPECT_EQ(scene.master.write(3, 32, 11), 0);
  EXPECT_EQ(scene.master.command(3, 128), 3);
}

TEST(SercosCheck4, ScalingAndLimits) {
  DriveScene scene;
  scene.master.toPhase3();
  EXPECT_EQ(scene.master.write(3, 32, 3), 0);
  EXPECT_EQ(scene.master.write(3, 76, 0x0081), 0) << "linear and modulo";
  EXPECT_EQ(scene.master.write(3, 55, 0x10), 0);
  EXPECT_EQ(scene.master.write(3, 49, 500, 4), 0);
  EXPECT_EQ(scene.master.write(3, 50, 500, 4), 0);
  EXPECT_EQ(scene.master.command(3, 128), 15);
  EXPECT_EQ(scene.master.ids(3, 22), (std::vector<Idn>{76, 49, 50}));
  EXPECT_EQ(scene.master.write(3, 76, 0x0089), 0);
  EXPECT_EQ(scene.master.write(3, 76, 0x0001), 0);
  EXPECT_EQ(scene.master.write(3, 50, 499, 4), 0);
  EXPECT_EQ(scene.master.command(3, 128), 3);
  scene.drive.faults().failPhase4 = true;
  EXPECT_EQ(scene.master.command(3, 128), 15);
}

} // namespace
} // namespace stride::sercos::simulation
