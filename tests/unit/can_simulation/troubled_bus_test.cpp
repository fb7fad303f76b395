// A bus on which somebody does what he should not.
#include "tests/unit/can_simulation/drive_scene.hpp"

#include <gtest/gtest.h>

namespace stride::can::simulation {
namespace {

/// Sends the same frame all the time.
class Babbler : public Puppet {
public:
  explicit Babbler(const Frame &frame) : frame_(frame) {}
  bool transmit(Frame &frame) noexcept override {
    frame = frame_;
    return babbles;
  }
  bool babbles = true;

private:
  Frame frame_;
};

TEST(CanTrouble, ABabblingNodeLetsNobodySend) {
  DriveScene scene;
  scene.operate();
  scene.enable();
  const int32_t place = scene.drive.position();
  Babbler babbler(frameOf(0x001, {0xAA}));
  scene.master.bus.attach(babbler);
  for (int i = 0; i < 3; ++i)
    scene.cycle(0x0F, place);
  const int before = scene.telegrams;
  SendResult last = SendResult::Sent;
  for (int i = 0; i < 20; ++i) {
    scene.cycle(0x0F, place);
    last = scene.master.port().send(frameOf(0x205, {0x0F, 0}), SendClass::Process);
  }
  EXPECT_EQ(scene.telegrams, before);
  EXPECT_EQ(last, SendResult::QueueFull);
  EXPECT_GT(scene.master.count(0x001), 100U);
  babbler.babbles = false;
  for (int i = 0; i < 40; ++i)
    scene.cycle(0x0F, place);
  EXPECT_GT(scene.telegrams, before + 20);
}

TEST(CanTrouble, ABabblerWithASmallPriorityTakesOnlyWhatIsLeft) {
  DriveScene scene;
  scene.operate();
  scene.enable();
  Babbler babbler(frameOf(0x7F0, {1, 2, 3, 4, 5, 6, 7, 8}));
  scene.master.bus.attach(babbler);
  const int before = scene.telegrams;
  for (int i = 0; i < 100; ++i)
    scene.cycle(0x0F, scene.drive.position());
  EXPECT_GE(scene.telegrams, before + 99);
  EXPECT_EQ(scene.drive.power(), PowerState::OperationEnabled);
}

/// Both answer to everything at the same time, with other bytes.
TEST(CanTrouble, TwoNodesWithOneIdentifierDisturbEachOther) {
  DriveScene scene;
  Drive402Setup other = plainDrive(5);
  other.drive.startPosition = -12345;
  other.node.serial = 99;
  SimulatedDrive402 twin(other);
  scene.master.bus.attach(twin);
  const uint64_t before = scene.master.bus.counters().collisions;
  scene.master.cycle(25);
  EXPECT_EQ(scene.master.count(0x705), 2U) << "a second boot-up message";
  (void)scene.master.read(5, 0x1018, 4);
  EXPECT_GT(scene.master.bus.counters().collisions, before);
}

TEST(CanTrouble, TwinsThatAnswerAtOtherTimesAreHeardTwice) {
  DriveScene scene;
  Drive402Setup other = plainDrive(5);
  other.drive.startPosition = -12345;
  SimulatedDrive402 twin(other);
  scene.master.bus.attach(twin, 300'000);
  scene.master.cycle(25);
  scene.operate();
  scene.master.seen.clear();
  for (int i = 0; i < 10; ++i)
    scene.cycle(0x06, 0);
  EXPECT_EQ(scene.telegrams, 2 * 9) << "those of the last SYNC are on their way";
}

TEST(CanTrouble, APlugThatIsPulledBeforeADriveLeavesTheOthers) {
  DriveScene scene;
  SimulatedDrive402 other(plainDrive(6));
  const Station station = scene.master.bus.attach(other);
  scene.master.cycle(25);
  scene.operate();
  scene.enable();
  scene.master.bus.setPiece(station, 1);
  for (int i = 0; i < 50; ++i)
    scene.cycle(0x0F, scene.drive.position());
  EXPECT_EQ(scene.drive.power(), PowerState::OperationEnabled);
  EXPECT_FALSE(scene.master.read(6, 0x1000));
  scene.master.bus.setPiece(station, 0);
  scene.master.cycle(3);
  EXPECT_EQ(scene.master.read(6, 0x1000), 0x00020192U);
}

} // namespace
} // namespace stride::can::simulation
