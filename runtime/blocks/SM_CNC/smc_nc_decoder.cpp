// SMC_NCDecoder and SMC_ShowCNCREF.
#include "runtime/blocks/SM_CNC/gcode_layout.hpp"
#include "runtime/numeric/cnc/gcode_text.hpp"

#include "st/SM_CNC/SMC_NCDecoder.h"
#include "st/SM_CNC/SMC_ShowCNCREF.h"

namespace {

namespace cnc = ::stride::cnc;
using Block = ::st::SM_CNC::SMC_NCDecoder;
using Program = ::st::SM_CNC::SMC_CNC_REF;

cnc::Decoder &decoderOf(Block &block) noexcept {
  return reinterpret_cast<cnc::Decoder &>(block.State);
}

void end(Block &block, int16_t error) noexcept {
  block.bBusy = 0;
  block.bWaiting = 0;
  block.bLooking = 0;
  block.wErrorID = error;
  block.bError = static_cast<::stride::BOOL>(error != ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
  block.iErr = 0;
  if (error == ::st::SM_Error::SMC_ERROR__SMC_DEC_ACC_TOO_LITTLE)
    block.iErr = 1;
  else if (error == ::st::SM_Error::SMC_ERROR__SMC_DEC_RET_TOO_LITTLE)
    block.iErr = 2;
}

/// Where the path begins.
cnc::Position startOf(const Block &block, const Program &program) noexcept {
  auto start = __builtin_bit_cast(cnc::Position, block.piStartPosition);
  for (const double coordinate : start.coordinate)
    if (coordinate != 0.0)
      return start;
  const uint16_t axes = start.axes;
  start = __builtin_bit_cast(cnc::Position, program.piStartPosition);
  start.axes = static_cast<uint16_t>(start.axes | axes);
  return start;
}

/// A rising edge. False: nothing happens.
bool begin(Block &block, Program &program) noexcept {
  block.bDone = 0;
  end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
  if (block.pbyBufferOutQueue == nullptr ||
      block.nSizeOutQueue < cnc::kLeastObjects * sizeof(cnc::PathObject))
    return false;
  if (!cnc::isProgram(program)) {
    end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_CNC_REF_TYPE);
    return false;
  }
  const bool append = block.bAppend != 0 && block.bBegun != 0;
  cnc::Queue *const queue = cnc::queueOf(&block.Queue);
  if (append) {
    cnc::appendDecoder(decoderOf(block));
  } else {
    queue->buffer = reinterpret_cast<uint8_t *>(block.pbyBufferOutQueue);
    queue->size = block.nSizeOutQueue;
    (void)cnc::clear(queue);
    cnc::startDecoder(decoderOf(block), startOf(block, program));
    decoderOf(block).separate = block.bSoftMotion3 != 0;
  }
  queue->endOfList = 0;
  queue->generator = cnc::kByDecoder;
  __builtin_memcpy(queue->programName, program.strProgramName.s, sizeof queue->programName);
  if (program.udiBuffer == cnc::kWholeProgram)
    program.diReadPos = 0;
  block.bBegun = block.bBusy = 1;
  block.iStatus = ::st::SM_CNC::SMC_DEC_STATUS__READ_WORD;
  block.iLineNumberDecoded = 0;
  block.udiJumps = 0;
  block.GCodeText.bClearList = static_cast<::stride::BOOL>(!append);
  return true;
}

void appendObjects(Block &block, const cnc::Decoded &decoded) noexcept {
  for (int32_t i = 0; i < decoded.count; ++i)
    (void)cnc::append(cnc::queueOf(&block.Queue), &decoded.objects[i]);
}

/// The sentence as SMC_GCodeViewer shows it.
void showSentence(Block &block, const cnc::SentenceWords &sentence) noexcept {
  cnc::sentenceText(sentence, block.GCodeText.str.s, 81);
  block.GCodeText.iLineNumber = sentence.line;
  for (int32_t i = 0; i < sentence.count; ++i)
    if (sentence.words[i].letter == 'N') {
      block.GCodeText.iLineNumber = sentence.words[i].integer;
      break;
    }
  block.GCodeText.bNewLine = 1;
}

/// A jump: at once in a program that is there as a whole, else with its next pieces.
void jump(Block &block, Program &program, int32_t target) noexcept {
  if (++block.udiJumps > cnc::kMostJumps) {
    end(block, ::st::SM_Error::SMC_ERROR__SMC_DEC_ENDLESS_JUMPS);
    return;
  }
  if (program.udiBuffer != cnc::kWholeProgram) {
    block.bLooking = 1;
    block.diTarget = target;
    program.bRestart = 1;
    return;
  }
  const int64_t at = cnc::findSentence(cnc::wordsOf(program), program.nElements, target);
  if (at < 0)
    end(block, ::st::SM_Error::SMC_ERROR__SMC_DEC_UNKNOWN_JUMP);
  else
    program.diReadPos = static_cast<uint32_t>(at);
}

void finish(Block &block, cnc::Decoded &decoded) noexcept {
  if (block.bLooking != 0) {
    end(block, ::st::SM_Error::SMC_ERROR__SMC_DEC_UNKNOWN_JUMP);
    return;
  }
  cnc::decodeEnd(decoderOf(block), decoded);
  appendObjects(block, decoded);
  block.Queue.bEndOfList = 1;
  block.iStatus = ::st::SM_CNC::SMC_DEC_STATUS__PROG_READ;
  block.bDone = block.bExecute;
  end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
}

void decode(Block &block, Program &program, const cnc::SentenceWords &sentence,
            cnc::Decoded &decoded) noexcept {
  block.iLineNumberDecoded = sentence.line;
  if (sentence.skip && block.bStepSuppress != 0)
    return;
  showSentence(block, sentence);
  if (block.pParameters != nullptr)
    __builtin_memcpy(decoderOf(block).parameters, block.pParameters,
                     sizeof decoderOf(block).parameters);
  cnc::decodeSentence(decoderOf(block), sentence.words, sentence.count, sentence.line, decoded);
  if (decoded.error != cnc::GCodeError::None) {
    end(block, cnc::errorOf(decoded.error));
    return;
  }
  appendObjects(block, decoded);
  if (decoded.count > 0)
    block.udiJumps = 0;
  block.bWaiting = static_cast<::stride::BOOL>(decoded.next == cnc::Next::Synchronise);
  if (decoded.next == cnc::Next::Jump)
    jump(block, program, decoded.target);
}

/// One sentence; while a jump looks for its target, all that there are.
void step(Block &block, Program &program) noexcept {
  static_assert(sizeof(cnc::Decoded) < 8192); // on the stack
  cnc::Decoded decoded;
  cnc::SentenceWords sentence;
  for (;;) {
    const bool whole = program.udiBuffer == cnc::kWholeProgram;
    const int64_t at = program.diReadPos;
    const int64_t next = cnc::sentenceAt(cnc::wordsOf(program), program.nElements, at, sentence);
    if (program.bRestart != 0 && !whole)
      return;
    if (next == at) {
      if (whole)
        finish(block, decoded);
      return;
    }
    program.diReadPos = static_cast<uint32_t>(next);
    if (sentence.ended) {
      finish(block, decoded);
      return;
    }
    if (block.bLooking != 0 && !cnc::hasNumber(sentence, block.diTarget))
      continue;
    block.bLooking = 0;
    decode(block, program, sentence, decoded);
    return;
  }
}

} // namespace

