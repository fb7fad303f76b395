// An application behaves alike on simulated drives with CAN and without: the same set values lead
// to the same positions, two cycles later.
#include "tests/unit/can_simulation/drive_scene.hpp"

#include "drivers/dummy/dummy_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace stride::can::simulation {
namespace {

constexpr int kDeadTime = 2;

bus::GroupSetup groupWith(const std::string &model) {
  bus::GroupSetup setup(dummy::kSchema, 0.001);
  bus::DriveSetup &drive = setup.addDrive({}, 1);
  drive.parameters.add({"dwRatioTechUnitsDenom", "", 1000});
  drive.parameters.add({"physics.model", "", model == "ideal" ? 0.0 : model == "lag" ? 1.0 : 2.0});
  drive.parameters.add({"physics.time_constant", "", 0.004});
  drive.parameters.add({"physics.inertia", "", 0.01});
  drive.parameters.add({"physics.torque_limit", "", 8});
  drive.parameters.add({"physics.viscous_friction", "", 0.05});
  drive.parameters.add({"physics.coulomb_friction", "", 0.3});
  drive.parameters.add({"physics.start_position", "", 1.25});
  return setup;
}

int32_t setPosition(int cycle) {
  return 1250 + static_cast<int32_t>(std::lround(20'000 * (1 - std::cos(cycle * 0.01)) + cycle));
}

class CanDriveAlike : public ::testing::TestWithParam<const char *> {};

TEST_P(CanDriveAlike, PositionsAreThoseOfDummyTwoCyclesLater) {
  const bus::GroupSetup group = groupWith(GetParam());
  dummy::DummyDriver driver(group);
  dummy::DriveSim sim{};
  driver.bindData(0, &sim);
  bus::DriveCommand command;
  command.position = 1250;
  command.regulatorOn = command.driveStart = true;
  uint16_t progress = 0;
  bus::Message message;
  for (int i = 0; i < 10; ++i) {
    driver.executeStart();
    if (driver.init(0, progress, message) == bus::StartUp::Started)
      driver.command(0, command);
    driver.executeEnd();
  }

  Drive402Setup setup = plainDrive();
  setup.drive = dummy::driveParameters(group.drives[0].parameters);
  DriveScene scene(setup);
  scene.operate();
  scene.enable();

  std::vector<uint32_t> expected;
  for (int i = 0; i < 1500; ++i) {
    driver.executeStart();
    expected.push_back(driver.status(0).position);
    command.position = static_cast<uint32_t>(setPosition(i));
    driver.command(0, command);
    driver.executeEnd();
    scene.cycle(0x0F, setPosition(i));
    if (i >= kDeadTime) {
      ASSERT_EQ(static_cast<uint32_t>(scene.actual), expected[static_cast<size_t>(i - kDeadTime)])
          << i;
    }
  }
  EXPECT_NE(expected.back(), 1250U);
}

INSTANTIATE_TEST_SUITE_P(Models, CanDriveAlike, ::testing::Values("ideal", "lag", "second_order"),
                         [](const auto &info) { return std::string(info.param); });

} // namespace
} // namespace stride::can::simulation
