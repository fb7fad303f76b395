// The simulated mechanics against closed forms computed here in long double.
#include "drivers/dummy/drive_parameters.hpp"
#include "drivers/dummy/mechanics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stride::dummy {
namespace {

MechanicsParameters lag(double timeConstant, double cycle = 0.001) {
  MechanicsParameters p;
  p.model = Model::Lag;
  p.cycle = cycle;
  p.timeConstant = timeConstant;
  return p;
}

MechanicsParameters body(double inertia, double viscous, double dry) {
  MechanicsParameters p;
  p.model = Model::SecondOrder;
  p.cycle = 0.001;
  p.inertia = inertia;
  p.viscousFriction = viscous;
  p.coulombFriction = dry;
  p.torqueLimit = 1e9;
  p.substeps = 4;
  return p;
}

double place(const Mechanics &m) { return static_cast<double>(m.position()) + m.fraction(); }

Demand positionDemand(int64_t from, int64_t to) { return {from, to, 0, 0, 0, kPositionMode}; }

TEST(Mechanics, IdealIsWhereItShouldBe) {
  Mechanics m(MechanicsParameters(), 7);
  EXPECT_EQ(m.position(), 7);
  Demand demand = positionDemand(7, 123456789012345);
  demand.velocity = 5;
  m.regulate(demand, 0);
  EXPECT_EQ(m.position(), 123456789012345);
  EXPECT_EQ(m.velocity(), 5);
}

TEST(Mechanics, IdealIntegratesTheVelocityWithoutLoss) {
  MechanicsParameters p;
  p.cycle = 0.001;
  Mechanics m(p, 0);
  for (int i = 0; i < 1000000; ++i)
    m.regulate({0, 0, 333.25, 333.25, 0, kVelocityMode}, 0);
  EXPECT_EQ(m.position(), 333250);
}

// A step is a ramp over one cycle, followed by x = constant.
TEST(Mechanics, LagStepResponse) {
  const double tau = 0.02;
  Mechanics m(lag(tau), 0);
  m.regulate(positionDemand(0, 1000000), 0);
  const long double afterRamp = // of the deviation, at the end of the first cycle
      1000000.0L * (static_cast<long double>(tau) / 0.001L) * -std::expm1(-0.001L / 0.02L);
  for (int k = 1; k <= 400; ++k) {
    const long double left = afterRamp * std::exp(-0.001L * (k - 1) / 0.02L);
    ASSERT_NEAR(static_cast<double>(1000000.0L - left), place(m), 1e-6) << k;
    ASSERT_NEAR(static_cast<double>(left / 0.02L), m.velocity(), 1e-4);
    m.regulate(positionDemand(1000000, 1000000), 0);
  }
  for (int k = 0; k < 2000; ++k)
    m.regulate(positionDemand(1000000, 1000000), 0);
  EXPECT_EQ(m.position(), 1000000) << "without a lasting deviation";
}

TEST(Mechanics, LagFollowsARampVTimesTBehindForever) {
  const double tau = 0.0123;
  const int64_t step = 777;
  const int64_t far = int64_t{1} << 50; // no digits are lost to the distance
  Mechanics m(lag(tau), far);
  int64_t x = far;
  for (int k = 0; k < 1000000; ++k, x += step)
    m.regulate(positionDemand(x, x + step), 0);
  EXPECT_NEAR(static_cast<double>(x - m.position()) - m.fraction(), 777 / 0.001 * tau, 1e-7);
  EXPECT_NEAR(m.velocity(), 777 / 0.001, 1e-4);
}

TEST(Mechanics, LagOfTheVelocity) {
  const double tau = 0.05;
  Mechanics m(lag(tau), 0);
  for (int k = 1; k <= 300; ++k) {
    m.regulate({0, 0, 10000, 10000, 0, kVelocityMode}, 0);
    const long double t = 0.001L * k;
    ASSERT_NEAR(m.velocity(), static_cast<double>(-10000.0L * std::expm1(-t / 0.05L)), 1e-8);
    ASSERT_NEAR(place(m), static_cast<double>(10000.0L * (t + 0.05L * std::expm1(-t / 0.05L))),
                1e-8);
  }
}

// A ramp of the set velocity with 20000 inc/s²: the velocity follows a T behind.
TEST(Mechanics, LagOfAVelocityRamp) {
  Mechanics m(lag(0.05), 0);
  for (int k = 1; k <= 1000; ++k) {
    m.regulate({0, 0, 20.0 * (k - 1), 20.0 * k, 0, kVelocityMode}, 0);
    const long double t = 0.001L * k;
    const long double e = -std::expm1(-t / 0.05L);
    ASSERT_NEAR(m.velocity(), static_cast<double>(20000.0L * (t - 0.05L * e)), 1e-7);
    ASSERT_NEAR(place(m), static_cast<double>(20000.0L * (t * t / 2 - 0.05L * t + 0.0025L * e)),
                1e-7);
  }
}

// m v' = F - d v from rest.
TEST(MoveBody, ViscousFriction) {
  for (const double viscous : {0.0, 1e-12, 1e-6, 0.01, 1.0, 40.0, 5000.0}) {
    const MechanicsParameters p = body(0.5, viscous, 0);
    double x = 3;
    double v = -2;
    moveBody(p, 10, 0.0, x, v);
    EXPECT_EQ(x, 3);
    v = 2;
    moveBody(p, 10, 0.25, x, v);
    const long double d = viscous;
    const long double k = d / 0.5L;
    long double expectedV = 2.0L + 10.0L / 0.5L * 0.25L;
    long double expectedX = 3.0L + 2.0L * 0.25L + 0.5L * 20.0L * 0.0625L;
    if (viscous > 1e-9) {
      const long double end = 10.0L / d;
      const long double gone = -std::expm1(-k * 0.25L);
      expectedV = 2.0L + (end - 2.0L) * gone;
      expectedX = 3.0L + end * 0.25L + (2.0L - end) * gone / k;
    }
    EXPECT_NEAR(v, static_cast<double>(expectedV), 1e-10) << viscous;
    EXPECT_NEAR(x, static_cast<double>(expectedX), viscous == 1e-6 ? 1e-7 : 1e-10) << viscous;
  }
}

TEST(MoveBody, ComesToRestAndSticks) {
  const MechanicsParameters p = body(2, 0, 5);
  double x = 0;
  double v = 10; // brakes with 5/2: at rest after 4 s and 20
  moveBody(p, 0, 100, x, v);
  EXPECT_EQ(v, 0);
  EXPECT_NEAR(x, 20, 1e-12);
  moveBody(p, -5, 100, x, v);
  EXPECT_EQ(v, 0);
  EXPECT_NEAR(x, 20, 1e-12);
  moveBody(p, -7, 3, x, v); // (7 - 5) / 2
  EXPECT_NEAR(v, -3, 1e-12);
  EXPECT_NEAR(x, 20 - 4.5, 1e-12);
}

TEST(MoveBody, TurnsRoundOnTheWay) {
  const MechanicsParameters p = body(2, 0, 5);
  double x = 0;
  double v = 9;
  moveBody(p, -13, 4, x, v); // (13 + 5) / 2 = 9 for 1 s, then (13 - 5) / 2 = 4 for 3 s
  EXPECT_NEAR(v, -12, 1e-12);
  EXPECT_NEAR(x, 4.5 - 18, 1e-12);
}

// One long step or many short ones: the same motion.
TEST(MoveBody, DoesNotDependOnTheStep) {
  const MechanicsParameters p = body(0.3, 0.7, 0.2);
  double x = 0;
  double v = 5;
  moveBody(p, -1.1, 3, x, v);
  double y = 0;
  double w = 5;
  for (int i = 0; i < 3000; ++i)
    moveBody(p, -1.1, 0.001, y, w);
  EXPECT_NEAR(v, w, 1e-11);
  EXPECT_NEAR(x, y, 1e-11);
}

// Work of the motor = kinetic energy + work of dry friction.
TEST(Mechanics, EnergyIsKept) {
  MechanicsParameters p = body(0.25, 0, 0.5);
  p.torqueLimit = 3;
  Mechanics m(p, 0);
  double work = 0;
  for (int k = 0; k < 2000; ++k) {
    const double before = place(m);
    m.regulate({0, 0, 0, 0, k < 1500 ? 2.0 : -1.0, kTorqueMode}, 0);
    work += m.torque() * (place(m) - before);
  }
  const double kinetic = 0.5 * 0.25 * m.velocity() * m.velocity();
  EXPECT_NEAR(kinetic, 4.5, 1e-9) << "6 u/s: 1.5 s with 6, 0.5 s with -6 u/s²";
  EXPECT_NEAR(work, kinetic + 0.5 * place(m), 1e-9);
}

TEST(Mechanics, TorqueSaturates) {
  MechanicsParameters p = body(1, 0, 0);
  p.torqueLimit = 100;
  p.positionGain = 50;
  p.velocityGain = 500;
  p.integralTime = 0.02;
  Mechanics m(p, 0);
  // A step that is far too large: full torque, so v = 100 t and x = 50 t².
  for (int k = 1; k <= 100; ++k) {
    m.regulate(positionDemand(1000000, 1000000), 0);
    ASSERT_TRUE(m.saturated());
    ASSERT_EQ(m.torque(), 100);
    const double t = 0.001 * k;
    ASSERT_NEAR(m.velocity(), 100 * t, 1e-9);
    ASSERT_NEAR(place(m), 50 * t * t, 1e-9);
  }
}

TEST(Mechanics, SecondOrderFollowsARampVOverKvBehind) {
  MechanicsParameters p = body(1, 0, 0);
  p.positionGain = 50;
  p.velocityGain = 500;
  p.integralTime = 0.02;
  for (const double feedforward : {0.0, 0.5, 1.0}) {
    p.velocityFeedforward = feedforward;
    Mechanics m(p, 0);
    int64_t x = 0;
    for (int k = 0; k < 5000; ++k, x += 1000)
      m.regulate(positionDemand(x, x + 1000), 0);
    EXPECT_NEAR(static_cast<double>(x - m.position()), (1 - feedforward) * 1e6 / 50, 1);
    EXPECT_NEAR(m.velocity(), 1e6, 1);
  }
}

TEST(Mechanics, TheControllersHoldALoad) {
  MechanicsParameters p = body(1, 0.1, 0.3);
  p.torqueLimit = 50;
  p.positionGain = 50;
  p.velocityGain = 500;
  p.integralTime = 0.02;
  Mechanics m(p, 500);
  for (int k = 0; k < 5000; ++k)
    m.regulate(positionDemand(500, 500), -20);
  EXPECT_NEAR(m.torque(), 20, 0.31);
  EXPECT_NEAR(place(m), 500, 0.01);
  m.coast(-20);
  EXPECT_LT(m.velocity(), 0) << "falls without power";
  m.hold();
  EXPECT_EQ(m.velocity(), 0);
}

TEST(Marks, FirstOneOnTheWay) {
  double mark = 0;
  const Marks marks{true, 10, 100};
  EXPECT_FALSE(marks.passed(11, 109, mark));
  EXPECT_TRUE(marks.passed(109, 110, mark));
  EXPECT_EQ(mark, 110);
  EXPECT_TRUE(marks.passed(-95, 400, mark));
  EXPECT_EQ(mark, -90);
  EXPECT_TRUE(marks.passed(400, -95, mark));
  EXPECT_EQ(mark, 310);
  const Marks single{true, 10, 0};
  EXPECT_TRUE(single.passed(0, 20, mark));
  EXPECT_EQ(mark, 10);
  EXPECT_FALSE(single.passed(20, 200, mark));
  EXPECT_TRUE(single.passed(20, 0, mark));
  EXPECT_FALSE(Marks().passed(-1e9, 1e9, mark));
}

TEST(SwitchRange, LinearAndRotary) {
  const SwitchRange range{true, 10, 20};
  EXPECT_FALSE(range.actuated(9, 0));
  EXPECT_TRUE(range.actuated(10, 0));
  EXPECT_FALSE(range.actuated(380, 0));
  EXPECT_TRUE(range.actuated(380, 360));
  EXPECT_TRUE(range.actuated(-345, 360));
  const SwitchRange across{true, 350, 10};
  EXPECT_TRUE(across.actuated(355, 360));
  EXPECT_TRUE(across.actuated(725, 360));
  EXPECT_FALSE(across.actuated(180, 360));
}

} // namespace
} // namespace stride::dummy
