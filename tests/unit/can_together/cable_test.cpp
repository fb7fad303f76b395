// Cables that are pulled at any time, and frames that do not come, come late, twice or damaged: no
// drive does what it was not told. STRIDE_CABLES=10000 pulls so many, and makes 1000 times as many
// cycles with such frames.
#include "tests/unit/can_together/together_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

namespace stride::can {
namespace {

using simulation::PowerState;

constexpr simulation::Station kMaster = 0;
constexpr int kStep = 40; ///< Largest change of a set position in a cycle. [inc]

/// Looks at all set values on the wire and at what the drives do with them.
class Judge final : public simulation::Tap {
public:
  explicit Judge(Together &scene) : scene_(scene) {}

  void seen(const Frame & /*frame*/, int64_t /*endNs*/,
            simulation::Station sender) noexcept override {
    frames += sender == kMaster ? 1U : 0U;
  }

  /// After each cycle.
  void look() {
    for (size_t i = 0; i < scene_.commands.size(); ++i) {
      simulation::SimulatedDrive402 &drive = scene_.network->drive(i);
      const int32_t place = drive.position();
      if (places_.size() <= i) {
        places_.push_back(place);
        states_.push_back(drive.power());
      }
      // Frames that are damaged unnoticed are not among the faults of these tests.
      ASSERT_LE(std::abs(place - places_[i]), 2 * kStep) << "drive " << i;
      const bool fault = states_[i] == PowerState::Fault || states_[i] == PowerState::FaultReaction;
      ASSERT_FALSE(fault && drive.power() == PowerState::OperationEnabled);
      places_[i] = place;
      states_[i] = drive.power();
    }
  }

  uint64_t frames = 0;

private:
  Together &scene_;
  std::vector<int32_t> places_;
  std::vector<PowerState> states_;
};

/// What the runtime does: what is lost or in error is switched off and follows what it is.
void guard(Together &scene, size_t drive) {
  const bus::DriveStatus status = scene.driver->status(drive);
  bus::DriveCommand &command = scene.commands[drive];
  if (status.communication && !status.error && status.driveStarted && command.driveStart)
    return;
  if (!status.communication || status.error)
    command.regulatorOn = command.driveStart = false;
  command.position = status.position;
}

TEST(CanCable, PulledAtAnyTimeNothingRunsAway) {
  const char *const many = std::getenv("STRIDE_CABLES");
  const unsigned rounds = many == nullptr ? 60 : static_cast<unsigned>(std::atoi(many));
  for (unsigned round = 0; round < rounds; ++round) {
    std::mt19937 random(round);
    Together scene;
    for (const uint32_t id : {4U, 7U})
      scene.add(id);
    scene.make();
    scene.run();
    Judge judge(scene);
    const auto moving = [&] {
      for (size_t i = 0; i < 2; ++i) {
        if (scene.commands[i].driveStart)
          scene.commands[i].position += static_cast<uint32_t>(kStep);
        guard(scene, i);
      }
    };
    const auto last = static_cast<unsigned>(random() % 300);
    for (unsigned i = 0; i < last; ++i) {
      scene.cycle(moving);
      judge.look();
    }
    // Before all drives or before the second, between two frames or within one.
    simulation::SimulatedBus &bus = scene.network->bus();
    const bool all = random() % 2 == 0;
    bus.runUntil(bus.nowNs() + static_cast<int64_t>(random() % 900000));
    bus.setPiece(all ? kMaster : simulation::Station{2}, 1);
    int32_t farthest = scene.network->drive(1).position();
    for (int i = 0; i < 400; ++i) {
      scene.cycle(moving);
      judge.look();
      farthest = std::max(farthest, scene.network->drive(1).position());
    }
    ASSERT_FALSE(scene.driver->status(1).communication) << round;
    ASSERT_EQ(scene.driver->status(0).communication, !all) << round;
    ASSERT_NE(scene.network->drive(1).power(), PowerState::OperationEnabled) << round;
    ASSERT_EQ(scene.network->drive(1).mechanics().velocity(), 0) << round;
    // It ends by its own watch over the master, 150 ms at most after the pull.
    bus.setPiece(all ? kMaster : simulation::Station{2}, 0);
    const int32_t rest = scene.network->drive(1).position();
    for (int i = 0; i < 100; ++i) {
      scene.cycle(moving);
      judge.look();
    }
    ASSERT_EQ(scene.network->drive(1).position(), rest) << "nothing starts again by itself";
    ASSERT_FALSE(scene.driver->status(1).communication) << round;
  }
}

TEST(CanCable, LostLateDoubleAndDisturbedFrames) {
  const char *const many = std::getenv("STRIDE_CABLES");
  const int cycles = many == nullptr ? 20'000 : 1000 * std::atoi(many);
  Together scene(0.002);
  for (const uint32_t id : {1U, 2U, 30U, 77U})
    scene.add(id);
  scene.make();
  scene.run();
  simulation::SimulatedBus &bus = scene.network->bus();
  Judge judge(scene);
  bus.setTap(&judge);
  simulation::FaultRates rates;
  rates.lose = 300;
  rates.delay = 100;
  rates.duplicate = 1000;
  rates.disturb = 5000;
  rates.longestDelayNs = 3'000'000;
  bus.faults().set(rates);
  int restarts = 0;
  int moved = 0;
  for (int i = 0; i < cycles; ++i) {
    scene.cycle([&] {
      for (size_t k = 0; k < scene.commands.size(); ++k) {
        const bus::DriveStatus status = scene.driver->status(k);
        bus::DriveCommand &command = scene.commands[k];
        if (status.driveStarted && command.driveStart) {
          command.position +=
              static_cast<uint32_t>((i / 500 + static_cast<int>(k)) % 2 == 0 ? 17 : -17);
          ++moved;
        }
        command.errorAckn = status.error && i % 100 < 50;
        guard(scene, k);
        if (!scene.started[k])
          continue;
        if (!status.communication && i % 200 == 0) { // SMC_ResetAxisGroup
          scene.driver->reset(k);
          scene.started[k] = false;
          ++restarts;
        } else if (status.communication && !status.error) {
          command.regulatorOn = command.driveStart = true;
        }
      }
    });
    judge.look();
    if (::testing::Test::HasFatalFailure())
      FAIL() << "in cycle " << i;
    scene.failed.clear(); // a start-up may fail; it is tried again
  }
  EXPECT_GT(moved, cycles) << "most of the time most of them move";
  EXPECT_GT(judge.frames, static_cast<uint64_t>(cycles));
  EXPECT_GT(restarts, cycles / 2000) << "drives are lost, and come back";
}

} // namespace
} // namespace stride::can
