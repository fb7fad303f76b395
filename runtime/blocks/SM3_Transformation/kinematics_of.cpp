#include "runtime/blocks/SM3_Transformation/kinematics_of.hpp"

#include "runtime/blocks/kinematic_frames.hpp"
#include "runtime/numeric/kinematics/jets_by_differences.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Transformation/AXISLIMITS.h"
#include "st/SM3_Transformation/AXISPOS_REF.h"
#include "st/SM3_Transformation/CONFIGDATA.h"
#include "st/SM3_Transformation/IKinematicParts.h"
#include "st/SM3_Transformation/MC_KIN_REF_SM3.h"

namespace stride::kinematics {
namespace {

namespace sm = ::st::SM3_Transformation;
namespace error = ::st::SM_Error;

static_assert(sizeof(sm::AXISPOS_REF) == kMostJoints * sizeof(double));
static_assert(sizeof(sm::CONFIGDATA) == kConfigurationBytes);
static_assert(sm::KinematicArm__BipodRotary == static_cast<int>(ArmKind::BipodRotary) &&
              sm::KinematicArm__Gantry2 == static_cast<int>(ArmKind::Gantry2) &&
              sm::KinematicArm__Gantry3 == static_cast<int>(ArmKind::Gantry3) &&
              sm::KinematicArm__BeltPortal == static_cast<int>(ArmKind::BeltPortal) &&
              sm::KinematicArm__Polar == static_cast<int>(ArmKind::Polar) &&
              sm::KinematicArm__PolarZ == static_cast<int>(ArmKind::PolarZ) &&
              sm::KinematicArm__Scara2Z == static_cast<int>(ArmKind::Scara2Z) &&
              sm::KinematicArm__Scara3Z == static_cast<int>(ArmKind::Scara3Z) &&
              sm::KinematicArm__ArmRrr == static_cast<int>(ArmKind::ArmRrr) &&
              sm::KinematicArm__Palletiser == static_cast<int>(ArmKind::Palletiser) &&
              sm::KinematicArm__OffsetWristArm == static_cast<int>(ArmKind::OffsetWristArm) &&
              sm::KinematicArm__FiveAxisTable == static_cast<int>(ArmKind::FiveAxisTable) &&
              sm::KinematicArm__TripodLinear == static_cast<int>(ArmKind::TripodLinear) &&
              sm::KinematicArm__TripodRotary == static_cast<int>(ArmKind::TripodRotary));
static_assert(sm::KinematicHand__TurningAxis == static_cast<int>(HandKind::TurningAxis) &&
              sm::KinematicHand__Wrist2 == static_cast<int>(HandKind::Wrist2) &&
              sm::KinematicHand__Wrist3 == static_cast<int>(HandKind::Wrist3));

/// What an error of a program's own kinematics means.
Outcome outcomeOf(error::SMC_ERROR number) noexcept {
  switch (number) {
  case error::SMC_ERROR__SMC_NO_ERROR:
    return Outcome::Done;
  case error::SMC_ERROR__SMC_TRAFO_INVALID_PARAMETERS:
    return Outcome::WrongMeasures;
  case error::SMC_ERROR__SMC_TRAFO_INVALID_COUPLING:
    return Outcome::WrongCoupling;
  case error::SMC_ERROR__SMC_TRAFO_TOOL_OFFSET_INCOMPATIBLE_WITH_KINEMATICS:
    return Outcome::WrongTool;
  case error::SMC_ERROR__SMC_TRAFO_INVALID_AXIS_LIMITS:
    return Outcome::WrongLimits;
  case error::SMC_ERROR__SMC_TRAFO_AXIS_LIMITS_EXCEEDED:
    return Outcome::OutOfLimits;
  case error::SMC_ERROR__SMC_TRAFO_NOT_INITIALIZED:
    return Outcome::NotSet;
  default:
    return Outcome::Unreachable;
  }
}

// ---- a kinematics that a program has written

using Own = KinematicsOf::Own;
const Own &own(const void *kinematics) { return *static_cast<const Own *>(kinematics); }

Outcome ownForward(const Own &its, const double *joints, Frame<double> &tool, sm::CONFIGDATA &cd) {
  sm::AXISPOS_REF positions{};
  __builtin_memcpy(&positions, joints, static_cast<size_t>(its.axes) * sizeof(double));
  ::st::SM3_Math::SMC_Frame frame{};
  const Outcome outcome =
      outcomeOf(sm::MC_KIN_REF_SM3__AxesToCartesian(*its.ctx, its.itf, frame, cd, positions));
  tool = fromSt(frame);
  if (its.hasTool)
    tool = tool * its.tool;
  return outcome;
}

Outcome ownInverse(const Own &its, const Frame<double> &tool, const Configuration &configuration,
                   const double *reference, double *joints) {
  ::st::SM3_Math::SMC_Frame frame{};
  toSt(its.hasTool ? tool * its.toolBack : tool, frame);
  sm::AXISPOS_REF near{};
  const size_t bytes = static_cast<size_t>(its.axes) * sizeof(double);
  __builtin_memcpy(&near, reference, bytes);
  sm::AXISPOS_REF positions = near;
  sm::CONFIGDATA cd{};
  __builtin_memcpy(&cd, &configuration, sizeof cd);
  const Outcome outcome =
      outcomeOf(sm::MC_KIN_REF_SM3__CartesianToAxes(*its.ctx, its.itf, positions, frame, near, cd));
  if (outcome == Outcome::Done)
    __builtin_memcpy(joints, &positions, bytes);
  return outcome;
}

/// A step after which numbers with these derivatives have changed by a hundredth of `scale`.
double stepFor(double first, double second, double third, double scale) {
  const double rate = first / scale;
  const double bend = ::stride::sqrt(second / scale);
  const double twist =
      third / scale; // below its cube root where it counts: a shorter step does no harm
  double fastest = rate > bend ? rate : bend;
  fastest = fastest > twist ? fastest : twist;
  return fastest > 0 ? 0.01 / fastest : 1.0;
}

Outcome ownForwardJets(const void *kinematics, const Jet<3> *joints, Frame<Jet<3>> &tool) {
  const Own &its = own(kinematics);
  double size[3] = {};
  for (int i = 0; i < its.axes; ++i)
    for (int k = 0; k < 3; ++k)
      size[k] += exact::fabs(joints[i].c[k + 1]);
  const auto evaluate = [&](double t, double *numbers) {
    double at[kMostJoints];
    for (int i = 0; i < its.axes; ++i)
      at[i] = valueAt(joints[i], t);
    Frame<double> frame;
    sm::CONFIGDATA cd{};
    const Outcome outcome = ownForward(its, at, frame, cd);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        numbers[3 * row + column] = frame.turn(row, column);
      numbers[9 + row] = frame.place(row);
    }
    return outcome;
  };
  Jet<3> numbers[kMostFrameNumbers];
  // Joints may turn: a radian bends.
  const Outcome outcome = jetsByDifferences(stepFor(size[0], size[1], size[2], 57.0),
                                            kMostFrameNumbers, evaluate, numbers);
  if (outcome != Outcome::Done)
    return outcome;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      tool.turn(row, column) = numbers[3 * row + column];
    tool.place(row) = numbers[9 + row];
  }
  return outcome;
}

