// The kinematics behind an interface of ST: one of the library's, or one that a program has
// written.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_TRANSFORMATION_KINEMATICS_OF_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_TRANSFORMATION_KINEMATICS_OF_HPP

#include "runtime/numeric/kinematics/any_kinematics.hpp"

#include "st/SM3_Transformation/KinematicParts.h"
#include "st/SM_Error/SMC_ERROR.h"

namespace stride::kinematics {

/// As SMC_ERROR says it.
::st::SM_Error::SMC_ERROR errorOf(Outcome outcome) noexcept;

/// Parts in one: what turns without anything that places gets a portal under it, whose three joints
/// `hidden` counts. WrongCoupling where they are refused.
Outcome join(const ::st::SM3_Transformation::KinematicParts &parts, AnyKinematics &kinematics,
             int &hidden);

/// A kinematics for the time of a call, from what a state keeps: the interface.
class KinematicsOf {
public:
  /// `itf`: a TRAFO.MC_KIN_REF_SM3; may be 0.
  KinematicsOf(Ctx &ctx, Interface itf);
  KinematicsOf(const KinematicsOf &) = delete;
  KinematicsOf &operator=(const KinematicsOf &) = delete;

  /// NotSet where the interface is 0.
  [[nodiscard]] Outcome check() const;
  /// Only after `check` has said Done. It lives as long as this object.
  [[nodiscard]] KinematicsRef ref() const;

  /// The library's, as it looks now; null: it is a program's own, or there is none.
  [[nodiscard]] const AnyKinematics *plain() const noexcept {
    return isOwn_ || outcome_ == Outcome::NotSet ? nullptr : &any_;
  }

  /// Where an axis may stand, in place of what AxisSettings has told. Of a program's own kinematics
  /// nothing changes: it keeps within limits itself, or not.
  void limit(int axis, const JointRange &range);
  /// The frame of a tool in the flange's. WrongTool: it does not fit; the one before stays.
  Outcome setTool(const Frame<double> &tool);

  /// What only the table of a program's own kinematics uses.
  struct Own {
    Ctx *ctx;
    Interface itf;
    int axes;
    bool hasTool;
    Frame<double> tool;
    Frame<double> toolBack;
  };

private:
  Outcome outcome_;
  bool isOwn_;
  AnyKinematics any_;
  Own own_;
};

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_TRANSFORMATION_KINEMATICS_OF_HPP
