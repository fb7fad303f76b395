// How a slave gets onto its cam without a jump: the ramp_in modes of MC_CamIn.StartMode.
#ifndef STRIDE_RUNTIME_AXIS_CAM_CAM_ENTRY_HPP
#define STRIDE_RUNTIME_AXIS_CAM_CAM_ENTRY_HPP

#include "runtime/axis/cam/cam_course.hpp"

namespace stride::motion {

/// SMC_CAM_STATE.byPhase.
enum class CamPhase : uint8_t {
  OnCam = 0,
  Compensating = 1, ///< A motion over time is added to the cam's.
  Waiting = 2,      ///< For the master to come near enough; the slave keeps its velocity.
  Approaching = 3,  ///< Over a way of the master.
};

inline CamPhase phaseOf(const CamState &state) noexcept {
  return static_cast<CamPhase>(state.byPhase);
}

/// The slave's set values at the end of this cycle if it went on as it does.
numeric::MotionState onwards(const axis::AxisRef &slave) noexcept;

/// Where another cam has ended, which this one goes on from.
struct CamJoint {
  double beyond; ///< How far the master is beyond it now. [master u]
  double slave;  ///< The slave's position there. [u]
};

/// Opens and sets up the cam of state.stCommand, from where master and slave are, or from `joint`,
/// and says where it has the slave. An SMC_ERROR.
int16_t startCam(CamState &state, cam::Curve &curve, const axis::AxisRef &slave,
                 axis::AxisRef &master, CamTarget &target,
                 const CamJoint *joint = nullptr) noexcept;

/// What is wrong with the start mode and its inputs, or with the hysteresis (627, 311), or kNone.
int16_t checkEntry(const axis::AxisRef &slave, const CamCommand &command) noexcept;

/// Begins the way onto the cam, where the slave should be at `target`. An SMC_ERROR.
int16_t beginEntry(CamState &state, const cam::Curve &curve, const axis::AxisRef &slave,
                   const CamTarget &target) noexcept;

/// One cycle on the way: the slave's set values, from those of the cam. On the cam they are the
/// cam's. An SMC_ERROR: the master turns round on the way (775).
int16_t stepEntry(CamState &state, const cam::Curve &curve, const axis::AxisRef &slave,
                  const CamTarget &target, numeric::MotionState &set) noexcept;

} // namespace stride::motion

#endif
