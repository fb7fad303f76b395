// SMC_AvoidLoop.
#include "runtime/blocks/SM_CNC/stream_block.hpp"
#include "runtime/numeric/cnc/processors/avoid_loop.hpp"

#include "st/SM_CNC/SMC_AL_STATUS.h"
#include "st/SM_CNC/SMC_AvoidLoop.h"

void st::SM_CNC::SMC_AvoidLoop::body__(::stride::Ctx & /*ctx__*/) {
  namespace cnc = ::stride::cnc;
  cnc::runProcessor<cnc::LoopAvoider>(*this);
  const bool isOn = bBusy != 0 && cnc::processorOf<cnc::LoopAvoider>(*this).on;
  iStatus = bDone != 0 ? SMC_AL_STATUS__AL_END
            : isOn     ? SMC_AL_STATUS__AL_ON
                       : SMC_AL_STATUS__AL_OFF;
}
