// For the sources of axis groups: whether the axes go along where the tool leads.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_TOOL_LED_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_TOOL_LED_HPP

#include "runtime/blocks/SM3_Robotics/requests.hpp"

namespace stride::robotics {

/// Whether axes bring the tool's point to a place: what a kinematics cannot choose it does not look
/// at.
bool reaches(const group::Arm &arm, const double *axes, const kinematics::Vector<double> &place);

/// Axes that bring the tool into a pose, as far as the kinematics chooses it; its place they reach
/// in any case. An SMC_ERROR.
int16_t axesFor(const group::Arm &arm, const kinematics::Frame<double> &pose,
                const kinematics::Configuration &configuration, const double *reference,
                double *axes);

/// Why the tool cannot lead from where the axes are, or 0: some machines have positions that their
/// kinematics never chooses, so that the axes would jump. An SMC_ERROR.
int16_t whyNotFrom(const group::Arm &arm, const double (&axes)[kAxes]);

/// The axes at the end of a leg, from ends.from on. It is looked at in `parts`: an axis may turn
/// far along it, and the tool has to be on it everywhere. An axis that would jump in a singular
/// pose is an error, too. An SMC_ERROR.
int16_t followLeg(const group::Arm &arm, const group::Leg &leg, int32_t parts, Ends &ends);

/// Sees to it that ends.to is where the axes come to at the end of a leg: whole turns may be
/// others. An SMC_ERROR if nothing else than turns is. See followLeg for `parts`.
int16_t settleLine(const group::Arm &arm, const group::Leg &leg, int32_t parts, Ends &ends);

/// Lets the tool axes of a leg go evenly from ends.from to ends.to, and settles it. `anyTurn`: they
/// may end whole turns away from ends.to, where their limits ask for that. An SMC_ERROR if the
/// kinematics has no such axes, or if the placing ones would have to pass a singular pose.
int16_t settleWithToolAxes(const group::Arm &arm, group::Leg &leg, int32_t parts, bool anyTurn,
                           Ends &ends);

/// The configuration that the axes keep along a leg on which the tool leads.
kinematics::Configuration configurationFor(const group::Arm &arm, const group::Leg &leg,
                                           const double *axes);

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_TOOL_LED_HPP
