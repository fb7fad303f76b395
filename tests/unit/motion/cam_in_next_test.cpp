// What comes after MC_CamIn: other blocks that take the slave, other cams (4.6.2 of the manual).
#include "tests/unit/motion/cam_in_scene.hpp"

#include "st/SM_PLCopen/MC_CamOut.h"
#include "st/SM_PLCopen/MC_MoveSuperImposed.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace {

using namespace stride::test;
namespace state = stride::axis::state;
namespace pl = ::st::SM_PLCopen;

// ---------------------------------------------------------------- Who takes the slave

TEST(CamIn, AnotherBlockTakesTheSlaveWithoutAJump) {
  auto scene = ready(line(360, 360), 360, 360);
  auto move = scene->rig.move(200, 500, 1000, 1000);
  for (int i = 0; i < 100; ++i)
    go(*scene, 300);
  double before = scene->rig.axis.fSetPosition;
  for (int i = 0; i < 1000; ++i) {
    const double velocity = scene->rig.axis.fSetVelocity;
    scene->rig.cycle([&] {
      scene->master.step(300);
      scene->rig.call(scene->camIn, true);
      scene->rig.call(move, true);
    });
    double way = scene->rig.axis.fSetPosition - before;
    way -= 360 * std::round(way / 360);
    if (i > 0) { // both have moved it in the first cycle
      ASSERT_NEAR(way, velocity * kCamCycle, 1000 * kCamCycle * kCamCycle) << i;
      ASSERT_TRUE(scene->camIn.CommandAborted);
      ASSERT_FALSE(scene->camIn.InSync);
      ASSERT_FALSE(scene->camIn.Busy);
      ASSERT_FALSE(scene->camIn.Error);
    } else {
      ASSERT_NEAR(way, velocity * kCamCycle, 1000 * kCamCycle * kCamCycle) << "jump at the start";
    }
    before = scene->rig.axis.fSetPosition;
  }
  EXPECT_TRUE(move.Done);
  EXPECT_EQ(scene->rig.axis.fSetPosition, 200);
  scene->rig.cycle([&] { scene->rig.call(scene->camIn, false); });
  EXPECT_FALSE(scene->camIn.CommandAborted);
}

TEST(CamIn, CamOutLetsTheSlaveGoOnWithItsVelocity) {
  auto scene = ready(hill(360, 100), 360);
  auto out = fresh<pl::MC_CamOut>();
  out.Slave = &scene->rig.axis;
  for (int i = 0; i < 100; ++i)
    go(*scene, 300);
  const double velocity = scene->rig.axis.fSetVelocity;
  ASSERT_GT(velocity, 10);
  double before = scene->rig.axis.fSetPosition;
  for (int i = 0; i < 100; ++i) {
    scene->rig.cycle([&] {
      scene->master.step(0);
      scene->rig.call(out, true);
      scene->rig.call(scene->camIn, true);
    });
    ASSERT_TRUE(out.Done);
    ASSERT_DOUBLE_EQ(scene->rig.axis.fSetVelocity, velocity);
    ASSERT_NEAR(scene->rig.axis.fSetPosition - before, velocity * kCamCycle, 1e-9);
    ASSERT_EQ(scene->rig.axis.nAxisState, state::kContinuous);
    ASSERT_TRUE(scene->camIn.CommandAborted);
    ASSERT_FALSE(scene->camIn.InSync);
    before = scene->rig.axis.fSetPosition;
  }
}

TEST(CamIn, CarriesASuperimposedMotion) {
  for (const double slavePeriod : {0.0, 90.0}) {
    auto scene = ready(hill(360, 100), 360, slavePeriod);
    auto twin = ready(hill(360, 100), 360, slavePeriod);
    auto super = fresh<pl::MC_MoveSuperImposed>();
    super.Axis = &scene->rig.axis;
    super.Distance = 37;
    super.VelocityDiff = 50;
    super.Acceleration = super.Deceleration = 500;
    long double last = 0;
    for (int i = 0; i < 1500; ++i) {
      scene->rig.cycle([&] {
        scene->master.step(300);
        scene->rig.call(scene->camIn, true);
        scene->rig.call(super, i >= 50);
      });
      go(*twin, 300);
      ASSERT_TRUE(scene->camIn.InSync);
      ASSERT_FALSE(scene->camIn.CommandAborted);
      long double added = scene->offFrom(twin->rig.axis.fSetPosition);
      if (slavePeriod > 0)
        added -= slavePeriod * std::round((added - last) / slavePeriod);
      ASSERT_LE(std::fabs(added - last), 50 * kCamCycle + 1e-9) << i;
      last = added;
    }
    EXPECT_TRUE(super.Done);
    EXPECT_NEAR(static_cast<double>(last), 37, 1e-9);
  }
}

// ---------------------------------------------------------------- From one cam to another

/// Both cams rise by 360; their velocities fit.
struct TwoCams {
  ModelCam first, second;
  CamRef secondRef;
  pl::MC_CamTableSelect select = fresh<pl::MC_CamTableSelect>();
  std::unique_ptr<CamScene> scene;

  TwoCams(bool periodic, bool slaveAbsolute, double masterPeriod, double slavePeriod) {
    first = line(360, 360);
    first.nodes.insert(first.nodes.begin() + 1, {180, 100, 1.5, 0});
    second = line(360, 360);
    second.nodes.insert(second.nodes.begin() + 1, {100, 200, 0.5, 0});
    secondRef = second.ref();
    scene = ready(first, masterPeriod, slavePeriod);
    scene->camIn.CamTableID.Periodic = periodic;
    select.Master = &scene->master.ref;
    select.Slave = &scene->rig.axis;
    select.CamTable = &secondRef;
    select.SlaveAbsolute = slaveAbsolute;
    select.Periodic = periodic;
    scene->rig.call(select, true);
    EXPECT_TRUE(select.Done);
  }
  TwoCams(const TwoCams &) = delete;

