// The compensating motion of MC_CamIn (ramp_in and its like): within its limits, in its direction,
// without a jump, to the cam exactly.
#include "cam_scene.hpp"

#include "st/SM_PLCopen/MC_MoveVelocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <string>

namespace {

using namespace stride::test;
namespace pl = ::st::SM_PLCopen;

enum StartMode : int16_t { kRampIn = 2, kRampInPos = 3, kRampInNeg = 4 };

struct Counts {
  int ramps = 0, moving = 0, resting = 0, turned = 0;
};

class RampCase {
public:
  RampCase(uint64_t seed, int16_t ramp, Counts &counts)
      : random_(seed), ramp_(ramp), counts_(counts), cam_(smoothCam()),
        period_(random_.chance(0.6) ? random_.magnitude(-1, 3) : 0),
        scene_(random_.chance(0.5) ? random_.magnitude(-1, 3) : 0, period_, cam_) {}

  void run() {
    auto &rig = scene_.rig;
    const double unit = period_ > 0 ? period_ : random_.magnitude(-1, 3);
    const double seconds = kCamCycle * random_.magnitude(1, 2.5);
    velocityDiff_ = 0.5 * unit / seconds * random_.uniform(0.1, 1);
    acceleration_ = velocityDiff_ / seconds * random_.magnitude(0, 1);
    deceleration_ =
        random_.chance(0.3) ? acceleration_ : acceleration_ * random_.magnitude(-0.5, 0.5);
    jerk_ = acceleration_ / seconds * random_.magnitude(0, 1);
    rig.axis.eRampType = ramp_;
    rig.axis.fJerk = random_.chance(0.5) ? jerk_ : 0;
    rig.axis.fSWMaxDeceleration = 1e6;
    ASSERT_GT(rig.powerUp(), 0);
    scene_.placeSlave(unit * random_.uniform(-0.5, 1.2));

    CamSettings &s = scene_.settings;
    s = randomSettings(random_, cam_);
    s.periodic = true;
    s.slaveOffset = random_.chance(0.5) ? unit * random_.uniform(-2, 2) : 0;
    const int mode = kRampIn + random_.below(3);
    scene_.camIn.StartMode = static_cast<int16_t>(mode);
    scene_.select.SlaveAbsolute = !s.relative;
    scene_.camIn.VelocityDiff = velocityDiff_;
    scene_.camIn.Acceleration = acceleration_;
    scene_.camIn.Deceleration = deceleration_;
    scene_.camIn.Jerk = rig.axis.fJerk == 0 ? jerk_ : 0;
    // The cam's own velocity and acceleration are of the size of the compensating motion's: with a
    // limited jerk those that are far beyond it would first lead away. Without, anything goes.
    const double range = static_cast<double>(cam_.length()) / std::fabs(s.masterScaling);
    const double speed = range / seconds * random_.magnitude(-1.5, 0);
    const bool wild = ramp_ == 0 && random_.chance(0.5);
    const ModelPoint shape = cam_.scale();
    const long double vx = speed * std::fabs(static_cast<long double>(s.masterScaling));
    const long double camV = shape.v * vx;
    const long double camA = shape.a * vx * vx + 0.1L * shape.v * vx / kCamCycle;
    long double factor = std::min(0.2L * unit / kCamCycle / camV, 2 * unit / shape.y);
    if (!wild)
      factor = std::min(
          {factor, velocityDiff_ / camV, 0.5L * std::min(acceleration_, deceleration_) / camA});
    s.slaveScaling = random_.sign() * static_cast<double>(factor) * random_.magnitude(-1, 0);
    camLimit_ = camA * std::fabs(static_cast<long double>(s.slaveScaling));
    rests_ = random_.chance(0.4);
    scene_.prepare();
    ModelMaster &master = scene_.master;
    master.place(random_.uniform(-100, 100));

    // Before: master and slave at rest, or any of them in motion.
    const int callOrder = rests_ ? 1 : random_.below(3);
    auto move = fresh<pl::MC_MoveVelocity>();
    move.Axis = &rig.axis;
    move.Velocity = velocityDiff_ * random_.uniform(0, 1.5);
    move.Acceleration = move.Deceleration = acceleration_;
    move.Jerk = jerk_;
    move.Direction = random_.chance(0.5) ? 1 : -1;
    const bool slaveMoves = !rests_ && random_.chance(0.7);
    double velocity = 0;
    const auto pace = [&] {
      if (!rests_ || inSync_)
        velocity += std::clamp(speed - velocity, -speed * 0.1, speed * 0.1);
      master.step(velocity);
    };
    for (int i = 0; i < 20 + random_.below(30); ++i)
      rig.cycle([&] {
        pace();
        if (slaveMoves)
          rig.call(move, true);
      });
    const double v0 = rig.axis.fSetVelocity;
    ASSERT_TRUE(slaveMoves || v0 == 0);
    const double p0 = rig.axis.fSetPosition;
    const ModelPoint before{master.total(), master.velocity(), master.acceleration()};

    std::optional<ModelCoupling> model;
    const long double scale =
        cam_.scale().y * std::fabs(static_cast<long double>(s.slaveScaling)) + unit;
    tolerance_ = 1e-9L * scale;
    limit_ = std::max(acceleration_, deceleration_) * (ramp_ == 1 ? 1.5708 : 1);
    int after = 0;
    note_ = std::string(s.relative ? "relative" : "absolute") + " mode " + std::to_string(mode) +
            (slaveMoves ? " moving, order " + std::to_string(callOrder) : " at rest") + " v0 " +
            std::to_string(v0) + " V " + std::to_string(velocityDiff_) + " A " +
            std::to_string(acceleration_) + " D " + std::to_string(deceleration_) + " J " +
            std::to_string(jerk_) + " period " + std::to_string(period_) + " master's " +
            (scene_.master.isRotary() ? "rotary" : "linear");
    SCOPED_TRACE(note_);
    for (int cycle = 0;
         cycle < (cycle == 0 ? 1 : longest()) && after < 20 && !testing::Test::HasFatalFailure();
         ++cycle) {
      SCOPED_TRACE("cycle " + std::to_string(cycle));
      rig.cycle([&] {
        pace();
        if (slaveMoves && (callOrder == 0 || cycle > 0))
          rig.call(move, true);
        if (cycle == 0) {
          // A relative cam begins where the slave would be now.
          const double onward = slaveMoves && callOrder == 0 ? 0 : v0 * kCamCycle;
          if (s.periodic)
            scene_.putCamUnderMaster(random_.uniform(0.01, 0.99));
          model.emplace(scene_.cam, s);
          ASSERT_TRUE(model->begin(master, rig.axis.fSetPosition + onward));
          const bool movedAlready = slaveMoves && callOrder == 0;
          const auto out = movedAlready ? model->at(master) : model->at(before, 0);
          start((movedAlready ? rig.axis.fSetPosition : p0) - out.slave.y,
                (movedAlready ? rig.axis.fSetVelocity : v0) - out.slave.v);
        }
        rig.call(scene_.camIn, true);
        if (slaveMoves && callOrder == 1)
          rig.call(move, true);
        ASSERT_EQ(scene_.camIn.ErrorID, 0);
        ASSERT_TRUE(scene_.camIn.Busy);
        step(model->at(master), cycle, slaveMoves && callOrder == 0, mode);
      });
      after += inSync_ ? 1 : 0;
    }
    ASSERT_TRUE(inSync_) << "after " << longest() << " cycles";
    // The way round.
    const long double way = r_ - first_;
    if (period_ > 0) {
      const long double turns = r_ / period_;
      ASSERT_NEAR(static_cast<double>(turns - std::round(turns)), 0, 1e-7);
    }
    ++counts_.ramps;
    counts_.moving += slaveMoves;
    counts_.resting += rests_;
    counts_.turned += std::fabs(way) > period_ && period_ > 0;
    if (rests_ && period_ > 0) {
      const long double slack = 1e-9L * period_ + tolerance_;
      if (mode == kRampIn) {
        ASSERT_LE(std::fabs(way), period_ / 2 + slack);
      } else if (mode == kRampInPos) {
        ASSERT_GE(way, -slack);
        ASSERT_LT(way, period_ + slack);
      } else {
        ASSERT_LE(way, slack);
        ASSERT_GT(way, -period_ - slack);
      }
    }
  }

private:
  ModelCam smoothCam() {
    ModelCam cam;
    do
      cam = randomCam(random_, true);
    while (cam.type != 3);
    return cam;
  }

