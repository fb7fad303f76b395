// Power, modes and motion of a simulated drive.
#include "tests/unit/sercos_simulation/ring_master.hpp"

#include <cmath>

namespace stride::sercos::simulation {
namespace {

struct Operating : DriveScene {
  explicit Operating(const DriveSetup &setup = plainDrive()) : DriveScene(setup) {
    master.toPhase4();
  }
  [[nodiscard]] unsigned ready() { return master.records[id].status >> 14U; }
  [[nodiscard]] bool follows() { return (master.records[id].status & 8U) != 0; }
};

// ---- power

TEST(SercosPower, NeedsBothBits) {
  Operating o;
  constexpr uint16_t kWords[] = {0x2000, 0x4000, 0x6000, 0x8000, 0xA000, 0x04C0};
  for (const uint16_t word : kWords) {
    o.master.setControl(3, word);
    o.master.cycle(5);
    EXPECT_EQ(o.ready(), 2U) << std::hex << word;
    o.master.setControl(3, 0);
    o.master.cycle(2);
  }
  o.master.powerOn(3);
  EXPECT_TRUE(o.follows());
  o.master.setControl(3, 0x8000); // enable goes: at once
  o.master.cycle(2);
  EXPECT_EQ(o.ready(), 2U);
}

TEST(SercosPower, OnHasToBeLetGoOfFirst) {
  Operating o;
  o.master.powerOn(3);
  o.drive.fail(4711);
  o.master.cycle(3);
  EXPECT_EQ(o.ready(), 0U);
  EXPECT_EQ(o.master.records[3].status & 0x2000U, 0x2000U);
  EXPECT_EQ(o.master.read(3, 129).number(), 4711);
  EXPECT_EQ(o.master.read(3, 11).number(), 0x8000);
  EXPECT_EQ(o.master.read(3, 95, 7, 0).text(), "error 4711");
  EXPECT_EQ(o.master.command(3, 99), 3);
  o.master.cycle(5);
  EXPECT_EQ(o.ready(), 2U) << "bit 15 is still on, but has not turned";
  o.master.setControl(3, 0x6000);
  o.master.cycle(2);
  o.master.powerOn(3);
}

TEST(SercosPower, TakesItsCycles) {
  DriveSetup setup = plainDrive();
  setup.drive.switchCycles = 7;
  Operating o(setup);
  o.master.setTarget(3, 777);
  o.master.setControl(3, 0xE000);
  o.master.cycle(6);
  EXPECT_EQ(o.ready(), 2U);
  o.master.cycle(1);
  EXPECT_EQ(o.ready(), 3U);
}

TEST(SercosPower, MainPower) {
  Operating o;
  o.drive.setMainPower(false);
  o.master.cycle();
  EXPECT_EQ(o.ready(), 1U);
  o.master.setControl(3, 0xE000);
  o.master.cycle(3);
  EXPECT_EQ(o.ready(), 1U);
  o.drive.setMainPower(true);
  o.master.setControl(3, 0);
  o.master.cycle(2);
  o.master.powerOn(3);
  o.drive.setMainPower(false);
  o.master.cycle(3);
  EXPECT_EQ(o.drive.list().value(11), 0x0200) << "undervoltage";
  EXPECT_FALSE(o.drive.hasTorque());
}

TEST(SercosPower, FallsWithThePhase) {
  Operating o;
  o.master.powerOn(3);
  o.master.phase = 0;
  o.master.cycle(2);
  EXPECT_FALSE(o.drive.hasTorque()) << "it stood: it is without torque at once";
}

// ---- positions

TEST(SercosPosition, IsReachedAtTheMstAfterTheNext) {
  Operating o;
  o.master.powerOn(3);
  o.master.setTarget(3, 900);
  o.master.cycle(); // in the MDT, valid from the MST on
  EXPECT_EQ(o.master.actual(3), 777);
  o.master.cycle(); // reached
  EXPECT_EQ(o.master.actual(3), 900);
  EXPECT_EQ(o.drive.mechanics().position(), 900);
}

TEST(SercosPosition, GoesOnWithoutAnMdt) {
  Operating o;
  o.master.powerOn(3);
  int32_t target = 777;
  for (int i = 0; i < 10; ++i) {
    o.master.setTarget(3, target += 15);
    o.master.cycle();
  }
  const int32_t before = o.master.actual(3);
  o.drive.faults().loseMdts = 1;
  for (int i = 1; i <= 6; ++i) {
    o.master.setTarget(3, target += 15);
    o.master.cycle();
    EXPECT_EQ(o.master.actual(3), before + 15 * i) << "nothing is seen of the loss";
  }
}

TEST(SercosPosition, OverTheEndOf32Bits) {
  DriveSetup setup = plainDrive();
  setup.drive.startPosition = 2147483600;
  Operating o(setup);
  o.master.powerOn(3);
  o.master.setTarget(3, 2147483700); // wraps
  o.master.cycle(3);
  EXPECT_EQ(o.drive.mechanics().position(), 2147483700);
  EXPECT_EQ(o.master.actual(3), static_cast<int32_t>(2147483700U));
}

TEST(SercosPosition, Modulo) {
  DriveScene scene;
  RingMaster &master = scene.master;
  master.toPhase3();
  master.write(3, 32, 3);
  EXPECT_EQ(master.write(3, 76, 0x8A), 0);
  EXPECT_EQ(master.write(3, 103, 1000, 4), 0);
  master.check(128);
  master.phase = 4;
  master.cycle(3);
  master.powerOn(3);
  EXPECT_EQ(master.actual(3), 777);
  master.setTarget(3, 50); // forwards: 273
  master.cycle(3);
  EXPECT_EQ(scene.drive.mechanics().position(), 1050);
  EXPECT_EQ(master.actual(3), 50);
  master.setTarget(3, 900); // backwards: 150
  master.cycle(3);
  EXPECT_EQ(scene.drive.mechanics().position(), 900);
}

TEST(SercosPosition, Scaling) {
  struct Case {
    int64_t type;
    int64_t resolution;
    int64_t factor;
    int64_t exponent;
    int32_t shown; ///< For 777 increments: 4096 in a turn, 10^7 in a metre.
  };
  const Case cases[] = {{0x0000, 100, 1, -7, 777},  {0x000A, 8192, 1, -7, 1554},
                        {0x000A, 1024, 1, -7, 194}, {0x0002, 1, 1, -7, 682910},
                        {0x0001, 1, 5, -4, 777},    {0x0009, 1, 1, -9, 77700},
                        {0x0009, 1, 7, -7, 111}};
  for (const Case &one : cases) {
    DriveScene scene;
    RingMaster &master = scene.master;
    master.toPhase3();
    master.write(3, 32, 3);
    EXPECT_EQ(master.write(3, 76, one.type), 0);
    EXPECT_EQ(master.write(3, 79, one.resolution, 4), 0);
    EXPECT_EQ(master.write(3, 77, one.factor), 0);
    EXPECT_EQ(master.write(3, 78, one.exponent), 0);
    master.check(128);
    master.phase = 4;
    master.cycle(3);
    EXPECT_EQ(master.actual(3), one.shown) << std::hex << one.type;
    master.powerOn(3);
    master.cycle(5);
    EXPECT_NEAR(static_cast<double>(scene.drive.mechanics().position()), 777, 3);
    master.setTarget(3, 3 * one.shown);
    master.cycle(3);
    EXPECT_EQ(master.actual(3), 3 * one.shown) << std::hex << one.type;
  }
}

TEST(SercosPosition, Polarity) {
  DriveScene scene;
  RingMaster &master = scene.master;
  master.toPhase3();
  master.write(3, 32, 3);
  EXPECT_EQ(master.write(3, 55, 0x05), 0);
  master.check(128);
  master.phase = 4;
  master.cycle(3);
  EXPECT_EQ(master.actual(3), -777);
  master.powerOn(3);
  master.setTarget(3, -800);
  master.cycle(3);
  EXPECT_EQ(scene.drive.mechanics().position(), 800);
}

TEST(SercosPosition, FineInterpolationOverSeveralCycles) {
  DriveScene scene;
  RingMaster &master = scene.master;
  master.toPhase2();
  master.writeTimes();
  master.write(3, 1, 8000);
  master.check(127);
  master.phase = 3;
  master.cycle(2);
  master.write(3, 32, 3);
  master.check(128);
  master.phase = 4;
  master.cycle(3);
  master.powerOn(3);
  master.setTarget(3, 777 + 400);
  master.setControl(3, 0xE400); // IPOSYNC turns
  master.cycle();
  for (const int32_t way : {100, 200, 300, 400, 400}) {
    master.cycle();
    EXPECT_EQ(master.actual(3), 777 + way);
  }
}

TEST(SercosPosition, HaltAndStopUseTheirRamp) {
  Operating o;
  o.master.powerOn(3);
  ASSERT_EQ(o.master.write(3, 138, 1'000'000, 4), 0);
  int32_t target = 777;
  for (int i = 0; i < 20; ++i) { // 20 increments in 2 ms: 10000 inc/s
    o.master.setTarget(3, target += 20);
    o.master.cycle();
  }
  o.master.setControl(3, 0xC000); // halt: 10000²/2/10⁶ = 50 increments
  o.master.cycle();
  const int32_t begun = o.master.actual(3);
  o.master.cycle(10);
  EXPECT_EQ(o.master.actual(3), begun + 50);
  EXPECT_EQ(o.ready(), 3U);
  EXPECT_FALSE(o.follows());
  o.master.setTarget(3, o.master.actual(3));
  o.master.setControl(3, 0xE000);
  o.master.cycle(2);
  EXPECT_TRUE(o.follows());
  target = o.master.actual(3);
  for (int i = 0; i < 20; ++i) {
    o.master.setTarget(3, target -= 20);
    o.master.cycle();
  }
  o.master.setControl(3, 0x6000); // off, still enabled
  o.master.cycle();
  const int32_t left = o.master.actual(3);
  EXPECT_EQ(o.ready(), 3U) << "until it stands";
  o.master.cycle(10);
  EXPECT_EQ(o.master.actual(3), left - 50);
  EXPECT_EQ(o.ready(), 2U);
}

TEST(SercosPosition, StopsWithoutItsMaster) {
  Operating o;
  o.master.powerOn(3);
  o.master.write(3, 138, 1'000'000, 4);
  int32_t target = 777;
  for (int i = 0; i < 10; ++i) {
    o.master.setTarget(3, target += 20);
    o.master.cycle();
  }
  o.master.ring.faults().open = true;
  o.master.cycle(2);
  EXPECT_EQ(o.drive.phase(), Phase::Zero);
  EXPECT_TRUE(o.drive.hasTorque());
  o.master.cycle(8);
  EXPECT_FALSE(o.drive.hasTorque());
  EXPECT_EQ(o.drive.list().value(11), 0x1000);
}

// ---- other modes

void toMode(RingMaster &master, int64_t telegram, size_t bytes, int64_t primary, int64_t second) {
  master.toPhase2();
  if (telegram == 7) {
    master.writeTimes(8, bytes, 7);
    EXPECT_EQ(master.writeIds(3, 16, {51, 40}), 0);
    EXPECT_EQ(master.writeIds(3, 24, {47, 36, 80}), 0);
  } else {
    master.writeTimes(bytes, bytes, telegram);
  }
  master.check(127);
  master.phase = 3;
  master.cycle(2);
  EXPECT_EQ(master.write(3, 32, primary), 0);
  EXPECT_EQ(master.write(3, 33, second), 0);
  master.check(128);
  master.phase = 4;
  master.cycle(3);
}

TEST(SercosVelocity, InItsUnits) {
  DriveScene scene;
  toMode(scene.master, 2, 4, 2, 0);
  scene.master.setTarget(3, 0);
  scene.master.setControl(3, 0xE000);
  scene.master.cycle(3);
  scene.master.setTarget(3, 6'000'000); // 600 rpm: 10 turns in a second, 40960 inc/s
  scene.master.cycle(4);
  EXPECT_DOUBLE_EQ(scene.drive.mechanics().velocity(), 40960);
  EXPECT_EQ(scene.master.actual(3), 6'000'000);
  ASSERT_EQ(scene.master.write(3, 91, 3'000'000, 4), 0);
  scene.master.cycle(3);
  EXPECT_EQ(scene.master.actual(3), 3'000'000) << "limited";
  ASSERT_EQ(scene.master.write(3, 38, 1'000'000, 4), 0);
  scene.master.cycle(3);
  EXPECT_EQ(scene.master.actual(3), 1'000'000);
  scene.master.setTarget(3, -9'000'000);
  scene.master.cycle(4);
  EXPECT_EQ(scene.master.actual(3), -3'000'000);
}

TEST(SercosModes, AreSwitchedByTheControlWord) {
  DriveSetup setup = plainDrive();
  setup.drive.mechanics.model = dummy::Model::SecondOrder;
  setup.drive.mechanics.torqueLimit = 5;
  setup.drive.mechanics.inertia = 1e-5;
  setup.drive.mechanics.positionGain = 50;
  setup.drive.mechanics.velocityGain = 5e-3;
  setup.drive.mechanics.integralTime = 0;
  setup.drive.mechanics.substeps = 40;
  setup.ratedTorque = 2;
  DriveScene scene(setup);
  RingMaster &master = scene.master;
  toMode(master, 7, 10, 3, 1);
  master.setTarget(3, 777);
  master.setControl(3, 0xE000);
  master.cycle(4);
  EXPECT_EQ(master.records[3].status & 0x0700U, 0U);
  master.setTarget(3, 0, 4);
  master.setTarget(3, 250, 8, 2); // 25 %
  master.setControl(3, 0xE100);
  master.cycle(3);
  EXPECT_EQ(master.records[3].status & 0x0700U, 0x0100U);
  EXPECT_DOUBLE_EQ(scene.drive.mechanics().torque(), 0.5);
  EXPECT_EQ(scene.drive.list().value(84), 250);
  EXPECT_GT(scene.drive.mechanics().velocity(), 0);
  master.setTarget(3, master.actual(3));
  master.setControl(3, 0xE200); // S-0-0034 is not defined
  master.cycle(4);
  EXPECT_EQ(scene.drive.list().value(14), 0x204);
  EXPECT_EQ(scene.drive.list().value(11), 0x1000);
  EXPECT_EQ(scene.drive.phase(), Phase::Four) << "that is no matter of phases";
}

TEST(SercosModes, TorqueIsLimited) {
  DriveSetup setup = plainDrive();
  setup.drive.mechanics.model = dummy::Model::SecondOrder;
  setup.drive.mechanics.torqueLimit = 5;
  setup.drive.mechanics.inertia = 1e-5;
  setup.ratedTorque = 2;
  DriveScene scene(setup);
  toMode(scene.master, 7, 10, 1, 0);
  scene.master.setControl(3, 0xE000);
  scene.master.cycle(3);
  scene.master.setTarget(3, 5000, 8, 2); // 500 %
  scene.master.cycle(3);
  EXPECT_DOUBLE_EQ(scene.drive.mechanics().torque(), 5);
  EXPECT_EQ(scene.drive.list().value(13) & 0x10, 0x10);
  ASSERT_EQ(scene.master.write(3, 92, 1000), 0);
  scene.master.cycle(3);
  EXPECT_DOUBLE_EQ(scene.drive.mechanics().torque(), 2);
}

TEST(SercosModes, AModeNeedsItsCommandValue) {
  Operating o;
  o.master.powerOn(3);
  o.master.setControl(3, 0xE100); // S-0-0033 is velocity, but only positions come
  o.master.cycle(3);
  EXPECT_EQ(o.drive.list().value(14), 0x204);
}

TEST(SercosModes, BothPositionFeedbacks) {
  DriveScene scene;
  toMode(scene.master, 12, 4, 4, 0);
  EXPECT_EQ(scene.master.actual(3), 777);
  scene.master.powerOn(3);
}

} // namespace
} // namespace stride::sercos::simulation
