// MC_MoveSuperImposed: a distance on top of another motion.
#include "runtime/axis/superimposed.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_PLCopen/MC_MoveSuperImposed.h"

namespace {

namespace axis = ::stride::axis;
namespace motion = ::stride::motion;
using Block = ::st::SM_PLCopen::MC_MoveSuperImposed;

void start(Block &block, motion::AxisRef &ref) noexcept {
  auto &command = block.stAdded.stCommand;
  int16_t problem = motion::refusal(ref);
  if (problem == axis::error::kNone && ref.iOwner == 0 && ref.stPlanner.bActive != 0)
    problem = axis::error::kNotReady; // it is still braked by itself
  // The way of a superimposed motion that has ended stays; one that runs is taken over with its
  // velocity.
  command.fPosition = ref.stSuperimposed.fPosition + block.Distance;
  command.fVelocity = block.VelocityDiff;
  command.fAcceleration = block.Acceleration;
  command.fDeceleration = block.Deceleration;
  command.fJerk = block.Jerk;
  if (problem == axis::error::kNone && !(::stride::exact::isPositive(block.VelocityDiff) &&
                                         motion::beginAdding(block.stAdded, block.stBlock, ref)))
    problem = axis::error::kSuperimposedValues;
  if (problem != axis::error::kNone)
    motion::fail(block.stBlock, &ref, problem);
}

} // namespace

void st::SM_PLCopen::MC_MoveSuperImposed::body__(::stride::Ctx & /*ctx__*/) {
  motion::runAdding(*this, start);
}
