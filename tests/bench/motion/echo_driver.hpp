#ifndef STRIDE_TESTS_BENCH_MOTION_ECHO_DRIVER_HPP
#define STRIDE_TESTS_BENCH_MOTION_ECHO_DRIVER_HPP

#include "runtime/bus/axis_driver.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stride::bench {

/// Drives that cost nothing: what they are told has happened in the next cycle.
class EchoDriver final : public stride::bus::AxisDriver {
public:
  explicit EchoDriver(size_t count) : statuses_(count) {
    for (auto &status : statuses_)
      status.communication = true;
  }
  void executeStart() override {}
  void executeEnd() override {}
  stride::bus::StartUp init(size_t /*drive*/, uint16_t & /*progress*/,
                            stride::bus::Message & /*message*/) override {
    return stride::bus::StartUp::Started;
  }
  void reset(size_t /*drive*/) override {}
  [[nodiscard]] stride::bus::DriveStatus status(size_t drive) const override {
    return statuses_[drive];
  }
  void command(size_t drive, const stride::bus::DriveCommand &command) override {
    auto &status = statuses_[drive];
    status.position = command.position;
    status.velocity = command.velocity;
    status.regulatorOn = command.regulatorOn;
    status.driveStarted = command.driveStart;
  }
  [[nodiscard]] uint8_t controllerModes(size_t /*drive*/) const override { return 8; }

private:
  std::vector<stride::bus::DriveStatus> statuses_;
};

} // namespace stride::bench

#endif
