// MC_CamIn against the formula of the manual, section 4.6.1, over random courses of the master.
#include "cam_scene.hpp"

#include "st/SM_PLCopen/SMC_GetCamSlaveSetPosition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace stride::test;
namespace state = stride::axis::state;
struct Seen {
  int cycles = 0, ends = 0, outside = 0, refused = 0, exact = 0, shifts = 0, switches = 0,
      foretold = 0;
};

/// A random course; all that MC_CamIn does is what the model says.
class Follower {
public:
  Follower(uint64_t seed, Seen &seen)
      : random_(seed), seen_(seen), cam_(randomCam(random_, random_.chance(0.5))),
        masterPeriod_(period(random_.chance(0.3) ? static_cast<double>(cam_.length())
                                                 : random_.magnitude(-1, 3))),
        scene_(masterPeriod_, period(random_.magnitude(-1, 3)), cam_) {}

  void run() {
    scene_.settings = randomSettings(random_, cam_);
    const CamSettings &s = scene_.settings;
    ASSERT_GT(scene_.rig.powerUp(), 0);
    scene_.placeSlave(random_.uniform(-300, 300));
    // The master somewhere, mostly where the cam is.
    const double range = static_cast<double>(cam_.length()) / std::fabs(s.masterScaling);
    const double middle = ((cam_.start() + cam_.end()) / 2 - s.masterOffset) / s.masterScaling;
    scene_.master.place(middle + range * random_.uniform(-0.55, 0.55));
    scene_.master.ref.bRegulatorOn = random_.chance(0.7);
    const bool viaSelect = random_.chance(0.5);
    scene_.select.SlaveAbsolute = !(s.relative && viaSelect);
    scene_.camIn.StartMode = s.relative && (!viaSelect || random_.chance(0.5)) ? 1 : 0;
    scene_.prepare();
    ASSERT_TRUE(scene_.select.Done) << scene_.select.ErrorID;
    MasterCourse course(random_, range);
    for (int i = 0; i < 5; ++i)
      scene_.rig.cycle([&] { scene_.master.step(course.next()); });
    std::optional<ModelCoupling> model;
    const ModelPoint scale = cam_.scale();
    bool ok = true;
    for (int cycle = 0; cycle < 60 && ok && !testing::Test::HasFatalFailure(); ++cycle) {
      SCOPED_TRACE("cycle " + std::to_string(cycle));
      scene_.rig.cycle([&] {
        const double slaveBefore = scene_.rig.axis.fSetPosition;
        scene_.master.step(course.next());
        disturb(cycle > 0);
        if (cycle == 0) {
          if (random_.chance(0.9))
            scene_.putCamUnderMaster(random_.uniform(0.001, 0.999));
          model.emplace(scene_.cam, s);
          ok = model->begin(scene_.master, slaveBefore);
          foretell();
        }
        scene_.rig.call(scene_.camIn, true);
        if (ok)
          check(model->at(scene_.master), scale);
        else
          refused(slaveBefore);
        if (cycle == 0)
          compareForetold(ok);
        shift();
      });
    }
  }

private:
  double period(double length) { return random_.chance(0.5) ? length : 0; }

  void shift() {
    if (!random_.chance(0.04))
      return;
    scene_.master.setPosition(random_.uniform(-1000, 1000), random_.chance(0.5));
    ++seen_.shifts;
  }

  void disturb(bool started) {
    shift();
    auto &ref = scene_.master.ref;
    // The way between set and actual position is known only if it is less than half a turn.
    const double most =
        std::max(std::fabs(ref.fSetVelocity), std::fabs(ref.fActVelocity)) * kCamCycle;
    if (started && random_.chance(0.05) && (masterPeriod_ == 0 || most < masterPeriod_ / 4)) {
      ref.bRegulatorOn = ref.bRegulatorOn == 0;
      ++seen_.switches;
    }
  }

