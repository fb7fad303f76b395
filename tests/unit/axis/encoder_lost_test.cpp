// Encoders that drivers do not hear all the time.
#include "tests/unit/axis/axis_rig.hpp"
#include "tests/unit/axis/idle_driver.hpp"

#include <gtest/gtest.h>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;

/// An encoder and no drive.
class EncoderDriver final : public stride::test::IdleDriver {
public:
  [[nodiscard]] uint32_t encoder(size_t /*encoder*/) const override { return count; }
  [[nodiscard]] bool encoderWorks(size_t /*encoder*/) const override { return works; }

  uint32_t count = 0;
  bool works = false;
};

TEST(LostEncoder, IsNotValidAndBeginsWhereItIsThen) {
  AxisRig rig;
  auto own = std::make_unique<EncoderDriver>();
  EncoderDriver &driver = *own;
  auto encoder = fresh<stride::axis::EncoderRef>();
  encoder.dwEncoderModulo = 1000;
  rig.axisGroup = std::make_unique<stride::bus::DriveGroup>(
      std::move(own), rig.group, std::vector<stride::axis::AxisRef *>{&rig.axis}, 0.001,
      std::vector<stride::axis::EncoderRef *>{&encoder});
  driver.count = 300;
  rig.idle(3);
  EXPECT_EQ(encoder.bValid, 0) << "the group has started, the encoder has not";
  driver.works = true;
  rig.idle();
  EXPECT_EQ(encoder.bValid, 1);
  EXPECT_EQ(encoder.liActIncrements, 300);
  EXPECT_EQ(encoder.liStep, 0);
  driver.count = 990; // backwards through 0
  rig.idle();
  EXPECT_EQ(encoder.liStep, -310);
  EXPECT_EQ(encoder.liActIncrements, -10);
  driver.works = false;
  driver.count = 400;
  rig.idle();
  EXPECT_EQ(encoder.bValid, 0);
  EXPECT_EQ(encoder.liActIncrements, -10) << "what was known last";
  driver.works = true;
  driver.count = 700;
  rig.idle();
  EXPECT_EQ(encoder.bValid, 1);
  EXPECT_EQ(encoder.liActIncrements, 700);
  EXPECT_EQ(encoder.liStep, 0) << "no way in one cycle";
}

TEST(LostEncoder, ThatTheProgramFeedsIsNotTheDrivers) {
  AxisRig rig;
  auto own = std::make_unique<EncoderDriver>();
  auto encoder = fresh<stride::axis::EncoderRef>();
  encoder.bFed = 1;
  encoder.bValid = 1;
  rig.axisGroup = std::make_unique<stride::bus::DriveGroup>(
      std::move(own), rig.group, std::vector<stride::axis::AxisRef *>{&rig.axis}, 0.001,
      std::vector<stride::axis::EncoderRef *>{&encoder});
  encoder.bValid = 1;
  rig.idle(3);
  EXPECT_EQ(encoder.bValid, 1);
}

} // namespace
