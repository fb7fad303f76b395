// Sentences of programs in SoftMotion 3's language for SMC_ReadNCFile2, which is written in ST.
#include "runtime/numeric/nc/reader.hpp"

#include "runtime/blocks/SM_CNC/nc_layout.hpp"

#include "st/SM_Error/SMC_ERROR.h"
#include "st/SM_FileFBs/SMC_NCReaderBegin.h"
#include "st/SM_FileFBs/SMC_NCReaderPath.h"
#include "st/SM_FileFBs/SMC_NCReaderRead.h"
#include "st/SM_FileFBs/SMC_NCReaderServe.h"
#include "st/SM_FileFBs/SMC_NC_READER.h"

namespace {

namespace cnc = ::stride::cnc;
namespace nc = ::stride::nc;
using Declared = ::st::SM_FileFBs::SMC_NC_READER;

static_assert(sizeof(nc::Reader) <= sizeof(Declared::aState));

nc::Reader &partOf(Declared &reader) noexcept {
  return reinterpret_cast<nc::Reader &>(reader.aState);
}

/// What the block in ST sees of the reader.
void showReader(Declared &reader) noexcept {
  const nc::Reader &part = partOf(reader);
  reader.diLevel = part.level;
  reader.diErrorLine = part.errorLine;
  reader.diErrorColumn = part.errorColumn;
  reader.bEnded = static_cast<::stride::BOOL>(part.ended);
}

} // namespace

namespace st::SM_FileFBs {

::stride::BOOL SMC_NCReaderBegin(::stride::Ctx & /*ctx__*/, SMC_NC_READER &Reader,
                                 ::st::SM_CNC::SMC_GSentenceQueue &Sentences,
                                 ::stride::BOOL bAppend, ::stride::BOOL b3D, ::stride::LREAL fVel,
                                 ::stride::LREAL fAccel, ::stride::LREAL fDecel,
                                 ::stride::LREAL fVelFF, ::stride::LREAL fAccelFF,
                                 ::stride::LREAL fDecelFF) {
  nc::SentenceQueue &sentences = nc::sentencesOf(Sentences);
  nc::beginReading(partOf(Reader), sentences, false);
  showReader(Reader);
  if (bAppend != 0)
    return 1;
  uint8_t codes[7] = {'G'};
  double values[7] = {b3D != 0 ? 17.0 : 15.0};
  int32_t count = 1;
  const auto add = [&](uint8_t code, double value, double sign) {
    if (!(value > 0.0))
      return;
    codes[count] = code;
    values[count++] = sign * value;
  };
  add('F', fVel, 1.0);
  add('E', fAccel, 1.0);
  add('E', fDecel, -1.0);
  add(cnc::kRapidVelocity, fVelFF, 1.0);
  add(cnc::kRapidAcceleration, fAccelFF, 1.0);
  add(cnc::kRapidAcceleration, fDecelFF, -1.0);
  return static_cast<::stride::BOOL>(nc::putSentence(sentences, codes, values, count));
}

::stride::INT SMC_NCReaderRead(::stride::Ctx & /*ctx__*/, SMC_NC_READER &Reader,
                               ::st::SM_CNC::SMC_GSentenceQueue &Sentences,
                               ::stride::UDINT &udiUsed, SMC_VARLIST *pvl, ::stride::BYTE *pBytes,
                               ::stride::UDINT udiCount, ::stride::BOOL bEnd,
                               ::stride::BOOL bParentheses) {
  nc::SentenceQueue &sentences = nc::sentencesOf(Sentences);
  sentences.variables = reinterpret_cast<uint8_t *>(pvl);
  const nc::ReadSettings settings{reinterpret_cast<const cnc::VariableList *>(pvl),
                                  bParentheses != 0};
  int64_t used = 0;
  const nc::ReadState state =
      nc::readProgram(partOf(Reader), sentences, settings, pBytes, udiCount, bEnd != 0, used);
  udiUsed = static_cast<::stride::UDINT>(used);
  showReader(Reader);
  return state == nc::ReadState::Wrong ? static_cast<int16_t>(partOf(Reader).error)
                                       : ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
}

::stride::LINT SMC_NCReaderServe(::stride::Ctx & /*ctx__*/, SMC_NC_READER &Reader,
                                 ::st::SM_CNC::SMC_GSentenceQueue &Sentences) {
  nc::SentenceQueue &sentences = nc::sentencesOf(Sentences);
  int64_t offset = -1;
  switch (sentences.request) {
  case nc::Request::Rewind:
    offset = nc::rewindProgram(partOf(Reader), sentences);
    break;
  case nc::Request::Call:
    offset = nc::enterSubprogram(partOf(Reader), sentences);
    break;
  case nc::Request::Return:
    offset = nc::leaveSubprogram(partOf(Reader), sentences);
    break;
  case nc::Request::None:
  case nc::Request::Finish:
    break;
  }
  showReader(Reader);
  return offset;
}

::stride::BOOL SMC_NCReaderPath(::stride::Ctx & /*ctx__*/,
                                ::st::SM_CNC::SMC_GSentenceQueue &Sentences,
                                ::stride::STRING<174> &sFolder, ::stride::STRING<255> &sPath) {
  constexpr char kEnding[] = ".cnc";
  constexpr int32_t kMost = 255;
  int32_t length = 0;
  const auto add = [&](char c) {
    if (length < kMost)
      sPath.s[length] = c;
    ++length;
  };
  for (int32_t i = 0; i < 174 && sFolder.s[i] != 0; ++i)
    add(sFolder.s[i]);
  if (length > 0)
    add('/');
  for (int32_t i = 0; i < nc::kMostName && Sentences.sName.s[i] != 0; ++i) {
    const char c = Sentences.sName.s[i];
    add(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  }
  for (int32_t i = 0; kEnding[i] != 0; ++i)
    add(kEnding[i]);
  sPath.s[length <= kMost ? length : 0] = 0;
  return static_cast<::stride::BOOL>(length <= kMost);
}

} // namespace st::SM_FileFBs
