// What the blocks of all path processors have in common: their pins and the stream of numeric/cnc.
// A block declares bExecute, bAbort, bAppend, poqDataIn, nSizeOutQueue, pbyBufferOutQueue, bDone,
// bBusy, bError, wErrorID, poqDataOut, and, hidden, Queue : SMC_OUTQUEUE, bOldExecute, bBegun and
// aState, an ARRAY OF LWORD with room for ProcessorState. Its body sets what the user says and
// calls runProcessor(). Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_BLOCKS_SM_CNC_STREAM_BLOCK_HPP
#define STRIDE_RUNTIME_BLOCKS_SM_CNC_STREAM_BLOCK_HPP

#include "runtime/blocks/SM_CNC/cnc_layout.hpp"
#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// What a block keeps in aState.
template <class Processor> struct ProcessorState {
  StreamState stream;
  Processor processor;
};

template <class Processor, class Block>
ProcessorState<Processor> &processorStateOf(Block &block) noexcept {
  static_assert(sizeof(ProcessorState<Processor>) <= sizeof block.aState, "aState is too small");
  static_assert(alignof(ProcessorState<Processor>) <= alignof(decltype(block.aState)));
  return *reinterpret_cast<ProcessorState<Processor> *>(&block.aState);
}

/// The processor of a block, to set what the user says before the call of runProcessor().
template <class Processor, class Block> Processor &processorOf(Block &block) noexcept {
  return processorStateOf<Processor>(block).processor;
}

/// Whether a path is on its way through the processor.
inline bool isAtWork(const StreamState &stream) noexcept {
  return stream.phase == StreamPhase::Running || stream.phase == StreamPhase::Draining;
}

template <class Block> void showStream(Block &block, const StreamState &stream) noexcept {
  block.bBusy = static_cast<BOOL>(isAtWork(stream));
  block.bDone = static_cast<BOOL>(stream.phase == StreamPhase::Done);
  block.bError = static_cast<BOOL>(stream.phase == StreamPhase::Failed);
  block.wErrorID = static_cast<int16_t>(stream.error);
}

/// Begins at a rising edge. With too little memory nothing happens.
template <class Processor, class Block> void beginProcessor(Block &block) noexcept {
  ProcessorState<Processor> &state = processorStateOf<Processor>(block);
  // What is held back of the path would be lost: who appends meanwhile, or after an abort, goes on.
  if (block.bAppend != 0 &&
      (isAtWork(state.stream) ||
       resumeStream(state.stream, queueOf(block.poqDataIn), queueOf(&block.Queue))))
    return;
  state.stream = {};
  if (block.pbyBufferOutQueue == nullptr ||
      block.nSizeOutQueue < kLeastObjects * sizeof(PathObject))
    return;
  Queue *const queue = queueOf(&block.Queue);
  const bool append = block.bAppend != 0 && block.bBegun != 0;
  if (!append) {
    queue->buffer = reinterpret_cast<uint8_t *>(block.pbyBufferOutQueue);
    queue->size = block.nSizeOutQueue;
  }
  startStream(state.stream, queue, Processor::kGenerator, append);
  start(state.processor);
  block.bBegun = 1;
}

/// The whole body: edges, one step, outputs.
template <class Processor, class Block> void runProcessor(Block &block) noexcept {
  ProcessorState<Processor> &state = processorStateOf<Processor>(block);
  const bool edge = block.bExecute != 0 && block.bOldExecute == 0;
  block.bOldExecute = block.bExecute;
  block.poqDataOut = &block.Queue;
  const bool ended =
      state.stream.phase == StreamPhase::Done || state.stream.phase == StreamPhase::Failed;
  if (block.bAbort != 0)
    abortStream(state.stream, queueOf(block.poqDataIn));
  else if (ended && block.bExecute == 0)
    state.stream = {};
  else if (edge)
    beginProcessor<Processor>(block);
  stepStream(state.stream, state.processor, queueOf(block.poqDataIn), queueOf(&block.Queue));
  showStream(block, state.stream);
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_BLOCKS_SM_CNC_STREAM_BLOCK_HPP
