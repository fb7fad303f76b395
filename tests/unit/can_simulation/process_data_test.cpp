// Process data objects: what may be configured and when, and when they are sent and used.
#include "tests/unit/can_simulation/drive_scene.hpp"

#include <gtest/gtest.h>

namespace stride::can::simulation {
namespace {

constexpr uint32_t kState = 0x08000022;
constexpr uint32_t kValue = 0x06090030;

struct PdoScene : ::testing::Test {
  uint32_t write(uint16_t index, uint8_t sub, uint32_t value, unsigned bytes) {
    return scene.master.write(5, index, sub, value, bytes);
  }

  DriveScene scene;
};

TEST_F(PdoScene, MappingIsChangedStepByStep) {
  EXPECT_EQ(write(0x1A00, 0, 0, 1), kState) << "the PDO exists";
  EXPECT_EQ(write(0x1800, 1, 0x40000190, 4), kValue) << "another identifier needs a break";
  EXPECT_EQ(write(0x1800, 1, 0xC0000185, 4), 0U);
  EXPECT_EQ(write(0x1A00, 1, 0x60640020, 4), kState) << "it has a count";
  EXPECT_EQ(write(0x1A00, 0, 0, 1), 0U);
  EXPECT_EQ(write(0x1A00, 1, 0x60640020, 4), 0U);
  EXPECT_EQ(write(0x1A00, 2, 0x60640010, 4), 0x06040041U) << "16 bits of 32";
  EXPECT_EQ(write(0x1A00, 2, 0x10080020, 4), 0x06040041U) << "not mappable";
  EXPECT_EQ(write(0x1A00, 2, 0x12340020, 4), 0x06020000U);
  EXPECT_EQ(write(0x1A00, 2, 0x607D0520, 4), 0x06090011U);
  EXPECT_EQ(write(0x1A00, 2, 0x606C0020, 4), 0U);
  EXPECT_EQ(write(0x1A00, 3, 0x60410010, 4), 0U);
  EXPECT_EQ(write(0x1A00, 0, 3, 1), 0x06040042U) << "80 bits";
  EXPECT_EQ(write(0x1A00, 0, 4, 1), 0x06020000U) << "there is nothing at 4";
  EXPECT_EQ(write(0x1A00, 0, 2, 1), 0U);
  EXPECT_EQ(write(0x1800, 1, 0x00000185, 4), kValue) << "nobody can ask for it by RTR";
  EXPECT_EQ(write(0x1800, 1, 0x60000185, 4), kValue) << "29 bits";
  EXPECT_EQ(write(0x1800, 1, 0x40000605, 4), kValue) << "belongs to SDO";
  EXPECT_EQ(write(0x1800, 2, 241, 1), kValue);
  EXPECT_EQ(write(0x1800, 2, 240, 1), 0U);
  EXPECT_EQ(write(0x1800, 1, 0x40000185, 4), 0U);
  EXPECT_EQ(write(0x1800, 3, 10, 2), kState);
}

TEST_F(PdoScene, MappingIsNotChangedWhileOperational) {
  ASSERT_EQ(write(0x1800, 1, 0xC0000185, 4), 0U);
  scene.master.send(0, {1, 5});
  scene.master.cycle(2);
  EXPECT_EQ(write(0x1A00, 0, 0, 1), kState);
}

TEST_F(PdoScene, WhatIsReceivedMustBeMappableThatWay) {
  ASSERT_EQ(write(0x1400, 1, 0x80000205, 4), 0U);
  ASSERT_EQ(write(0x1600, 0, 0, 1), 0U);
  EXPECT_EQ(write(0x1600, 1, 0x60410010, 4), 0x06040041U) << "the statusword";
  EXPECT_EQ(write(0x1600, 1, 0x00050008, 4), 0U) << "a gap of one byte";
  EXPECT_EQ(write(0x1600, 2, 0x60400010, 4), 0U);
  EXPECT_EQ(write(0x1600, 0, 2, 1), 0U);
  ASSERT_EQ(write(0x1400, 1, 0x00000205, 4), 0U);
  scene.master.send(0, {1, 5});
  scene.master.cycle(2);
  scene.master.send(0x205, {0xFF, 0x06, 0x00});
  scene.master.cycle(2);
  EXPECT_EQ(scene.drive.objects().value(0x6040), 6U);
  EXPECT_EQ(scene.drive.power(), PowerState::ReadyToSwitchOn);
}

TEST_F(PdoScene, EveryNthSync) {
  for (const unsigned type : {1U, 3U}) {
    DriveScene other;
    ASSERT_EQ(other.master.configure(5, true, 0, 0x185, static_cast<uint8_t>(type), {0x60410010}),
              0U);
    other.master.send(0, {1, 5});
    other.master.cycle(3);
    other.master.seen.clear();
    other.master.syncCycle(31);
    EXPECT_EQ(other.master.count(0x185), 30 / type);
  }
}

TEST_F(PdoScene, SynchronousWhenSomethingHasChanged) {
  ASSERT_EQ(scene.master.configure(5, true, 0, 0x185, 0, {0x60410010}), 0U);
  scene.master.send(0, {1, 5});
  scene.master.cycle(3);
  scene.master.seen.clear();
  scene.master.syncCycle(10);
  EXPECT_EQ(scene.master.count(0x185), 1U);
  scene.master.send(0x205, {0x06, 0});
  scene.master.cycle(3);
  EXPECT_EQ(scene.master.count(0x185), 1U) << "not before SYNC";
  scene.master.syncCycle(10);
  EXPECT_EQ(scene.master.count(0x185), 2U);
}

TEST_F(PdoScene, EventsTimersAndInhibitTimes) {
  ASSERT_EQ(write(0x1800, 1, 0xC0000185, 4), 0U);
  ASSERT_EQ(write(0x1800, 3, 50, 2), 0U);  // 5 ms
  ASSERT_EQ(write(0x1800, 5, 100, 2), 0U); // 100 ms
  ASSERT_EQ(write(0x1800, 1, 0x40000185, 4), 0U);
  scene.master.send(0, {1, 5});
  scene.master.cycle(2);
  EXPECT_EQ(scene.master.count(0x185), 1U);
  scene.master.seen.clear();
  scene.master.cycle(96);
  EXPECT_EQ(scene.master.count(0x185), 0U);
  scene.master.cycle(6);
  EXPECT_EQ(scene.master.count(0x185), 1U) << "the timer";
  scene.master.cycle(10);
  scene.master.seen.clear();
  scene.master.send(0x205, {0x06, 0});
  scene.master.cycle(1);
  scene.master.send(0x205, {0x07, 0});
  scene.master.cycle(3);
  EXPECT_EQ(scene.master.count(0x185), 1U) << "the second change is inhibited";
  scene.master.cycle(4);
  EXPECT_EQ(scene.master.count(0x185), 2U);
  EXPECT_EQ(wordAt(*scene.master.last(0x185), 0, 2) & 0x6F, 0x23U);
}

TEST_F(PdoScene, APdoThatIsTooShortIsNotUsed) {
  scene.operate();
  scene.enable();
  scene.master.seen.clear();
  scene.master.send(0x205, {0x0F, 0, 1, 2}, SendClass::Process);
  scene.master.syncCycle(3);
  EXPECT_EQ(scene.drive.position(), 777);
  const auto message = scene.master.last(0x085);
  ASSERT_TRUE(message);
  EXPECT_EQ(wordAt(*message, 0, 2), 0x8210U);
}

TEST_F(PdoScene, RemoteRequestsWhereTheyAreKnown) {
  Drive402Setup setup = plainDrive();
  setup.node.remotely = true;
  DriveScene other(setup);
  other.master.send(0, {1, 5});
  other.master.cycle(3);
  Frame question = frameOf(0x185);
  question.remote = true;
  question.length = 2;
  for (DriveScene *one : {&scene, &other}) {
    one->master.seen.clear();
    one->master.port().send(question, SendClass::Service);
    one->master.cycle(2);
    EXPECT_EQ(one->master.count(0x185), one == &other ? 1U : 0U);
  }
}

} // namespace
} // namespace stride::can::simulation