Frame<double> frameAt(const Frame<Jet<3>> &way, double t) {
  Frame<double> frame;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      frame.turn(row, column) = valueAt(way.turn(row, column), t);
    frame.place(row) = valueAt(way.place(row), t);
  }
  return frame;
}

Outcome ownInverseJets(const void *kinematics, const Frame<Jet<3>> &tool,
                       const Configuration &configuration, const double *reference,
                       Jet<3> *joints) {
  const Own &its = own(kinematics);
  const Frame<double> start = frameAt(tool, 0);
  const double length = start.place.norm() > 1 ? start.place.norm() : 1.0;
  double size[3] = {};
  for (int k = 0; k < 3; ++k)
    for (int row = 0; row < 3; ++row) {
      size[k] += exact::fabs(tool.place(row).c[k + 1]) / length;
      for (int column = 0; column < 3; ++column)
        size[k] += exact::fabs(tool.turn(row, column).c[k + 1]);
    }
  double middle[kMostJoints] = {};
  const Outcome outcome = ownInverse(its, start, configuration, reference, middle);
  if (outcome != Outcome::Done)
    return outcome;
  const auto evaluate = [&](double t, double *numbers) {
    return ownInverse(its, frameAt(tool, t), configuration, middle, numbers);
  };
  const double step = stepFor(size[0], size[1], size[2], 1.0);
  const Outcome wide = jetsByDifferences(step, its.axes, evaluate, joints);
  // Near the end of its reach a shorter step may do.
  return wide == Outcome::Done ? wide : jetsByDifferences(0.01 * step, its.axes, evaluate, joints);
}

