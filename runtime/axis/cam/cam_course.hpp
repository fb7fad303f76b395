// From a master's position to a slave's by a cam: what MC_CamIn and SMC_GetCamSlaveSetPosition have
// in common. Manual, section 4.6.1.
#ifndef STRIDE_RUNTIME_AXIS_CAM_CAM_COURSE_HPP
#define STRIDE_RUNTIME_AXIS_CAM_CAM_COURSE_HPP

#include "runtime/axis/cam/cam_ref.hpp"
#include "runtime/axis/master.hpp"
#include "runtime/numeric/motion_state.hpp"

#include "st/SM_PLCopen/MC_CAM_ID.h"
#include "st/SM_PLCopen/SMC_CAM_STATE.h"

namespace stride::motion {

using CamId = ::st::SM_PLCopen::MC_CAM_ID;
using CamCommand = ::st::SM_PLCopen::SMC_CAM_COMMAND;
using CamState = ::st::SM_PLCopen::SMC_CAM_STATE;

/// Where a cam has the slave.
struct CamTarget {
  cam::Place place;           ///< Of the master in the cam.
  bool outside;               ///< Outside of a cam that is not periodic.
  double local;               ///< Slave position without whole periods and shifts, scaled. [u]
  double rise;                ///< Of one period, scaled; 0 unless needed. [u]
  double velocity;            ///< Of the master in the cam. [master u/s]
  double acceleration;        ///< Of the master in the cam. [master u/s^2]
  numeric::MotionState state; ///< Of the slave; the position as it shows it.
};

/// From what a cam begins.
struct CamStart {
  double masterZero; ///< Where the master was; there is place 0 if it is not MasterAbsolute. [u]
  double slaveBase;  ///< What a relative cam is shifted by. [u]
  bool relative;     ///< The slave's positions are relative.
};

/// What is wrong with offsets and scalings (628), or kNone.
int16_t checkCamInputs(const CamCommand &command) noexcept;

/// The curve of the selected cam: an SMC_ERROR if none is selected (625) or it is none (750). Does
/// not look at all of its data, which MC_CamTableSelect has done.
int16_t openCam(const CamId &id, cam::Curve &curve) noexcept;

/// Sets up the cam that state.stCommand names, with the master where it is now. SMC_ERROR 626 if
/// it was outside of the cam at the start.
int16_t enterCam(CamState &state, const cam::Curve &curve, const CamStart &start,
                 const MasterMotion &master) noexcept;

/// The master's place in the cam.
cam::Place placeInCam(const CamState &state, const cam::Curve &curve,
                      const MasterMotion &master) noexcept;

/// Where the cam has the slave now. False if that is no number.
bool evaluateCam(CamState &state, const cam::Curve &curve, const MasterMotion &master,
                 const axis::AxisRef &slave, CamTarget &target) noexcept;

/// The slave's position, as it shows it: `periods` after the first one, at `local` in it.
double slavePosition(const CamState &state, const axis::AxisRef &slave, int64_t periods,
                     double rise, double local) noexcept;

} // namespace stride::motion

#endif
