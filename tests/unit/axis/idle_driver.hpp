// A driver of drives that do nothing: for tests, which replace what they look at.
#ifndef STRIDE_TESTS_UNIT_AXIS_IDLE_DRIVER_HPP
#define STRIDE_TESTS_UNIT_AXIS_IDLE_DRIVER_HPP

#include "runtime/bus/drive_group.hpp"

#include <cstdint>

namespace stride::test {

/// Starts at once, hears nothing and says nothing; position control (8) is all that it can.
class IdleDriver : public bus::AxisDriver {
public:
  void executeStart() override {}
  void executeEnd() override {}
  bus::StartUp init(size_t /*drive*/, uint16_t & /*progress*/,
                    bus::Message & /*message*/) override {
    return bus::StartUp::Started;
  }
  void reset(size_t /*drive*/) override { ++resets; }
  [[nodiscard]] bus::DriveStatus status(size_t /*drive*/) const override { return {}; }
  void command(size_t /*drive*/, const bus::DriveCommand & /*command*/) override {}
  [[nodiscard]] uint8_t controllerModes(size_t /*drive*/) const override { return 8; }

  int resets = 0;
};

} // namespace stride::test

#endif // STRIDE_TESTS_UNIT_AXIS_IDLE_DRIVER_HPP
