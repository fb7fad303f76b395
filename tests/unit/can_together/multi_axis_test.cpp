// Drives that are one node: its master and its simulated device.
#include "tests/unit/can_together/together_scene.hpp"

#include <gmock/gmock-matchers.h>

#include <cmath>

namespace stride::test {
size_t allocations();
} // namespace stride::test

namespace stride::can {
namespace {

using ::testing::HasSubstr;

int32_t wave(int cycle, int amplitude) {
  return static_cast<int32_t>(std::lround(amplitude * (1 - std::cos(cycle * 0.011))));
}

/// A device with the axes 0, 1 and 4 as node 5, and a drive of its own as node 9 between them.
class MultiAxis : public ::testing::Test {
protected:
  MultiAxis() { addDrives(scene.setup, 4, 4); }
  static void addDrives(bus::GroupSetup &setup, double controlType, int last) {
    for (const auto &[name, id, axis] :
         {std::tuple{"A", 5U, 0}, {"B", 5U, 1}, {"Alone", 9U, 0}, {"C", 5U, last}}) {
      bus::SetupParameters &drive = setup.addDrive(name, id).parameters;
      drive.add({"wControlType", "", controlType});
      drive.add({"axis", "", static_cast<double>(axis)});
      drive.add({"dwRatioTechUnitsDenom", "", 1000});
      drive.add({"physics.start_position", "", 0.5 * axis});
    }
  }
  bus::SetupParameters &drive(size_t index) { return scene.setup.drives[index].parameters; }
  bus::DriveStatus status(size_t index) const { return scene.driver->status(index); }
  void cycles(int count) {
    for (int i = 0; i < count; ++i)
      scene.cycle();
  }
  bool communicates(std::initializer_list<bool> expected) const {
    size_t i = 0;
    for (const bool one : expected)
      if (status(i++).communication != one)
        return false;
    return true;
  }
  uint64_t object(uint16_t index, uint8_t sub = 0) {
    return scene.network->drive(0).objects().value(index, sub);
  }

