// SMC_SmoothPath and SMC_RoundPath.
#include "runtime/blocks/SM_CNC/stream_block.hpp"
#include "runtime/numeric/cnc/processors/corner_path.hpp"

#include "st/SM_CNC/SMC_RoundPath.h"
#include "st/SM_CNC/SMC_SMOOTHPATHMODE.h"
#include "st/SM_CNC/SMC_SmoothPath.h"

namespace {

namespace cnc = ::stride::cnc;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// What both blocks say in the same way.
template <class Processor, class Block>
void runCorners(Block &block, double distance, cnc::DistanceRule rule) noexcept {
  Processor &processor = cnc::processorOf<Processor>(block);
  processor.distance = distance;
  processor.leastTurn = block.dAngleTol * kDegree;
  processor.rule = block.bSoftMotion3 != 0 ? cnc::DistanceRule::CornerDistanceAdded : rule;
  processor.passesFunctions = block.bSoftMotion3 != 0;
  cnc::runProcessor<Processor>(block);
}

} // namespace

void st::SM_CNC::SMC_SmoothPath::body__(::stride::Ctx & /*ctx__*/) {
  cnc::SmoothPath &processor = cnc::processorOf<cnc::SmoothPath>(*this);
  processor.kind = eMode == SMC_SMOOTHPATHMODE__SP_SPLINE5_MIN_CURVATURE ? cnc::PieceKind::Quintic
                                                                         : cnc::PieceKind::Cubic;
  processor.symmetrical = bSymmetricalDistances != 0;
  runCorners<cnc::SmoothPath>(*this, dEdgeDistance, cnc::DistanceRule::ToolRadiusAdded);
}

void st::SM_CNC::SMC_RoundPath::body__(::stride::Ctx & /*ctx__*/) {
  cnc::RoundPath &processor = cnc::processorOf<cnc::RoundPath>(*this);
  processor.kind = cnc::PieceKind::Arc;
  runCorners<cnc::RoundPath>(*this, dRadius, cnc::DistanceRule::ToolRadiusElse);
}
