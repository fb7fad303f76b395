// MC_CamTableSelect: chooses a cam; SMC_GetCamSlaveSetPosition: where it would have the slave.
#include "runtime/motion/blocks/cam_course.hpp"

#include "st/SM_PLCopen/MC_CamTableSelect.h"
#include "st/SM_PLCopen/SMC_GetCamSlaveSetPosition.h"

namespace {

namespace axis = ::stride::axis;
namespace cam = ::stride::cam;
namespace motion = ::stride::motion;

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
    motion::CamState state{};
    cam::Curve curve;
    const motion::CamInputs inputs{MasterOffset, SlaveOffset, MasterScaling, SlaveScaling};
    if (Master == nullptr || Slave == nullptr || CamTableID == nullptr) {
      ErrorID = axis::error::kNoAxis;
    } else {
      state.stCam = *CamTableID;
      ErrorID = motion::openCam(state.stCam, curve);
    }
    if (ErrorID == axis::error::kNone) {
      const motion::MasterMotion master = motion::beginMaster(state.stMaster, *Master);
      state.stFollow.fFirstOffset = Slave->fOffsetPosition;
      ErrorID = motion::enterCam(
          state, curve, inputs,
          {cam::toDouble(master.position), Slave->fSetPosition, state.stCam.SlaveAbsolute == 0},
          master);
      motion::CamTarget target;
      if (ErrorID == axis::error::kNone &&
          !motion::evaluateCam(state, curve, master, *Slave, target))
        ErrorID = axis::error::kOutOfRange;
      if (ErrorID == axis::error::kNone)
        fStartPosition = target.state.position;
    }
  }
  Error = ErrorID != axis::error::kNone;
}
