// Drives on a CAN bus: interface type "CAN".
#ifndef STRIDE_DRIVERS_CAN_CAN_DRIVER_HPP
#define STRIDE_DRIVERS_CAN_CAN_DRIVER_HPP

#include "drivers/can/can_setup.hpp"
#include "drivers/can/master/master.hpp"
#include "drivers/can/parameter_loader.hpp"
#include "drivers/can/port/port.hpp"
#include "runtime/bus/axis_driver.hpp"
#include "runtime/bus/group_setup.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stride::can {

/// What a drive is sent at the end of a cycle it does from the next SYNC on; what it says at a SYNC
/// is known one cycle later.
class CanDriver : public bus::AxisDriver {
public:
  CanDriver(const bus::GroupSetup &setup, std::unique_ptr<Port> port);

  void executeStart() override;
  void executeEnd() override;
  bus::StartUp init(size_t drive, uint16_t &progress, bus::Message &message) override;
  void reset(size_t drive) override;
  void resetOthers() override;
  [[nodiscard]] bus::DriveStatus status(size_t drive) const override;
  void command(size_t drive, const bus::DriveCommand &command) override;
  [[nodiscard]] uint8_t controllerModes(size_t drive) const override;
  [[nodiscard]] uint8_t captureInputs(size_t drive) const override;
  bool startParameter(size_t drive, const bus::ParameterRequest &request) override;
  bool pollParameter(size_t drive, bus::ParameterAnswer &answer) override;
  void cancelParameter(size_t drive) override;
  [[nodiscard]] uint32_t encoder(size_t encoder) const override;
  [[nodiscard]] bool encoderWorks(size_t encoder) const override;
  bool bindGroupData(void *data, uint64_t layout) override;
  void attach(bus::DriverHost &host) override;
  bus::SyncWake waitSync(int64_t afterNs, int64_t deadlineNs, bus::BusClock &clock) override;
  void applicationStopped() override;
  [[nodiscard]] bool atRest() const override;
  void problem(bus::Message &text) const override;

  [[nodiscard]] const Master &master() const { return master_; }

protected:
  void say(const bus::Message &text) { master_.news().say(text.text()); }

private:
  CanDriver(const CanSetup &setup, std::unique_ptr<Port> port);

  void startOthers();
  void stop();
  bool takeParameters();

  [[nodiscard]] Node &nodeOf(size_t drive) { return master_.node(places_[drive].node); }
  [[nodiscard]] const Node &nodeOf(size_t drive) const { return master_.node(places_[drive].node); }
  [[nodiscard]] Drive402 &driveAt(size_t drive) {
    return nodeOf(drive).drive(places_[drive].device);
  }
  [[nodiscard]] const Drive402 &driveAt(size_t drive) const {
    return nodeOf(drive).drive(places_[drive].device);
  }

  void showCounters();

  Master master_;
  void *counters_ = nullptr; ///< SMC_CAN_COUNTERS; null: nobody looks.
  BusLoad load_;
  std::vector<std::string> faults_; ///< Of each drive: why it cannot start.
  std::vector<std::string> notes_;
  std::unique_ptr<ParameterLoader> loader_; ///< Null: no drive has a file.
  bool awaits_ = false;                     ///< What the loader was asked for is still to be taken.
  bus::DriverHost *host_ = nullptr;
  int64_t periodNs_;
  uint32_t stopCycles_ = 0;        ///< Since the application has stopped …
  uint32_t stopPatience_;          ///< … until its drives are stopped by themselves.
  uint32_t offPatience_;           ///< … until nobody waits any more for them.
  std::vector<uint32_t> standing_; ///< Of each drive: cycles without a demand to move.
  std::vector<CanSetup::EncoderSource> encoders_;
  std::vector<CanSetup::DrivePlace> places_; ///< Of each drive.
  size_t driveNodes_;
  bool hasIos_ = false;
  std::vector<bool> othersFailed_; ///< Of each node after those of the drives.
  bool stopped_ = false;
};

/// The driver for one drive group of interface type "CAN", on a bus of setup.kind.
std::unique_ptr<bus::AxisDriver> makeDriver(const bus::GroupSetup &setup);

/// Of DUMMY_DRIVE_SIM, as this runtime knows it.
uint64_t driveDataLayout();

} // namespace stride::can

#endif
