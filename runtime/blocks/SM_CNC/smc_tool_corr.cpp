// SMC_ToolCorr and SMC_ToolRadiusCorr.
#include "runtime/blocks/SM_CNC/stream_block.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"

#include "st/SM_CNC/SMC_TC_STATUS.h"
#include "st/SM_CNC/SMC_ToolCorr.h"
#include "st/SM_CNC/SMC_ToolRadiusCorr.h"

namespace {

namespace cnc = ::stride::cnc;
namespace decl = ::st::SM_CNC;

/// The body of both.
template <class Block> void correctTool(Block &block, cnc::ToolEntry entry) noexcept {
  cnc::processorOf<cnc::ToolCorrection>(block).rules = {block.dToolRadius, 0.0, entry};
  cnc::runProcessor<cnc::ToolCorrection>(block);
}

} // namespace

void decl::SMC_ToolCorr::body__(::stride::Ctx & /*ctx__*/) {
  correctTool(*this, cnc::ToolEntry::Positioning);
  const cnc::ToolSide side = cnc::sideOf(cnc::processorOf<cnc::ToolCorrection>(*this));
  iStatus = bDone != 0                     ? SMC_TC_STATUS__TC_END
            : bBusy == 0                   ? SMC_TC_STATUS__TC_ORIG
            : side == cnc::ToolSide::Left  ? SMC_TC_STATUS__TC_LEFT
            : side == cnc::ToolSide::Right ? SMC_TC_STATUS__TC_RIGHT
                                           : SMC_TC_STATUS__TC_ORIG;
}

void decl::SMC_ToolRadiusCorr::body__(::stride::Ctx & /*ctx__*/) {
  correctTool(*this, cnc::ToolEntry::Ramp);
}