void st::SM_CNC::SMC_NCDecoder::body__(::stride::Ctx & /*ctx__*/) {
  GCodeText.bNewLine = 0;
  GCodeText.bClearList = 0;
  poqDataOut = &Queue;
  const bool edge = bExecute != 0 && bOldExecute == 0;
  bOldExecute = bExecute;
  if (bAbort != 0) {
    end(*this, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
    bDone = 0;
    return;
  }
  Program &program = *ncprog;
  if (edge && !begin(*this, program))
    return;
  if (bBusy == 0) {
    if (bExecute == 0) {
      bDone = 0;
      end(*this, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
    }
    return;
  }
  if (!::stride::cnc::isProgram(program)) {
    end(*this, ::st::SM_Error::SMC_ERROR__SMC_NO_CNC_REF_TYPE);
    return;
  }
  const ::stride::cnc::Queue *const queue = ::stride::cnc::queueOf(&Queue);
  if (bWaiting != 0 && ::stride::cnc::countOf(queue) == 0)
    bWaiting = 0;
  if (bWaiting == 0 && !::stride::cnc::isFull(queue))
    step(*this, program);
}

void st::SM_CNC::SMC_ShowCNCREF::body__(::stride::Ctx & /*ctx__*/) {
  const Program &program = *ncprog;
  int64_t at = 0;
  for (auto &line : astr.v) {
    line.s[0] = 0;
    if (bEnable == 0 || !cnc::isProgram(program))
      continue;
    cnc::SentenceWords sentence;
    const int64_t next = cnc::sentenceAt(cnc::wordsOf(program), program.nElements, at, sentence);
    if (next != at && !sentence.ended)
      cnc::sentenceText(sentence, line.s, sizeof line.s);
    at = next;
  }
}
