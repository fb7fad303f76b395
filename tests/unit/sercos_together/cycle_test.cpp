// The cycle itself: no memory, the same bits each time, and whatever goes wrong at random.
#include "tests/unit/sercos_together/together.hpp"

#include <random>

namespace stride::test {
size_t allocations();
}

namespace stride::sercos {
namespace {

TEST(SercosCycle, AllocatesNothing) {
  Together all({.drives = 4});
  all.cycle();
  const size_t before = stride::test::allocations();
  all.runUp();
  for (bus::DriveCommand &command : all.commands)
    command.regulatorOn = command.driveStart = true;
  for (int i = 0; i < 300; ++i) {
    for (bus::DriveCommand &command : all.commands) {
      command.position += 7;
      command.capture = static_cast<uint8_t>(i / 40 % 4);
    }
    all.cycle();
  }
  all.ring.faults().open = true;
  all.run(20);
  all.ring.faults().open = false;
  all.reset();
  all.runUp();
  EXPECT_EQ(stride::test::allocations(), before);
  EXPECT_TRUE(all.allStarted());
}

/// Faults at random, and the way back from each: drives never have torque that nobody wants, and
/// the ring comes up again each time. Gives a hash of all that was on the ring.
uint64_t troubles(unsigned seed, size_t &falls) {
  std::mt19937 random(seed);
  Together all({.drives = 3});
  uint64_t hash = 14695981039346656037U;
  const auto mix = [&hash](uint64_t word) { hash = (hash ^ word) * 1099511628211U; };
  all.watch->watch = [&](const MasterTelegrams &sent, const RingAnswers &answers) {
    mix(static_cast<uint64_t>(sent.phase));
    for (size_t i = 0; sent.mdt && i < sent.mdtLength; ++i)
      mix(sent.mdtData[i]);
    for (const DriveTelegram &at : answers.ats())
      for (const uint8_t byte : at.bytes())
        mix(byte);
  };
  for (int round = 0; round < 6; ++round) {
    all.runUp();
    EXPECT_TRUE(all.allStarted()) << seed << ' ' << round << ' ' << all.messages[0].text();
    for (bus::DriveCommand &command : all.commands)
      command.errorAckn = true;
    all.run(60);
    for (bus::DriveCommand &command : all.commands)
      command.errorAckn = false;
    all.powerOn();
    for (int i = 0; i < 200; ++i) {
      simulation::DeviceFaults &faults = all.drives[random() % 3]->faults();
      switch (random() % 40) {
      case 0:
        faults.loseAts = static_cast<uint32_t>(random() % 3);
        break;
      case 1:
        faults.loseMdts = static_cast<uint32_t>(random() % 3);
        break;
      case 2:
        faults.distortAts = static_cast<uint32_t>(random() % 3);
        break;
      case 3:
        all.ring.faults().loseMsts = static_cast<uint32_t>(random() % 3);
        break;
      case 4:
        all.drives[random() % 3]->fail(static_cast<uint16_t>(1 + random() % 9));
        break;
      default:
        break;
      }
      for (size_t k = 0; k < 3; ++k)
        if (all.status(k).driveStarted)
          all.commands[k].position += static_cast<uint32_t>(random() % 20);
      all.cycle();
    }
    for (bus::DriveCommand &command : all.commands)
      command.regulatorOn = command.driveStart = false;
    all.run(300);
    for (const auto &drive : all.drives) {
      EXPECT_FALSE(drive->hasTorque()) << seed;
      drive->faults() = {};
    }
    all.ring.faults() = {};
    all.reset();
  }
  falls += all.master->counters().ringFalls;
  return hash;
}

TEST(SercosCycle, TroublesEnd) {
  size_t falls = 0;
  for (unsigned seed = 0; seed < 12; ++seed)
    (void)troubles(seed, falls);
  EXPECT_GT(falls, 10U);
}

TEST(SercosCycle, RunsAreTheSameToTheBit) {
  size_t falls = 0;
  const uint64_t first = troubles(4, falls);
  EXPECT_EQ(troubles(4, falls), first);
  EXPECT_NE(troubles(5, falls), first);
}

} // namespace
} // namespace stride::sercos
