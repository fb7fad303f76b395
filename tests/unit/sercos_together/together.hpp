// The master and the simulated ring, which do not know each other's code.
#ifndef STRIDE_TESTS_UNIT_SERCOS_TOGETHER_TOGETHER_HPP
#define STRIDE_TESTS_UNIT_SERCOS_TOGETHER_TOGETHER_HPP

#include "drivers/sercos/master/master.hpp"
#include "drivers/sercos/simulation/simulated_drive.hpp"
#include "drivers/sercos/simulation/simulated_ring.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stride::sercos {

/// Passes all on to a simulated ring, and shows what there was.
class WatchedRing final : public Ring {
public:
  explicit WatchedRing(simulation::SimulatedRing &ring) : ring_(ring) {}

  void cycle(const MasterTelegrams &sent, RingAnswers &answers) noexcept override {
    ring_.cycle(sent, answers);
    if (watch)
      watch(sent, answers);
  }
  void setLight(uint8_t percent) noexcept override { ring_.setLight(percent); }
  void setBaudRate(uint8_t megabits) noexcept override { ring_.setBaudRate(megabits); }

  std::function<void(const MasterTelegrams &, const RingAnswers &)> watch;

private:
  simulation::SimulatedRing &ring_;
};

struct Options {
  size_t drives = 4;
  double cycle = 0.003; ///< [s]
  uint32_t megabits = 2;
  uint8_t controlType = 5;
  std::vector<CyclicObject> more{};
  PackProfile profile = PackProfile::None;
  bool rotary = false;
  std::function<void(size_t, simulation::DriveSetup &)> setup{};
};

class Together {
public:
  explicit Together(const Options &options) {
    MasterConfig config;
    config.cycle = options.cycle;
    config.megabits = options.megabits;
    for (size_t i = 0; i < options.drives; ++i) {
      simulation::DriveSetup setup = setupOf(i, options);
      drives.push_back(std::make_unique<simulation::SimulatedDrive>(setup));
      config.drives.push_back(configOf(setup, options));
      ring.attach(*drives.back());
    }
    auto watched = std::make_unique<WatchedRing>(ring);
    watch = watched.get();
    master = std::make_unique<Master>(config, std::move(watched));
    commands.resize(options.drives);
    results.resize(options.drives);
    messages.resize(options.drives);
    progress.resize(options.drives);
  }

  /// A cycle as a drive group has it.
  void cycle() {
    master->executeStart();
    for (size_t i = 0; i < drives.size(); ++i) {
      if (results[i] == bus::StartUp::Busy)
        results[i] = master->init(i, progress[i], messages[i]);
      if (results[i] != bus::StartUp::Started)
        continue;
      if (move)
        move(i);
      master->drive(i).axis().command(commands[i]);
    }
    master->executeEnd();
    ++cycles;
  }
  void run(size_t times) {
    for (; times > 0; --times)
      cycle();
  }
  [[nodiscard]] bool allStarted() const {
    for (const bus::StartUp result : results)
      if (result != bus::StartUp::Started)
        return false;
    return true;
  }
  [[nodiscard]] bool anyFailed() const {
    for (const bus::StartUp result : results)
      if (result == bus::StartUp::Failed)
        return true;
    return false;
  }
  /// Cycles until all have started, or one has failed.
  size_t runUp(size_t most = 60'000) {
    const size_t before = cycles;
    while (!allStarted() && !anyFailed() && cycles - before < most)
      cycle();
    return cycles - before;
  }
  /// SMC_ResetAxisGroup.
  void reset() {
    for (size_t i = 0; i < drives.size(); ++i) {
      master->reset(i);
      results[i] = bus::StartUp::Busy;
      commands[i] = {};
      messages[i].set();
    }
  }
  [[nodiscard]] bus::DriveStatus status(size_t drive) const {
    return master->drive(drive).status();
  }

  /// Until all have torque and follow.
  void powerOn() {
    for (size_t i = 0; i < drives.size(); ++i) {
      commands[i].position = status(i).position;
      commands[i].regulatorOn = commands[i].driveStart = true;
    }
    for (int n = 0; n < 100; ++n) {
      for (size_t i = 0; i < drives.size(); ++i)
        if (!status(i).driveStarted)
          commands[i].position = status(i).position;
      cycle();
    }
    for (size_t i = 0; i < drives.size(); ++i)
      EXPECT_TRUE(status(i).regulatorOn && status(i).driveStarted) << i;
  }

  simulation::SimulatedRing ring;
  std::vector<std::unique_ptr<simulation::SimulatedDrive>> drives;
  std::unique_ptr<Master> master;
  WatchedRing *watch = nullptr;
  std::vector<bus::DriveCommand> commands;
  std::vector<bus::StartUp> results; ///< Busy at first.
  std::vector<bus::Message> messages;
  std::vector<uint16_t> progress;
  std::function<void(size_t)> move; ///< Sets the command of a drive.
  size_t cycles = 0;

private:
  static simulation::DriveSetup setupOf(size_t index, const Options &options) {
    simulation::DriveSetup setup;
    setup.device.address = static_cast<uint8_t>(index + 1);
    setup.drive.mechanics.cycle = options.cycle;
    setup.drive.switchCycles = 2;
    setup.drive.probeInputs = 15;
    setup.drive.homing = {false, 20000, 3000, 1'000'000};
    setup.drive.startPosition = 1000 * static_cast<int64_t>(index) - 70;
    setup.incrementsPerTurn = 36000;
    if (options.setup)
      options.setup(index, setup);
    return setup;
  }
  static DriveConfig configOf(const simulation::DriveSetup &setup, const Options &options) {
    DriveConfig drive;
    drive.address = static_cast<uint8_t>(setup.device.address);
    drive.cycle = options.cycle;
    drive.rotary = options.rotary;
    drive.period = options.rotary ? 36000 : 0;
    drive.torqueRated = setup.ratedTorque;
    drive.probeInputs = 15;
    drive.settings.profile = options.profile;
    CyclicWish wish;
    wish.controlType = options.controlType;
    wish.more = options.more;
    drive.settings.cyclic = planCyclic(wish, drive.settings.errors);
    EXPECT_TRUE(drive.settings.errors.empty());
    return drive;
  }
};

} // namespace stride::sercos

#endif
