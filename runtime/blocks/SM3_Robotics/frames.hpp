// The coordinate systems of a group, and its arm for the time of a call.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_FRAMES_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_FRAMES_HPP

#include "runtime/blocks/SM3_Robotics/group.hpp"
#include "runtime/blocks/SM3_Transformation/kinematics_of.hpp"

namespace stride::robotics {

/// Which place in the arrays of a group's motion its axis number `i` has.
inline int32_t placeOf(const GroupRef &group, int32_t i) noexcept {
  return i < group.uiJoints ? i : kArmAxes + i - group.uiJoints;
}

/// The arm of a group with the limits of its axes and the tool.
class GroupArm {
public:
  GroupArm(Ctx &ctx, const GroupRef &group);
  GroupArm(const GroupArm &) = delete;
  GroupArm &operator=(const GroupArm &) = delete;

  /// Another tool in place of the present one.
  void setTool(const Tool &tool);

  /// Whether its kinematics is plain data, or there is none: a program's own one is not.
  bool isPlain() const noexcept;
  /// Its kinematics as plain data, which nobody asks where there is none.
  const kinematics::AnyKinematics &plainKinematics() const noexcept;

private:
  kinematics::KinematicsOf kinematics_;
  kinematics::AnyKinematics none_; ///< Where there is no kinematics: it is not asked for anything.
  group::AxisLimits limits_[kAxes];

public:
  kinematics::Outcome outcome; ///< Whether the tool can lead.
  group::Arm arm;              ///< It lives as long as this object.
};

/// Which of the axes of a disabled group are those of its kinematics: they may change in each call.
void countJoints(Ctx &ctx, GroupRef &group);

/// Why it is not known where the tool is, or 0: an SMC_ERROR. A disabled group may have other axes
/// than its kinematics.
int16_t whyNoTool(const GroupRef &group, const GroupArm &arm) noexcept;

/// The tool of movements that are commanded now.
inline Tool toolOf(const GroupRef &group) noexcept { return {group.stTool, group.bTool != 0}; }

/// Whether a pose is one of numbers: an input may be NaN or infinite.
bool isFinite(const ::st::SM3_Robotics::MC_COORD_REF &pose) noexcept;
bool isFinite(const double (&numbers)[kArmAxes]) noexcept;

/// A pose as ST has it, by X, Y, Z and the angles A, B, C; and a tool in its flange.
kinematics::Frame<double> frameOf(const double (&pose)[kArmAxes]);
kinematics::Frame<double> frameOf(const ::st::SM3_Robotics::MC_COORD_REF &pose);
kinematics::Frame<double> frameOf(const Tool &tool);
void toPose(const kinematics::Frame<double> &frame, double (&pose)[kArmAxes]);

/// Where a coordinate system stands in the machine: WCS, PCS_1, PCS_2, MCS. False: it is none of
/// these.
bool systemInMachine(const GroupRef &group, int16_t system, kinematics::Frame<double> &frame);

/// Likewise, and TCS, by the set positions of the axes. An SMC_ERROR.
int16_t originOf(const GroupRef &group, const GroupArm &arm, int16_t system,
                 kinematics::Frame<double> &origin);

/// Which of the systems that can be set is meant, 0 to 2; -1: none of them.
int32_t settableSystem(int16_t system) noexcept;

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_FRAMES_HPP
