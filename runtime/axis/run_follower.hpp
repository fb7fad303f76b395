// One call of a block that couples an axis to a master: the rules of motion commands (edge, owner,
// buffer mode, outputs) for blocks that compute the set values by themselves.
#ifndef STRIDE_RUNTIME_AXIS_RUN_FOLLOWER_HPP
#define STRIDE_RUNTIME_AXIS_RUN_FOLLOWER_HPP

#include "runtime/axis/follow.hpp"
#include "runtime/axis/master.hpp"
#include "runtime/axis/motion_block.hpp"

namespace stride::motion {

/// What a call of a synchronized block has to do.
enum class Turn : uint8_t {
  None,  ///< Nothing: it does not run, waits for its turn, or has just ended.
  Begin, ///< The slave is the block's from now on: start from its set values (FollowState).
  Move,  ///< Go on.
};

/// Why the slave cannot be coupled to the master now, or kNone: there is no master, or it is the
/// slave itself (31), the slave takes no command (see refusal), or there is no such buffer mode
/// (311).
int16_t couplingRefusal(const AxisRef *master, const AxisRef &slave, int16_t bufferMode) noexcept;

/// The block does not wait in the queue any more.
void withdrawFollower(BlockState &block, AxisRef &slave) noexcept;

/// A rising edge whose inputs are good: takes the slave, or lets the block wait for the motion
/// before it. All modes of MC_BUFFER_MODE except Aborting mean Buffered. Begin or None.
Turn startFollower(BlockState &block, FollowState &follow, AxisRef &slave,
                   int16_t bufferMode) noexcept;

/// Any other call while the block runs. None: it waits, or has lost the slave.
Turn continueFollower(BlockState &block, FollowState &follow, AxisRef &slave) noexcept;

/// One call: at a rising edge of `execute` `check` returns what is wrong with the block's other
/// inputs, an SMC_ERROR. Another master while the
/// block runs is error 32. After Begin and Move, whoever has already moved the slave in this cycle
/// (bMovedInThisCycle) is to be left alone: the slave goes on in the next one.
template <class Check>
Turn callFollower(BlockState &block, MasterState &master, FollowState &follow, bool execute,
                  AxisRef *masterRef, AxisRef *slave, int16_t bufferMode,
                  const Check &check) noexcept {
  switch (beginCall(block, execute, slave)) {
  case Call::Start: {
    int16_t problem = couplingRefusal(masterRef, *slave, bufferMode);
    if (problem == axis::error::kNone)
      problem = check();
    if (problem != axis::error::kNone) {
      fail(block, slave, problem);
      return Turn::None;
    }
    master.pAxis = masterRef;
    return startFollower(block, follow, *slave, bufferMode);
  }
  case Call::Go:
    if (masterRef != master.pAxis) {
      fail(block, slave, axis::error::kAxisChanged);
      return Turn::None;
    }
    return continueFollower(block, follow, *slave);
  case Call::Idle:
    break;
  }
  return Turn::None;
}

/// After the set values of a cycle have been written: the block has what was asked of it, and a
/// command that waits after it takes the slave. `shown`: the block has shown so before, so that it
/// is aborted, else it has finished. True if the block is over.
bool passOn(BlockState &block, AxisRef &slave, bool shown) noexcept;

/// For the output that shows whether the block has what was asked of it (bDone: InGear, InSync): it
/// is TRUE as long as Execute is, without Execute once.
void noteReached(BlockState &block, bool reached) noexcept;

/// noteReached, and passOn when it is so.
void showReached(BlockState &block, AxisRef &slave, bool reached) noexcept;

} // namespace stride::motion

#endif
