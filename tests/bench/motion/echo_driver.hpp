#ifndef STRIDE_TESTS_BENCH_MOTION_ECHO_DRIVER_HPP
#define STRIDE_TESTS_BENCH_MOTION_ECHO_DRIVER_HPP

#include "runtime/axis/axis_driver.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stride::bench {

/// Drives that cost nothing: what they are told has happened in the next cycle.
class EchoDriver final : public stride::axis::AxisDriver {
public:
  explicit EchoDriver(std::size_t count) : statuses_(count) {
    for (auto &status : statuses_)
      status.communication = true;
  }
  void executeStart() override {}
  void executeEnd() override {}
  stride::axis::StartUp init(std::size_t /*drive*/, uint16_t & /*progress*/,
                             stride::axis::Message & /*message*/) override {
    return stride::axis::StartUp::Started;
  }
  void reset(std::size_t /*drive*/) override {}
  [[nodiscard]] stride::axis::DriveStatus status(std::size_t drive) const override {
    return statuses_[drive];
  }
  void command(std::size_t drive, const stride::axis::DriveCommand &command) override {
    auto &status = statuses_[drive];
    status.position = command.position;
    status.velocity = command.velocity;
    status.regulatorOn = command.regulatorOn;
    status.driveStarted = command.driveStart;
  }
  [[nodiscard]] uint8_t controllerModes(std::size_t /*drive*/) const override { return 8; }

private:
  std::vector<stride::axis::DriveStatus> statuses_;
};

} // namespace stride::bench

#endif
