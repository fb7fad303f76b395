// The master of layer setting services and the simulated nodes, each the other's judge.
#include "drivers/can/master/lss_master.hpp"
#include "drivers/can/port/port.hpp"
#include "drivers/can/simulation/canopen_node.hpp"
#include "drivers/can/simulation/simulated_bus.hpp"
#include "tests/unit/can_together/together_scene.hpp"

#include <gtest/gtest.h>

#include <array>

namespace stride::can {
namespace {

using simulation::CanopenNode;
using Identity = LssMaster::Identity;

class Lss : public ::testing::Test {
protected:
  Lss()
      : bus({}), port(bus.port(bus.addPort())), one({.id = simulation::kUnconfigured,
                                                     .vendor = 0xA0000001,
                                                     .product = 0x22,
                                                     .revision = 0xFFFFFFFF,
                                                     .serial = 0x1234},
                                                    {}),
        two({.id = simulation::kUnconfigured,
             .vendor = 0xA0000001,
             .product = 0x22,
             .revision = 0,
             .serial = 0x80000000},
            {}),
        three({.id = 3, .vendor = 1, .product = 2, .revision = 3, .serial = 4}, {}),
        master([this](const Frame &request, bool awaits) { return exchange(request, awaits); }) {
    for (CanopenNode *node : {&one, &two, &three})
      bus.attach(*node);
    run(30);
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i)
      port.beginCycle();
  }
  std::optional<Frame> exchange(const Frame &request, bool awaits) {
    std::array<Received, 16> frames;
    while (port.receive(frames) != 0) {
    }
    port.send(request, SendClass::Service);
    ++requests;
    run(2);
    const size_t count = port.receive(frames);
    for (size_t i = 0; awaits && i < count; ++i)
      if (frames[i].frame.id == LssMaster::kAnswerId)
        return frames[i].frame;
    return std::nullopt;
  }

