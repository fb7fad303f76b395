// One call of a block that gives a motion command: all positioning and velocity blocks.
#ifndef STRIDE_RUNTIME_AXIS_RUN_COMMAND_HPP
#define STRIDE_RUNTIME_AXIS_RUN_COMMAND_HPP

#include "runtime/axis/command.hpp"
#include "runtime/axis/motion_block.hpp"

namespace stride::motion {

/// Starts the command, or lets it wait where its buffer mode says so; its owner is filled in. A
/// command without end (a velocity at the end) has bDone set while it has what it wants, others end
/// with it.
void startCommand(BlockState &block, AxisRef &ref, const Command &command) noexcept;

/// Moves the axis on, or waits for the command's turn.
void continueCommand(BlockState &block, AxisRef &ref) noexcept;

/// Whether the waiting command's turn has come, so that it owns the axis; if it cannot come any
/// more, the outcome says why.
bool awaitTurn(BlockState &block, AxisRef &ref) noexcept;

/// One call: at a rising edge of `execute`, `read` fills in the command from the block's inputs.
template <class Read>
void runCommand(BlockState &block, bool execute, AxisRef *ref, const Read &read) noexcept {
  switch (beginCall(block, execute, ref)) {
  case Call::Start: {
    Command command = {};
    read(command);
    startCommand(block, *ref, command);
    break;
  }
  case Call::Go:
    continueCommand(block, *ref);
    break;
  case Call::Idle:
    break;
  }
}

} // namespace stride::motion

#endif