  /// SMC_GetCamSlaveSetPosition with the same inputs, before MC_CamIn.
  void foretell() {
    told_.CamTableID = &scene_.select.CamTableID;
    told_.Master = &scene_.master.ref;
    told_.Slave = &scene_.rig.axis;
    told_.Enable = 1;
    told_.MasterOffset = scene_.camIn.MasterOffset;
    told_.MasterScaling = scene_.camIn.MasterScaling;
    told_.SlaveOffset = scene_.camIn.SlaveOffset;
    told_.SlaveScaling = scene_.camIn.SlaveScaling;
    const auto before = scene_.rig.axis;
    told_.body__(scene_.rig.ctx);
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): to the byte
    ASSERT_EQ(std::memcmp(&before, &scene_.rig.axis, sizeof before), 0) << "touches the slave";
  }

  void compareForetold(bool ok) {
    ASSERT_EQ(told_.Error != 0, !ok);
    ASSERT_EQ(told_.ErrorID, ok ? 0 : 626);
    // StartMode is none of its inputs.
    if (ok && (!scene_.settings.relative || scene_.select.SlaveAbsolute == 0)) {
      ASSERT_EQ(told_.fStartPosition, scene_.rig.axis.fSetPosition);
      ASSERT_EQ(told_.fStartVelocity, scene_.rig.axis.fSetVelocity);
      ASSERT_EQ(told_.fStartAcceleration, scene_.rig.axis.fSetAcceleration);
      ++seen_.foretold;
    }
  }

  void check(const ModelCoupling::Out &out, const ModelPoint &scale) {
    const auto &camIn = scene_.camIn;
    const auto &axis = scene_.rig.axis;
    const CamSettings &s = scene_.settings;
    const long double slave = std::fabs(static_cast<long double>(s.slaveScaling));
    const long double master = std::fabs(static_cast<long double>(s.masterScaling));
    ASSERT_EQ(camIn.ErrorID, 0);
    ASSERT_TRUE(camIn.InSync);
    ASSERT_TRUE(camIn.Busy);
    ASSERT_TRUE(camIn.Active);
    ASSERT_FALSE(camIn.CommandAborted);
    ASSERT_EQ(axis.nAxisState, state::kSynchronized);
    const long double off = scene_.offFrom(out.slave.y);
    const long double mayBe = slave * (1e-9L * scale.y + scale.v * out.haze) +
                              1e-15L * (std::fabs(out.slave.y) + axis.fPositionPeriod) +
                              1e-15L * std::fabs(static_cast<long double>(axis.fSetPosition));
    ASSERT_LE(std::fabs(off), mayBe) << "at " << static_cast<double>(out.x);
    if (scene_.rotarySlave()) {
      ASSERT_GE(axis.fSetPosition, 0);
      ASSERT_LT(axis.fSetPosition, axis.fPositionPeriod);
    }
    ++seen_.cycles;
    seen_.outside += out.outside;
    if (!out.exact)
      return;
    ++seen_.exact;
    seen_.ends += out.endOfProfile;
    ASSERT_EQ(camIn.EndOfProfile != 0, out.endOfProfile) << "at " << static_cast<double>(out.x);
    const long double vx = master * std::fabs(static_cast<long double>(scene_.master.velocity()));
    const long double ax =
        master * std::fabs(static_cast<long double>(scene_.master.acceleration()));
    const long double relative = 1e-9L + 100 * out.haze / cam_.length();
    ASSERT_LE(std::fabs(axis.fSetVelocity - out.slave.v),
              relative * slave * scale.v * vx + 1e-300L);
    ASSERT_LE(std::fabs(axis.fSetAcceleration - out.slave.a),
              10 * relative * slave * (scale.a * vx * vx + scale.v * ax) + 1e-300L);
  }

  void refused(double slaveBefore) {
    ++seen_.refused;
    const auto &camIn = scene_.camIn;
    ASSERT_TRUE(camIn.Error);
    ASSERT_EQ(camIn.ErrorID, 626);
    ASSERT_FALSE(camIn.Busy);
    ASSERT_FALSE(camIn.InSync);
    ASSERT_EQ(scene_.rig.axis.fSetPosition, slaveBefore);
    ASSERT_EQ(scene_.rig.axis.nAxisState, state::kStandstill);
  }

  Random random_;
  Seen &seen_;
  ModelCam cam_;
  double masterPeriod_;
  CamScene scene_;
  ::st::SM_PLCopen::SMC_GetCamSlaveSetPosition told_ =
      fresh<::st::SM_PLCopen::SMC_GetCamSlaveSetPosition>();
};

TEST(CamInProperty, PositionVelocityAndAccelerationFollowTheFormula) {
  Seen seen;
  const int cases = casesOf(20000);
  for (int i = 0; i < cases && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Follower(static_cast<uint64_t>(i), seen).run();
  }
  std::cout << seen.cycles << " cycles, " << seen.exact << " with derivatives, " << seen.ends
            << " ends, " << seen.outside << " outside, " << seen.refused << " refused, "
            << seen.shifts << " shifts, " << seen.switches << " switches\n";
  EXPECT_GT(seen.exact, 30 * cases);
  EXPECT_GT(seen.ends, cases);
  EXPECT_GT(seen.outside, cases);
  EXPECT_GT(seen.refused, cases / 100);
  EXPECT_GT(seen.foretold, cases / 2);
}

