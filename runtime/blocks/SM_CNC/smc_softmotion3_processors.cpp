// SMC_ObjectSplitter, SMC_ExtendedVelocityChecks, SMC_SmoothMerge.
#include "runtime/blocks/SM_CNC/stream_block.hpp"
#include "runtime/numeric/cnc/processors/axis_limits.hpp"
#include "runtime/numeric/cnc/processors/merge_path.hpp"
#include "runtime/numeric/cnc/processors/object_splitter.hpp"

#include "st/SM_CNC/SMC_ExtendedVelocityChecks.h"
#include "st/SM_CNC/SMC_OBJECTSPLITTERMODE.h"
#include "st/SM_CNC/SMC_ObjectSplitter.h"
#include "st/SM_CNC/SMC_SmoothMerge.h"

namespace cnc = stride::cnc;

void st::SM_CNC::SMC_ObjectSplitter::body__(::stride::Ctx & /*ctx__*/) {
  cnc::ObjectSplitter &splitter = cnc::processorOf<cnc::ObjectSplitter>(*this);
  splitter.parameter = dSplittingParameter;
  splitter.byLength = eMode == SMC_OBJECTSPLITTERMODE__LENGTH;
  cnc::runProcessor<cnc::ObjectSplitter>(*this);
}

void st::SM_CNC::SMC_ExtendedVelocityChecks::body__(::stride::Ctx & /*ctx__*/) {
  cnc::runProcessor<cnc::LimitByAxes>(*this);
}

void st::SM_CNC::SMC_SmoothMerge::body__(::stride::Ctx & /*ctx__*/) {
  constexpr uint32_t kMostBit = 31;
  cnc::MergePath &path = cnc::processorOf<cnc::MergePath>(*this);
  // A bit that cannot be is refused as a tolerance that cannot be.
  path.tolerance = wFeatureBit <= kMostBit ? dMaxDeviation : -1.0;
  path.features = wFeatureBit == 0 || wFeatureBit > kMostBit ? 0 : 1U << wFeatureBit;
  cnc::runProcessor<cnc::MergePath>(*this);
}
