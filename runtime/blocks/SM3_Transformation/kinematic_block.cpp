// What the blocks Kin_... have in common.
#include "runtime/blocks/SM3_Transformation/kinematics_of.hpp"
#include "runtime/blocks/kinematic_frames.hpp"

#include "st/SM3_Transformation/AXISPOS_REF.h"
#include "st/SM3_Transformation/CONFIGDATA.h"
#include "st/SM3_Transformation/KinematicBlock.h"

namespace kin = ::stride::kinematics;
using Block = ::st::SM3_Transformation::KinematicBlock;

namespace {

/// A block as it stands, with its axes' limits.
kin::Outcome kinematicsOf(Block &block, ::stride::Ctx &ctx, kin::AnyKinematics &kinematics,
                          int &hidden) {
  ::st::SM3_Transformation::KinematicParts parts{};
  block.Describe__call(ctx, parts);
  const kin::Outcome outcome = kin::join(parts, kinematics, hidden);
  if (outcome != kin::Outcome::Done)
    return outcome;
  for (int i = hidden; i < kinematics.joints(); ++i) {
    const auto &limits = block.aSettings.v[i - hidden].limits;
    kinematics.range[i] = {limits.xUnlimited == 0, limits.dLower, limits.dUpper};
  }
  return kinematics.check();
}

/// Positions of a block's axes as those of its kinematics: the hidden ones are 0.
void positionsOf(const ::st::SM3_Transformation::AXISPOS_REF &positions, int hidden,
                 double (&axes)[kin::kMostJoints]) {
  for (double &axis : axes)
    axis = 0;
  const double *from = &positions.a0;
  for (int i = hidden; i < kin::kMostJoints; ++i)
    axes[i] = from[i - hidden];
}

} // namespace

::stride::UDINT st::SM3_Transformation::KinematicBlock::NumAxes__get(::stride::Ctx &ctx__) {
  kin::AnyKinematics kinematics;
  int hidden = 0;
  (void)kinematicsOf(*this, ctx__, kinematics, hidden);
  return static_cast<::stride::UDINT>(kinematics.joints() - hidden);
}

::st::SM_Error::SMC_ERROR st::SM3_Transformation::KinematicBlock::AxesToCartesian(
    ::stride::Ctx &ctx__, ::st::SM3_Math::SMC_Frame &f, CONFIGDATA &cd, AXISPOS_REF &a) {
  kin::AnyKinematics kinematics;
  int hidden = 0;
  kin::Outcome outcome = kinematicsOf(*this, ctx__, kinematics, hidden);
  if (outcome != kin::Outcome::Done)
    return kin::errorOf(outcome);
  double axes[kin::kMostJoints];
  positionsOf(a, hidden, axes);
  kin::Frame<double> tool;
  outcome = kinematics.forward(axes, tool);
  if (outcome != kin::Outcome::Done)
    return kin::errorOf(outcome);
  kin::toSt(tool, f);
  const kin::Configuration configuration = kin::configurationOf(kinematics.postureOf(axes));
  __builtin_memcpy(&cd, &configuration, sizeof configuration);
  return kin::errorOf(outcome);
}

::st::SM_Error::SMC_ERROR
st::SM3_Transformation::KinematicBlock::CartesianToAxes(::stride::Ctx &ctx__, AXISPOS_REF &a,
                                                        ::st::SM3_Math::SMC_Frame &f,
                                                        AXISPOS_REF &aRef, CONFIGDATA &cd) {
  kin::AnyKinematics kinematics;
  int hidden = 0;
  kin::Outcome outcome = kinematicsOf(*this, ctx__, kinematics, hidden);
  if (outcome != kin::Outcome::Done)
    return kin::errorOf(outcome);
  double reference[kin::kMostJoints];
  positionsOf(aRef, hidden, reference);
  kin::Configuration configuration;
  __builtin_memcpy(&configuration, &cd, sizeof configuration);
  double axes[kin::kMostJoints];
  outcome = kinematics.inverse(kin::fromSt(f), kin::postureOf(configuration), reference, axes);
  for (int i = 0; outcome == kin::Outcome::Done && i < kinematics.joints(); ++i)
    if (!::stride::exact::isfinite(axes[i]))
      outcome = kin::Outcome::Unreachable; // the frame holds what is no number
  if (outcome == kin::Outcome::Done)
    for (int i = hidden; i < kinematics.joints(); ++i)
      (&a.a0)[i - hidden] = axes[i];
  return kin::errorOf(outcome);
}
