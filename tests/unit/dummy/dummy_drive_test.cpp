// The simulated drive as an axis group sees it, with its DUMMY_DRIVE_SIM.
#include "drivers/dummy/dummy_drive.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

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

TEST_F(DummyDrive, HasTheProbeInputsThatItsSetupSays) {
  EXPECT_EQ(DummyDriver(plainSetup(1)).captureInputs(0), 0x0F);
  for (const int inputs : {0x00, 0x01, 0x05, 0x0F}) {
    make({{"physics.probe_inputs", "", static_cast<double>(inputs)}});
    EXPECT_EQ(driver->captureInputs(0), inputs);
    sim = {};
    command = {};
    command.capture = 0x0F;
    started = false;
    for (int i = 0; i < 4; ++i)
      cycle();
    for (BOOL &probe : sim.abProbe.v)
      probe = 1;
    cycle();
    EXPECT_EQ(status().captured, inputs) << "what it does not have latches nothing";
  }
}

TEST_F(DummyDrive, WhatArrivesIsWhatItsControlTypeSays) {
  constexpr uint8_t kAlways = bus::kTorque | bus::kCurrent; // they cost nothing on this bus
  constexpr std::array<uint8_t, 7> kOf = {
      0, 0, bus::kVelocity, bus::kPosition, bus::kPosition, bus::kPosition | bus::kVelocity, 0};
  for (size_t type = 1; type < kOf.size(); ++type) {
    make({{"wControlType", "", static_cast<double>(type)}});
    EXPECT_EQ(status().received, kOf[type] | kAlways) << type;
  }
  make({{"wControlType", "", 0}, {"wCyclicDataR2", "", 1111}});
  EXPECT_EQ(status().received, bus::kVelocity | kAlways);
  make({});
  EXPECT_EQ(status().received, 0x0F) << "by default positions and velocities";
}

/// Drives away with 1000 u/s² up to 2 u/s, as a motion does.
struct Stopping : DummyDrive {
  void driveOff() {
    powerUp();
    const auto start = static_cast<int32_t>(status().position);
    for (int i = 1; i <= 100; ++i) {
      command.velocity = 2000;
      command.position = static_cast<uint32_t>(start + 2 * i);
      cycle();
    }
  }
};

TEST_F(Stopping, WithoutAQuickStopItFollowsItsSetValues) {
  make({});
  driveOff();
  driver->applicationStopped();
  EXPECT_TRUE(driver->atRest()) << "nothing that the driver does by itself";
  command.position += 2;
  cycle();
  EXPECT_EQ(status().position, command.position);
}

TEST_F(Stopping, AQuickStopBrakesWhateverTheSetValuesSay) {
  make({{"physics.quick_stop", "", 80}}); // 2 u/s: 25 cycles, 25 increments
  driveOff();
  const uint32_t from = status().position;
  driver->applicationStopped();
  int cycles = 0;
  while (!driver->atRest()) {
    ASSERT_LT(++cycles, 100);
    command.position += 2;
    cycle();
  }
  EXPECT_EQ(cycles, 25);
  EXPECT_EQ(status().position - from, 25U);
  EXPECT_EQ(status().velocity, 0);
  cycle();
  EXPECT_EQ(status().position - from, 25U) << "it stays";
}

TEST_F(Stopping, ADriveWithoutPowerHasNoQuickStop) {
  make({{"physics.quick_stop", "", 80}});
  cycle();
  driver->applicationStopped();
  EXPECT_TRUE(driver->atRest());
}

/// The parameters that are no numbers.
struct Parameters : DummyDrive {
  Parameters() {
    make({});
    powerUp();
  }
  bus::ParameterAnswer ask(const bus::ParameterRequest &request) {
    EXPECT_TRUE(driver->startParameter(0, request));
    bus::ParameterAnswer answer;
    for (int i = 0; !driver->pollParameter(0, answer) && i < 10; ++i)
      cycle();
    return answer;
  }
  static bus::ParameterRequest read(int32_t number, bus::ParameterForm form) {
    bus::ParameterRequest request;
    request.number = number;
    request.form = form;
    return request;
  }
};
using Form = bus::ParameterForm;
using Result = bus::ParameterAnswer::Result;
using Kind = bus::ParameterRequest::Kind;

TEST_F(Parameters, RawBitsAreNoNumber) {
  EXPECT_EQ(ask(read(200, Form::Raw)).raw, 0x00020192U);
  EXPECT_EQ(ask(read(200, Form::Number)).result, Result::Unknown);
  EXPECT_EQ(ask(read(200, Form::Bool)).result, Result::Unknown);
  EXPECT_EQ(ask(read(100, Form::Raw)).result, Result::Unknown) << "a number is no raw one";
  bus::ParameterRequest write = read(201, Form::Raw);
  write.kind = Kind::Write;
  write.raw = 0xFFFFFFFF;
  EXPECT_EQ(ask(write).result, Result::Done);
  EXPECT_EQ(ask(read(201, Form::Raw)).raw, 0xFFFFFFFFU) << "all 32 bits";
  write.number = 200;
  EXPECT_EQ(ask(write).result, Result::ReadOnly);
}

TEST_F(Parameters, BytesHaveALength) {
  EXPECT_EQ(ask(read(210, Form::Bytes)).bytes.text(), "Stride Dummy");
  EXPECT_EQ(ask(read(211, Form::Bytes)).bytes.size(), 0U);
  bus::ParameterRequest write = read(211, Form::Bytes);
  write.kind = Kind::Write;
  const std::string text = std::string("with a zero ") + '\0' + " in it";
  for (const size_t size : {size_t{31}, size_t{32}}) {
    const std::string own = (text + std::string(40, '.')).substr(0, size);
    write.bytes = bus::ByteString{std::string_view(own)};
    EXPECT_EQ(ask(write).result, Result::Done);
    EXPECT_EQ(ask(read(211, Form::Bytes)).bytes.text(), own);
  }
  write.bytes = bus::ByteString{std::string_view("one byte more than 32 of them ...")};
  ASSERT_EQ(write.bytes.size(), 33U);
  EXPECT_EQ(ask(write).result, Result::Refused);
  EXPECT_EQ(ask(read(211, Form::Bytes)).bytes.size(), 32U) << "as it was";
  EXPECT_EQ(ask(read(211, Form::Raw)).result, Result::Unknown);
}

TEST_F(Parameters, AListHasThoseThatTheAskerCanDealWith) {
  const auto numbers = [&](bus::ParameterForms forms) {
    std::vector<int32_t> found;
    for (int32_t place = 0;; ++place) {
      bus::ParameterRequest describe;
      describe.kind = Kind::Describe;
      describe.number = place;
      describe.forms = forms;
      const bus::ParameterAnswer answer = ask(describe);
      if (answer.result != Result::Done)
        return found;
      found.push_back(answer.number);
    }
  };
  EXPECT_EQ(numbers(bus::formBit(Form::Raw)), (std::vector<int32_t>{200, 201}));
  EXPECT_EQ(numbers(bus::formBit(Form::Bytes)), (std::vector<int32_t>{210, 211}));
  EXPECT_EQ(numbers(0), std::vector<int32_t>{});
  const std::vector<int32_t> all = numbers(bus::kAllForms);
  EXPECT_EQ(all.size(), numbers(bus::formBit(Form::Number) | bus::formBit(Form::Bool)).size() + 4);
  EXPECT_EQ(all.back(), 211);
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
