#include "drivers/sercos/master/scaling.hpp"

#include <gtest/gtest.h>

namespace stride::sercos::test {
namespace {

TEST(Scaling, VelocitiesInIncrements) {
  ScalingFacts facts;
  facts.position = 1; // linear, 10^-7 m
  facts.velocity = 0x29;
  facts.velocityFactor = 1;
  facts.velocityExponent = -7;
  EXPECT_NEAR(velocityUnit(facts), 1, 1e-12); // 10^-7 m/s
  facts.velocity = 1;
  EXPECT_NEAR(velocityUnit(facts), 10.0 / 60, 1e-12); // 10^-6 m/min
  facts.position = 9;
  facts.linearFactor = 5;
  facts.linearExponent = -6;
  EXPECT_NEAR(velocityUnit(facts), 1e-6 / 60 / 5e-6, 1e-12);
  facts.position = 2;
  facts.velocity = 2;
  EXPECT_NEAR(velocityUnit(facts), 6, 1e-12); // 10^-4 turns/min of 3600000
  facts.position = 10;
  facts.turn = 65536;
  EXPECT_NEAR(velocityUnit(facts), 65536e-4 / 60, 1e-12);
  facts.velocity = 0x3A; // radians per second, by factor and exponent
  facts.velocityFactor = 2;
  facts.velocityExponent = -3;
  EXPECT_NEAR(velocityUnit(facts), 2e-3 / 6.283185307179586 * 65536, 1e-9);
  facts.velocity = 0;
  EXPECT_EQ(velocityUnit(facts), 1);
}

TEST(Scaling, Torques) {
  ScalingFacts facts;
  EXPECT_NEAR(torqueUnit(facts, 8), 0.008, 1e-12);
  facts.torque = 2;
  EXPECT_NEAR(torqueUnit(facts, 8), 0.01, 1e-12);
  facts.torque = 10;
  facts.torqueFactor = 5;
  facts.torqueExponent = -1;
  EXPECT_NEAR(torqueUnit(facts, 8), 0.5, 1e-12);
}

TEST(Scaling, ModuloNeedsItsBit) {
  ScalingFacts facts;
  facts.modulo = 1000;
  facts.position = 2;
  EXPECT_EQ(moduloOf(facts), 0U);
  facts.position = 0x82;
  EXPECT_EQ(moduloOf(facts), 1000U);
  facts.modulo = -1;
  EXPECT_EQ(moduloOf(facts), 0U);
}

TEST(PositionCounter, GoesRoundWithoutAnEnd) {
  PositionCounter counter;
  counter.begin(1000, 990);
  counter.show(20);
  EXPECT_EQ(counter.counter(), 1020U);
  counter.show(600); // 580 forwards are 420 backwards
  EXPECT_EQ(counter.counter(), 600U);
  counter.show(990);
  counter.show(400); // -590: 410 forwards
  EXPECT_EQ(counter.counter(), 1400U);
  EXPECT_EQ(counter.command(1010), 10);
  EXPECT_EQ(counter.command(995), 995);
  EXPECT_EQ(counter.command(static_cast<uint32_t>(-5)), 995);
  EXPECT_EQ(counter.counterOf(390), 1390U);
}

TEST(PositionCounter, WithoutModuloWrapsAt32Bits) {
  PositionCounter counter;
  counter.begin(0, 2147483640);
  counter.show(-2147483646);
  EXPECT_EQ(counter.counter(), 2147483650U);
  EXPECT_EQ(counter.command(2147483652U), -2147483644);
}

} // namespace
} // namespace stride::sercos::test
