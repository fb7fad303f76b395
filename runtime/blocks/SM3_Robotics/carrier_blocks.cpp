// MC_TrackConveyorBelt, MC_TrackRotaryTable, MC_SetDynCoordTransform.
#include "runtime/axis/axis_ref.hpp"
#include "runtime/blocks/SM3_Robotics/carriers.hpp"
#include "runtime/blocks/SM3_Robotics/group_block.hpp"

#include "st/SM3_Robotics/MC_SetDynCoordTransform.h"
#include "st/SM3_Robotics/MC_TrackConveyorBelt.h"
#include "st/SM3_Robotics/MC_TrackRotaryTable.h"

namespace {

namespace robotics = ::stride::robotics;
namespace decl = ::st::SM3_Robotics;

template <class Block> void showUse(Block &block) noexcept {
  block.InUse =
      block.AxisGroup != nullptr && robotics::isInUse(*block.AxisGroup, block.CoordSystem) ? 1 : 0;
}

template <class Block>
void run(::stride::Ctx &ctx, Block &block, ::stride::axis::AxisRef *axis,
         const decl::MC_COORD_REF &origin, bool table) {
  robotics::runOnce(ctx, block, [&](robotics::GroupRef &group) {
    decl::SMC_GROUP_CARRIER carrier{};
    carrier.pAxis = axis;
    carrier.bTable = table ? 1 : 0;
    carrier.bActual = axis != nullptr && axis->bRegulatorOn == 0 ? 1 : 0;
    carrier.stOrigin = origin;
    carrier.stObject = block.InitialObjectPosition;
    return robotics::setCarrier(group, block.CoordSystem, carrier);
  });
  showUse(block);
}

} // namespace

void decl::MC_TrackConveyorBelt::body__(::stride::Ctx &ctx__) {
  run(ctx__, *this, ConveyorBelt, ConveyorBeltOrigin, false);
}
void decl::MC_TrackRotaryTable::body__(::stride::Ctx &ctx__) {
  run(ctx__, *this, RotaryTable, RotaryTableOrigin, true);
}
void decl::MC_SetDynCoordTransform::body__(::stride::Ctx &ctx__) {
  robotics::runOnce(ctx__, *this, [&](robotics::GroupRef &group) {
    return robotics::setMaster(ctx__, group, CoordSystem, MasterAxisGroup, CoordTransform);
  });
  showUse(*this);
}
