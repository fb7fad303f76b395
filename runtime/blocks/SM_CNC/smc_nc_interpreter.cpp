// SMC_NCInterpreter: its pins and the interpreter of numeric/nc.
#include "runtime/numeric/nc/interpreter.hpp"

#include "runtime/blocks/SM_CNC/gcode_layout.hpp"
#include "runtime/blocks/SM_CNC/nc_layout.hpp"
#include "runtime/numeric/cnc/gcode_text.hpp"

#include "st/SM_CNC/SMC_NCInterpreter.h"

namespace {

namespace cnc = ::stride::cnc;
namespace nc = ::stride::nc;
using Interpreter = ::st::SM_CNC::SMC_NCInterpreter;

static_assert(sizeof(nc::Interpreter) <= sizeof(Interpreter::aState));
static_assert(sizeof(nc::Carried) + sizeof(nc::Evaluation) < 24576); // on the stack

/// What the manual asks for.
constexpr uint32_t kLeastObjects = 5;

nc::Interpreter &partOf(Interpreter &block) noexcept {
  return reinterpret_cast<nc::Interpreter &>(block.aState);
}

cnc::Decoder &stateOf(Interpreter &block) noexcept {
  return reinterpret_cast<cnc::Decoder &>(block.State);
}

void stop(Interpreter &block, int16_t error) noexcept {
  block.bBusy = 0;
  block.bWaiting = 0;
  block.wErrorID = error;
  block.bError = static_cast<::stride::BOOL>(error != ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
}

/// A rising edge.
void start(Interpreter &block) noexcept {
  block.bDone = 0;
  stop(block, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
  block.errorPos = {};
  if (block.pbyBufferOutQueue == nullptr ||
      block.nSizeOutQueue < kLeastObjects * sizeof(cnc::PathObject)) {
    stop(block, ::st::SM_Error::SMC_ERROR__SMC_IPR_OUTQUEUE_BUFFER_TOO_SMALL);
    return;
  }
  const bool append = block.bAppend != 0 && block.bBegun != 0;
  cnc::Queue *const queue = cnc::queueOf(&block.Queue);
  if (append) {
    cnc::appendDecoder(stateOf(block));
  } else {
    queue->buffer = reinterpret_cast<uint8_t *>(block.pbyBufferOutQueue);
    queue->size = block.nSizeOutQueue;
    (void)cnc::clear(queue);
    cnc::startDecoder(stateOf(block), __builtin_bit_cast(cnc::Position, block.piStartPosition));
    stateOf(block).separate = true;
  }
  nc::startInterpreter(partOf(block));
  queue->endOfList = 0;
  queue->generator = cnc::kByDecoder;
  block.bBegun = block.bBusy = 1;
  block.iLineNumberDecoded = 0;
  block.udiJumps = 0;
  block.GCodeText.bClearList = static_cast<::stride::BOOL>(!append);
}

void appendAll(Interpreter &block, const cnc::Decoded &decoded) noexcept {
  for (int32_t i = 0; i < decoded.count; ++i)
    (void)cnc::append(cnc::queueOf(&block.Queue), &decoded.objects[i]);
}

/// The sentence as SMC_GCodeViewer shows it.
void show(Interpreter &block, const nc::Carried &carried) noexcept {
  if (carried.count == 0)
    return;
  const cnc::SentenceWords sentence{carried.words, carried.count, carried.line + 1, carried.skip,
                                    false};
  cnc::sentenceText(sentence, block.GCodeText.str.s, 81);
  const bool numbered = carried.words[0].letter == 'N';
  block.GCodeText.iLineNumber = numbered ? carried.words[0].integer : carried.line + 1;
  block.GCodeText.bNewLine = 1;
}

void fail(Interpreter &block, const nc::SentenceQueue &sentences,
          const nc::Carried &carried) noexcept {
  const bool reader = carried.error != nc::Error::None && carried.error == sentences.error;
  if (!reader) {
    block.errorPos.diSourceLineNo = carried.line;
    block.errorPos.diColumnNo = carried.column;
  }
  stop(block, carried.error == nc::Error::None ? cnc::errorOf(carried.decoded.error)
                                               : static_cast<int16_t>(carried.error));
}

/// Counts jumps that make nothing of the path; false: there are too many in a row.
bool countJumps(Interpreter &block, const nc::Carried &carried) noexcept {
  if (carried.decoded.count > 0)
    block.udiJumps = 0;
  if (carried.decoded.next != cnc::Next::Jump || ++block.udiJumps <= cnc::kMostJumps)
    return true;
  block.errorPos.diSourceLineNo = carried.line;
  stop(block, ::st::SM_Error::SMC_ERROR__SMC_DEC_ENDLESS_JUMPS);
  return false;
}

/// One sentence.
void carryOut(Interpreter &block, nc::SentenceQueue &sentences) noexcept {
  nc::Carried carried;
  if (block.pParameters != nullptr)
    __builtin_memcpy(stateOf(block).parameters, block.pParameters,
                     sizeof stateOf(block).parameters);
  const nc::Outcome outcome =
      nc::interpret(partOf(block), stateOf(block), sentences, block.bStepSuppress != 0, carried);
  if (outcome == nc::Outcome::Idle)
    return;
  if (outcome == nc::Outcome::Wrong) {
    fail(block, sentences, carried);
    return;
  }
  __builtin_memcpy(block.Queue.strProgramName.s, sentences.title,
                   sizeof block.Queue.strProgramName.s);
  block.iLineNumberDecoded = carried.line + 1;
  appendAll(block, carried.decoded);
  if (outcome == nc::Outcome::Finished) {
    block.Queue.bEndOfList = 1;
    block.bDone = block.bExecute;
    stop(block, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
    return;
  }
  show(block, carried);
  if (!countJumps(block, carried))
    return;
  block.bWaiting = static_cast<::stride::BOOL>(carried.decoded.next == cnc::Next::Synchronise);
}

} // namespace

void st::SM_CNC::SMC_NCInterpreter::body__(::stride::Ctx & /*ctx__*/) {
  GCodeText.bNewLine = 0;
  GCodeText.bClearList = 0;
  poqDataOut = &Queue;
  const bool edge = bExecute != 0 && bOldExecute == 0;
  bOldExecute = bExecute;
  if (bAbort != 0) {
    stop(*this, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
    bDone = 0;
    return;
  }
  if (edge)
    start(*this);
  if (bBusy == 0) {
    if (bExecute == 0) {
      bDone = 0;
      stop(*this, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
    }
    return;
  }
  const ::stride::cnc::Queue *const queue = ::stride::cnc::queueOf(&Queue);
  if (bWaiting != 0 && ::stride::cnc::countOf(queue) == 0)
    bWaiting = 0;
  if (bWaiting == 0 && !::stride::cnc::isFull(queue))
    carryOut(*this, ::stride::nc::sentencesOf(*sentences));
}