  Together scene;
};

TEST_F(MultiAxis, StartsAndMovesEachAxisByItself) {
  scene.make();
  scene.run();
  EXPECT_EQ(scene.driver->master().nodeCount(), 2U);
  EXPECT_EQ(scene.network->axis(1).number(), 1);
  EXPECT_EQ(scene.network->axis(3).number(), 4);
  EXPECT_EQ(status(1).position, 500U);
  EXPECT_EQ(status(3).position, 2000U);
  std::array<std::vector<uint32_t>, 4> told;
  for (int i = 0; i < 900; ++i)
    scene.cycle([&] {
      for (size_t k = 0; k < 4; ++k) {
        const uint32_t start = k == 1 ? 500 : k == 3 ? 2000 : 0;
        scene.commands[k].position =
            start + static_cast<uint32_t>(wave(i, 3000 + 1700 * static_cast<int>(k)));
        told[k].push_back(scene.commands[k].position);
        if (i >= 3) {
          ASSERT_EQ(status(k).position, told[k][static_cast<size_t>(i - 3)]) << k << ' ' << i;
        }
      }
    });
}

TEST_F(MultiAxis, HasObjects800hAndPdos64Apart) {
  drive(1).add({"startup", "6898h := 35\n6899h:2 := 1234\n2031h:1 := UINT#7", 0});
  drive(3).add({"startup", "8098h := 37", 0});
  scene.make();
  scene.run();
  EXPECT_EQ(object(0x1000), 0xFFFF0192U);
  EXPECT_EQ(object(0x6FFF), 0x00020192U);
  EXPECT_EQ(object(0x6898), 35U);
  EXPECT_EQ(object(0x6899, 2), 1234U);
  EXPECT_EQ(object(0x8098), 37U);
  EXPECT_NE(object(0x6098), 35U);
  EXPECT_EQ(object(0x2031, 1), 7U);
  // RPDO 65 and TPDO 257.
  EXPECT_EQ(object(0x1640, 1), 0x68400010U);
  EXPECT_EQ(object(0x1640, 2), 0x687A0020U);
  EXPECT_EQ(object(0x1B00, 1), 0x80410010U);
  EXPECT_EQ(object(0x6860), 8U) << "mode of operation";
  EXPECT_EQ(object(0x68C2, 1), 1U) << "interpolation period";
}

TEST_F(MultiAxis, AFaultOfOneAxisIsItsOwn) {
  scene.make();
  scene.run();
  scene.network->axis(1).raiseError(0x2310);
  cycles(20);
  EXPECT_TRUE(communicates({true, true, true, true}));
  EXPECT_TRUE(status(1).error);
  EXPECT_EQ(status(1).errorId, 0x2310);
  for (const size_t other : {0U, 2U, 3U}) {
    EXPECT_FALSE(status(other).error) << other;
    EXPECT_TRUE(status(other).driveStarted) << other;
  }
  // A second axis with the same error keeps it when the first one has none any more.
  scene.network->axis(3).raiseError(0x2310);
  cycles(20);
  scene.commands[1].errorAckn = true;
  cycles(6);
  scene.commands[1].errorAckn = false;
  cycles(30);
  EXPECT_FALSE(status(1).error);
  EXPECT_TRUE(status(3).error);
  EXPECT_EQ(object(0x1001), 3U) << "generic, current";
}

/// Whatever is wrong with the node stops all its axes, and no other drive.
TEST_F(MultiAxis, ALostNodeStopsAllItsAxes) {
  scene.make();
  scene.run();
  scene.network->drive(0).setSilent(true);
  cycles(6);
  EXPECT_TRUE(communicates({false, false, true, false}));
  scene.network->drive(0).setSilent(false);
  cycles(6);
  EXPECT_TRUE(communicates({true, true, true, true}));
  scene.network->drive(0).reset();
  cycles(60);
  EXPECT_TRUE(communicates({false, false, true, false}));
}

/// One axis begins anew, and with it the node; the others join without a second reset.
TEST_F(MultiAxis, AxesComeBackOneAfterTheOther) {
  scene.make();
  scene.run();
  scene.network->drive(0).reset();
  cycles(60);
  const auto reinit = [&](size_t index) {
    scene.driver->reset(index);
    scene.started[index] = false;
    scene.commands[index] = {};
    for (int i = 0; i < 2000 && !scene.started[index]; ++i)
      scene.cycle();
    ASSERT_TRUE(scene.started[index]) << scene.failed;
    cycles(5);
  };
  reinit(1);
  EXPECT_TRUE(communicates({false, true, true, false})) << "nobody has started the others";
  reinit(3);
  EXPECT_TRUE(communicates({false, true, true, true}));
  reinit(0);
  EXPECT_TRUE(communicates({true, true, true, true}));
  // Who has come back begins with the whole node, again.
  reinit(3);
  EXPECT_TRUE(communicates({false, false, true, true}));
}

TEST(OneAxis, IsADriveAsAnyOther) {
  Together other;
  bus::SetupParameters &first = other.add(5);
  first.add({"axis", "", 0});
  other.make();
  other.run();
  EXPECT_EQ(other.network->drive(0).objects().value(0x1000), 0x00020192U) << "one drive";
  EXPECT_EQ(other.network->drive(0).objects().find(0x6840, 0), nullptr);
}

TEST_F(MultiAxis, ParametersAreThoseOfTheDevice) {
  scene.make();
  scene.run();
  const auto ask = [&](size_t index, const bus::ParameterRequest &request) {
    bus::ParameterAnswer answer;
    EXPECT_TRUE(scene.driver->startParameter(index, request));
    for (int i = 0; i < 50; ++i) {
      scene.cycle();
      if (scene.driver->pollParameter(index, answer))
        return answer;
    }
    ADD_FAILURE() << "no answer";
    return answer;
  };
  bus::ParameterRequest write;
  write.kind = bus::ParameterRequest::Kind::Write;
  write.number = 0x6898 * 256;
  write.value = -3; // INTEGER8, as 6098h: it is refused by the drive and not cut
  EXPECT_EQ(ask(1, write).result, bus::ParameterAnswer::Result::Refused);
  write.value = 34;
  EXPECT_EQ(ask(1, write).result, bus::ParameterAnswer::Result::Done);
  EXPECT_EQ(object(0x6898), 34U);
  // The list for SMC_WriteDriveParamsToFile is that of the axis.
  bus::ParameterRequest list;
  list.kind = bus::ParameterRequest::Kind::Describe;
  EXPECT_EQ(ask(3, list).number, 0x8007 * 256);
  EXPECT_EQ(ask(0, list).number, 0x6007 * 256);
  // Two at once have their turns.
  bus::ParameterRequest read;
  read.number = 0x6898 * 256;
  ASSERT_TRUE(scene.driver->startParameter(1, read));
  read.number = 0x8098 * 256;
  ASSERT_TRUE(scene.driver->startParameter(3, read));
  scene.driver->cancelParameter(3);
  bus::ParameterAnswer answer;
  bool answered = false;
  for (int i = 0; i < 50 && !answered; ++i) {
    scene.cycle();
    answered = scene.driver->pollParameter(1, answer);
  }
  EXPECT_TRUE(answered);
  EXPECT_EQ(answer.value, 34);
}

TEST_F(MultiAxis, NoCycleTakesMemory) {
  scene.make();
  const size_t before = test::allocations();
  for (int i = 0; i < 1500; ++i)
    scene.cycle([&] {
      for (size_t k = 0; k < 4; ++k)
        scene.commands[k].regulatorOn = scene.commands[k].driveStart = scene.started[k];
      if (i == 900)
        scene.network->axis(3).raiseError(0x2310);
    });
  EXPECT_TRUE(scene.allStarted());
  EXPECT_EQ(test::allocations(), before);
}

// ---- what the configuration may say

std::vector<std::string> faultsOf(const bus::GroupSetup &setup) { return planGroup(setup).faults; }

TEST_F(MultiAxis, IdentifiersOfItsPdosAreNobodyElses) {
  bus::GroupSetup setup(kSchema, 0.001);
  addDrives(setup, 5, 4); // two PDOs in each direction
  const GroupPlan plan = planGroup(setup);
  EXPECT_THAT(plan.faults, ::testing::Each(""));
  std::vector<uint16_t> ids;
  for (const PlanResult &one : plan.drives) {
    for (const Pdo &pdo : one.plan.receivedByDrive())
      ids.push_back(pdo.cobId);
    for (const Pdo &pdo : one.plan.sentByDrive())
      ids.push_back(pdo.cobId);
  }
  // B has what is left of node 5, C the last number that is free: 126 is the master's, 127 SYNC's.
  EXPECT_THAT(ids, ::testing::ElementsAre(0x205, 0x305, 0x185, 0x285, 0x405, 0x505, 0x385, 0x485,
                                          0x209, 0x309, 0x189, 0x289, 0x27D, 0x37D, 0x1FD, 0x2FD));
  EXPECT_EQ(plan.drives[1].plan.rpdos[0].number, 65);
  EXPECT_EQ(plan.drives[3].plan.tpdos[1].number, 258);
  EXPECT_GT(plan.load.bits, 4U * 270U) << "all of them count";
}

TEST_F(MultiAxis, TheSameAxisTwiceIsNone) {
  bus::GroupSetup setup(kSchema, 0.001);
  addDrives(setup, 4, 1);
  EXPECT_THAT(faultsOf(setup), ::testing::ElementsAre("", HasSubstr("same wDriveId"), "",
                                                      HasSubstr("same wDriveId")));
}

TEST_F(MultiAxis, WhatIsOfTheDeviceStandsAtItsFirstDrive) {
  drive(0).add({"pdo_timeout", "", 7});
  drive(1).add({"pdo_timeout", "", 7});
  drive(3).add({"pdo_timeout", "", 8});
  EXPECT_THAT(
      faultsOf(scene.setup),
      ::testing::ElementsAre("", "", "",
                             "`pdo_timeout` is of the whole device: it belongs to drive `A`, "
                             "which is its first one here"));
}

TEST_F(MultiAxis, ObjectsOfAnotherAxisAreNotItsOwn) {
  drive(1).add({"startup", "6098h := 35", 0});
  drive(3).add({"rpdo1.map", "6040h\n687Ah", 0});
  const GroupPlan plan = planGroup(scene.setup);
  EXPECT_THAT(plan.faults[1], HasSubstr("this object is of axis 0: of axis 1 it is 6898h"));
  EXPECT_THAT(plan.faults[3], HasSubstr("this object is of axis 0: of axis 4 it is 8040h"));
}

TEST_F(MultiAxis, OwnPdosHaveTheObjectsOfTheAxis) {
  drive(1).add({"rpdo2.map", "6840h\n687Ah", 0});
  drive(1).add({"tpdo1.map", "6864h\n6841h\n2031h:2:16", 0});
  scene.make();
  scene.run();
  EXPECT_EQ(object(0x1641, 2), 0x687A0020U);
  EXPECT_EQ(object(0x1A40, 3), 0x20310210U);
  EXPECT_EQ(status(1).position, 500U);
}

} // namespace
} // namespace stride::can
