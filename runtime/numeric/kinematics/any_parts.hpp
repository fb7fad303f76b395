// For the sources of AnyKinematics: what they have in common.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_ANY_PARTS_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_ANY_PARTS_HPP

#include "runtime/numeric/kinematics/any_kinematics.hpp"

namespace stride::kinematics {

/// The tool's frame in that of the last joint.
inline Frame<double> toolOf(const AnyKinematics &kinematics) {
  Frame<double> tool;
  for (int row = 0; row < 3; ++row) {
    tool.place(row) = kinematics.toolPlace[row];
    for (int column = 0; column < 3; ++column)
      tool.turn(row, column) = kinematics.toolTurn[row][column];
  }
  return tool;
}

/// An angle of an axis, with the whole turns that bring it within its range; what is nearest to the
/// reference is nearest to the angle itself, which is within half a turn of it. A billionth beyond
/// a limit is rounding.
inline bool bringIntoRange(const JointRange &range, bool turns, double &angle) {
  if (!range.limited)
    return true;
  constexpr double kRounding = 1e-9;
  double placed = angle;
  if (turns && placed < range.lower - kRounding)
    placed += 360 * exact::ceil((range.lower - kRounding - placed) / 360);
  else if (turns && placed > range.upper + kRounding)
    placed -= 360 * exact::ceil((placed - range.upper - kRounding) / 360);
  if (!(placed >= range.lower - kRounding && placed <= range.upper + kRounding))
    return false;
  angle = placed < range.lower ? range.lower : (placed > range.upper ? range.upper : placed);
  return true;
}

/// How the frame of the last joint goes with the joints [rad].
inline Outcome ratesOf(const AnyKinematics &kinematics, const Jet<1> *joints, Frame<Jet<1>> &end) {
  const ArmTable &arm = tableOf(kinematics.arm);
  const Outcome outcome = arm.rates(kinematics.armMeasure, joints, end);
  if (kinematics.hand != HandKind::None)
    end = end * tableOf(kinematics.hand).rates(kinematics.handMeasure, joints + arm.joints);
  return outcome;
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_ANY_PARTS_HPP
