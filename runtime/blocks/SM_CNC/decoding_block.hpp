// What SMC_NCDecoder and SMC_NCInterpreter have in common: the queue that they fill, bExecute and
// bAbort, and the sentence for SMC_GCodeViewer. Block has the members of these blocks. Free of the
// C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_BLOCKS_SM_CNC_DECODING_BLOCK_HPP
#define STRIDE_RUNTIME_BLOCKS_SM_CNC_DECODING_BLOCK_HPP

#include "runtime/blocks/SM_CNC/gcode_layout.hpp"
#include "runtime/numeric/cnc/gcode_text.hpp"

namespace stride::cnc {

/// So many jumps without an object of the path are an error: nothing would ever move.
inline constexpr uint32_t kMostJumps = 100000;

template <class Block> Decoder &decoderOf(Block &block) noexcept {
  return reinterpret_cast<Decoder &>(block.State);
}

/// No longer busy; with an SMC_ERROR, or none.
template <class Block> void stopDecoding(Block &block, int16_t error) noexcept {
  block.bBusy = 0;
  block.bWaiting = 0;
  block.wErrorID = error;
  block.bError = static_cast<BOOL>(error != ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
}

template <class Block> bool hasQueueMemory(const Block &block) noexcept {
  return block.pbyBufferOutQueue != nullptr &&
         block.nSizeOutQueue >= kLeastObjects * sizeof(PathObject);
}

/// Begins a program from `start`, or appends it to the one before.
template <class Block>
void startDecoding(Block &block, const Position &start, bool softMotion3) noexcept {
  const bool append = block.bAppend != 0 && block.bBegun != 0;
  Queue *const queue = queueOf(&block.Queue);
  if (!append) { // else all stays as it is, also an object that is held back
    queue->buffer = reinterpret_cast<uint8_t *>(block.pbyBufferOutQueue);
    queue->size = block.nSizeOutQueue;
    (void)clear(queue);
    startDecoder(decoderOf(block), start);
    decoderOf(block).softMotion3 = softMotion3;
    decoderOf(block).orientation = orientationOf(block.eOriConv);
    decoderOf(block).tool = __builtin_bit_cast(Vector3, block.vStartToolLength);
  }
  queue->endOfList = 0;
  queue->generator = kByDecoder;
  block.bBegun = block.bBusy = 1;
  block.iLineNumberDecoded = 0;
  block.udiJumps = 0;
  block.GCodeText.bClearList = static_cast<BOOL>(!append);
}

/// The beginning of a call: a rising edge calls `start`, bAbort and the end of bExecute `stop`.
/// True: there is a program to go on with.
template <class Block, class Start, class Stop>
bool beginCall(Block &block, Start start, Stop stop) noexcept {
  block.GCodeText.bNewLine = 0;
  block.GCodeText.bClearList = 0;
  block.poqDataOut = &block.Queue;
  const bool edge = block.bExecute != 0 && block.bOldExecute == 0;
  block.bOldExecute = block.bExecute;
  if (edge && block.bAbort == 0)
    start();
  if (block.bAbort == 0 && block.bBusy != 0)
    return true;
  if (block.bAbort != 0 || (block.bExecute == 0 && block.bBusy == 0)) {
    stop();
    block.bDone = 0;
  }
  return false;
}

/// Whether the queue can take what a sentence gives: it has room, and is empty after G75.
template <class Block> bool hasRoom(Block &block) noexcept {
  const Queue *const queue = queueOf(&block.Queue);
  if (block.bWaiting != 0 && countOf(queue) == 0)
    block.bWaiting = 0;
  return block.bWaiting == 0 && !isFull(queue);
}

template <class Block> void appendObjects(Block &block, const Decoded &decoded) noexcept {
  for (int32_t i = 0; i < decoded.count; ++i)
    (void)append(queueOf(&block.Queue), &decoded.objects[i]);
}

/// Counts a jump, and forgets those before an object of the path; false: there are too many.
template <class Block> bool countJump(Block &block, const Decoded &decoded) noexcept {
  if (decoded.count > 0)
    block.udiJumps = 0;
  return decoded.next != Next::Jump || ++block.udiJumps <= kMostJumps;
}

/// M functions without O take the parameters of gSMC_MParameters.
template <class Block> void takeParameters(Block &block) noexcept {
  if (block.pParameters != nullptr)
    __builtin_memcpy(decoderOf(block).parameters, block.pParameters,
                     sizeof decoderOf(block).parameters);
}

/// The sentence as SMC_GCodeViewer shows it.
template <class Block> void showSentence(Block &block, const SentenceWords &sentence) noexcept {
  sentenceText(sentence, block.GCodeText.str.s, 81);
  block.GCodeText.iLineNumber = sentence.line;
  for (int32_t i = 0; i < sentence.count; ++i)
    if (sentence.words[i].letter == 'N') {
      block.GCodeText.iLineNumber = sentence.words[i].integer;
      break;
    }
  block.GCodeText.bNewLine = 1;
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_BLOCKS_SM_CNC_DECODING_BLOCK_HPP
