// Layer setting services: nodes get their identifiers over the bus.
#include "tests/unit/can_simulation/can_master.hpp"

#include "drivers/can/simulation/canopen_node.hpp"

#include <gtest/gtest.h>

namespace stride::can::simulation {
namespace {

struct LssScene : ::testing::Test {
  LssScene()
      : one({.id = kUnconfigured,
             .vendor = 0x11,
             .product = 0x22,
             .revision = 0x33,
             .serial = 0x1234},
            {}),
        two({.id = kUnconfigured,
             .vendor = 0x11,
             .product = 0x22,
             .revision = 0x33,
             .serial = 0x9234},
            {}),
        three({.id = 3, .vendor = 0x11, .product = 0x22, .revision = 0x33, .serial = 0x0FFF}, {}) {
    for (CanopenNode *node : {&one, &two, &three})
      master.bus.attach(*node);
    master.cycle(25);
  }

  /// Sends a request; how the answers begin, or 0 without any.
  unsigned ask(std::initializer_list<unsigned> bytes) {
    std::vector<unsigned> all(bytes);
    all.resize(8);
    master.seen.clear();
    Frame frame = frameOf(0x7E5);
    for (const unsigned byte : all)
      frame.data[frame.length++] = static_cast<uint8_t>(byte);
    master.port().send(frame, SendClass::Service);
    master.cycle(2);
    const auto found = master.last(0x7E4);
    answer = found.value_or(Frame{});
    return answer.data[0];
  }
  unsigned ask(unsigned command, uint32_t number) {
    return ask(
        {command, number & 0xFFU, number >> 8U & 0xFFU, number >> 16U & 0xFFU, number >> 24U});
  }
  unsigned scan(uint32_t number, unsigned bit, unsigned part, unsigned next) {
    return ask({0x51, number & 0xFFU, number >> 8U & 0xFFU, number >> 16U & 0xFFU, number >> 24U,
                bit, part, next});
  }

  Master master;
  CanopenNode one;
  CanopenNode two;
  CanopenNode three;
  Frame answer;
};

TEST_F(LssScene, ANodeWithoutAnIdentifierDoesNotBoot) {
  EXPECT_EQ(master.seen.size(), 1U) << "the boot-up message of the third";
  EXPECT_EQ(ask({0x4C}), 0x50U);
}

TEST_F(LssScene, SelectedByItsIdentity) {
  EXPECT_EQ(ask(0x40, 0x11), 0U);
  EXPECT_EQ(ask(0x41, 0x22), 0U);
  EXPECT_EQ(ask(0x42, 0x33), 0U);
  EXPECT_EQ(ask(0x43, 0x9234), 0x44U);
  EXPECT_EQ(ask({0x5E}), 0x5EU);
  EXPECT_EQ(answer.data[1], 255);
  EXPECT_EQ(ask({0x5D}), 0x5DU);
  EXPECT_EQ(wordAt(answer, 1, 4), 0x9234U);
  EXPECT_EQ(ask({0x11, 128}), 0x11U);
  EXPECT_EQ(answer.data[1], 1) << "out of range";
  // Bit rates of the table of the standard.
  for (const unsigned place : {0U, 4U, 6U, 8U}) {
    EXPECT_EQ(ask({0x13, 0, place}), 0x13U);
    EXPECT_EQ(answer.data[1], 0) << place;
  }
  for (const unsigned place : {5U, 9U}) {
    EXPECT_EQ(ask({0x13, 0, place}), 0x13U);
    EXPECT_EQ(answer.data[1], 1) << place;
  }
  EXPECT_EQ(ask({0x13, 1, 2}), 0x13U);
  EXPECT_EQ(answer.data[1], 1) << "a table of a maker";
  EXPECT_EQ(ask({0x11, 42}), 0x11U);
  EXPECT_EQ(answer.data[1], 0);
  EXPECT_EQ(ask({0x17}), 0x17U);
  EXPECT_EQ(ask({0x04, 0}), 0U);
  master.cycle(25);
  EXPECT_EQ(two.id(), 42);
  EXPECT_EQ(master.count(0x72A), 1U) << "its boot-up message";
  EXPECT_EQ(master.read(42, 0x1018, 4), 0x9234U);
  EXPECT_EQ(master.read(42, 0x1200, 1), 0x62AU);
  EXPECT_EQ(one.id(), kUnconfigured);
  master.bus.setPower(2, false);
  master.cycle(5);
  master.bus.setPower(2, true);
  master.cycle(25);
  EXPECT_EQ(two.id(), 42) << "stored";
}

TEST_F(LssScene, ANodeWithAnIdentifierTakesANewOneWithAReset) {
  for (const uint32_t word : {0x11U, 0x22U, 0x33U, 0xFFFU})
    ask(0x40 + (word == 0x11 ? 0 : word == 0x22 ? 1 : word == 0x33 ? 2 : 3), word);
  EXPECT_EQ(ask({0x11, 9}), 0x11U);
  ask({0x04, 0});
  EXPECT_EQ(three.id(), 3);
  master.send(0, {0x82, 3});
  master.cycle(25);
  EXPECT_EQ(three.id(), 9);
  EXPECT_EQ(master.count(0x709), 1U);
}

TEST_F(LssScene, IdentifiedByRanges) {
  const auto within = [&](uint32_t least, uint32_t last) {
    ask(0x46, 0x11);
    ask(0x47, 0x22);
    ask(0x48, 0x30);
    ask(0x49, 0x40);
    ask(0x4A, least);
    return ask(0x4B, last) == 0x4F;
  };
  EXPECT_TRUE(within(0x1000, 0x2000));
  EXPECT_FALSE(within(0x1235, 0x9233));
  EXPECT_TRUE(within(0x9234, 0x9234));
}

/// The search that masters make: the largest identity is found first, bit by bit.
TEST_F(LssScene, FastScanFindsBothNodes) {
  for (uint8_t id = 50; id < 52; ++id) {
    ASSERT_EQ(scan(0, 0x80, 0, 0), 0x4FU);
    std::array<uint32_t, 4> identity{};
    for (unsigned part = 0; part < 4; ++part) {
      for (unsigned bit = 32; bit-- > 0;)
        if (scan(identity[part], bit, part, part) != 0x4F)
          identity[part] |= 1U << bit;
      ASSERT_EQ(scan(identity[part], 0, part, (part + 1) % 4), 0x4FU);
    }
    EXPECT_EQ(identity[0], 0x11U);
    EXPECT_EQ(identity[3], id == 50 ? 0x1234U : 0x9234U);
    ASSERT_EQ(ask({0x11, id}), 0x11U);
    ask({0x04, 0});
    master.cycle(25);
    EXPECT_EQ((id == 50 ? one : two).id(), id);
  }
  EXPECT_EQ(scan(0, 0x80, 0, 0), 0U) << "nobody is left";
}

} // namespace
} // namespace stride::can::simulation
