// Whatever comes: a node survives all frames, and a drive has power only after the controlwords
// that the profile asks for. Runs are the same to the bit.
#include "tests/unit/can_simulation/drive_scene.hpp"

#include "drivers/can/simulation/wire.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>

namespace stride::can::simulation {
namespace {

/// What the profile's picture allows, and nothing of the drive's code.
struct Walk {
  PowerState state = PowerState::SwitchOnDisabled;

  /// Whether the drive may be there now; `words` is what it was told since.
  bool allows(PowerState now, const std::vector<uint16_t> &words) const {
    if (now == state)
      return true;
    const auto told = [&](unsigned mask, unsigned value) {
      for (const uint16_t word : words)
        if ((word & mask) == value)
          return true;
      return false;
    };
    switch (now) {
    case PowerState::ReadyToSwitchOn:
      return state != PowerState::Fault && told(0x87, 0x06);
    case PowerState::SwitchedOn:
      return (state == PowerState::ReadyToSwitchOn && told(0x87, 0x07)) ||
             (state == PowerState::OperationEnabled && told(0x8F, 0x07));
    case PowerState::OperationEnabled:
      return (state == PowerState::SwitchedOn || state == PowerState::QuickStopActive) &&
             told(0x8F, 0x0F);
    case PowerState::QuickStopActive:
      return state == PowerState::OperationEnabled;
    case PowerState::FaultReaction:
      return true;
    case PowerState::Fault:
      return true;
    case PowerState::SwitchOnDisabled:
      return state != PowerState::Fault || told(0x80, 0x80);
    default:
      return false;
    }
  }
};

Frame anything(std::mt19937 &random) {
  // Mostly what the node listens to.
  constexpr uint16_t kIds[] = {0x000, 0x080, 0x205, 0x305, 0x405, 0x505,
                               0x605, 0x605, 0x605, 0x705, 0x77E, 0x7E5};
  Frame frame;
  frame.id = random() % 8 == 0 ? static_cast<uint16_t>(random() % 2048) : kIds[random() % 12];
  frame.length = static_cast<uint8_t>(random() % 4 == 0 ? random() % 9 : 8);
  frame.remote = random() % 50 == 0;
  for (uint8_t i = 0; i < frame.length; ++i)
    frame.data[i] = static_cast<uint8_t>(random());
  if (frame.id == 0x605) { // often an object that there is
    constexpr uint16_t kObjects[] = {0x1400, 0x1600, 0x1800, 0x1A00, 0x1005, 0x1006,
                                     0x1010, 0x1016, 0x1017, 0x100C, 0x1019, 0x1029,
                                     0x6040, 0x6060, 0x607A, 0x6098, 0x60B8, 0x60C2,
                                     0x6007, 0x605A, 0x6083, 0x607C, 0x1008, 0x60FF};
    const uint16_t index = kObjects[random() % 24];
    frame.data[1] = static_cast<uint8_t>(index & 0xFFU);
    frame.data[2] = static_cast<uint8_t>(index >> 8U);
    frame.data[3] = static_cast<uint8_t>(random() % 4);
    if (random() % 2 == 0)
      frame.data[0] = static_cast<uint8_t>(0x22U | random() % 16U);
  }
  if (frame.id == 0 && random() % 2 == 0) {
    frame.length = 2;
    constexpr uint8_t kCommands[] = {1, 1, 1, 2, 0x80, 0x81, 0x82};
    frame.data[0] = kCommands[random() % 7];
    frame.data[1] = 5;
  }
  if (frame.id == 0x080 && random() % 2 == 0)
    frame.length = 0;
  return frame;
}

TEST(CanRandom, NodesSurviveEverythingAndPowerIsNeverFree) {
  size_t enabled = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    Drive402Setup setup = plainDrive();
    setup.drive.mechanics.model = dummy::Model::SecondOrder;
    setup.drive.mechanics.torqueLimit = 1;
    setup.drive.mechanics.inertia = 1e-6;
    setup.node.bootNs = 2'000'000;
    setup.node.remotely = seed % 3 == 0;
    SimulatedDrive402 drive(setup);
    drive.powerOn(0);
    Walk walk;
    walk.state = drive.power();
    int64_t now = 0;
    std::vector<uint16_t> words; // since it is in this state: a ramp may come first
    for (int i = 0; i < 4000; ++i) {
      now += static_cast<int64_t>(random() % 700'000);
      int rounds = 0;
      while (drive.nextNs() <= now) {
        drive.advance(drive.nextNs());
        ASSERT_LT(++rounds, 3000) << "time stands still";
      }
      if (random() % 4 == 0) { // somebody who knows the way
        const uint16_t known[] = {0x80, 0x06, 0x07, 0x0F, 0x1F, 0x02, 0x00, 0x86};
        const uint16_t word = known[random() % 8];
        drive.receive(frameOf(0x605, {0x2B, 0x40, 0x60, 0, word, 0U, 0U, 0U}), now);
      } else {
        drive.receive(anything(random), now);
      }
      words.push_back(static_cast<uint16_t>(drive.objects().value(0x6040)));
      ASSERT_TRUE(walk.allows(drive.power(), words) || drive.state() == NmtState::Initialising)
          << seed << ' ' << i << ": " << static_cast<int>(walk.state) << " to "
          << static_cast<int>(drive.power());
      if (walk.state != drive.power())
        words.clear();
      walk.state = drive.power();
      enabled += walk.state == PowerState::OperationEnabled ? 1U : 0U;
      Frame frame;
      for (int k = 0; k < 200 && random() % 4 != 0 && drive.transmit(frame); ++k) {
        ASSERT_LE(frame.length, 8);
        ASSERT_LE(frame.id, Frame::kLastId);
      }
    }
  }
  EXPECT_GT(enabled, 1000U) << "the walk is found now and then";
}

/// A hash of all that there was on the bus.
class Signature : public Tap {
public:
  void seen(const Frame &frame, int64_t endNs, Station sender) noexcept override {
    mix(frame.id);
    for (const uint8_t byte : frame.bytes())
      mix(byte);
    mix(static_cast<uint64_t>(endNs));
    mix(sender);
  }
  uint64_t value = 14695981039346656037U;

private:
  void mix(uint64_t word) { value = (value ^ word) * 1099511628211U; }
};

uint64_t runWith(uint64_t seed) {
  BusSetup setup;
  setup.seed = seed;
  DriveScene scene;
  Master master(setup);
  Signature signature;
  master.bus.setTap(&signature);
  std::vector<std::unique_ptr<SimulatedDrive402>> drives;
  for (uint8_t id = 1; id <= 6; ++id) {
    drives.push_back(std::make_unique<SimulatedDrive402>(plainDrive(id)));
    master.bus.attach(*drives.back(), id * 2000);
  }
  master.cycle(25);
  for (uint8_t id = 1; id <= 6; ++id) {
    master.configure(id, false, 0, 0x200U + id, 1, {0x60400010, 0x607A0020});
    master.configure(id, true, 0, 0x180U + id, 1, {0x60410010, 0x60640020});
    master.write(id, 0x6060, 0, 8, 1);
  }
  FaultRates rates;
  rates.lose = rates.delay = rates.duplicate = rates.corrupt = rates.disturb = 20'000;
  rates.longestDelayNs = 3'000'000;
  master.bus.faults().set(rates);
  master.send(0, {1, 0});
  for (unsigned i = 0; i < 600; ++i) {
    master.syncCycle();
    for (uint8_t id = 1; id <= 6; ++id)
      master.send(static_cast<uint16_t>(0x200 + id),
                  {i < 20   ? 6U
                   : i < 40 ? 7U
                            : 15U,
                   0, i & 0xFFU, 3, 0, 0},
                  SendClass::Process);
  }
  return signature.value;
}

TEST(CanRandom, TheSameSeedGivesTheSameBits) {
  const uint64_t once = runWith(5);
  EXPECT_EQ(runWith(5), once);
  EXPECT_NE(runWith(6), once);
}

TEST(CanRandom, ACableThatIsPulledLeavesNobodyInMotion) {
  for (unsigned round = 0; round < 200; ++round) {
    DriveScene scene;
    ASSERT_EQ(scene.master.write(5, 0x1016, 1, 126U << 16U | 5, 4), 0U);
    ASSERT_EQ(scene.master.write(5, 0x6085, 0, 5'000'000, 4), 0U);
    scene.operate();
    scene.enable();
    int32_t target = scene.drive.position();
    const unsigned last = 10 + round;
    for (unsigned i = 0; i < last; ++i) {
      scene.master.send(0x77E, {5});
      scene.cycle(0x0F, target += 20);
    }
    // In the middle of a frame, or between two.
    scene.master.bus.runUntil(scene.master.bus.nowNs() + round * 4'321 % 1'000'000);
    scene.master.bus.setPiece(scene.master.station, 1);
    scene.master.cycle(12);
    ASSERT_EQ(scene.drive.power(), PowerState::Fault) << round;
    ASSERT_LE(scene.drive.position(), target + 20 * 5 + 40) << round;
    ASSERT_GE(scene.drive.position(), target - 60) << round;
    const int32_t rest = scene.drive.position();
    scene.master.bus.setPiece(scene.master.station, 0);
    scene.master.cycle(20);
    for (int i = 0; i < 5; ++i)
      scene.cycle(0x0F, target);
    ASSERT_EQ(scene.drive.power(), PowerState::Fault);
    ASSERT_EQ(scene.drive.position(), rest);
  }
}

} // namespace
} // namespace stride::can::simulation
