// Whatever comes: drives survive all telegrams, and have torque only after the control words that
// ask for it.
#include "tests/unit/sercos_simulation/ring_master.hpp"

#include <random>

namespace stride::sercos::simulation {
namespace {

MasterTelegrams anything(std::mt19937 &random, uint8_t &phase) {
  MasterTelegrams sent;
  sent.periodNs =
      random() % 10 == 0 ? 1 + static_cast<int64_t>(random() % 20'000'000) : int64_t{2'000'000};
  sent.mst = random() % 20 != 0;
  if (random() % 30 == 0)
    phase = static_cast<uint8_t>(random() % 4 == 0 ? random() % 9 : (phase + 1) % 5);
  sent.phase = static_cast<Phase>(phase);
  sent.mdt = random() % 20 != 0;
  sent.mdtAddress = random() % 3 == 0 ? 255 : static_cast<uint8_t>(random() % 5);
  sent.mdtLength = random() % 4 == 0 ? static_cast<uint16_t>(random() % 9000) : uint16_t{8};
  for (size_t i = 0; i < 64; ++i)
    sent.mdtData[i] = static_cast<uint8_t>(random());
  return sent;
}

TEST(SercosRandom, DrivesSurviveEverything) {
  size_t answers = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    SimulatedRing ring;
    SimulatedDrive drive(plainDrive(3));
    SimulatedIo io({.device = {.address = 2}});
    ring.attach(drive);
    ring.attach(io);
    RingAnswers result;
    uint8_t phase = 0;
    for (int i = 0; i < 3000; ++i) {
      if (random() % 200 == 0)
        drive.faults().loseMdts = static_cast<uint32_t>(random() % 3);
      ring.cycle(anything(random, phase), result);
      ASSERT_LE(result.count, 2U);
      ASSERT_FALSE(drive.hasTorque() && drive.phase() != Phase::Four);
      answers += result.count;
    }
  }
  EXPECT_GT(answers, 1000U);
}

/// From phase 4 on, with control words at random: what the description of bits 15 and 14 allows.
TEST(SercosRandom, TorqueIsNeverFree) {
  size_t powered = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    DriveScene scene;
    RingMaster &master = scene.master;
    master.toPhase4();
    master.setTarget(3, 777);
    bool before = false;
    uint16_t word = 0;    // in the MDT of this cycle
    uint16_t earlier = 0; // in that of the cycle before
    bool error = false;
    for (int i = 0; i < 600; ++i) {
      const uint16_t known[] = {0x0000, 0xE000, 0xE000, 0xE000, 0xC000,
                                0x6000, 0x8000, 0x4000, 0xE000, static_cast<uint16_t>(random())};
      if (random() % 6 == 0)
        master.setControl(3, static_cast<uint16_t>(known[random() % 10] & 0xF4C0U));
      if (random() % 200 == 0)
        scene.drive.fail(static_cast<uint16_t>(1 + random() % 100));
      if (random() % 60 == 0 && error)
        master.command(3, 99);
      earlier = word;
      word = master.records[3].control;
      master.cycle();
      const bool now = scene.drive.hasTorque();
      if (now && !before) {
        EXPECT_EQ(word & 0xC000U, 0xC000U) << seed << ' ' << i << ' ' << earlier;
        EXPECT_FALSE(scene.drive.hasError());
      }
      EXPECT_FALSE(now && (word & 0x4000U) == 0) << "without enable never";
      powered += now ? 1U : 0U;
      before = now;
      error = scene.drive.hasError();
    }
  }
  EXPECT_GT(powered, 1000U);
}

} // namespace
} // namespace stride::sercos::simulation