  void start(long double r, long double rv) {
    r_ = first_ = r;
    if (period_ > 0)
      r_ = first_ = r - period_ * std::round(r / period_);
    rv_ = rv;
    ra_ = 0;
    top_ = std::max(std::fabs(rv), static_cast<long double>(velocityDiff_));
  }

  /// Cycles that a compensation may take.
  [[nodiscard]] int longest() const {
    const double stop = static_cast<double>(rv0_) / deceleration_;
    const double change = velocityDiff_ / acceleration_ + velocityDiff_ / deceleration_ +
                          4 * std::sqrt(velocityDiff_ / jerk_) + 4 * limit_ / jerk_;
    // Braking may lead far away.
    double way = static_cast<double>(std::fabs(first_)) + period_ + change * velocityDiff_;
    if (period_ == 0)
      way += static_cast<double>(std::fabs(rv0_)) * (stop + change);
    return static_cast<int>((stop + 4 * change + way / velocityDiff_) / kCamCycle) + 50;
  }

  void step(const ModelCoupling::Out &out, int cycle, bool moved, int mode) {
    const auto &axis = scene_.rig.axis;
    const bool inSync = scene_.camIn.InSync;
    const long double T = kCamCycle;
    long double way = axis.fSetPosition - out.slave.y - r_;
    if (period_ > 0)
      way -= period_ * std::round(way / period_);
    const long double rv = axis.fSetVelocity - out.slave.v;
    const long double ra = axis.fSetAcceleration - out.slave.a;
    const long double slackV = 1e-9L * (top_ + std::fabs(out.slave.v)) + tolerance_;
    if (cycle == 0 && moved) {
      ra_ = ra;
      rv0_ = std::fabs(rv);
      // It stays where the other block has moved the slave in this cycle.
      ASSERT_LE(std::fabs(way), tolerance_) << "position jumps";
      ASSERT_LE(std::fabs(rv - rv_), slackV) << "velocity jumps";
      return;
    }
    // In the first cycle the model's place of the cycle before is as exact as the master's course
    // is even. An acceleration that was there before is taken away by the jerk.
    const long double most = ramp_ == 0 ? limit_ : std::max<long double>(limit_, std::fabs(ra_));
    const long double limit = most * (1 + 1e-6L) + (cycle == 0 ? 2 * camLimit_ : 0.0L);
    ASSERT_LE(std::fabs(rv - rv_), limit * T + slackV) << "velocity jumps";
    ASSERT_LE(std::fabs(way - T * (rv + rv_) / 2), limit * T * T / 2 + tolerance_)
        << "position jumps";
    if (cycle == 0) {
      rv0_ = std::max(std::fabs(rv_), std::fabs(rv));
      top_ = std::max(top_, rv0_);
    }
    ASSERT_LE(std::fabs(rv), top_ + (ramp_ == 0 ? 0 : 4 * limit_ * limit_ / jerk_) + slackV);
    if (cycle > 0) {
      if (rv * rv_ >= 0 && (ramp_ == 0 || rests_)) {
        const long double a = (std::fabs(rv) - std::fabs(rv_)) / T;
        const long double sine = ramp_ == 1 ? 1.5708L : 1;
        ASSERT_LE(a, acceleration_ * sine * (1 + 1e-6L) + slackV / T) << "accelerates too much";
        ASSERT_GE(a, -deceleration_ * sine * (1 + 1e-6L) - slackV / T) << "brakes too much";
      }
      if (ramp_ == 2 && cycle > 1) {
        ASSERT_LE(std::fabs(ra - ra_),
                  jerk_ * T * (1 + 1e-6L) + 1e-7L * (limit_ + std::fabs(out.slave.a)))
            << "acceleration jumps";
      }
    }
    // A direction once taken is kept. (An acceleration that has to be taken away first may turn
    // it.)
    if (period_ > 0 && (ramp_ == 0 || rests_) && mode != kRampIn && cycle > 0) {
      const long double sign = mode == kRampInPos ? 1 : -1;
      if (rv_ * sign > slackV) {
        ASSERT_GT(rv * sign, -slackV) << "turns round";
      }
    }
    if (inSync_) {
      ASSERT_TRUE(inSync);
    }
    if (inSync) {
      ASSERT_LE(std::fabs(scene_.offFrom(out.slave.y)), tolerance_);
      ASSERT_LE(std::fabs(rv), slackV);
    } else {
      long double rest = r_ + way;
      if (period_ > 0)
        rest -= period_ * std::round(rest / period_);
      ASSERT_GT(std::fabs(rest) + std::fabs(rv) * T, 0);
    }
    r_ += way;
    rv_ = rv;
    ra_ = ra;
    inSync_ = inSync;
  }

