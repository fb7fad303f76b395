// A kinematics of a program's own as a group sees it: its derivatives come from differences, the
// library's from formulas.
#include "runtime/blocks/SM3_Transformation/kinematics_of.hpp"
#include "runtime/blocks/kinematic_frames.hpp"
#include "runtime/numeric/kinematics/hands.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "runtime/app/ctx.h"

#include "st/SM3_Transformation/AXISPOS_REF.h"
#include "st/SM3_Transformation/CONFIGDATA.h"
#include "st/SM3_Transformation/MC_KIN_REF_SM3.h"

#include "tests/property/random_kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace {

using stride::kinematics::AnyKinematics;

/// What the program's block computes by.
AnyKinematics &programs() {
  static AnyKinematics kinematics{};
  return kinematics;
}

} // namespace

// In place of what a project's dispatch__.cpp holds.
namespace st::SM3_Transformation {

::st::SM_Error::SMC_ERROR MC_KIN_REF_SM3__AxesToCartesian(::stride::Ctx & /*ctx__*/,
                                                          ::stride::Interface /*self__*/,
                                                          ::st::SM3_Math::SMC_Frame &f,
                                                          CONFIGDATA &cd, AXISPOS_REF &a) {
  stride::kinematics::Frame<double> frame;
  const auto outcome = programs().forward(&a.a0, frame);
  stride::kinematics::toSt(frame, f);
  cd.abyData.v[0] = configurationOf(programs().postureOf(&a.a0)).bytes[0];
  return errorOf(outcome);
}

::st::SM_Error::SMC_ERROR MC_KIN_REF_SM3__CartesianToAxes(::stride::Ctx & /*ctx__*/,
                                                          ::stride::Interface /*self__*/,
                                                          AXISPOS_REF &a,
                                                          ::st::SM3_Math::SMC_Frame &f,
                                                          AXISPOS_REF &aRef, CONFIGDATA &cd) {
  stride::kinematics::Configuration configuration;
  std::memcpy(&configuration, &cd, sizeof configuration);
  return errorOf(programs().inverse(stride::kinematics::fromSt(f),
                                    stride::kinematics::postureOf(configuration), &aRef.a0, &a.a0));
}

::stride::UDINT MC_KIN_REF_SM3__NumAxes__get(::stride::Ctx & /*ctx__*/,
                                             ::stride::Interface /*self__*/) {
  return static_cast<::stride::UDINT>(programs().joints());
}

} // namespace st::SM3_Transformation

namespace stride::kinematics {
namespace {

TEST(OwnKinematics, MovesAsTheLibrarysDoes) {
  random::Random random;
  Ctx ctx{};
  UDINT type = 1; // of no block of the library
  for (int i = 0; i < 300 && !testing::Test::HasFailure(); ++i) {
    const auto arm = random::makeModel<ArticulatedArm>(random);
    programs() = {};
    programs().setArm(ArmKind::ArmRrr, arm.arm);
    programs().setHand(HandKind::Wrist3, arm.hand);
    const AnyKinematics library = programs();
    KinematicsOf own(ctx, &type);
    ASSERT_EQ(own.check(), Outcome::Done);
    ASSERT_EQ(own.ref().joints(), 6);
    EXPECT_EQ(own.ref().task(), Task::Full);
    Jet<3> axes[kMostJoints];
    double at[kMostJoints];
    for (int k = 0; k < kMostJoints; ++k) {
      at[k] = random.between(-150, 150);
      axes[k] = Jet<3>(at[k]);
      for (int order = 1; order <= 3; ++order)
        axes[k].c[order] = random.between(-20, 20);
    }
    const double singular = library.distanceFromSingular(at);
    if (singular < 0.03)
      continue;
    EXPECT_EQ(own.ref().configurationOf(at), library.ref().configurationOf(at));
    Frame<Jet<3>> wanted;
    Frame<Jet<3>> found;
    ASSERT_EQ(library.forward(axes, wanted), Outcome::Done);
    ASSERT_EQ(own.ref().forward(axes, found), Outcome::Done);
    for (int row = 0; row < 3; ++row)
      for (int order = 0; order <= 3; ++order) {
        EXPECT_NEAR(found.place(row).c[order], wanted.place(row).c[order], 1e-5);
        EXPECT_NEAR(found.turn(row, 1).c[order], wanted.turn(row, 1).c[order], 1e-5);
      }
    Jet<3> back[kMostJoints];
    ASSERT_EQ(own.ref().inverse(wanted, library.ref().configurationOf(at), at, back),
              Outcome::Done);
    for (int k = 0; k < kMostJoints; ++k)
      for (int order = 0; order <= 3; ++order)
        EXPECT_NEAR(back[k].c[order], axes[k].c[order], 1e-4 * std::pow(singular, -order)) << order;
  }
}

TEST(OwnKinematics, CarriesATool) {
  Ctx ctx{};
  UDINT type = 1;
  programs() = {};
  programs().setArm(ArmKind::Gantry3, Gantry3{});
  programs().setHand(HandKind::TurningAxis, TurningAxis{});
  KinematicsOf own(ctx, &type);
  ASSERT_EQ(own.setTool({turnFrom(Convention::Zyz, {30, 0, 0}), {1, 2, 3}}), Outcome::Done);
  const double axes[] = {10, 20, 30, 90};
  Frame<double> tool;
  ASSERT_EQ(own.ref().forward(axes, tool), Outcome::Done);
  EXPECT_NEAR(tool.place(0), 8, 1e-14); // a quarter turn leads (1, 2) to (-2, 1)
  EXPECT_NEAR(tool.place(1), 21, 1e-14);
  EXPECT_NEAR(tool.place(2), 33, 1e-14);
  double back[6];
  const double near[6] = {};
  ASSERT_EQ(own.ref().inverse(tool, {}, near, back), Outcome::Done);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(back[i], axes[i], 1e-12);
}

TEST(OwnKinematics, NothingIsNotSet) {
  Ctx ctx{};
  EXPECT_EQ(KinematicsOf(ctx, nullptr).check(), Outcome::NotSet);
}

} // namespace
} // namespace stride::kinematics
