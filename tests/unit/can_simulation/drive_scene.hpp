// A master and a simulated drive with cyclic positions.
#ifndef STRIDE_TESTS_UNIT_CAN_SIMULATION_DRIVE_SCENE_HPP
#define STRIDE_TESTS_UNIT_CAN_SIMULATION_DRIVE_SCENE_HPP

#include "tests/unit/can_simulation/can_master.hpp"

#include "drivers/can/simulation/drive402.hpp"

#include <gtest/gtest.h>

namespace stride::can::simulation {

inline Drive402Setup plainDrive(uint8_t id = 5) {
  Drive402Setup setup;
  setup.node.id = id;
  setup.node.vendor = 0x1234;
  setup.drive.mechanics.cycle = 0.001;
  setup.drive.switchCycles = 1;
  setup.drive.probeInputs = 15;
  setup.drive.homing = {false, 20000, 3000, 1'000'000};
  setup.drive.startPosition = 777;
  return setup;
}

struct DriveScene {
  explicit DriveScene(const Drive402Setup &setup = plainDrive()) : drive(setup) {
    master.bus.attach(drive);
    master.cycle(25); // boot-up
    id = setup.node.id;
  }

  /// RPDO1: control word and `target`; TPDO1: statusword and position; both with SYNC.
  void operate(int8_t mode = 8, uint32_t target = 0x607A0020, uint32_t actual = 0x60640020) {
    ASSERT_EQ(master.configure(id, false, 0, 0x200U + id, 1, {0x60400010, target}), 0U);
    ASSERT_EQ(master.configure(id, true, 0, 0x180U + id, 1, {0x60410010, actual}), 0U);
    ASSERT_EQ(master.write(id, 0x6060, 0, static_cast<uint8_t>(mode), 1), 0U);
    master.send(0, {1, id});
    master.cycle(2);
  }

  /// A cycle: SYNC, what has come, and then set values.
  void cycle(uint16_t controlword, int32_t target) {
    const size_t before = master.seen.size();
    master.syncCycle();
    for (size_t i = before; i < master.seen.size(); ++i)
      if (const Received &received = master.seen[i]; received.frame.id == 0x180 + id) {
        status = static_cast<uint16_t>(wordAt(received.frame, 0, 2));
        actual = static_cast<int32_t>(wordAt(received.frame, 2, 4));
        ++telegrams;
      }
    const auto bits = static_cast<uint32_t>(target);
    master.send(static_cast<uint16_t>(0x200 + id),
                {controlword & 0xFFU, static_cast<unsigned>(controlword >> 8U), bits & 0xFFU,
                 bits >> 8U & 0xFFU, bits >> 16U & 0xFFU, bits >> 24U},
                SendClass::Process);
  }

  /// Until it is in operation enabled, at its place or with another set value.
  void enable(int32_t target) {
    for (const uint16_t word : {uint16_t{0x06}, uint16_t{0x07}, uint16_t{0x0F}})
      for (int i = 0; i < 5; ++i)
        cycle(word, target);
    ASSERT_EQ(drive.power(), PowerState::OperationEnabled);
  }

  void enable() { enable(drive.position()); }

  Master master;
  SimulatedDrive402 drive;
  uint8_t id = 0;
  uint16_t status = 0;
  int32_t actual = 0;
  int telegrams = 0;
};

} // namespace stride::can::simulation

#endif