/// A cam that fits together at its ends, with a rise; all numbers exact.
ModelCam exactCam(double length, double rise) {
  ModelCam cam;
  cam.nodes = {{0, 0, 0.5, 0},
               {length * 0.25, rise, 2, 0.125},
               {length * 0.625, -rise, -1, 0},
               {length, rise, 0.5, 0}};
  return cam;
}

TEST(CamInProperty, AReversingMasterRetracesTheSlavesCourseToTheBit) {
  for (int i = 0; i < casesOf(3000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const ModelCam cam = randomCam(random, true);
    const double masterPeriod = random.chance(0.6) ? random.magnitude(-1, 3) : 0;
    CamScene scene(masterPeriod, random.chance(0.5) ? random.magnitude(-1, 3) : 0, cam);
    scene.settings = randomSettings(random, cam);
    scene.settings.periodic = true;
    ASSERT_GT(scene.rig.powerUp(), 0);
    scene.camIn.StartMode = scene.settings.relative ? 1 : 0;
    scene.prepare();
    struct Stop {
      double position;
      int64_t turns;
      double velocity, slave, slaveVelocity;
    };
    std::vector<Stop> stops;
    MasterCourse course(random, static_cast<double>(cam.length()) / scene.settings.masterScaling);
    ModelMaster &master = scene.master;
    master.place(random.uniform(-1000, 1000));
    scene.putCamUnderMaster(random.uniform(0.001, 0.999));
    const int there = 40;
    for (int k = 0; k <= there; ++k)
      scene.rig.cycle([&] {
        if (k > 0)
          master.step(k == there ? 0 : course.next());
        scene.rig.call(scene.camIn, true);
        ASSERT_EQ(scene.camIn.ErrorID, 0);
        stops.push_back({master.ref.fSetPosition, master.turns(), master.ref.fSetVelocity,
                         scene.rig.axis.fSetPosition, scene.rig.axis.fSetVelocity});
      });
    for (int k = there - 1; k >= 0 && !HasFailure(); --k)
      scene.rig.cycle([&] {
        const Stop &stop = stops[static_cast<size_t>(k)];
        master.jumpTo(stop.position, stop.turns, -stop.velocity);
        scene.rig.call(scene.camIn, true);
        ASSERT_EQ(scene.rig.axis.fSetPosition, stop.slave) << k;
        ASSERT_EQ(scene.rig.axis.fSetVelocity, -stop.slaveVelocity) << k;
      });
  }
}

TEST(CamInProperty, HundredMillionTurnsDoNotDrift) {
  for (const double masterPeriod : {360.0, 0.0, 77.7}) {
    for (const double length : {100.0, 360.0, 0.3}) {
      SCOPED_TRACE(std::to_string(masterPeriod) + " " + std::to_string(length));
      ModelCam cam = exactCam(length, 37.25);
      cam.fill();
      CamScene scene(masterPeriod, 270, cam);
      ASSERT_GT(scene.rig.powerUp(), 0);
      scene.prepare();
      ModelCoupling model(scene.cam, scene.settings);
      const ModelPoint scale = cam.scale();
      ModelMaster &master = scene.master;
      const double turn = masterPeriod > 0 ? masterPeriod : 360;
      int64_t most = 0;
      for (int k = 0; k < 12000 && !HasFailure(); ++k)
        scene.rig.cycle([&] {
          // 20,000 turns per cycle and a bit, more slowly at both ends; then back.
          const double part = k < 6000 ? std::min({k, 500, 6000 - k}) / 500.0
                                       : -std::min({k - 6000, 500, 12000 - k}) / 500.0;
          master.step(part * 20000.3 * turn / kCamCycle);
          const bool begun = k > 0 || model.begin(master, 0);
          ASSERT_TRUE(begun);
          scene.rig.call(scene.camIn, true);
          most = std::max(most, static_cast<int64_t>(std::fabs(master.total()) / turn));
          // What long double loses.
          const long double bit = std::fabs(master.total()) * 0x1p-61L;
          const auto out = model.at(master);
          ASSERT_LE(std::fabs(scene.offFrom(out.slave.y)), 1e-9L * scale.y + bit * scale.v)
              << k << " " << static_cast<double>(out.x);
        });
      EXPECT_GT(most, 100'000'000);
    }
  }
}

} // namespace
