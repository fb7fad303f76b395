// From a master's position to a slave's by a cam: what MC_CamIn and SMC_GetCamSlaveSetPosition have
// in common. Manual, section 4.6.1.
#ifndef STRIDE_RUNTIME_MOTION_BLOCKS_CAM_COURSE_HPP
#define STRIDE_RUNTIME_MOTION_BLOCKS_CAM_COURSE_HPP

#include "runtime/axis/motion_state.hpp"
#include "runtime/cam/cam_ref.hpp"
#include "runtime/motion/blocks/master.hpp"

#include "st/SM_PLCopen/MC_CAM_ID.h"
#include "st/SM_PLCopen/SMC_CAM_STATE.h"

namespace stride::motion {

using CamId = ::st::SM_PLCopen::MC_CAM_ID;
using CamState = ::st::SM_PLCopen::SMC_CAM_STATE;

/// Offsets and scalings as the blocks' inputs give them.
struct CamInputs {
  double masterOffset;
  double slaveOffset;
  double masterScaling;
  double slaveScaling;
};

/// Where a cam would have the slave.
struct CamTarget {
  cam::Place place;        ///< Of the master in the cam.
  bool outside;            ///< Outside of a cam that is not periodic.
  double local;            ///< Slave position without whole periods and shifts, scaled. [u]
  double rise;             ///< Of one period, scaled; 0 unless needed. [u]
  axis::MotionState state; ///< Position as the slave shows it, velocity, acceleration.
};

/// The curve of the selected cam: an SMC_ERROR if none is selected (625) or it is none (750). Does
/// not look at all of its data, which MC_CamTableSelect has done.
int16_t openCam(const CamId &id, cam::Curve &curve) noexcept;

/// The master's place in the cam that `state` has been set up for.
cam::Place placeInCam(const CamState &state, const cam::Curve &curve,
                      const MasterMotion &master) noexcept;

/// From what a cam begins.
struct CamStart {
  double masterZero; ///< Where the cam's place 0 is if it is not MasterAbsolute. [u]
  double slaveBase;  ///< What a relative cam is shifted by. [u]
  bool relative;     ///< The slave's positions are relative.
};

/// Sets a cam up from where the master is; `state.stCam` names it. An SMC_ERROR if a scaling is 0
/// or an input no number (628), or the master is outside of a cam that is not periodic (626).
int16_t enterCam(CamState &state, const cam::Curve &curve, const CamInputs &inputs,
                 const CamStart &start, const MasterMotion &master) noexcept;

/// Where the cam has the slave now. False if that is no number.
bool evaluateCam(CamState &state, const cam::Curve &curve, const MasterMotion &master,
                 const axis::AxisRef &slave, CamTarget &target) noexcept;

} // namespace stride::motion

#endif
