// SMC_LimitCircularVelocities, and SMC_LimitCircularVelocity, as SoftMotion 3 calls it.
#include "runtime/blocks/SM_CNC/stream_block.hpp"
#include "runtime/numeric/cnc/processors/limit_circular.hpp"

#include "st/SM_CNC/SMC_LimitCircularVelocities.h"
#include "st/SM_CNC/SMC_LimitCircularVelocity.h"

namespace {

namespace cnc = ::stride::cnc;

template <class Block> void runLimit(Block &block, double perRadius) noexcept {
  cnc::LimitCircular &limit = cnc::processorOf<cnc::LimitCircular>(block);
  limit.acceleration = block.dMaxAcc;
  limit.jump = block.dMaxAccJump;
  limit.perRadius = perRadius;
  cnc::runProcessor<cnc::LimitCircular>(block);
}

} // namespace

void st::SM_CNC::SMC_LimitCircularVelocities::body__(::stride::Ctx & /*ctx__*/) {
  runLimit(*this, dVmaxPerRadiusUnit);
}

void st::SM_CNC::SMC_LimitCircularVelocity::body__(::stride::Ctx & /*ctx__*/) {
  runLimit(*this, 0.0);
}
