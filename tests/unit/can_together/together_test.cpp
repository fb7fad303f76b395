// Start-up and motion of the driver with simulated drives.
#include "tests/unit/can_together/together_scene.hpp"

#include "drivers/dummy/dummy_drive.hpp"

#include <cmath>
#include <tuple>

namespace stride::test {
size_t allocations();
} // namespace stride::test

namespace stride::can {
namespace {

void addPhysics(bus::SetupParameters &drive, int model) {
  drive.add({"physics.model", "", static_cast<double>(model)});
  drive.add({"physics.time_constant", "", 0.004});
  drive.add({"physics.inertia", "", 0.01});
  drive.add({"physics.torque_limit", "", 8});
  drive.add({"physics.coulomb_friction", "", 0.3});
  drive.add({"physics.start_position", "", -1.5});
}

int32_t setPosition(int cycle) {
  return -1500 + static_cast<int32_t>(std::lround(15'000 * (1 - std::cos(cycle * 0.012))));
}

/// wControlType, model.
class CanTogether : public ::testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(CanTogether, EveryControlTypeStarts) {
  const auto [type, model] = GetParam();
  Together scene(0.002);
  for (const uint32_t id : {3U, 9U})
    addPhysics(scene.add(id, type), model);
  scene.make();
  for (int i = 0; i < 3000 && !scene.allStarted() && scene.failed.empty(); ++i)
    scene.cycle();
  EXPECT_EQ(scene.failed, "");
  EXPECT_TRUE(scene.allStarted());
  for (const bus::DriveStatus &status : {scene.driver->status(0), scene.driver->status(1)}) {
    EXPECT_TRUE(status.communication);
    EXPECT_FALSE(status.error);
  }
}

INSTANTIATE_TEST_SUITE_P(Types, CanTogether,
                         ::testing::Combine(::testing::Values(2, 3, 4, 5),
                                            ::testing::Values(0, 2)));

/// The same commands from the first cycle of regulation on: the same positions, two cycles later.
TEST(CanTogetherMotion, IsThatOfDummyTwoCyclesLater) {
  for (const int model : {0, 1, 2}) {
    Together scene;
    addPhysics(scene.add(5), model);
    scene.make();
    scene.run();

    bus::GroupSetup group(dummy::kSchema, 0.001);
    bus::SetupParameters &drive = group.addDrive("D5", 5).parameters;
    drive.add({"dwRatioTechUnitsDenom", "", 1000});
    addPhysics(drive, model);
    dummy::DummyDriver other(group);
    dummy::DriveSim sim{};
    other.bindData(0, &sim);
    bus::DriveCommand command;
    command.position = static_cast<uint32_t>(-1500);
    command.regulatorOn = command.driveStart = true;
    uint16_t progress = 0;
    bus::Message message;
    for (int i = 0; i < 10; ++i) {
      other.executeStart();
      if (other.init(0, progress, message) == bus::StartUp::Started)
        other.command(0, command);
      other.executeEnd();
    }
    std::vector<uint32_t> expected;
    for (int i = 0; i < 1200; ++i) {
      other.executeStart();
      expected.push_back(other.status(0).position);
      command.position = static_cast<uint32_t>(setPosition(i));
      other.command(0, command);
      other.executeEnd();
      uint32_t actual = 0;
      scene.cycle([&] {
        actual = scene.driver->status(0).position;
        scene.commands[0].position = command.position;
      });
      if (i >= 2) {
        ASSERT_EQ(actual, expected[static_cast<size_t>(i - 2)]) << model << ' ' << i;
      }
    }
  }
}

TEST(CanTogetherMotion, NoCycleTakesMemory) {
  Together scene;
  for (const uint32_t id : {5U, 6U})
    addPhysics(scene.add(id), 2);
  scene.make();
  simulation::FaultRates rates;
  rates.disturb = 20'000;
  scene.network->bus().faults().set(rates);
  const size_t before = test::allocations();
  for (int i = 0; i < 2000; ++i)
    scene.cycle([&] {
      for (size_t k = 0; k < 2; ++k) {
        bus::DriveCommand &command = scene.commands[k];
        command.regulatorOn = command.driveStart = scene.started[k] && i % 700 != 0;
        command.position = static_cast<uint32_t>(setPosition(i > 600 ? i - 600 : 0));
      }
      if (i == 1000)
        scene.network->drive(1).raiseError(0x2310);
    });
  EXPECT_TRUE(scene.allStarted());
  EXPECT_GT(scene.host.said, 0) << "the error is news";
  EXPECT_EQ(test::allocations(), before);
}

TEST(CanTogetherMotion, AFaultIsReportedAndAcknowledged) {
  Together scene;
  scene.add(5);
  scene.add(6);
  scene.make();
  scene.run();
  scene.network->drive(0).raiseError(0x3210);
  for (int i = 0; i < 10; ++i)
    scene.cycle([&] {
      if (scene.driver->status(0).error)
        scene.commands[0].regulatorOn = scene.commands[0].driveStart = false;
    });
  EXPECT_TRUE(scene.driver->status(0).error);
  EXPECT_EQ(scene.driver->status(0).errorId, 0x3210);
  EXPECT_FALSE(scene.driver->status(0).regulatorOn);
  EXPECT_FALSE(scene.driver->status(1).error) << "the other one goes on";
  EXPECT_TRUE(scene.driver->status(1).driveStarted);
  for (int i = 0; i < 40; ++i)
    scene.cycle([&] { scene.commands[0].errorAckn = scene.driver->status(0).error; });
  EXPECT_FALSE(scene.driver->status(0).error);
  scene.commands[0].regulatorOn = scene.commands[0].driveStart = true;
  for (int i = 0; i < 100; ++i)
    scene.cycle();
  EXPECT_TRUE(scene.driver->status(0).driveStarted);
}

TEST(CanTogetherMotion, ADriveThatIsResetIsLostUntilItIsStartedAgain) {
  Together scene;
  scene.add(5);
  scene.make();
  scene.run();
  scene.network->drive(0).reset();
  for (int i = 0; i < 60; ++i)
    scene.cycle([&] {
      if (!scene.driver->status(0).communication)
        scene.commands[0].regulatorOn = scene.commands[0].driveStart = false;
    });
  EXPECT_FALSE(scene.driver->status(0).communication);
  scene.driver->reset(0);
  scene.started[0] = false;
  scene.run();
}

/// In operation there is room for one SDO in a cycle; while nothing else is on the bus, for four.
TEST(CanTogetherStart, ManyDrivesStartSideBySide) {
  Together scene(0.004);
  for (uint32_t id = 1; id <= 16; ++id)
    scene.add(id);
  scene.make();
  ASSERT_EQ(canSetup(scene.setup).master.sdoPerCycle, 1U);
  int cycles = 0;
  uint64_t most = 0;
  for (; cycles < 3000 && !scene.allStarted() && scene.failed.empty(); ++cycles) {
    const uint64_t before = scene.network->bus().counters().bits;
    scene.cycle();
    most = std::max(most, scene.network->bus().counters().bits - before);
  }
  EXPECT_EQ(scene.failed, "");
  ASSERT_TRUE(scene.allStarted());
  RecordProperty("cycles", cycles);
  EXPECT_LT(cycles, 320) << "one after the other it takes more than 900";
  EXPECT_LT(most, 4000U) << "the bus has time for that many bits";
  for (int i = 0; i < 50; ++i)
    scene.cycle();
  for (size_t i = 0; i < 16; ++i)
    EXPECT_TRUE(scene.driver->status(i).communication) << i;
  EXPECT_EQ(scene.driver->master().counters().sendQueueFull, 0U);
}

/// Longer than an SDO that has its value with it: in segments, and in blocks.
TEST(CanTogether, LongStartUpValues) {
  Together scene;
  const std::string text =
      "A drive whose name goes over 64 bytes, so that it is written in blocks: 12";
  scene.add(3).add({"startup",
                    "2031h:3 := LREAL#-1.5\n2032h := ULINT#16#8877665544332211\n2033h := 'Axis 1'\n"
                    "2034h:1 := '" +
                        text + "'\n2035h := UINT#515\n2036h := 'abc'",
                    0});
  scene.make();
  scene.run();
  simulation::Dictionary &objects = scene.network->drive(0).objects();
  EXPECT_EQ(objects.value(0x2031, 3), 0xBFF8000000000000U);
  EXPECT_EQ(objects.value(0x2032), 0x8877665544332211U);
  const auto textOf = [&objects](uint16_t index, uint8_t sub) {
    const std::vector<uint8_t> &bytes = objects.at(index, sub).text;
    return std::string(bytes.begin(), bytes.end());
  };
  EXPECT_EQ(textOf(0x2033, 0), "Axis 1");
  EXPECT_EQ(textOf(0x2034, 1), text);
  EXPECT_EQ(objects.value(0x2035), 515U);
  EXPECT_EQ(textOf(0x2036, 0), "abc");
}

TEST(CanTogether, PdosWithObjectsOfOddLengths) {
  Together scene;
  bus::SetupParameters &drive = scene.add(3);
  drive.add({"rpdo1.map", "6040h\n2030h:5:16\n607Ah", 0});
  drive.add({"tpdo1.map", "2031h:1:24\n6064h", 0});
  drive.add({"tpdo2.map", "2032h:0:40\n6041h", 0});
  drive.add({"tpdo3.map", "2033h:0:56", 0});
  drive.add({"tpdo4.map", "2034h:0:48\n2035h:0:8", 0});
  scene.make();
  scene.run();
  const int32_t before = scene.network->drive(0).position();
  for (int i = 0; i < 40; ++i)
    scene.cycle([&] { scene.commands[0].position += 7; });
  for (int i = 0; i < 5; ++i)
    scene.cycle();
  EXPECT_EQ(scene.network->drive(0).position(), before + 280);
  EXPECT_EQ(scene.driver->status(0).position, static_cast<uint32_t>(before + 280));
}

} // namespace
} // namespace stride::can