  simulation::SimulatedBus bus;
  Port &port;
  CanopenNode one;
  CanopenNode two;
  CanopenNode three;
  LssMaster master;
  int requests = 0;
};

TEST_F(Lss, FastScanFindsOneAfterTheOtherAndGivesThemNumbers) {
  const std::optional<Identity> first = master.fastScan();
  ASSERT_TRUE(first);
  EXPECT_EQ(*first, (Identity{0xA0000001, 0x22, 0, 0x80000000})) << "the smaller revision";
  EXPECT_EQ(master.node(), LssMaster::kNoNode);
  EXPECT_EQ(master.setNode(17), LssResult::Done);
  EXPECT_EQ(master.store(), LssResult::Done);
  master.leave();
  run(40);
  EXPECT_EQ(two.id(), 17) << "it begins with its number";
  EXPECT_EQ(one.id(), simulation::kUnconfigured);

  const std::optional<Identity> second = master.fastScan();
  ASSERT_TRUE(second);
  EXPECT_EQ(*second, (Identity{0xA0000001, 0x22, 0xFFFFFFFF, 0x1234}));
  EXPECT_EQ(master.setNode(127), LssResult::Done);
  master.leave();
  run(40);
  EXPECT_EQ(one.id(), 127);
  EXPECT_EQ(master.fastScan(), std::nullopt) << "all have one";
  EXPECT_EQ(three.id(), 3);
}

TEST_F(Lss, ByItsIdentityANodeIsChangedWithTheNextReset) {
  EXPECT_EQ(master.select({1, 2, 3, 5}), LssResult::NoAnswer);
  ASSERT_EQ(master.select({1, 2, 3, 4}), LssResult::Done);
  EXPECT_EQ(master.node(), 3);
  EXPECT_EQ(master.setNode(0), LssResult::Refused);
  EXPECT_EQ(master.setNode(128), LssResult::Refused);
  EXPECT_EQ(master.setNode(9), LssResult::Done);
  master.leave();
  run(40);
  EXPECT_EQ(three.id(), 3);
  Frame reset;
  reset.length = 2;
  reset.data = {0x82, 3};
  port.send(reset, SendClass::Service);
  run(40);
  EXPECT_EQ(three.id(), 9);
}

TEST_F(Lss, WithoutNodesNobodyAnswers) {
  for (CanopenNode *node : {&one, &two, &three})
    node->setSilent(true);
  EXPECT_EQ(master.fastScan(), std::nullopt);
  EXPECT_EQ(requests, 1);
  EXPECT_EQ(master.setNode(5), LssResult::NoAnswer);
  EXPECT_EQ(master.store(), LssResult::NoAnswer);
  EXPECT_EQ(master.node(), std::nullopt);
}

/// Drives that get their numbers before they start: 1 "set", 2 "store".
struct LssTogether : ::testing::Test {
  void add(uint32_t id, double serial, int lss) {
    bus::SetupParameters &drive = scene.add(id);
    drive.add({"identity.vendor", "", 0xA0000001});
    drive.add({"identity.product", "", 7});
    drive.add({"identity.revision", "", 0});
    drive.add({"identity.serial", "", serial});
    if (lss != 0)
      drive.add({"lss", "", static_cast<double>(lss)});
  }
  /// Its supply is switched off and on, and it is started anew.
  void again(size_t drive, simulation::Station station) {
    scene.network->bus().setPower(station, false);
    for (int i = 0; i < 20; ++i)
      scene.cycle();
    scene.network->bus().setPower(station, true);
    scene.driver->reset(drive);
    scene.started[drive] = false;
    scene.commands[drive] = {};
  }
  /// The devices have been on for a while when the master begins.
  void boot() {
    for (int i = 0; i < 40; ++i)
      scene.network->beginCycle();
  }
  /// A device that has that number from the beginning.
  void store(size_t drive, uint8_t id) {
    CanopenNode &node = scene.network->drive(drive);
    for (const uint32_t request : {0x0104U, 0x0011U + (uint32_t{id} << 8U), 0x0017U, 0x0004U}) {
      Frame frame;
      frame.id = LssMaster::kRequestId;
      frame.length = 8;
      frame.data = {static_cast<uint8_t>(request), static_cast<uint8_t>(request >> 8U)};
      node.receive(frame, 0);
    }
    ASSERT_EQ(node.id(), id);
  }
  Together scene;
};

TEST_F(LssTogether, DrivesWithoutNumbersGetThemAndMove) {
  add(4, 1001, 1);
  add(5, 0xFFFFFFFF, 0);
  add(6, 1000, 2);
  scene.make();
  EXPECT_EQ(scene.network->drive(0).id(), simulation::kUnconfigured);
  EXPECT_EQ(scene.network->drive(2).id(), simulation::kUnconfigured);
  scene.run();
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(scene.network->drive(i).id(), 4 + i);
  const int32_t before = scene.network->drive(2).position();
  for (int i = 0; i < 50; ++i)
    scene.cycle([&] { scene.commands[2].position += 10; });
  for (int i = 0; i < 5; ++i)
    scene.cycle();
  EXPECT_EQ(scene.network->drive(2).position(), before + 500);
  EXPECT_EQ(scene.network->drive(0).objects().value(0x1200, 1), 0x604U);
}

TEST_F(LssTogether, WhatIsStoredIsKeptAndWhatIsSetIsSetAgain) {
  add(4, 1001, 1);
  add(6, 1000, 2);
  scene.make();
  scene.run();
  const auto station = [](size_t drive) { return static_cast<simulation::Station>(1 + drive); };
  again(0, station(0));
  EXPECT_EQ(scene.network->drive(0).id(), simulation::kUnconfigured);
  again(1, station(1));
  EXPECT_EQ(scene.network->drive(1).id(), 6);
  scene.run();
  EXPECT_EQ(scene.network->drive(0).id(), 4);
  EXPECT_EQ(scene.network->drive(1).id(), 6);
}

/// Factory-new, all are node 1: each one that gets its number is reset together with those that
/// are still to get theirs.
TEST_F(LssTogether, DevicesThatHaveOneNumber) {
  add(1, 1001, 1);
  add(2, 1002, 2);
  add(3, 1003, 1);
  scene.make();
  for (size_t i = 0; i < 3; ++i)
    store(i, 1);
  boot();
  scene.run();
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(scene.network->drive(i).id(), 1 + i);
}

/// The same, but the first one has its number by a switch, and is not looked for.
TEST_F(LssTogether, ADeviceWithTheNumberOfOneWithoutLss) {
  add(1, 1001, 0);
  add(2, 1002, 1);
  add(3, 1003, 2);
  scene.make();
  for (size_t i = 1; i < 3; ++i)
    store(i, 1);
  boot();
  scene.run();
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(scene.network->drive(i).id(), 1 + i);
}

TEST_F(LssTogether, DevicesSwapTheirNumbers) {
  add(5, 1005, 1);
  add(8, 1008, 2);
  scene.make();
  store(0, 8);
  store(1, 5);
  boot();
  scene.run();
  EXPECT_EQ(scene.network->drive(0).id(), 5);
  EXPECT_EQ(scene.network->drive(1).id(), 8);
}

TEST_F(LssTogether, ANumberThatIsSetOutlivesTheResetOfTheNode) {
  add(5, 1005, 1);
  scene.setup.drives[0].parameters.add({"reset", "", double{kResetNode}});
  scene.make();
  scene.run();
  EXPECT_EQ(scene.network->drive(0).id(), 5);
}

TEST_F(LssTogether, ADeviceThatIsAnotherOneIsNotFound) {
  add(4, 1001, 1);
  scene.make();
  // What the bus has is not what the configuration says.
  CanopenNode other({.id = simulation::kUnconfigured,
                     .vendor = 0xA0000001,
                     .product = 7,
                     .revision = 0,
                     .serial = 1002},
                    {});
  scene.network->bus().attach(other);
  scene.network->drive(0).setSilent(true);
  for (int i = 0; i < 5000 && scene.failed.empty(); ++i)
    scene.cycle();
  EXPECT_EQ(scene.failed, "node 4 does not answer: is it on, with this number and bit rate? No "
                          "node with its identity answers by LSS, either");
  EXPECT_EQ(other.id(), simulation::kUnconfigured);
}

} // namespace
} // namespace stride::can
