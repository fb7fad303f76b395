// Simulated drives: interface type "Dummy".
#ifndef STRIDE_DRIVERS_DUMMY_DUMMY_DRIVE_HPP
#define STRIDE_DRIVERS_DUMMY_DUMMY_DRIVE_HPP

#include "runtime/axis/axis_driver.hpp"

#include <memory>
#include <vector>

namespace stride::dummy {

/// Ideal drives on an ideal bus. A drive needs three cycles to start up and two to switch its
/// regulator or brake. In regulation it is, at the start of a cycle, exactly where the cycle before
/// told it to be: actual values lag set values by one cycle, as on a real bus. Out of regulation,
/// or with the brake applied, it stands still.
class DummyDriver final : public axis::AxisDriver {
public:
  static constexpr uint16_t kStartUpCycles = 3;
  static constexpr uint8_t kSwitchCycles = 2;

  explicit DummyDriver(std::size_t drives) : drives_(drives) {}

  void executeStart() override {}
  void executeEnd() override;
  axis::StartUp init(std::size_t drive, uint16_t &progress, std::string &message) override;
  [[nodiscard]] axis::DriveStatus status(std::size_t drive) const override;
  void command(std::size_t drive, const axis::DriveCommand &command) override;

  /// Simulates an error of the drive: it goes out of regulation until the error is acknowledged.
  void raiseError(std::size_t drive, uint16_t errorId);

  /// Simulates that the drive no longer answers, or answers again.
  void setCommunication(std::size_t drive, bool answers);

  /// Simulates that an unpowered axis is turned by hand.
  void setPosition(std::size_t drive, uint32_t position);

private:
  struct Drive {
    axis::DriveStatus status;
    axis::DriveCommand command;
    uint16_t started = 0;
    uint8_t regulatorDelay = 0;
    uint8_t brakeDelay = 0;
  };
  std::vector<Drive> drives_;
};

/// The driver for one axis group of interface type "Dummy".
std::unique_ptr<axis::AxisDriver> makeDummyDriver(std::size_t drives);

} // namespace stride::dummy

#endif
