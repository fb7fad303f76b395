// Drives on a Sercos ring: interface type "Sercos".
#ifndef STRIDE_DRIVERS_SERCOS_SERCOS_DRIVER_HPP
#define STRIDE_DRIVERS_SERCOS_SERCOS_DRIVER_HPP

#include "drivers/sercos/master/master.hpp"
#include "drivers/sercos/sercos_setup.hpp"
#include "runtime/bus/axis_driver.hpp"
#include "runtime/bus/group_setup.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stride::sercos {

/// What a drive is sent at the end of a cycle goes with that cycle's MDT, is valid from the MST of
/// the next cycle on, and reached at that of the one after it; what it says at an MST is known in
/// that cycle. So a set position is seen as the actual one two cycles later, with ideal mechanics.
class SercosDriver : public bus::AxisDriver {
public:
  SercosDriver(const bus::GroupSetup &setup, std::unique_ptr<Ring> ring);

  void executeStart() override;
  void executeEnd() override;
  bus::StartUp init(size_t drive, uint16_t &progress, bus::Message &message) override;
  void reset(size_t drive) override;
  [[nodiscard]] bus::DriveStatus status(size_t drive) const override;
  void command(size_t drive, const bus::DriveCommand &command) override;
  [[nodiscard]] uint8_t controllerModes(size_t drive) const override;
  [[nodiscard]] uint8_t captureInputs(size_t drive) const override;
  bool startParameter(size_t drive, const bus::ParameterRequest &request) override;
  bool pollParameter(size_t drive, bus::ParameterAnswer &answer) override;
  void cancelParameter(size_t drive) override;
  [[nodiscard]] uint32_t encoder(size_t encoder) const override;
  [[nodiscard]] bool encoderWorks(size_t encoder) const override;
  void attach(bus::DriverHost &host) override;
  void applicationStopped() override;
  [[nodiscard]] bool atRest() const override;
  void problem(bus::Message &text) const override;

  [[nodiscard]] const Master &master() const { return master_; }
  /// The ring as a whole: phases, baud rate, optical power.
  [[nodiscard]] RingControl &ringControl() { return master_; }

protected:
  [[nodiscard]] Master &ringMaster() { return master_; }

private:
  SercosDriver(const SercosSetup &setup, std::unique_ptr<Ring> ring);

  void stop();

  Master master_;
  std::vector<std::string> faults_; ///< Of each drive: why it cannot start.
  std::vector<size_t> encoders_;    ///< Of each: its drive, or SercosSetup::kNoDrive.
  std::vector<uint32_t> standing_;  ///< Of each drive: cycles without a demand to move.
  uint32_t stopCycles_ = 0;         ///< Since the application has stopped …
  uint32_t stopPatience_;           ///< … until its drives are stopped by themselves.
  uint32_t offPatience_;            ///< … until nobody waits any more for them.
  bool stopped_ = false;
};

/// The driver for one drive group of interface type "Sercos", on a simulated ring.
std::unique_ptr<bus::AxisDriver> makeDriver(const bus::GroupSetup &setup);

/// Of SERCOS_DRIVE_SIM, as this runtime knows it.
uint64_t driveDataLayout();

} // namespace stride::sercos

#endif