constexpr KinematicsTable makeOwnTable() {
  KinematicsTable table{};
  table.joints = [](const void *kinematics) { return own(kinematics).axes; };
  table.turning = [](const void *) { return 0U; };
  table.task = [](const void *kinematics) {
    constexpr Task kTasks[] = {Task::Plane,     Task::Plane,          Task::Plane, Task::Place,
                               Task::PlaceTurn, Task::PlaceDirection, Task::Full};
    return kTasks[own(kinematics).axes];
  };
  table.reach = [](const void *) { return 1.0; };
  table.check = [](const void *) { return Outcome::Done; };
  table.forward = [](const void *kinematics, const double *joints, Frame<double> &tool) {
    sm::CONFIGDATA cd{};
    return ownForward(own(kinematics), joints, tool, cd);
  };
  table.forwardJets = ownForwardJets;
  table.configurationOf = [](const void *kinematics, const double *joints) {
    sm::CONFIGDATA cd{};
    Frame<double> frame;
    (void)ownForward(own(kinematics), joints, frame, cd);
    Configuration configuration;
    __builtin_memcpy(&configuration, &cd, sizeof configuration);
    return configuration;
  };
  table.inverse = [](const void *kinematics, const Frame<double> &tool,
                     const Configuration &configuration, const double *reference, double *joints) {
    return ownInverse(own(kinematics), tool, configuration, reference, joints);
  };
  table.inverseJets = ownInverseJets;
  table.distanceFromSingular = [](const void *, const double *) { return 1.0; };
  table.splits = [](const void *, unsigned &) { return false; };
  return table;
}

constexpr KinematicsTable kOwnTable = makeOwnTable();

} // namespace

::st::SM_Error::SMC_ERROR errorOf(Outcome outcome) noexcept {
  switch (outcome) {
  case Outcome::Done:
    break;
  case Outcome::Unreachable:
    return error::SMC_ERROR__SMC_TRAFO_OUT_OF_WORKSPACE;
  case Outcome::WrongMeasures:
    return error::SMC_ERROR__SMC_TRAFO_INVALID_PARAMETERS;
  case Outcome::OutOfLimits:
    return error::SMC_ERROR__SMC_TRAFO_AXIS_LIMITS_EXCEEDED;
  case Outcome::WrongCoupling:
    return error::SMC_ERROR__SMC_TRAFO_INVALID_COUPLING;
  case Outcome::WrongTool:
    return error::SMC_ERROR__SMC_TRAFO_TOOL_OFFSET_INCOMPATIBLE_WITH_KINEMATICS;
  case Outcome::WrongLimits:
    return error::SMC_ERROR__SMC_TRAFO_INVALID_AXIS_LIMITS;
  case Outcome::NotSet:
    return error::SMC_ERROR__SMC_TRAFO_NOT_INITIALIZED;
  }
  return error::SMC_ERROR__SMC_NO_ERROR;
}

