// Network management, error control, emergencies, SYNC and storage of a node.
#include "tests/unit/can_simulation/drive_scene.hpp"

#include <gtest/gtest.h>

namespace stride::can::simulation {
namespace {

NmtState stateOf(const CanopenNode &node) { return node.state(); }

TEST(CanNode, BootsAfterItsTimeAndKeepsToItsStates) {
  Master master;
  SimulatedDrive402 drive(plainDrive(5));
  master.bus.attach(drive);
  master.cycle(20); // 20 ms
  EXPECT_EQ(stateOf(drive), NmtState::PreOperational);
  master.cycle();
  ASSERT_EQ(master.count(0x705), 1U);
  EXPECT_EQ(master.last(0x705), frameOf(0x705, {0}));

  master.send(0, {1, 6}); // somebody else
  master.cycle(2);
  EXPECT_EQ(stateOf(drive), NmtState::PreOperational);
  master.send(0, {1, 5, 0}); // three bytes
  master.cycle(2);
  EXPECT_EQ(stateOf(drive), NmtState::PreOperational);
  master.send(0, {1, 5});
  master.cycle(2);
  EXPECT_EQ(stateOf(drive), NmtState::Operational);
  EXPECT_EQ(master.count(0x185), 1U) << "TPDO 1 is sent by events, the first one at once";
  master.send(0, {2, 0}); // all
  master.cycle(2);
  EXPECT_EQ(stateOf(drive), NmtState::Stopped);
  EXPECT_FALSE(master.read(5, 0x1000)) << "no SDO while it is stopped";
  EXPECT_EQ(master.aborted, 1U);
  master.send(0, {0x80, 5});
  master.cycle(2);
  EXPECT_EQ(master.read(5, 0x1000), 0x00020192U);
  master.seen.clear();
  master.send(0, {0x81, 5});
  master.cycle(2);
  EXPECT_EQ(stateOf(drive), NmtState::Initialising);
  master.cycle(25);
  EXPECT_EQ(master.count(0x705), 1U);
}

TEST(CanNode, ResetCommunicationBringsBackWhatIsAbove1000hOnly) {
  DriveScene scene;
  ASSERT_EQ(scene.master.write(5, 0x1017, 0, 100, 2), 0U);
  ASSERT_EQ(scene.master.write(5, 0x6083, 0, 4711, 4), 0U);
  scene.master.send(0, {0x82, 5});
  scene.master.cycle(30);
  EXPECT_EQ(scene.master.read(5, 0x1017), 0U);
  EXPECT_EQ(scene.master.read(5, 0x6083), 4711U);
  scene.master.send(0, {0x81, 5});
  scene.master.cycle(30);
  EXPECT_EQ(scene.master.read(5, 0x6083), 1'000'000U);
}

TEST(CanNode, HeartbeatsAreProducedAndWatched) {
  DriveScene scene;
  ASSERT_EQ(scene.master.write(5, 0x1017, 0, 10, 2), 0U);
  scene.master.seen.clear();
  scene.master.cycle(100);
  EXPECT_NEAR(static_cast<double>(scene.master.count(0x705)), 10, 1);
  EXPECT_EQ(scene.master.last(0x705), frameOf(0x705, {0x7F}));

  ASSERT_EQ(scene.master.write(5, 0x1016, 1, 126U << 16U | 20, 4), 0U);
  EXPECT_EQ(scene.master.write(5, 0x1016, 2, 126U << 16U | 30, 4), 0x08000000U)
      << "watched already";
  EXPECT_EQ(scene.master.write(5, 0x1016, 2, 128U << 16U | 30, 4), 0x06090030U);
  scene.operate();
  scene.enable();
  EXPECT_EQ(scene.drive.power(), PowerState::OperationEnabled)
      << "without a first heartbeat nobody is missing";
  scene.master.seen.clear();
  for (int i = 0; i < 100; ++i) {
    if (i % 10 == 0)
      scene.master.send(0x77E, {5});
    scene.cycle(0x0F, scene.drive.position());
  }
  EXPECT_EQ(scene.drive.power(), PowerState::OperationEnabled);
  EXPECT_EQ(scene.master.count(0x085), 0U);
  for (int i = 0; i < 30; ++i)
    scene.cycle(0x0F, scene.drive.position());
  EXPECT_EQ(scene.drive.power(), PowerState::Fault) << "6007h is 1";
  EXPECT_EQ(scene.drive.state(), NmtState::PreOperational) << "1029h:1 is 0";
  ASSERT_GE(scene.master.count(0x085), 1U);
  EXPECT_EQ(scene.drive.objects().value(0x603F), 0x8130U);
  EXPECT_EQ(scene.drive.objects().value(0x1003, 1), 0x8130U);
}

TEST(CanNode, ErrorBehaviourAndAbortOption) {
  for (const unsigned option : {0U, 2U, 3U}) {
    DriveScene scene;
    ASSERT_EQ(scene.master.write(5, 0x1029, 1, 1, 1), 0U); // stays operational
    EXPECT_EQ(scene.master.write(5, 0x1029, 1, 3, 1), 0x06090031U);
    ASSERT_EQ(scene.master.write(5, 0x6007, 0, option, 2), 0U);
    ASSERT_EQ(scene.master.write(5, 0x1016, 1, 126U << 16U | 20, 4), 0U);
    scene.operate();
    scene.enable();
    scene.master.send(0x77E, {5});
    for (int i = 0; i < 40; ++i)
      scene.cycle(0x0F, scene.drive.position());
    EXPECT_EQ(scene.drive.state(), NmtState::Operational);
    EXPECT_EQ(scene.drive.power(),
              option == 0 ? PowerState::OperationEnabled : PowerState::SwitchOnDisabled);
  }
}

TEST(CanNode, GuardingTogglesAndExpectsToBeAsked) {
  DriveScene scene;
  Frame guard = frameOf(0x705);
  guard.remote = true;
  guard.length = 1;
  ASSERT_EQ(scene.master.write(5, 0x100C, 0, 20, 2), 0U);
  ASSERT_EQ(scene.master.write(5, 0x100D, 0, 2, 1), 0U);
  std::vector<uint8_t> answers;
  for (int i = 0; i < 4; ++i) {
    scene.master.port().send(guard, SendClass::Service);
    scene.master.cycle(10);
    const auto answer = scene.master.last(0x705);
    ASSERT_TRUE(answer);
    answers.push_back(answer->data[0]);
  }
  EXPECT_EQ(answers, (std::vector<uint8_t>{0x7F, 0xFF, 0x7F, 0xFF}));
  scene.master.cycle(20);
  EXPECT_EQ(scene.master.count(0x085), 0U);
  scene.master.cycle(20); // 40 ms after the last one
  EXPECT_EQ(scene.master.count(0x085), 1U);
  // Heartbeats exclude it.
  ASSERT_EQ(scene.master.write(5, 0x1017, 0, 1000, 2), 0U);
  scene.master.seen.clear();
  scene.master.port().send(guard, SendClass::Service);
  scene.master.cycle(5);
  EXPECT_EQ(scene.master.count(0x705), 0U);
}

TEST(CanNode, TheListOfErrorsIsEmptiedByZeroOnly) {
  DriveScene scene;
  scene.drive.raiseError(0x2310);
  scene.master.cycle(2);
  EXPECT_EQ(scene.master.read(5, 0x1001), 3U) << "generic and current";
  EXPECT_EQ(scene.master.read(5, 0x1003), 1U);
  EXPECT_EQ(scene.master.read(5, 0x1003, 1), 0x2310U);
  EXPECT_EQ(scene.master.write(5, 0x1003, 0, 1, 1), 0x06090030U);
  EXPECT_EQ(scene.master.write(5, 0x1003, 0, 0, 1), 0U);
  EXPECT_EQ(scene.master.read(5, 0x1003), 0U);
  scene.drive.write(0x6040, 0, 0);
  scene.drive.write(0x6040, 0, 0x80);
  scene.master.seen.clear();
  scene.drive.advance(scene.master.bus.nowNs());
  scene.master.send(0x605, {0x40, 0, 0x10, 0, 0, 0, 0, 0});
  scene.master.cycle(2);
  const auto gone = scene.master.last(0x085);
  ASSERT_TRUE(gone);
  EXPECT_EQ(*gone, frameOf(0x085, {0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(CanNode, ProducesSyncToo) {
  DriveScene scene;
  ASSERT_EQ(scene.master.write(5, 0x1006, 0, 2000, 4), 0U);
  EXPECT_EQ(scene.master.write(5, 0x1019, 0, 10, 1), 0x08000022U) << "not while 1006h is set";
  ASSERT_EQ(scene.master.write(5, 0x1005, 0, 0x40000080, 4), 0U);
  EXPECT_EQ(scene.master.write(5, 0x1005, 0, 0x40000081, 4), 0x06090030U);
  EXPECT_EQ(scene.master.write(5, 0x1005, 0, 0x60000080, 4), 0x06090030U) << "29 bits";
  scene.master.cycle(2);
  scene.master.seen.clear();
  scene.master.cycle(20);
  std::vector<int64_t> times;
  for (const Received &received : scene.master.seen)
    if (received.frame.id == 0x80)
      times.push_back(received.timeNs);
  ASSERT_EQ(times.size(), 10U);
  for (size_t i = 1; i < times.size(); ++i)
    EXPECT_EQ(times[i] - times[i - 1], 2'000'000);
}

TEST(CanNode, SyncWithOrWithoutACounter) {
  DriveScene scene;
  scene.operate();
  scene.master.seen.clear();
  scene.master.send(0x80, {1});
  scene.master.cycle(2);
  EXPECT_EQ(scene.master.count(0x185), 0U) << "one byte where none is expected";
  const auto message = scene.master.last(0x085);
  ASSERT_TRUE(message);
  EXPECT_EQ(wordAt(*message, 0, 2), 0x8240U);
}

TEST(CanNode, WhatIsStoredIsThereAfterAReset) {
  DriveScene scene;
  ASSERT_EQ(scene.master.write(5, 0x6083, 0, 4711, 4), 0U);
  ASSERT_EQ(scene.master.write(5, 0x1017, 0, 50, 2), 0U);
  ASSERT_EQ(scene.master.write(5, 0x1020, 1, 99, 4), 0U);
  EXPECT_EQ(scene.master.write(5, 0x1010, 1, 0x12345678, 4), 0x08000020U);
  EXPECT_EQ(scene.master.write(5, 0x1010, 1, 0x65766173, 4), 0U);
  scene.master.send(0, {0x81, 5});
  scene.master.cycle(30);
  EXPECT_EQ(scene.master.read(5, 0x6083), 4711U);
  EXPECT_EQ(scene.master.read(5, 0x1020, 1), 99U);
  EXPECT_EQ(scene.master.read(5, 0x1017), 50U);
  ASSERT_EQ(scene.master.write(5, 0x1017, 0, 51, 2), 0U);
  EXPECT_EQ(scene.master.read(5, 0x1020, 1), 0U) << "the configuration has changed";
  EXPECT_EQ(scene.master.write(5, 0x1011, 1, 0x64616F6C, 4), 0U);
  scene.master.send(0, {0x81, 5});
  scene.master.cycle(30);
  EXPECT_EQ(scene.master.read(5, 0x6083), 1'000'000U);
}

TEST(CanNode, ABusOffIsAnErrorOfTheNode) {
  DriveScene scene;
  scene.operate();
  scene.enable();
  scene.master.bus.forceBusOff(1);
  for (int i = 0; i < 5; ++i)
    scene.cycle(0x0F, 777);
  EXPECT_EQ(scene.drive.power(), PowerState::Fault);
  EXPECT_EQ(scene.drive.objects().value(0x1003, 0), 2U);
}

} // namespace
} // namespace stride::can::simulation
