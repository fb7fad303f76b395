// MC_CamTableSelect: chooses a cam; SMC_GetCamSlaveSetPosition: where it would have the slave.
#include "runtime/axis/cam/cam_entry.hpp"

#include "st/SM_PLCopen/MC_CamTableSelect.h"
#include "st/SM_PLCopen/SMC_GetCamSlaveSetPosition.h"

namespace {

namespace axis = ::stride::axis;
namespace cam = ::stride::cam;
namespace motion = ::stride::motion;
using Query = ::st::SM_PLCopen::SMC_GetCamSlaveSetPosition;
using axis::AxisRef;

/// An SMC_ERROR; `start` changes only if there is none.
int16_t findStart(const Query &query, const motion::CamId &id, AxisRef &master,
                  const AxisRef &slave, stride::numeric::MotionState &start) noexcept {
  motion::CamState state{};
  auto &command = state.stCommand;
  command.stCam = id;
  command.fMasterOffset = query.MasterOffset;
  command.fSlaveOffset = query.SlaveOffset;
  command.fMasterScaling = query.MasterScaling;
  command.fSlaveScaling = query.SlaveScaling;
  cam::Curve curve;
  motion::CamTarget target;
  if (const int16_t error = motion::startCam(state, curve, slave, master, target);
      error != axis::error::kNone)
    return error;
  start = target.state;
  return axis::error::kNone;
}

} // namespace

void st::SM_PLCopen::MC_CamTableSelect::body__(::stride::Ctx & /*ctx__*/) {
  const bool rising = Execute != 0 && bExecuteOld == 0;
  bExecuteOld = Execute;
  if (rising) {
    ErrorID = CamTable == nullptr ? int16_t{::st::SM_Error::SMC_ERROR__SMC_NO_CAM_REF_TYPE}
                                  : cam::checkCam(*CamTable);
    Error = ErrorID != axis::error::kNone;
    Done = Error == 0;
    CamTableID.pCam = Done != 0 ? CamTable : nullptr;
    CamTableID.Periodic = Periodic;
    CamTableID.MasterAbsolute = MasterAbsolute;
    CamTableID.SlaveAbsolute = SlaveAbsolute;
  } else if (Execute == 0) {
    Done = 0;
    Error = 0;
    ErrorID = axis::error::kNone;
  }
  Busy = 0;
}

void st::SM_PLCopen::SMC_GetCamSlaveSetPosition::body__(::stride::Ctx & /*ctx__*/) {
  ErrorID = axis::error::kNone;
  if (Enable != 0) {
    stride::numeric::MotionState start{fStartPosition, fStartVelocity, fStartAcceleration};
    ErrorID = Master == nullptr || Slave == nullptr || CamTableID == nullptr
                  ? axis::error::kNoAxis
                  : findStart(*this, *CamTableID, *Master, *Slave, start);
    fStartPosition = start.position;
    fStartVelocity = start.velocity;
    fStartAcceleration = start.acceleration;
  }
  Error = ErrorID != axis::error::kNone;
}
