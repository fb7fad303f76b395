// What goes wrong in operation, and how it gets right again.
#include "tests/unit/sercos_together/together.hpp"

namespace stride::sercos {
namespace {

struct Moving : Together {
  explicit Moving(const Options &options = {}) : Together(options) {
    runUp();
    EXPECT_TRUE(allStarted());
    powerOn();
    move = [this](size_t i) {
      if (moves && status(i).driveStarted && !status(i).error)
        commands[i].position += 30 + static_cast<uint32_t>(i);
    };
    run(50);
  }
  bool moves = true;

  /// What SMC_ResetAxisGroup and then MC_Reset and MC_Power do.
  void recover() {
    move = nullptr;
    reset();
    runUp();
    ASSERT_TRUE(allStarted()) << messages[0].text();
    for (size_t i = 0; i < drives.size(); ++i)
      commands[i].errorAckn = true;
    run(60);
    for (size_t i = 0; i < drives.size(); ++i) {
      commands[i].errorAckn = false;
      EXPECT_FALSE(status(i).error) << i;
      EXPECT_EQ(status(i).errorId, 0);
    }
    powerOn();
  }
};

TEST(SercosFaults, TheRingOpens) {
  for (size_t before = 0; before < 4; ++before) {
    Moving all;
    all.ring.faults() = {.open = true, .openBefore = before};
    all.run(3);
    EXPECT_EQ(all.master->actualPhase(), Phase::Zero);
    for (size_t i = 0; i < 4; ++i)
      EXPECT_FALSE(all.status(i).communication);
    bus::Message why;
    all.master->problem(why);
    EXPECT_NE(why.text().find("no light"), std::string_view::npos) << why.text();
    all.run(50);
    for (const auto &drive : all.drives)
      EXPECT_FALSE(drive->hasTorque()) << "it has stopped by itself";
    EXPECT_EQ(all.master->counters().ringFalls, 1U);
    all.ring.faults().open = false;
    all.run(100);
    EXPECT_EQ(all.master->actualPhase(), Phase::Zero) << "nobody has asked for it";
    all.recover();
  }
}

TEST(SercosFaults, ADriveLeaves) {
  for (const bool off : {false, true}) {
    Moving all;
    (off ? all.drives[2]->faults().off : all.drives[2]->faults().leaves) = true;
    all.run(4);
    EXPECT_EQ(all.master->actualPhase(), Phase::Zero);
    for (size_t i = 0; i < 4; ++i)
      EXPECT_FALSE(all.status(i).communication);
    all.run(100);
    for (const auto &drive : all.drives)
      EXPECT_FALSE(drive->hasTorque());
    all.drives[2]->faults() = {};
    all.recover();
  }
}

TEST(SercosFaults, WhatIsLostOnceDoesNotMatter) {
  Moving all;
  for (int i = 0; i < 40; ++i) {
    simulation::DeviceFaults &faults = all.drives[static_cast<size_t>(i) % 4]->faults();
    if (i % 5 == 0)
      faults.loseAts = 1;
    if (i % 5 == 1)
      faults.distortAts = 1;
    if (i % 5 == 2)
      faults.loseMdts = 1;
    if (i % 5 == 3)
      faults.loseMsts = 1;
    if (i % 5 == 4)
      all.ring.faults().loseMsts = 1;
    all.run(3);
  }
  EXPECT_EQ(all.master->actualPhase(), Phase::Four);
  EXPECT_GT(all.master->counters().atLost, 20U);
  all.moves = false;
  all.run(5);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(all.status(i).communication);
    EXPECT_EQ(all.status(i).position, all.commands[i].position) << i;
  }
}

TEST(SercosFaults, TwoInARowDo) {
  for (int what = 0; what < 4; ++what) {
    Moving all;
    simulation::DeviceFaults &faults = all.drives[3]->faults();
    (what == 0   ? faults.loseAts
     : what == 1 ? faults.distortAts
     : what == 2 ? faults.loseMdts
                 : faults.loseMsts) = 2;
    all.run(6);
    EXPECT_EQ(all.master->actualPhase(), Phase::Zero) << what;
    all.run(50);
    for (const auto &drive : all.drives)
      EXPECT_FALSE(drive->hasTorque());
    all.recover();
  }
}

TEST(SercosFaults, Class1) {
  Moving all;
  all.drives[1]->fail(4711);
  all.run(60);
  EXPECT_TRUE(all.status(1).error);
  EXPECT_EQ(all.status(1).errorId, 4711) << "S-0-0129";
  EXPECT_FALSE(all.status(1).regulatorOn);
  EXPECT_TRUE(all.status(0).driveStarted) << "the others go on";
  EXPECT_EQ(all.master->actualPhase(), Phase::Four);
  all.commands[1].regulatorOn = all.commands[1].driveStart = false;
  all.commands[1].errorAckn = true;
  all.run(60);
  EXPECT_FALSE(all.status(1).error);
  all.commands[1].errorAckn = false;
  all.commands[1].position = all.status(1).position;
  all.moves = false;
  all.commands[1].regulatorOn = all.commands[1].driveStart = true;
  all.run(20);
  EXPECT_TRUE(all.status(1).driveStarted);
}

TEST(SercosFaults, AServiceChannelThatIsMuteDoesNotStopTheAxis) {
  Moving all;
  all.drives[0]->faults().mute = true;
  bus::ParameterRequest request;
  request.number = idns::kAcceleration;
  Slave &drive = all.master->drive(0);
  drive.ask(request);
  bus::ParameterAnswer answer;
  for (int i = 0; i < 200 && !drive.poll(answer); ++i)
    all.cycle();
  EXPECT_NE(answer.result, bus::ParameterAnswer::Result::Done);
  EXPECT_TRUE(all.status(0).driveStarted);
  all.drives[0]->faults().mute = false;
  drive.ask(request);
  for (int i = 0; i < 200 && !drive.poll(answer); ++i)
    all.cycle();
  EXPECT_EQ(answer.result, bus::ParameterAnswer::Result::Done);
  EXPECT_EQ(answer.value, 10'000'000);
}

TEST(SercosFaults, PhasesByProgram) {
  Moving all;
  all.master->commandPhase(Phase::Two);
  all.run(3);
  EXPECT_EQ(all.master->actualPhase(), Phase::Zero);
  all.run(50);
  for (const auto &drive : all.drives)
    EXPECT_FALSE(drive->hasTorque());
  all.move = nullptr;
  all.reset();
  all.run(4000);
  EXPECT_EQ(all.master->actualPhase(), Phase::Two) << "and no further";
  all.master->commandPhase(Phase::Four);
  all.runUp();
  EXPECT_TRUE(all.allStarted());
}

} // namespace
} // namespace stride::sercos