  /// One cycle of the manual's program: a restart at EndOfProfile. True if there was one.
  bool cycle(double velocity, double slaveOffset = 0) {
    bool changed = false;
    scene->rig.cycle([&] {
      scene->master.step(velocity);
      scene->rig.call(scene->camIn, true);
      if (scene->camIn.EndOfProfile != 0 && scene->camIn.CamTableID.pCam != &secondRef) {
        atEnd = scene->rig.axis.fSetPosition;
        scene->rig.call(scene->camIn, false);
        scene->camIn.CamTableID = select.CamTableID;
        scene->camIn.SlaveOffset = slaveOffset;
        scene->rig.call(scene->camIn, true);
        changed = true;
      }
    });
    EXPECT_EQ(scene->camIn.ErrorID, 0);
    return changed;
  }
  double atEnd = 0;
};

TEST(CamIn, GoesOverToARelativeCamWithoutLosingTheWay) {
  // 2a: CAM1 not periodic stays at 360 (point 2b of the figure), CAM2 relative begins there.
  TwoCams cams(false, false, 360, 0);
  double last = 0;
  int changes = 0;
  for (int i = 0; i < 700; ++i) {
    const bool change = cams.cycle(500);
    changes += change;
    const double slave = cams.scene->rig.axis.fSetPosition;
    if (change) {
      const double x = cams.scene->master.ref.fSetPosition;
      EXPECT_DOUBLE_EQ(cams.atEnd, 360);
      EXPECT_NEAR(slave, 360 + static_cast<double>(cams.second.at(x).y), 1e-9) << "point 3";
      ASSERT_LT(x, 1.0);
    }
    ASSERT_NEAR(slave - last, 500 * kCamCycle, 3 * kCamCycle * 500) << i;
    last = slave;
  }
  EXPECT_EQ(changes, 1);
}

TEST(CamIn, ARelativeCamAfterAPeriodicOneBeginsWhereThatHasGoneOn) {
  // 2a, the other way: CAM1 periodic has begun again (point 2a); CAM2 is shifted by that.
  TwoCams cams(true, false, 360, 0);
  for (int i = 0; i < 700; ++i) {
    if (!cams.cycle(500))
      continue;
    const double x = cams.scene->master.ref.fSetPosition;
    const double again = 360 + static_cast<double>(cams.first.at(x).y);
    EXPECT_NEAR(cams.atEnd, again, 1e-9);
    EXPECT_NEAR(cams.scene->rig.axis.fSetPosition, again + static_cast<double>(cams.second.at(x).y),
                1e-9);
    return;
  }
  FAIL() << "no change";
}

TEST(CamIn, GoesOverToAnAbsoluteCamIfThePeriodsFit) {
  // 2b: periods 360/360; periodic or not does not matter.
  for (const bool periodic : {false, true}) {
    TwoCams cams(periodic, true, 360, 360);
    double last = 0;
    int changes = 0;
    for (int i = 0; i < 700; ++i) {
      const bool change = cams.cycle(500);
      changes += change;
      const double slave = cams.scene->rig.axis.fSetPosition;
      double way = slave - last;
      way -= 360 * std::round(way / 360);
      ASSERT_NEAR(way, 500 * kCamCycle, 3 * 500 * kCamCycle) << i;
      if (change) {
        EXPECT_NEAR(slave,
                    static_cast<double>(cams.second.at(cams.scene->master.ref.fSetPosition).y),
                    1e-9);
      }
      last = slave;
    }
    EXPECT_EQ(changes, 1);
  }
}

TEST(CamIn, NeedsASlaveOffsetIfTheSlavesPeriodIsAnother) {
  // 2b: the slave's period is 270, so it stands at 90; with SlaveOffset 90 nothing jumps.
  for (const double offset : {0.0, 90.0}) {
    TwoCams cams(false, true, 360, 270);
    double last = 0;
    for (int i = 0; i < 700; ++i) {
      const bool change = cams.cycle(500, offset);
      const double slave = cams.scene->rig.axis.fSetPosition;
      double way = slave - last;
      way -= 270 * std::round(way / 270);
      if (change) {
        EXPECT_NEAR(cams.atEnd, 90, 1e-9);
        const double jump = offset - 90;
        EXPECT_NEAR(way, jump + 500 * kCamCycle, 3 * 500 * kCamCycle);
      } else {
        ASSERT_NEAR(way, 500 * kCamCycle, 3 * 500 * kCamCycle) << i;
      }
      last = slave;
    }
  }
}

TEST(CamIn, GoesOverByItselfWhereTheCamEnds) {
  // Another CamTableID while it runs: from the end of the running cam on, exactly.
  for (const bool slaveAbsolute : {false, true}) {
    TwoCams cams(true, slaveAbsolute, 360, 360);
    cams.scene->camIn.CamTableID = cams.scene->select.CamTableID;
    go(*cams.scene, 500);
    cams.scene->camIn.CamTableID = cams.select.CamTableID;
    int ends = 0;
    for (int i = 0; i < 900; ++i) {
      go(*cams.scene, 500);
      const double x = cams.scene->master.ref.fSetPosition;
      ends += cams.scene->camIn.EndOfProfile;
      const ModelCam &cam = ends > 0 ? cams.second : cams.first;
      const double y = static_cast<double>(cam.at(x).y); // both periods: whole turns
      ASSERT_NEAR(static_cast<double>(cams.scene->offFrom(y)), 0, 1e-9) << i << " " << ends;
      ASSERT_TRUE(cams.scene->camIn.InSync);
    }
    EXPECT_EQ(ends, 2);
  }
}

} // namespace
