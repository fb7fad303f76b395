// MC_HaltSuperImposed: brakes what is on top of another motion.
#include "runtime/axis/superimposed.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_PLCopen/MC_HaltSuperImposed.h"

namespace {

namespace axis = ::stride::axis;
namespace exact = ::stride::exact;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_HaltSuperImposed;

void start(Block &block, motion::AxisRef &ref) noexcept {
  auto &added = block.stAdded;
  if (!exact::isPositive(block.Deceleration) || !exact::isfinite(block.Jerk) || block.Jerk < 0.0) {
    motion::fail(block.stBlock, &ref, axis::error::kSuperimposedValues);
    return;
  }
  if (!motion::isAdding(ref)) {
    motion::finish(block.stBlock);
    return;
  }
  added.bHalt = 1;
  added.stCommand.fDeceleration = block.Deceleration;
  added.stCommand.fJerk = block.Jerk;
  int16_t problem = motion::refusal(ref);
  if (problem == axis::error::kNone && !motion::beginAdding(added, block.stBlock, ref))
    problem = axis::error::kSuperimposedValues;
  if (problem != axis::error::kNone)
    motion::fail(block.stBlock, &ref, problem);
}

} // namespace

void st::SM_PLCopen::MC_HaltSuperImposed::body__(::stride::Ctx & /*ctx__*/) {
  motion::runAdding(*this, start);
}
