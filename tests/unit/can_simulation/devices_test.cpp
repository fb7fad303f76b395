// Devices beside drives: inputs and outputs, encoders.
#include "tests/unit/can_simulation/drive_scene.hpp"

#include "drivers/can/simulation/encoder406.hpp"
#include "drivers/can/simulation/io401.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stride::can::simulation {
namespace {

struct IoScene : ::testing::Test {
  IoScene()
      : io({.node = {.id = 33},
            .inputBytes = 3,
            .outputBytes = 2,
            .analogInputs = 2,
            .analogOutputs = 1}) {
    master.bus.attach(io);
    master.cycle(25);
  }

  void start() {
    master.send(0, {1, 33});
    master.cycle(3);
    master.seen.clear();
  }

  Master master;
  SimulatedIo401 io;
};

TEST_F(IoScene, SaysWhatItHas) {
  EXPECT_EQ(master.read(33, 0x1000), 0x000F0191U);
  EXPECT_EQ(master.read(33, 0x6000), 3U);
  EXPECT_EQ(master.read(33, 0x6200), 2U);
  EXPECT_FALSE(master.read(33, 0x6200, 3));
  EXPECT_EQ(master.aborted, 0x06090011U);
}

TEST_F(IoScene, InputsAreSentWhenTheyChange) {
  start();
  io.setInput(1, 0xA5);
  master.cycle(2);
  EXPECT_EQ(master.last(0x1A1), frameOf(0x1A1, {0, 0xA5, 0}));
  io.setInput(7, 1); // there is none
  master.cycle(2);
  EXPECT_EQ(master.count(0x1A1), 0U);
  EXPECT_EQ(master.read(33, 0x6100, 1), 0xA500U);
}

TEST_F(IoScene, AnalogInputsOnlyIfThatIsWanted) {
  start();
  io.setAnalogInput(1, -300);
  master.cycle(2);
  EXPECT_EQ(master.count(0x2A1), 0U);
  ASSERT_EQ(master.write(33, 0x6423, 0, 1, 1), 0U);
  io.setAnalogInput(1, -301);
  master.cycle(2);
  const auto frame = master.last(0x2A1);
  ASSERT_TRUE(frame);
  EXPECT_EQ(*frame, frameOf(0x2A1, {0, 0, 0xD3, 0xFE}));
}

TEST_F(IoScene, OutputsAreSetAndSafeWhenTheNodeIsStopped) {
  ASSERT_EQ(master.write(33, 0x6206, 2, 0xF0, 1), 0U);
  ASSERT_EQ(master.write(33, 0x6207, 2, 0x30, 1), 0U);
  start();
  master.send(0x221, {0x12, 0xCD});
  master.send(0x321, {0xFF, 0x7F});
  master.cycle(2);
  EXPECT_EQ(io.output(0), 0x12);
  EXPECT_EQ(io.output(1), 0xCD);
  EXPECT_EQ(io.analogOutput(0), 32767);
  EXPECT_EQ(master.read(33, 0x6300, 1), 0xCD12U);
  ASSERT_EQ(master.write(33, 0x6300, 1, 0xBEEF, 2), 0U);
  EXPECT_EQ(io.output(0), 0xEF);
  EXPECT_EQ(io.output(1), 0xBE);
  master.send(0, {2, 33});
  master.cycle(2);
  EXPECT_EQ(io.output(0), 0x00) << "all of its bits take their value";
  EXPECT_EQ(io.output(1), 0x3E) << "four of them";
  EXPECT_EQ(io.analogOutput(0), 0);
  EXPECT_EQ(io.output(9), 0);
}

TEST_F(IoScene, OutputsAreSafeWhenTheMasterIsLost) {
  ASSERT_EQ(master.write(33, 0x1016, 1, 126U << 16U | 10, 4), 0U);
  start();
  master.send(0x77E, {5});
  master.send(0x221, {0xFF, 0xFF});
  master.cycle(5);
  EXPECT_EQ(io.output(0), 0xFF);
  master.cycle(15);
  EXPECT_EQ(io.output(0), 0);
  EXPECT_EQ(io.state(), NmtState::PreOperational);
}

TEST(CanEncoder, TurnsByItself) {
  Master master;
  SimulatedEncoder406 encoder(
      {.node = {.id = 60}, .perTurn = 1000, .turns = 4, .velocity = 25'000});
  master.bus.attach(encoder);
  master.cycle(25);
  EXPECT_EQ(master.read(60, 0x1000), 0x00020196U);
  EXPECT_EQ(master.read(60, 0x6501), 1000U);
  EXPECT_EQ(master.read(60, 0x6502), 4U);
  EXPECT_EQ(master.read(60, 0x6030, 1), 25'000U);
  master.send(0, {1, 60});
  master.cycle(2);
  master.seen.clear();
  master.syncCycle(300);
  std::vector<uint32_t> positions;
  for (const Received &received : master.seen)
    if (received.frame.id == 0x280 + 60)
      positions.push_back(wordAt(received.frame, 0, 4));
  ASSERT_EQ(positions.size(), 299U);
  for (size_t i = 1; i < positions.size(); ++i)
    ASSERT_EQ((positions[i] + 4000 - positions[i - 1]) % 4000, 25U);
}

TEST(CanEncoder, PresetsScalesAndReverses) {
  Master master;
  Drive402Setup setup = plainDrive();
  setup.drive.startPosition = 1000;
  SimulatedDrive402 drive(setup);
  SimulatedEncoder406 encoder(
      {.node = {.id = 60}, .perTurn = 4096, .turns = 16, .stepsPerIncrement = 0.5});
  encoder.follow(&drive);
  master.bus.attach(drive);
  master.bus.attach(encoder);
  master.cycle(25);
  EXPECT_EQ(master.read(60, 0x6004), 500U);
  EXPECT_EQ(master.write(60, 0x6003, 0, 4096 * 16, 4), 0x06090031U);
  ASSERT_EQ(master.write(60, 0x6003, 0, 65'530, 4), 0U);
  EXPECT_EQ(master.read(60, 0x6004), 65'530U);
  drive.place(1020);
  EXPECT_EQ(master.read(60, 0x6004), 65'540U - 65'536U) << "around the end of its range";
  ASSERT_EQ(master.write(60, 0x6001, 0, 360, 4), 0U);
  ASSERT_EQ(master.write(60, 0x6002, 0, 3600, 4), 0U);
  ASSERT_EQ(master.write(60, 0x6000, 0, 4, 2), 0U);
  EXPECT_EQ(master.read(60, 0x6004), static_cast<uint32_t>(510 * 360 / 4096));
  ASSERT_EQ(master.write(60, 0x6000, 0, 5, 2), 0U);
  EXPECT_EQ(master.read(60, 0x6004), 3600 - static_cast<uint32_t>(510 * 360 / 4096) - 1);
  EXPECT_EQ(master.write(60, 0x6001, 0, 4097, 4), 0x06090031U);
}

TEST(CanEncoder, TheFirstPdoGoesByItsTimer) {
  Master master;
  SimulatedEncoder406 encoder({.node = {.id = 60}, .velocity = 1000});
  master.bus.attach(encoder);
  master.cycle(25);
  ASSERT_EQ(master.write(60, 0x6200, 0, 20, 2), 0U);
  EXPECT_EQ(master.read(60, 0x1800, 5), 20U);
  master.send(0, {1, 60});
  master.cycle(2);
  master.seen.clear();
  master.cycle(200);
  EXPECT_EQ(master.count(0x180 + 60), 10U);
}

TEST(CanDriveSignals, ASecondEncoderIn60E4h) {
  Drive402Setup setup = plainDrive();
  setup.drive.startPosition = 1001;
  setup.secondEncoder = -2.5;
  DriveScene scene(setup);
  EXPECT_EQ(scene.master.read(5, 0x60E4, 1), static_cast<uint32_t>(-2502));
}

} // namespace
} // namespace stride::can::simulation
