// SMC_NCInterpreter: its pins and the interpreter of numeric/nc.
#include "runtime/numeric/nc/interpreter.hpp"

#include "runtime/blocks/SM_CNC/decoding_block.hpp"
#include "runtime/blocks/SM_CNC/nc_layout.hpp"

#include "st/SM_CNC/SMC_NCInterpreter.h"

namespace {

namespace cnc = ::stride::cnc;
namespace nc = ::stride::nc;
using Interpreter = ::st::SM_CNC::SMC_NCInterpreter;

static_assert(sizeof(nc::Interpreter) <= sizeof(Interpreter::aState));
/// SMC_NCCallstackInfo: how many calls it has room for.
constexpr uint16_t kMostCalls =
    sizeof(::st::SM_CNC::SMC_NCCallstackInfo::auiCaller) / sizeof(uint16_t);

static_assert(sizeof(nc::Carried) + sizeof(nc::Evaluation) < 24576); // on the stack

nc::Interpreter &partOf(Interpreter &block) noexcept {
  return reinterpret_cast<nc::Interpreter &>(block.aState);
}

/// A rising edge.
void start(Interpreter &block) noexcept {
  block.bDone = 0;
  cnc::stopDecoding(block, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
  block.errorPos = {};
  if (!cnc::hasQueueMemory(block)) {
    cnc::stopDecoding(block, ::st::SM_Error::SMC_ERROR__SMC_IPR_OUTQUEUE_BUFFER_TOO_SMALL);
    return;
  }
  cnc::startDecoding(block, __builtin_bit_cast(cnc::Position, block.piStartPosition), true);
  nc::startInterpreter(partOf(block));
  if (block.bAppend == 0)
    block.CallstackInfo.uiCount = 0;
}

/// The sentence as SMC_GCodeViewer shows it.
void show(Interpreter &block, const nc::Carried &carried) noexcept {
  if (carried.count > 0)
    cnc::showSentence(block, {carried.words, carried.count, carried.line + 1, carried.skip, false});
}

void fail(Interpreter &block, const nc::SentenceQueue &sentences,
          const nc::Carried &carried) noexcept {
  const bool reader = carried.error != nc::Error::None && carried.error == sentences.error;
  if (!reader) {
    block.errorPos.diSourceLineNo = carried.line;
    block.errorPos.diColumnNo = carried.column;
  }
  cnc::stopDecoding(block, carried.error == nc::Error::None ? cnc::errorOf(carried.decoded.error)
                                                            : static_cast<int16_t>(carried.error));
}

/// Notes the call of a program by another one; the number that it gets, 1 more than there can be if
/// there is no room. The same call has the same number.
uint16_t noteCall(Interpreter &block, uint16_t caller, const char *name) noexcept {
  auto &info = block.CallstackInfo;
  for (uint16_t i = 0; i < info.uiCount; ++i)
    if (info.auiCaller.v[i] == caller && __builtin_strcmp(info.asName.v[i].s, name) == 0)
      return static_cast<uint16_t>(i + 1);
  if (info.uiCount >= kMostCalls || caller > kMostCalls)
    return kMostCalls + 1;
  static_assert(sizeof info.asName.v[0].s == nc::kMostName + 1);
  info.auiCaller.v[info.uiCount] = caller;
  __builtin_strcpy(info.asName.v[info.uiCount].s, name);
  return ++info.uiCount;
}

/// Says of which program the objects to come are, before a sentence: at the beginning of the main
/// program.
void beginCalls(Interpreter &block, const nc::SentenceQueue &sentences) noexcept {
  nc::Interpreter &in = partOf(block);
  if (in.callers[0] == 0 && sentences.title[0] != 0)
    in.callers[0] = cnc::decoderOf(block).program = noteCall(block, 0, sentences.title);
}

/// Likewise after a sentence that began on level `before` of calls: a call or a return.
void followCalls(Interpreter &block, const nc::SentenceQueue &sentences, int32_t before) noexcept {
  nc::Interpreter &in = partOf(block);
  if (in.level > before)
    in.callers[in.level] = noteCall(block, in.callers[before], sentences.name);
  cnc::decoderOf(block).program = in.callers[in.level];
}

/// One sentence.
void carryOut(Interpreter &block, nc::SentenceQueue &sentences) noexcept {
  nc::Carried carried;
  cnc::takeParameters(block);
  beginCalls(block, sentences);
  const int32_t level = partOf(block).level;
  const nc::Outcome outcome = nc::interpret(partOf(block), cnc::decoderOf(block), sentences,
                                            block.bStepSuppress != 0, carried);
  if (outcome == nc::Outcome::Idle)
    return;
  if (outcome == nc::Outcome::Wrong) {
    fail(block, sentences, carried);
    return;
  }
  followCalls(block, sentences, level);
  __builtin_memcpy(block.Queue.strProgramName.s, sentences.title,
                   sizeof block.Queue.strProgramName.s);
  block.iLineNumberDecoded = carried.line + 1;
  cnc::appendObjects(block, carried.decoded);
  if (outcome == nc::Outcome::Finished) {
    block.Queue.bEndOfList = 1;
    block.bDone = block.bExecute;
    cnc::stopDecoding(block, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
    return;
  }
  show(block, carried);
  if (!cnc::countJump(block, carried.decoded)) {
    block.errorPos.diSourceLineNo = carried.line;
    cnc::stopDecoding(block, ::st::SM_Error::SMC_ERROR__SMC_DEC_ENDLESS_JUMPS);
    return;
  }
  block.bWaiting = static_cast<::stride::BOOL>(carried.decoded.next == cnc::Next::Synchronise);
}

} // namespace

void st::SM_CNC::SMC_NCInterpreter::body__(::stride::Ctx & /*ctx__*/) {
  const auto stop = [this] {
    ::stride::cnc::stopDecoding(*this, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
  };
  if (::stride::cnc::beginCall(
          *this, [this] { start(*this); }, stop) &&
      ::stride::cnc::hasRoom(*this))
    carryOut(*this, ::stride::nc::sentencesOf(*sentences));
}
