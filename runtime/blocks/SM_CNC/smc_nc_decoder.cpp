// SMC_NCDecoder and SMC_ShowCNCREF.
#include "runtime/blocks/SM_CNC/decoding_block.hpp"

#include "st/SM_CNC/SMC_NCDecoder.h"
#include "st/SM_CNC/SMC_ShowCNCREF.h"

namespace {

namespace cnc = ::stride::cnc;
using Block = ::st::SM_CNC::SMC_NCDecoder;
using Program = ::st::SM_CNC::SMC_CNC_REF;

void end(Block &block, int16_t error) noexcept {
  cnc::stopDecoding(block, error);
  block.bLooking = 0;
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

/// A rising edge. Without memory for the queue nothing happens.
void begin(Block &block, Program &program) noexcept {
  block.bDone = 0;
  end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
  if (!cnc::hasQueueMemory(block))
    return;
  if (!cnc::isProgram(program)) {
    end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_CNC_REF_TYPE);
    return;
  }
  cnc::startDecoding(block, startOf(block, program), block.bSoftMotion3 != 0);
  __builtin_memcpy(cnc::queueOf(&block.Queue)->programName, program.strProgramName.s,
                   sizeof block.Queue.strProgramName.s);
  if (program.udiBuffer == cnc::kWholeProgram) {
    program.diReadPos = 0;
    program.bBegun = 1;
  }
  block.pWords = program.pgc;
  block.udiNextWord = 0;
  block.iStatus = ::st::SM_CNC::SMC_DEC_STATUS__READ_WORD;
}

/// A jump: at once in a program that is there as a whole, else with its next pieces.
void jump(Block &block, Program &program, int32_t target) noexcept {
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
  cnc::decodeEnd(cnc::decoderOf(block), decoded);
  cnc::appendObjects(block, decoded);
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
  cnc::showSentence(block, sentence);
  cnc::takeParameters(block);
  cnc::decodeSentence(cnc::decoderOf(block), sentence.words, sentence.count, sentence.line,
                      decoded);
  if (decoded.error != cnc::GCodeError::None) {
    end(block, cnc::errorOf(decoded.error));
    return;
  }
  cnc::appendObjects(block, decoded);
  if (!cnc::countJump(block, decoded)) {
    end(block, ::st::SM_Error::SMC_ERROR__SMC_DEC_ENDLESS_JUMPS);
    return;
  }
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

/// An online change has made the program anew: the same one goes on where it was, instead of
/// another one nothing can. False: that is so, and the block has ended.
bool goesOn(Block &block, Program &program) noexcept {
  if (program.udiBuffer != cnc::kWholeProgram || program.bBegun != 0)
    return true;
  if (block.pWords == nullptr && block.udiNextWord != 0) {
    end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_CNC_REF_TYPE);
    return false;
  }
  if (block.pWords == program.pgc)
    program.diReadPos = block.udiNextWord;
  program.bBegun = 1;
  return true;
}

} // namespace

void st::SM_CNC::SMC_NCDecoder::body__(::stride::Ctx & /*ctx__*/) {
  Program &program = *ncprog;
  const auto stop = [this] { end(*this, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR); };
  if (!::stride::cnc::beginCall(
          *this, [&] { begin(*this, program); }, stop))
    return;
  if (!::stride::cnc::isProgram(program))
    end(*this, ::st::SM_Error::SMC_ERROR__SMC_NO_CNC_REF_TYPE);
  else if (goesOn(*this, program) && ::stride::cnc::hasRoom(*this)) {
    step(*this, program);
    udiNextWord = program.diReadPos;
  }
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
