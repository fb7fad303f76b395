// The simulated drive as an axis group sees it, with its DUMMY_DRIVE_SIM.
#include "drivers/dummy/dummy_drive.hpp"

#include <gtest/gtest.h>

namespace stride::dummy {
namespace {

/// One drive with 1000 increments per unit and cycles of 1 ms.
class DummyDrive : public ::testing::Test {
protected:
  void make(std::vector<bus::SetupParameter> parameters) {
    bus::GroupSetup setup(kSchema, 0.001);
    bus::DriveSetup &drive = setup.addDrive({}, 1);
    drive.parameters.add({"dwRatioTechUnitsDenom", "", 1000});
    for (bus::SetupParameter &parameter : parameters)
      drive.parameters.add(std::move(parameter));
    driver = std::make_unique<DummyDriver>(setup);
    driver->bindData(0, &sim);
  }

  /// Starts the drive and switches it on.
  void powerUp() {
    command.regulatorOn = true;
    command.driveStart = true;
    for (int i = 0; i < 10; ++i)
      cycle();
    ASSERT_TRUE(status().regulatorOn);
    ASSERT_TRUE(status().driveStarted);
  }

  void cycle() {
    driver->executeStart();
    if (!started) {
      uint16_t progress = 0;
      const bus::StartUp result = driver->init(0, progress, message);
      started = result == bus::StartUp::Started;
      failed = result == bus::StartUp::Failed;
      if (started)
        command.position = status().position;
    }
    if (started)
      driver->command(0, command);
    driver->executeEnd();
  }

  bus::DriveStatus status() const { return driver->status(0); }

