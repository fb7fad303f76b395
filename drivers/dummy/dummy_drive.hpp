// Simulated drives: interface type "Dummy". See docs/dummy-drive.md.
#ifndef STRIDE_DRIVERS_DUMMY_DUMMY_DRIVE_HPP
#define STRIDE_DRIVERS_DUMMY_DUMMY_DRIVE_HPP

#include "drivers/dummy/drive_parameters.hpp"
#include "drivers/dummy/reference_run.hpp"
#include "drivers/dummy/schema.hpp"
#include "drivers/dummy/simulated_sync.hpp"
#include "runtime/bus/axis_driver.hpp"

#include "st/DummyDrive/DUMMY_DRIVE_SIM.h"

#include <memory>
#include <vector>

namespace stride::dummy {

using DriveSim = ::st::DummyDrive::DUMMY_DRIVE_SIM;

/// Drives on an ideal bus: what is sent at the end of a cycle has been carried out at the start of
/// the next one, as far as the mechanics let it. Without a `physics` section a drive needs three
/// cycles to start up and two to switch its regulator or brake, and is in regulation exactly where
/// the cycle before told it to be. Out of regulation, or with the brake applied, it stands still.
class DummyDriver final : public bus::AxisDriver {
public:
  explicit DummyDriver(const bus::GroupSetup &setup);

  void executeStart() override;
  void executeEnd() override;
  bus::StartUp init(size_t drive, uint16_t &progress, bus::Message &message) override;
  void reset(size_t drive) override;
  [[nodiscard]] bus::DriveStatus status(size_t drive) const override;
  void command(size_t drive, const bus::DriveCommand &command) override;
  [[nodiscard]] uint8_t controllerModes(size_t drive) const override;
  [[nodiscard]] uint8_t captureInputs(size_t drive) const override {
    return drives_[drive].parameters.probeInputs;
  }
  [[nodiscard]] uint32_t encoder(size_t encoder) const override;
  void bindData(size_t drive, void *data) override;
  bool startParameter(size_t drive, const bus::ParameterRequest &request) override;
  bool pollParameter(size_t drive, bus::ParameterAnswer &answer) override;
  void cancelParameter(size_t drive) override;
  void attach(bus::DriverHost &host) override { host_ = &host; }
  bus::SyncWake waitSync(int64_t afterNs, int64_t deadlineNs, bus::BusClock &clock) override;
  void applicationStopped() override;
  [[nodiscard]] bool atRest() const override;
  void problem(bus::Message &text) const override;

  /// Simulates an error of the drive: it goes out of regulation until the error is acknowledged.
  void raiseError(size_t drive, uint16_t errorId);

  /// Simulates that the drive no longer answers, or answers again.
  void setCommunication(size_t drive, bool answers);

  /// Simulates that an unpowered axis is turned by hand.
  void setPosition(size_t drive, uint32_t position);

private:
  struct Drive {
    explicit Drive(const DriveParameters &parameters);

    DriveParameters parameters;
    Mechanics mechanics;
    ReferenceRun homing;
    bus::DriveStatus status;
    bus::DriveCommand command;
    std::vector<Demand> delayed; ///< Set values under way: a ring.
    size_t oldest = 0;
    int64_t demanded = 0;        ///< Last set position, over any number of turns. [inc]
    double velocityDemanded = 0; ///< Last set velocity. [inc/s]
    int64_t reached = 0;         ///< Last set position that has reached the drive. [inc]
    uint32_t started = 0;
    uint32_t regulatorDelay = 0;
    uint32_t brakeDelay = 0;
    bool lost = false;           ///< By setCommunication.
    bus::ParameterRequest asked; ///< The question for a parameter …
    uint32_t askedCycles = 0;    ///< … and the cycles until it is answered; 0: it is.
    bool stops = false;          ///< By itself: a quick stop.
    double stopRest = 0;         ///< Of its set position, below one increment.
    bool index = false;
    double indexMark = 0; ///< [inc]
    DriveSim *sim = nullptr;
  };

  struct Encoder {
    size_t drive = 0;     ///< It follows this one …
    bool follows = false; ///< … or turns by itself.
    double perUnit = 1;   ///< [inc/u]
    double way = 0;       ///< That it turns by itself in a cycle. [inc]
    int64_t modulo = 0;
    int64_t whole = 0; ///< How far it has turned by itself …
    double rest = 0;   ///< … and what is left below one increment. [inc]
    uint32_t count = 0;
  };

  static Encoder makeEncoder(const bus::EncoderSetup &encoder, const bus::GroupSetup &setup);
  void show(Encoder &encoder);
  void disturb(Drive &drive);
  void publish(Drive &drive);
  void updateSwitches(Drive &drive);
  void switchPower(Drive &drive);
  void move(Drive &drive);
  static void latch(Drive &drive, size_t input, double increments);
  static Demand nextDemand(Drive &drive);
  static Demand home(Drive &drive, const Demand &demand);
  static Demand quickStop(Drive &drive);
  void giveSync();

  std::vector<Drive> drives_;
  std::vector<Encoder> encoders_;
  bus::DriverHost *host_ = nullptr;
  SimulatedSync sync_;
  uint32_t missingUs_ = 0; ///< Of the SYNC of the last cycle before the stop.
  bool stopped_ = false;
};

/// The driver for one drive group of interface type "Dummy".
std::unique_ptr<bus::AxisDriver> makeDriver(const bus::GroupSetup &setup);

/// The layout hash of DUMMY_DRIVE_SIM, as this runtime knows it.
uint64_t driveDataLayout();

/// What a group of drives without any configuration is told.
bus::GroupSetup plainSetup(size_t drives, double cycleSeconds = 0.01);

} // namespace stride::dummy

#endif
