// The driver of a drive group and its simulated drives, each the other's judge: neither knows how
// the other one is written.
#ifndef STRIDE_TESTS_UNIT_CAN_TOGETHER_TOGETHER_SCENE_HPP
#define STRIDE_TESTS_UNIT_CAN_TOGETHER_TOGETHER_SCENE_HPP

#include "drivers/can/can_driver.hpp"
#include "drivers/can/schema.hpp"
#include "drivers/can/simulated_network.hpp"
#include "runtime/bus/group_setup.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stride::can {

class QuietHost final : public bus::DriverHost {
public:
  void raise(bus::BusEvent /*event*/) noexcept override {}
  void say(const bus::Message & /*news*/) noexcept override { ++said; }
  int said = 0;
};

/// Drives with 1000 increments per unit. What the runtime does around a driver is here as little as
/// it can be: a drive in error or without communication is switched off.
struct Together {
  explicit Together(double cycle = 0.001) : setup(kSchema, cycle) {}

  bus::SetupParameters &add(uint32_t id, double controlType = 4) {
    bus::SetupParameters &drive = setup.addDrive("D" + std::to_string(id), id).parameters;
    drive.add({"wControlType", "", controlType});
    drive.add({"dwRatioTechUnitsDenom", "", 1000});
    return drive;
  }

  void make() {
    auto port = std::make_unique<SimulatedNetwork>(setup);
    network = port.get();
    driver = std::make_unique<CanDriver>(setup, std::move(port));
    driver->attach(host);
    commands.resize(setup.drives.size());
    started.assign(setup.drives.size(), false);
  }

  /// One cycle. `move` may change the commands between what was received and what is sent.
  template <class Move> void cycle(const Move &move) {
    driver->executeStart();
    for (size_t i = 0; i < commands.size(); ++i) {
      if (!started[i]) {
        uint16_t progress = 0;
        bus::Message message;
        const bus::StartUp result = driver->init(i, progress, message);
        started[i] = result == bus::StartUp::Started;
        if (result == bus::StartUp::Failed)
          failed = message.text();
        commands[i].position = driver->status(i).position;
      }
    }
    move();
    for (size_t i = 0; i < commands.size(); ++i)
      if (started[i])
        driver->command(i, commands[i]);
    driver->executeEnd();
  }
  void cycle() {
    cycle([] {});
  }

  bool allStarted() const {
    for (const bool one : started)
      if (!one)
        return false;
    return true;
  }

  /// Until all have started and are in operation.
  void run(uint8_t mode = 3) {
    for (int i = 0; i < 3000 && !allStarted() && failed.empty(); ++i)
      cycle();
    ASSERT_EQ(failed, "");
    ASSERT_TRUE(allStarted());
    for (bus::DriveCommand &command : commands) {
      command.regulatorOn = command.driveStart = true;
      command.controllerMode = mode;
    }
    const auto ready = [&] {
      for (size_t i = 0; i < commands.size(); ++i)
        if (!driver->status(i).driveStarted || !driver->status(i).regulatorOn)
          return false;
      return true;
    };
    for (int i = 0; i < 500 && !ready(); ++i)
      cycle();
    ASSERT_TRUE(ready());
  }

  bus::GroupSetup setup;
  QuietHost host;
  SimulatedNetwork *network = nullptr; ///< The driver's port.
  std::unique_ptr<CanDriver> driver;
  std::vector<bus::DriveCommand> commands;
  std::vector<bool> started;
  std::string failed;
};

} // namespace stride::can

#endif