  std::unique_ptr<DummyDriver> driver;
  DriveSim sim{};
  bus::DriveCommand command;
  bus::Message message;
  bool started = false;
  bool failed = false;
};

TEST(DummySetup, DefaultsStandInTheSchema) {
  bus::GroupSetup setup(kSchema, 0.00022);
  bus::SetupParameters &drive = setup.addDrive("X", 7).parameters;
  EXPECT_EQ(drive.text("physics.model"), "ideal");
  EXPECT_EQ(drive.number("physics.homing_direction"), -1);
  EXPECT_EQ(drive.text("physics.homing_direction"), "negative");
  EXPECT_EQ(drive.number("physics.velocity_integral_time"), 0.02);
  EXPECT_EQ(drive.number("physics.substeps"), 5) << "220 us in steps of 50 us at most";
  EXPECT_EQ(drive.number("iMovementType"), 1);
  EXPECT_EQ(drive.text("wControlType"), "POS, VEL -> POS, VEL");
  EXPECT_EQ(drive.number("physics.index_distance"), 0) << "linear";
  EXPECT_FALSE(drive.given("physics.homing_velocity"));
  drive.add({"physics.homing_velocity", "", 30});
  drive.add({"physics.inertia", "", 0.25});
  drive.add({"iMovementType", "rotary", 0});
  drive.add({"fPositionPeriod", "", 360});
  EXPECT_TRUE(drive.given("physics.homing_velocity"));
  EXPECT_EQ(drive.number("physics.homing_velocity_slow"), 3);
  EXPECT_EQ(drive.number("physics.homing_acceleration"), 300);
  EXPECT_EQ(drive.number("physics.velocity_gain"), 125);
  EXPECT_EQ(drive.number("physics.index_distance"), 360);
  EXPECT_EQ(drive.number("physics.nothing"), 0);
  EXPECT_EQ(drive.text("physics.velocity_gain"), "") << "computed, not a text";
}

TEST(DummySetup, SubstepsHaveTheirLimits) {
  const auto substeps = [](double cycle) {
    return bus::GroupSetup(kSchema, cycle).addDrive("X", 1).parameters.number("physics.substeps");
  };
  EXPECT_EQ(substeps(0), 1);
  EXPECT_EQ(substeps(20e-6), 1);
  EXPECT_EQ(substeps(50e-6), 1);
  EXPECT_EQ(substeps(51e-6), 2);
  EXPECT_EQ(substeps(0.05), 1000);
  EXPECT_EQ(substeps(10), 1000);
}

TEST_F(DummyDrive, StartsWhereItStands) {
  make({{"physics.start_position", "", -12.3456}});
  powerUp();
  EXPECT_EQ(status().position, static_cast<uint32_t>(-12346));
  command.position += 500;
  cycle();
  EXPECT_EQ(status().position, static_cast<uint32_t>(-11846));
  driver->executeStart();
  EXPECT_EQ(sim.fPosition, -11.846);
  EXPECT_EQ(sim.fLag, 0);
}

TEST_F(DummyDrive, DeadTimeDelaysSetValuesOnly) {
  make({{"physics.dead_time", "", 3}});
  powerUp();
  command.position += 1000;
  for (int i = 0; i < 3; ++i) {
    cycle();
    EXPECT_EQ(status().position, 0U) << i;
  }
  cycle();
  EXPECT_EQ(status().position, 1000U);
}

TEST_F(DummyDrive, FailsToStartWhenTold) {
  make({});
  sim.bFailStartUp = 1;
  cycle();
  EXPECT_TRUE(failed);
  EXPECT_EQ(message.text(), "the simulation lets it fail (bFailStartUp)");
  sim.bFailStartUp = 0;
  driver->reset(0);
  powerUp();
}

TEST_F(DummyDrive, AResetDriveMustStartAgain) {
  make({});
  powerUp();
  driver->reset(0);
  EXPECT_FALSE(status().communication);
  EXPECT_FALSE(status().regulatorOn);
  driver->executeStart();
  EXPECT_FALSE(status().communication) << "until it has started up";
  started = false;
  powerUp();
  EXPECT_TRUE(status().communication);
}

TEST_F(DummyDrive, ErrorsAreAcknowledgedUnlessPersistent) {
  make({});
  powerUp();
  sim.wDriveError = 99;
  sim.bErrorPersistent = 1;
  cycle();
  EXPECT_TRUE(status().error);
  EXPECT_EQ(status().errorId, 99);
  EXPECT_FALSE(status().regulatorOn);
  command.errorAckn = true;
  cycle();
  EXPECT_TRUE(status().error);
  sim.bErrorPersistent = 0;
  cycle();
  EXPECT_FALSE(status().error);
  EXPECT_EQ(sim.wDriveError, 0);
}

TEST_F(DummyDrive, LostCommunicationSwitchesOff) {
  make({});
  powerUp();
  sim.bLoseCommunication = 1;
  cycle();
  EXPECT_FALSE(status().communication);
  EXPECT_FALSE(status().regulatorOn);
  sim.bLoseCommunication = 0;
  cycle();
  EXPECT_TRUE(status().communication);
}

TEST_F(DummyDrive, LatchesTheExactPositionOfAMark) {
  make({{"physics.probe_position", "", 1.2345}, {"physics.probe_distance", "", 10}});
  powerUp();
  command.position += 5000; // not armed
  cycle();
  EXPECT_EQ(status().captured, 0);
  command.capture = 1;
  command.position += 10000; // passes 11.2345
  cycle();
  EXPECT_EQ(status().captured, 1);
  EXPECT_EQ(status().capturedPosition[0], 11235U);
  command.position += 10000;
  cycle();
  EXPECT_EQ(status().capturedPosition[0], 11235U) << "the first one counts";
  command.capture = 0;
  cycle();
  EXPECT_EQ(status().captured, 0);
  command.capture = 1;
  command.position -= 10000; // back through 21.2345
  cycle();
  EXPECT_EQ(status().capturedPosition[0], 21235U);
}

TEST_F(DummyDrive, ProbeInputsAreEdges) {
  make({});
  powerUp();
  command.capture = 8;
  command.position += 700;
  cycle();
  sim.abProbe.v[1] = 1;
  cycle();
  EXPECT_EQ(status().captured, 0) << "another input";
  sim.abProbe.v[3] = 1;
  cycle();
  EXPECT_EQ(status().captured, 8);
  EXPECT_EQ(status().capturedPosition[3], 700U);
  command.capture = 0;
  cycle();
  command.capture = 8;
  cycle();
  cycle();
  EXPECT_EQ(status().captured, 0) << "no new edge";
}

TEST_F(DummyDrive, IndexPulsesAreCounted) {
  make({{"physics.index_position", "", 0.5}, {"physics.index_distance", "", 1}});
  powerUp();
  for (int i = 0; i < 100; ++i) {
    command.position += 100;
    cycle();
  }
  driver->executeStart();
  EXPECT_EQ(sim.udiIndexCount, 10U); // 0.5 to 9.5
  EXPECT_EQ(sim.fIndexPosition, 9.5);
  EXPECT_FALSE(sim.bIndex);
}

TEST_F(DummyDrive, OnlyWhatIsSentCanBeControlled) {
  make({{"wControlType", "VEL -> POS", 3}});
  EXPECT_EQ(driver->controllerModes(0), 1U << kVelocityMode);
  EXPECT_EQ(status().received & (bus::kPosition | bus::kVelocity), bus::kPosition);
  make({{"wControlType", "CONFIGURABLE", 0},
        {"wCyclicDataS1", "SetPosition", 1100},
        {"wCyclicDataS2", "SetTorque", 1160},
        {"wCyclicDataR1", "ActVelocity", 1111},
        {"physics.model", "second_order", 2},
        {"physics.torque_limit", "", 1}});
  EXPECT_EQ(driver->controllerModes(0), 1U << kPositionMode | 1U << kTorqueMode);
  EXPECT_EQ(status().received & (bus::kPosition | bus::kVelocity), bus::kVelocity);
}

} // namespace
} // namespace stride::dummy
