// MC_CamIn through its life: what it refuses, who takes the slave from it, how it starts anew, what
// happens to its axes meanwhile. Expectations are those of the manual, sections 4.6 and 5.4.
#include "runtime/axis/axis_cycle.hpp"
#include "tests/unit/motion/cam_in_scene.hpp"

#include "st/SM_PLCopen/MC_MoveVelocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

namespace {

using namespace stride::test;
namespace error = stride::axis::error;
namespace state = stride::axis::state;
namespace pl = ::st::SM_PLCopen;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// ---------------------------------------------------------------- What it refuses

struct Refusal {
  const char *name;
  int error;
  void (*spoil)(CamScene &);
};

const Refusal kRefusals[] = {
    {"no cam selected", 625, [](CamScene &s) { s.camIn.CamTableID = fresh<pl::MC_CAM_ID>(); }},
    {"no MC_CAM_REF", 750, [](CamScene &s) { s.camRef.wCamStructID = 1; }},
    {"no data", 750, [](CamScene &s) { s.camRef.pce = nullptr; }},
    {"no points", 750, [](CamScene &s) { s.camRef.nElements = 0; }},
    {"no length", 750, [](CamScene &s) { s.camRef.xEnd = s.camRef.xStart; }},
    {"unknown form", 750, [](CamScene &s) { s.camRef.byType = 9; }},
    {"outside", 626,
     [](CamScene &s) {
       s.camIn.CamTableID.Periodic = 0;
       s.camIn.MasterOffset = 1000;
     }},
    {"relative outside", 626,
     [](CamScene &s) {
       s.camIn.CamTableID.Periodic = 0;
       s.camIn.CamTableID.MasterAbsolute = 0;
       s.camIn.MasterOffset = -1;
     }},
    {"MasterScaling 0", 628, [](CamScene &s) { s.camIn.MasterScaling = 0; }},
    {"SlaveScaling 0", 628, [](CamScene &s) { s.camIn.SlaveScaling = 0; }},
    {"MasterScaling NaN", 628, [](CamScene &s) { s.camIn.MasterScaling = kNan; }},
    {"SlaveScaling infinite", 628, [](CamScene &s) { s.camIn.SlaveScaling = kInf; }},
    {"MasterOffset NaN", 628, [](CamScene &s) { s.camIn.MasterOffset = kNan; }},
    {"SlaveOffset infinite", 628, [](CamScene &s) { s.camIn.SlaveOffset = -kInf; }},
    {"VelocityDiff 0", 627,
     [](CamScene &s) {
       s.camIn.StartMode = 2;
       s.camIn.VelocityDiff = 0;
     }},
    {"VelocityDiff negative", 627,
     [](CamScene &s) {
       s.camIn.StartMode = 3;
       s.camIn.VelocityDiff = -10;
     }},
    {"Acceleration 0", 627,
     [](CamScene &s) {
       s.camIn.StartMode = 4;
       s.camIn.Acceleration = 0;
     }},
    {"Deceleration NaN", 627,
     [](CamScene &s) {
       s.camIn.StartMode = 2;
       s.camIn.Deceleration = kNan;
     }},
    {"Acceleration infinite", 627,
     [](CamScene &s) {
       s.camIn.StartMode = 2;
       s.camIn.Acceleration = kInf;
     }},
    {"no jerk", 627,
     [](CamScene &s) {
       s.camIn.StartMode = 2;
       s.rig.axis.eRampType = 2;
     }},
    {"BufferMode above", 311, [](CamScene &s) { s.camIn.BufferMode = 6; }},
    {"BufferMode below", 311, [](CamScene &s) { s.camIn.BufferMode = -1; }},
    {"no slave", error::kNoAxis, [](CamScene &s) { s.camIn.Slave = nullptr; }},
    {"no master", error::kNoAxis, [](CamScene &s) { s.camIn.Master = nullptr; }},
    {"error stop", error::kNotReady,
     [](CamScene &s) { stride::axis::enterErrorStop(s.rig.axis, error::kDrive); }},
};

class CamRefusals : public testing::TestWithParam<Refusal> {};

TEST_P(CamRefusals, LeaveTheSlaveAlone) {
  auto scene = ready(line(360, 360), 360, 0, 10);
  scene->camIn.VelocityDiff = scene->camIn.Acceleration = scene->camIn.Deceleration = 100;
  scene->rig.idle();
  GetParam().spoil(*scene);
  go(*scene, 0);
  EXPECT_TRUE(scene->camIn.Error);
  EXPECT_EQ(scene->camIn.ErrorID, GetParam().error);
  EXPECT_FALSE(scene->camIn.Busy);
  EXPECT_FALSE(scene->camIn.Active);
  EXPECT_FALSE(scene->camIn.InSync);
  EXPECT_FALSE(scene->camIn.CommandAborted);
  EXPECT_EQ(scene->rig.axis.fSetPosition, 0);
  EXPECT_EQ(scene->rig.axis.iOwner, 0);
  go(*scene, 0);
  EXPECT_TRUE(scene->camIn.Error) << "as long as Execute";
  go(*scene, 0, false);
  EXPECT_FALSE(scene->camIn.Error);
  EXPECT_EQ(scene->camIn.ErrorID, 0);
}

INSTANTIATE_TEST_SUITE_P(CamIn, CamRefusals, testing::ValuesIn(kRefusals), [](const auto &info) {
  std::string name = info.param.name;
  for (char &c : name)
    if (c == ' ')
      c = '_';
  return name;
});

TEST(CamIn, NeedsPower) {
  CamScene scene(0, 0, line(10, 10));
  scene.rig.start();
  scene.prepare();
  scene.rig.power.bRegulatorOn = 0;
  scene.rig.idle(50);
  go(scene, 0);
  EXPECT_EQ(scene.camIn.ErrorID, error::kNotPowered);
}

TEST(CamIn, EndsWithThePowerOfTheSlave) {
  auto scene = ready(line(10, 10));
  for (int i = 0; i < 5; ++i)
    go(*scene, 1);
  scene->rig.power.bRegulatorOn = 0;
  for (int i = 0; i < 3; ++i)
    go(*scene, 1);
  EXPECT_EQ(scene->camIn.ErrorID, error::kNotPowered);
  EXPECT_FALSE(scene->camIn.Busy);
  EXPECT_FALSE(scene->camIn.InSync);
}

TEST(CamIn, BringsASlaveThatIsNotCalledForIntoErrorStop) {
  auto scene = ready(line(10, 10));
  for (int i = 0; i < 5; ++i)
    go(*scene, 1);
  scene->rig.idle();
  EXPECT_EQ(scene->rig.axis.nAxisState, state::kErrorStop);
  go(*scene, 1);
  EXPECT_EQ(scene->camIn.ErrorID, error::kNotCalled);
  EXPECT_FALSE(scene->camIn.InSync);
}

TEST(CamIn, NoticesThatAnAxisIsChanged) {
  auto scene = ready(line(10, 10));
  AxisRig other(kCamCycle);
  for (int i = 0; i < 5; ++i)
    go(*scene, 1);
  scene->camIn.Slave = &other.axis;
  go(*scene, 1);
  EXPECT_EQ(scene->camIn.ErrorID, error::kAxisChanged);
  EXPECT_FALSE(scene->camIn.Busy);
}

TEST(CamIn, LosesItsMasterAndBrakes) {
  auto scene = ready(line(10, 10));
  for (int i = 0; i < 5; ++i)
    go(*scene, 1);
  scene->camIn.Master = nullptr;
  go(*scene, 1);
  EXPECT_NE(scene->camIn.ErrorID, 0);
  for (int i = 0; i < 20; ++i)
    go(*scene, 1);
  EXPECT_TRUE(std::isfinite(scene->rig.axis.fSetPosition));
  EXPECT_EQ(scene->rig.axis.nAxisState, state::kErrorStop);
}

// ---------------------------------------------------------------- Nothing but numbers

TEST(CamIn, NeverWritesWhatIsNoNumber) {
  const double values[] = {0,      1,      -1,  kNan, kInf,  -kInf, 1e308, -1e308,
                           1e-308, 4e-324, 360, 1e17, -1e17, 0.1,   -0.0};
  const auto any = [&](Random &random) { return values[random.below(std::size(values))]; };
  int failures = 0;
  for (int i = 0; i < casesOf(20000) && !HasFailure(); ++i) {
    Random random(static_cast<uint64_t>(i));
    SCOPED_TRACE("seed " + std::to_string(i));
    const ModelCam cam = randomCam(random, true);
    CamScene scene(random.chance(0.5) ? 360 : 0, random.chance(0.5) ? 270 : 0, cam);
    ASSERT_GT(scene.rig.powerUp(), 0);
    scene.prepare();
    auto &camIn = scene.camIn;
    const auto spoil = [&](double &value) {
      if (random.chance(0.2))
        value = any(random);
    };
    camIn.VelocityDiff = camIn.Acceleration = camIn.Deceleration = 1000;
    camIn.StartMode = static_cast<int16_t>(random.below(7));
    for (double *value :
         {&camIn.MasterOffset, &camIn.MasterScaling, &camIn.SlaveOffset, &camIn.SlaveScaling,
          &camIn.VelocityDiff, &camIn.Acceleration, &camIn.Deceleration, &camIn.Jerk,
          &camIn.TappetHysteresis, &camIn.MasterStartDistance, &camIn.MasterSyncPosition})
      spoil(*value);
    camIn.CamTableID.Periodic = random.chance(0.5);
    scene.rig.axis.eRampType = static_cast<int16_t>(random.below(4));
    double velocity = 0;
    for (int cycle = 0; cycle < 20 && !HasFailure(); ++cycle)
      scene.rig.cycle([&] {
        if (cycle > 0 && random.chance(0.1))
          velocity = any(random);
        scene.master.step(1);
        scene.master.ref.fSetVelocity = velocity;
        if (random.chance(0.03))
          scene.master.ref.fSetPosition = any(random);
        if (random.chance(0.03))
          scene.master.ref.fPositionPeriod = any(random);
        if (cycle > 0 && random.chance(0.05))
          scene.cam.nodes[static_cast<size_t>(random.below(static_cast<int>(cam.nodes.size())))]
              .dY = any(random);
        if (cycle > 0 && random.chance(0.02))
          scene.cam.fill();
        if (random.chance(0.02))
          scene.camRef.nElements = static_cast<int16_t>(random.below(4) - 1);
        if (random.chance(0.02))
          scene.camRef.xEnd = any(random);
        scene.rig.call(camIn, true);
        const auto &axis = scene.rig.axis;
        ASSERT_TRUE(std::isfinite(axis.fSetPosition));
        ASSERT_TRUE(std::isfinite(axis.fSetVelocity));
        ASSERT_TRUE(std::isfinite(axis.fSetAcceleration));
        failures += camIn.Error;
      });
  }
  EXPECT_GT(failures, casesOf(20000));
}

// ---------------------------------------------------------------- While it runs

TEST(CamIn, RunsOnWithoutExecute) {
  auto scene = ready(line(360, 720));
  go(*scene, 100);
  for (int i = 0; i < 50; ++i) {
    go(*scene, 100, false);
    ASSERT_TRUE(scene->camIn.Busy);
    ASSERT_DOUBLE_EQ(scene->rig.axis.fSetPosition, 2 * scene->master.ref.fSetPosition);
  }
}

TEST(CamIn, ReadsItsInputsAtTheEdge) {
  auto scene = ready(line(360, 720));
  go(*scene, 100);
  scene->camIn.SlaveScaling = 5;
  scene->camIn.SlaveOffset = 3;
  scene->camIn.MasterScaling = 5;
  scene->camIn.MasterOffset = 7;
  go(*scene, 100);
  EXPECT_DOUBLE_EQ(scene->rig.axis.fSetPosition, 2 * scene->master.ref.fSetPosition);
  go(*scene, 100, false);
  go(*scene, 100);
  EXPECT_DOUBLE_EQ(scene->rig.axis.fSetPosition,
                   3 + 5 * 2 * (5 * scene->master.ref.fSetPosition + 7));
}

TEST(CamIn, AnotherEdgeForgetsWhatHasGoneBefore) {
  // 4.6.2: Offset1 and Offset2 are deleted; the original equation holds.
  auto scene = ready(line(100, 30), 360, 0, 50);
  scene->settings.periodic = true;
  for (int i = 0; i < 40; ++i) // 390 on: four passages
    go(*scene, i < 39 ? 5000 : 0);
  const double master = scene->master.ref.fSetPosition; // a turn and 80
  ASSERT_LT(master, 100);
  EXPECT_GT(scene->rig.axis.fSetPosition, 120);
  go(*scene, 0, false);
  go(*scene, 0);
  EXPECT_NEAR(scene->rig.axis.fSetPosition, 0.3 * master, 1e-9);
}

TEST(CamIn, APeriodicCamThatDoesNotHoldTheMastersPlaceDoesNotStart) {
  // 4.6.1, whether its place 0 is the axis's (MasterAbsolute) or where the master is.
  for (const bool absolute : {true, false}) {
    for (const double place : {-1e-6, 0.0, 60.0, 100.0, 100.0 + 1e-6}) {
      SCOPED_TRACE((absolute ? "absolute " : "relative ") + std::to_string(place));
      auto scene = ready(line(100, 30), 0, 0, absolute ? place : 777);
      scene->camIn.CamTableID.Periodic = 1;
      scene->camIn.CamTableID.MasterAbsolute = absolute;
      scene->camIn.MasterOffset = absolute ? 0 : place;
      go(*scene, 0);
      const bool inside = place >= 0 && place <= 100;
      EXPECT_EQ(scene->camIn.ErrorID, inside ? 0 : 626);
      EXPECT_NEAR(scene->rig.axis.fSetPosition, inside ? 0.3 * place : 0, 1e-12);
      EXPECT_EQ(scene->camIn.InSync != 0, inside);
    }
  }
}

TEST(CamIn, AHaltingMasterHoldsTheSlaveOnTheCam) {
  auto scene = ready(hill(360, 50), 360);
  for (int i = 0; i < 100; ++i)
    go(*scene, 300);
  for (int i = 0; i < 100; ++i)
    go(*scene, 0);
  EXPECT_TRUE(scene->camIn.InSync);
  EXPECT_TRUE(scene->camIn.Busy);
  EXPECT_EQ(scene->rig.axis.fSetVelocity, 0);
  EXPECT_EQ(scene->rig.axis.fSetAcceleration, 0);
  EXPECT_EQ(scene->rig.axis.nAxisState, state::kSynchronized);
  go(*scene, -300);
  EXPECT_TRUE(scene->camIn.InSync);
  EXPECT_LT(scene->rig.axis.fSetVelocity, 0);
}

TEST(CamIn, FollowsAMasterThatLosesItsPower) {
  auto scene = ready(line(360, 360), 360);
  for (int i = 0; i < 10; ++i)
    go(*scene, 300);
  scene->master.ref.bRegulatorOn = 0;
  scene->master.ref.nAxisState = state::kErrorStop;
  for (int i = 0; i < 10; ++i)
    go(*scene, 300 - 30 * i);
  EXPECT_TRUE(scene->camIn.InSync);
  EXPECT_DOUBLE_EQ(scene->rig.axis.fSetPosition, scene->master.ref.fActPosition);
}

/// What ends the motion of a master that is a drive.
enum class End { Stop, ErrorStop, PowerOff };

class RealMaster : public testing::TestWithParam<End> {};

TEST_P(RealMaster, IsFollowedUntilItStands) {
  // Rotary, 360; the cam has two periods in a turn.
  AxisRig masterRig(kCamCycle);
  masterRig.makeRotary(360);
  masterRig.axis.fSWMaxDeceleration = 500;
  ASSERT_GT(masterRig.powerUp(), 0);
  auto scene = ready(hill(180, 20));
  auto &camIn = scene->camIn;
  camIn.Master = &masterRig.axis;
  auto move = fresh<pl::MC_MoveVelocity>();
  move.Axis = &masterRig.axis;
  move.Velocity = 400;
  move.Acceleration = move.Deceleration = 1000;
  move.Direction = 1;
  auto stop = masterRig.stop(1000);
  double position = 0; // of the master as the slave sees it: in error stop it brakes after that
  const auto follow = [&] {
    const auto &master = masterRig.axis;
    position = master.bRegulatorOn != 0 ? master.fSetPosition : master.fActPosition;
    scene->rig.cycle([&] { scene->rig.call(camIn, true); });
  };
  const auto cycle = [&](bool ended) {
    masterRig.cycle([&] {
      masterRig.call(move, true);
      if (GetParam() == End::Stop)
        masterRig.call(stop, ended);
      follow();
    });
  };
  const auto check = [&] {
    const ModelPoint wanted = scene->cam.at(std::fmod(position, 180));
    ASSERT_NEAR(scene->rig.axis.fSetPosition, static_cast<double>(wanted.y), 1e-9);
    ASSERT_TRUE(camIn.InSync);
    ASSERT_EQ(scene->rig.axis.nAxisState, state::kSynchronized);
  };
  for (int i = 0; i < 1000; ++i) {
    cycle(false);
    check();
  }
  ASSERT_DOUBLE_EQ(masterRig.axis.fSetVelocity, 400);
  if (GetParam() == End::ErrorStop)
    masterRig.cycle([&] {
      stride::axis::enterErrorStop(masterRig.axis, error::kDrive);
      follow();
    });
  if (GetParam() == End::PowerOff)
    masterRig.power.bRegulatorOn = 0;
  for (int i = 0; i < 1000; ++i) {
    cycle(true);
    check();
  }
  EXPECT_EQ(scene->rig.axis.fSetVelocity, 0);
  EXPECT_NE(masterRig.axis.nAxisState, state::kContinuous);
}

INSTANTIATE_TEST_SUITE_P(CamIn, RealMaster,
                         testing::Values(End::Stop, End::ErrorStop, End::PowerOff),
                         [](const auto &info) {
                           return info.param == End::Stop        ? "Stop"
                                  : info.param == End::ErrorStop ? "ErrorStop"
                                                                 : "PowerOff";
                         });

TEST(CamIn, AShiftOfTheSlavesZeroPointIsNoMotion) {
  for (const double slavePeriod : {0.0, 360.0}) {
    SCOPED_TRACE(slavePeriod);
    auto scene = ready(hill(360, 50), 360, slavePeriod);
    auto twin = ready(hill(360, 50), 360, slavePeriod);
    auto set = fresh<pl::MC_SetPosition>();
    set.Axis = &scene->rig.axis;
    for (int i = 0; i < 400; ++i) {
      set.Position = i == 100 ? 77 : -500;
      set.Mode = i < 200;
      const bool before = i < 150;
      scene->rig.cycle([&] {
        scene->master.step(300);
        if (before)
          scene->rig.call(set, i == 100);
        scene->rig.call(scene->camIn, true);
        if (!before)
          scene->rig.call(set, i == 300);
      });
      go(*twin, 300);
      ASSERT_NEAR(static_cast<double>(scene->rig.axis.liSetIncrements),
                  static_cast<double>(twin->rig.axis.liSetIncrements), 1)
          << i;
      ASSERT_TRUE(scene->camIn.InSync);
      const double shift = scene->rig.axis.fSetPosition - twin->rig.axis.fSetPosition;
      const double wanted = i < 100 ? 0 : 77;
      if (i < 300 && slavePeriod == 0) {
        ASSERT_NEAR(shift, wanted, 1e-9) << i;
      }
      ASSERT_NEAR(scene->rig.axis.fSetVelocity, twin->rig.axis.fSetVelocity, 1e-9);
    }
  }
}

} // namespace