  Random random_;
  int16_t ramp_;
  Counts &counts_;
  ModelCam cam_;
  double period_;
  CamScene scene_;
  double velocityDiff_ = 0, acceleration_ = 0, deceleration_ = 0, jerk_ = 0, limit_ = 0;
  long double r_ = 0, rv_ = 0, ra_ = 0, rv0_ = 0, first_ = 0, top_ = 0, tolerance_ = 0;
  long double camLimit_ = 0;
  bool rests_ = false;
  bool inSync_ = false;
  std::string note_;
};

class CamRamps : public testing::TestWithParam<int> {};

TEST_P(CamRamps, LeadToTheCamWithinTheirLimits) {
  Counts counts;
  const int cases = casesOf(1000);
  for (int i = 0; i < cases && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    RampCase(static_cast<uint64_t>(i), static_cast<int16_t>(GetParam()), counts).run();
  }
  std::cout << counts.ramps << " ramps, " << counts.moving << " of a moving slave, "
            << counts.resting << " at rest, " << counts.turned << " longer than a turn\n";
  EXPECT_GT(counts.resting, cases / 4);
  EXPECT_GT(counts.moving, cases / 4);
}

INSTANTIATE_TEST_SUITE_P(Ramps, CamRamps, testing::Values(0, 1, 2, 3),
                         [](const auto &info) { return "Ramp" + std::to_string(info.param); });

} // namespace