Outcome join(const sm::KinematicParts &parts, AnyKinematics &kinematics, int &hidden) {
  kinematics = {};
  hidden = 0;
  if (parts.bRefused != 0)
    return Outcome::WrongCoupling;
  kinematics.arm = static_cast<ArmKind>(parts.eArm);
  kinematics.hand = static_cast<HandKind>(parts.eHand);
  if (kinematics.arm == ArmKind::None && kinematics.hand != HandKind::None)
    kinematics.arm = ArmKind::Gantry3;
  if (kinematics.arm == ArmKind::None)
    return Outcome::NotSet;
  if (kinematics.joints() > kMostJoints) { // of blocks that programs derive from the library's
    kinematics = {};
    return Outcome::WrongCoupling;
  }
  const int armJoints = tableOf(kinematics.arm).joints;
  if (parts.eArm == sm::KinematicArm__NoPart)
    hidden = armJoints;
  __builtin_memcpy(kinematics.armMeasure, &parts.aArm, sizeof kinematics.armMeasure);
  __builtin_memcpy(kinematics.handMeasure, &parts.aHand, sizeof kinematics.handMeasure);
  for (int i = 0; i < kinematics.joints(); ++i)
    kinematics.offset[i] =
        i < armJoints ? parts.aArmOffset.v[i] : parts.aHandOffset.v[i - armJoints];
  return Outcome::Done;
}

KinematicsOf::KinematicsOf(Ctx &ctx, Interface itf)
    : outcome_(Outcome::NotSet), isOwn_(false), any_{}, own_{} {
  if (itf == nullptr)
    return;
  if (sm::IKinematicParts__is__(*itf)) {
    sm::KinematicParts parts{};
    sm::IKinematicParts__Describe(ctx, itf, parts);
    int hidden = 0;
    outcome_ = join(parts, any_, hidden);
    if (outcome_ == Outcome::Done && hidden > 0)
      outcome_ = Outcome::WrongCoupling; // it only turns
    for (int i = 0; outcome_ == Outcome::Done && i < any_.joints(); ++i) {
      const sm::AXISLIMITS limits = sm::IKinematicParts__LimitsOf(ctx, itf, static_cast<UDINT>(i));
      any_.range[i] = {limits.xUnlimited == 0, limits.dLower, limits.dUpper};
    }
    if (outcome_ == Outcome::Done)
      outcome_ = any_.check();
    return;
  }
  isOwn_ = true;
  own_.ctx = &ctx;
  own_.itf = itf;
  const UDINT axes = sm::MC_KIN_REF_SM3__NumAxes__get(ctx, itf);
  own_.axes = axes >= 1 && axes <= kMostJoints ? static_cast<int>(axes) : 0;
  outcome_ = own_.axes > 0 ? Outcome::Done : Outcome::WrongMeasures;
}

Outcome KinematicsOf::check() const { return outcome_; }

KinematicsRef KinematicsOf::ref() const {
  if (isOwn_)
    return {kOwnTable, &own_};
  return any_.ref();
}

void KinematicsOf::limit(int axis, const JointRange &range) {
  if (isOwn_)
    return;
  any_.range[axis] = range;
  if (outcome_ == Outcome::Done || outcome_ == Outcome::WrongLimits)
    outcome_ = any_.check();
}

Outcome KinematicsOf::setTool(const Frame<double> &tool) {
  if (outcome_ != Outcome::Done)
    return outcome_;
  if (isOwn_) {
    if (!exact::isfinite(tool.place.sum() + tool.turn.sum()))
      return Outcome::WrongTool;
    own_.hasTool = true;
    own_.tool = tool;
    own_.toolBack = inverted(tool);
    return Outcome::Done;
  }
  const AnyKinematics before = any_;
  any_.setTool(tool);
  const Outcome outcome = any_.check();
  if (outcome != Outcome::Done)
    any_ = before;
  return outcome;
}

} // namespace stride::kinematics
