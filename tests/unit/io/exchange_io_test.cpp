// An I/O device that is a simulated node: what somebody writes in its inputs is what its world has
// there.
#include "drivers/io/io_drivers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <memory>
#include <vector>

namespace stride::io {
namespace {

/// Two digital bytes and an analog value. What the world has is there some cycles later, as over a
/// bus.
class World : public testing::Test {
protected:
  World() {
    const drivers::IoDriverEntry &kind = *drivers::findIoDriver("CAN");
    IoSettings settings;
    settings.inputBytes = 4;
    settings.exchange = exchange_;
    settings.parameters =
        common::SetupParameters({{}, kind.schema->parameters, kind.schema->tables});
    settings.parameters.add({"analog_inputs", "", 1});
    driver_ = kind.make(settings);
    exchange_->simulated = true;
  }

  /// What a task does at the start of its cycle; before it the bus moves on.
  void cycle() {
    std::vector<BYTE> world(4);
    exchange_->terminals.read(0, world);
    onTheWay_.push_back(world);
    if (onTheWay_.size() > kDelay) {
      exchange_->inputs.write(0, onTheWay_.front());
      onTheWay_.pop_front();
    }
    driver_->sense(0, image_);
    driver_->read(0, image_);
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i)
      cycle();
  }

  static constexpr size_t kDelay = 3;
  std::shared_ptr<common::IoExchange> exchange_ = std::make_shared<common::IoExchange>(4, 0);
  std::unique_ptr<IoDriver> driver_;
  std::deque<std::vector<BYTE>> onTheWay_;
  std::array<BYTE, 4> image_{};
};

TEST_F(World, WhatIsWrittenOnceStays) {
  cycles(5);
  image_[0] = 0x20;
  image_[2] = 0x67;
  image_[3] = 0x12;
  cycles(2);
  EXPECT_EQ(image_[0], 0); // still on its way
  cycles(3);
  for (int i = 0; i < 20; ++i) {
    cycle();
    EXPECT_EQ(image_, (std::array<BYTE, 4>{0x20, 0, 0x67, 0x12})) << i;
  }
}

TEST_F(World, BitsOfOneByteAreWrittenOneAfterTheOther) {
  cycles(5);
  for (const int bit : {0x01, 0x08, 0x80}) {
    image_[1] = static_cast<BYTE>(image_[1] | bit); // the others have not come back yet
    cycle();
  }
  cycles(6);
  EXPECT_EQ(image_[1], 0x89);
  image_[1] = 0x81;
  cycles(6);
  EXPECT_EQ(image_[1], 0x81);
}

TEST_F(World, AnAnalogValueIsTakenAsAWhole) {
  cycles(5);
  image_[2] = 0xFF;
  image_[3] = 0x01;
  cycle();
  image_[2] = 0x00; // 512, while 511 is on its way: the low byte is what was given
  image_[3] = 0x02;
  cycles(6);
  EXPECT_EQ(image_[2], 0x00);
  EXPECT_EQ(image_[3], 0x02);
}

TEST_F(World, ARealNodeIsNotWritten) {
  exchange_->simulated = false;
  image_[0] = 1;
  cycles(6);
  EXPECT_EQ(image_[0], 0);
}

} // namespace
} // namespace stride::io
