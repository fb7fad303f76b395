// The service channel word by word.
#include "tests/unit/sercos_simulation/ring_master.hpp"

namespace stride::sercos::simulation {
namespace {

struct Channel : DriveScene {
  explicit Channel(const DriveSetup &setup = plainDrive()) : DriveScene(setup) {
    master.toPhase2();
  }
};

TEST(SercosService, AStepTakesACycle) {
  Channel c;
  const Answer answer = c.master.open(3, 95);
  EXPECT_EQ(answer.error, 0);
  EXPECT_EQ(answer.cycles, 1U);
  // S-0-0095: a cycle to open, one for each of two words before it, one for each two characters.
  const Answer text = c.master.read(3, 95, 7, 0);
  EXPECT_EQ(text.text(), "ready");
  EXPECT_EQ(text.cycles, 1U + 2U + 3U);
  const Answer name = c.master.read(3, 47, 2, 0);
  EXPECT_EQ(name.text(), "Position command value");
  EXPECT_EQ(name.cycles, 1U + 2U + 11U);
}

TEST(SercosService, Elements) {
  Channel c;
  EXPECT_EQ(c.master.read(3, 47, 3, 4).number(), 0x0022'0001);
  EXPECT_EQ(c.master.read(3, 47, 4, 0).text(), "incr");
  EXPECT_EQ(c.master.read(3, 41, 5, 4).number(), 1);
  EXPECT_EQ(c.master.read(3, 41, 6, 4).number(), 2147483647);
  EXPECT_EQ(c.master.read(3, 79, 7, 4).number(), 4096);
  EXPECT_EQ(c.master.read(3, 47, 1).number(), 0);
}

TEST(SercosService, WhatIsNotThere) {
  Channel c;
  EXPECT_EQ(c.master.read(3, 999).error, 0x1001);
  EXPECT_EQ(c.master.read(3, 15, 4, 0).error, 0x4001) << "no unit";
  EXPECT_EQ(c.master.read(3, 15, 5).error, 0x5001) << "no minimum";
  EXPECT_EQ(c.master.read(3, 17, 6).error, 0x6001) << "no maximum";
  EXPECT_EQ(c.master.step(3, 0, false, false, 0).error, 0) << "closed";
  EXPECT_EQ(c.master.step(3, 7, false, true, 0).error, 0x0001);
  EXPECT_EQ(c.master.step(3, 1, true, false, 47).error, 0x1009) << "without end";
}

TEST(SercosService, TooShortAndTooLong) {
  Channel c;
  ASSERT_EQ(c.master.open(3, 79).error, 0);
  EXPECT_EQ(c.master.step(3, 7, false, true, 0).error, 0x7002);
  EXPECT_EQ(c.master.step(3, 7, false, false, 0).error, 0) << "anew";
  EXPECT_EQ(c.master.step(3, 7, false, false, 0).error, 0);
  EXPECT_EQ(c.master.step(3, 7, false, false, 0).error, 0x7003);
  EXPECT_EQ(c.master.step(3, 2, false, true, 0).error, 0x2002);
  EXPECT_EQ(c.master.step(3, 7, true, true, 5).error, 0x7002);
  ASSERT_EQ(c.master.open(3, 41).error, 0);
  EXPECT_EQ(c.master.step(3, 7, true, true, 5).error, 0x7002);
  EXPECT_EQ(c.master.step(3, 7, true, false, 5).error, 0);
  EXPECT_EQ(c.master.step(3, 7, true, false, 0).error, 0);
  EXPECT_EQ(c.master.step(3, 7, true, false, 0).error, 0x7003);
  EXPECT_EQ(c.master.read(3, 41, 7, 4).number(), c.drive.list().at(41).row.value);
}

TEST(SercosService, AnElementCanBeLeft) {
  Channel c;
  ASSERT_EQ(c.master.open(3, 17).error, 0);
  EXPECT_EQ(c.master.step(3, 7, false, false, 0).error, 0);
  EXPECT_EQ(c.master.step(3, 3, false, false, 0).error, 0);
  EXPECT_EQ(c.master.step(3, 3, false, true, 0).error, 0);
  EXPECT_EQ(c.master.read(3, 2).number(), 2000);
}

TEST(SercosService, LimitsOfValues) {
  Channel c;
  EXPECT_EQ(c.master.write(3, 2, 61), 0x7006);
  EXPECT_EQ(c.master.write(3, 2, 62), 0);
  EXPECT_EQ(c.master.write(3, 2, 65000), 0);
  EXPECT_EQ(c.master.write(3, 2, 65001), 0x7007);
  EXPECT_EQ(c.master.write(3, 41, 0, 4), 0x7006);
  EXPECT_EQ(c.master.write(3, 41, 1, 4), 0);
  EXPECT_EQ(c.master.write(3, 78, -9), 0);
  EXPECT_EQ(c.master.write(3, 78, -10), 0x7006);
  EXPECT_EQ(c.master.write(3, 78, 0), 0);
  EXPECT_EQ(c.master.write(3, 78, 1), 0x7007);
  EXPECT_EQ(c.master.write(3, 169, 15), 0);
  EXPECT_EQ(c.master.write(3, 169, 16), 0x7007);
  EXPECT_EQ(c.master.write(3, 33, 5), 0x7008);
  EXPECT_EQ(c.master.write(3, 147, 0x100), 0x7008);
  EXPECT_EQ(c.master.write(3, 301, 405), 0);
  EXPECT_EQ(c.master.write(3, 301, 47), 0x7008);
  EXPECT_EQ(c.master.write(3, 305, 403), 0);
  EXPECT_EQ(c.master.write(3, 305, 405), 0x7008);
  EXPECT_EQ(c.master.write(3, 86, 1), 0x7008);
  EXPECT_EQ(c.master.write(3, 44, 3), 0x7008);
  EXPECT_EQ(c.master.write(3, 160, 4), 0x7008);
}

TEST(SercosService, WhenDataCanBeWritten) {
  DriveScene scene;
  scene.master.toPhase2();
  EXPECT_EQ(scene.master.write(3, 3, 1), 0x7004) << "never";
  EXPECT_EQ(scene.master.write(3, 128, 3), 0x7005) << "not yet";
  scene.master.writeTimes();
  scene.master.check(127);
  scene.master.phase = 3;
  scene.master.cycle(2);
  EXPECT_EQ(scene.master.write(3, 2, 2000), 0x7005) << "in phase 2 only";
  EXPECT_EQ(scene.master.write(3, 127, 3), 0x7005);
  EXPECT_EQ(scene.master.write(3, 47, 5, 4), 0) << "not cyclic yet";
  EXPECT_EQ(scene.master.write(3, 32, 3), 0);
  scene.master.check(128);
  scene.master.phase = 4;
  scene.master.cycle(2);
  EXPECT_EQ(scene.master.write(3, 32, 3), 0x7005);
  EXPECT_EQ(scene.master.write(3, 47, 5, 4), 0x700A);
  EXPECT_EQ(scene.master.write(3, 36, 5, 4), 0) << "that one does not come";
  EXPECT_EQ(scene.master.write(3, 142, 41, 4), 0x7003) << "a text with more than its room";
}

TEST(SercosService, Texts) {
  Channel c;
  EXPECT_EQ(c.master.writeBytes(3, 142, {3, 0, 3, 0, 'X', '-', '1', 0}), 0);
  EXPECT_EQ(c.master.read(3, 142, 7, 0).text(), "X-1");
  EXPECT_EQ(c.master.writeBytes(3, 142, {40, 0}), 0x7002);
  EXPECT_EQ(c.master.writeBytes(3, 142, {41, 0, 41, 0}), 0x7003);
  EXPECT_EQ(c.master.writeBytes(3, 142, {0, 0, 0, 0}), 0);
  EXPECT_EQ(c.master.read(3, 142, 7, 0).text(), "");
  EXPECT_EQ(c.master.writeBytes(3, 16, {3, 0, 3, 0, 1, 0, 1, 0}), 0x7008) << "half an IDN";
}

TEST(SercosService, Busy) {
  Channel c;
  for (const unsigned busy : {1U, 9U, 10U, 11U, 25U}) {
    c.drive.faults().busyCycles = busy;
    EXPECT_EQ(c.master.open(3, 95).cycles, 1U + busy);
  }
  c.drive.faults().busyCycles = 5;
  c.master.asked = 3;
  c.master.records[3].control ^= 1U;
  c.master.cycle(3);
  EXPECT_EQ(c.master.records[3].status & 2U, 2U);
  c.master.records[3].control ^= 1U; // taken back
  c.master.cycle(2);
  EXPECT_EQ(c.master.records[3].status & 7U, c.master.records[3].control & 1U);
  c.drive.faults().busyCycles = 0;
  c.drive.faults().mute = true;
  EXPECT_EQ(c.master.open(3, 95).error, 0xFFFF);
}

TEST(SercosService, Refusals) {
  Channel c;
  c.drive.faults().refuses = true;
  c.drive.faults().refused = 6;
  EXPECT_EQ(c.master.write(3, 6, 20), 0x7008);
  EXPECT_EQ(c.master.read(3, 6).error, 0);
  c.drive.faults().reason = 0x1001;
  EXPECT_EQ(c.master.read(3, 6).error, 0x1001);
  EXPECT_EQ(c.master.write(3, 7, 20), 0) << "another one";
}

TEST(SercosService, CommandsHaveAState) {
  Channel c;
  c.master.writeTimes();
  EXPECT_EQ(c.master.write(3, 127, 4), 0x7008);
  EXPECT_EQ(c.master.write(3, 127, 2), 0x7008) << "enabled, but not set";
  EXPECT_EQ(c.master.write(3, 127, 3), 0);
  EXPECT_EQ(c.master.records[3].status & 0x20U, 0U);
  c.master.cycle(6);
  EXPECT_EQ(c.master.records[3].status & 0x20U, 0x20U) << "something has ended";
  EXPECT_EQ(c.master.read(3, 127, 1).number(), 3);
  EXPECT_EQ(c.master.write(3, 127, 3), 0) << "it is not carried out again";
  EXPECT_EQ(c.master.read(3, 127, 1).number(), 3);
  EXPECT_EQ(c.master.write(3, 127, 0), 0);
  EXPECT_EQ(c.master.read(3, 127, 1).number(), 0);
  EXPECT_EQ(c.master.records[3].status & 0x20U, 0U);
}

TEST(SercosService, ACommandCanBeInterrupted) {
  DriveSetup setup = plainDrive();
  setup.device.commandCycles = 100;
  Channel c(setup);
  c.master.writeTimes();
  EXPECT_EQ(c.master.write(3, 127, 3), 0);
  EXPECT_EQ(c.master.read(3, 127, 1).number(), 7);
  EXPECT_EQ(c.master.write(3, 127, 1), 0);
  EXPECT_EQ(c.master.read(3, 127, 1).number(), 5);
  EXPECT_EQ(c.master.write(3, 127, 3), 0);
  EXPECT_EQ(c.master.read(3, 127, 1).number(), 7);
  EXPECT_EQ(c.master.write(3, 127, 0), 0);
  EXPECT_EQ(c.master.read(3, 127, 1).number(), 0);
}

TEST(SercosService, GoesOnOverTheChangeOfPhases) {
  DriveScene scene;
  scene.master.toPhase3();
  EXPECT_EQ(scene.master.read(3, 2).number(), 2000);
  EXPECT_EQ(scene.master.open(3, 47).cycles, 1U);
  scene.master.toPhase2();
  EXPECT_EQ(scene.master.step(3, 7, false, true, 0).error, 0x0001) << "closed";
}

} // namespace
} // namespace stride::sercos::simulation
