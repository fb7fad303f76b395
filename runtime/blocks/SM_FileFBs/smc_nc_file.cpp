// The words of CNC files for SMC_ReadNCFile, which is written in ST.
#include "runtime/blocks/SM_CNC/gcode_layout.hpp"
#include "runtime/blocks/same_place.hpp"
#include "runtime/numeric/cnc/gcode_reader.hpp"

#include "st/SM_FileFBs/SMC_GCODE_READER.h"
#include "st/SM_FileFBs/SMC_GCodePut.h"
#include "st/SM_FileFBs/SMC_GCodeRead.h"
#include "st/SM_FileFBs/SMC_SingleVar.h"
#include "st/SM_FileFBs/SMC_VARLIST.h"

namespace {

namespace cnc = ::stride::cnc;
namespace st = ::st::SM_FileFBs;

static_assert(sizeof(cnc::Reader) == sizeof(st::SMC_GCODE_READER));
STRIDE_SAME_PLACE(cnc::Scanner, word, st::SMC_GCODE_READER, Word);
STRIDE_SAME_PLACE(cnc::Scanner, offset, st::SMC_GCODE_READER, liOffset);
STRIDE_SAME_PLACE(cnc::Scanner, wordOffset, st::SMC_GCODE_READER, liWordOffset);
STRIDE_SAME_PLACE(cnc::Scanner, lastLine, st::SMC_GCODE_READER, liLastLine);
STRIDE_SAME_PLACE(cnc::Scanner, mantissa, st::SMC_GCODE_READER, liMantissa);
STRIDE_SAME_PLACE(cnc::Scanner, line, st::SMC_GCODE_READER, diLine);
STRIDE_SAME_PLACE(cnc::Scanner, count, st::SMC_GCODE_READER, diCount);
STRIDE_SAME_PLACE(cnc::Scanner, decimals, st::SMC_GCODE_READER, diDecimals);
STRIDE_SAME_PLACE(cnc::Scanner, error, st::SMC_GCODE_READER, byError);
STRIDE_SAME_PLACE(cnc::Scanner, state, st::SMC_GCODE_READER, byState);
STRIDE_SAME_PLACE(cnc::Scanner, inSentence, st::SMC_GCODE_READER, bInSentence);
STRIDE_SAME_PLACE(cnc::Scanner, begun, st::SMC_GCODE_READER, bBegun);
STRIDE_SAME_PLACE(cnc::Scanner, carriageReturn, st::SMC_GCODE_READER, bCarriageReturn);
STRIDE_SAME_PLACE(cnc::Scanner, variable, st::SMC_GCODE_READER, bVariable);
STRIDE_SAME_PLACE(cnc::Scanner, lowerCase, st::SMC_GCODE_READER, bLowerCase);
STRIDE_SAME_PLACE(cnc::Scanner, endsInDigit, st::SMC_GCODE_READER, bEndsInDigit);
STRIDE_SAME_PLACE(cnc::Scanner, exponent, st::SMC_GCODE_READER, byExponent);
STRIDE_SAME_PLACE(cnc::Scanner, letters, st::SMC_GCODE_READER, abyLetters);
STRIDE_SAME_PLACE(cnc::Scanner, digits, st::SMC_GCODE_READER, abyDigits);
STRIDE_SAME_PLACE(cnc::Scanner, name, st::SMC_GCODE_READER, abyName);
STRIDE_SAME_PLACE(cnc::Reader, written, st::SMC_GCODE_READER, udiWritten);
STRIDE_SAME_PLACE(cnc::Reader, ended, st::SMC_GCODE_READER, bEnded);

static_assert(sizeof(cnc::NamedVariable) == sizeof(st::SMC_SingleVar));
STRIDE_SAME_PLACE(cnc::NamedVariable, name, st::SMC_SingleVar, strVarName);
STRIDE_SAME_PLACE(cnc::NamedVariable, type, st::SMC_SingleVar, eVarType);
STRIDE_SAME_PLACE(cnc::NamedVariable, address, st::SMC_SingleVar, pAdr);
STRIDE_SAME_PLACE(cnc::NamedVariable, integer, st::SMC_SingleVar, diValue);
STRIDE_SAME_PLACE(cnc::NamedVariable, real, st::SMC_SingleVar, fValue);
static_assert(sizeof(cnc::VariableList) == sizeof(st::SMC_VARLIST));
STRIDE_SAME_PLACE(cnc::VariableList, count, st::SMC_VARLIST, wNumberVars);
static_assert(__builtin_offsetof(cnc::VariableList, first) ==
              __builtin_offsetof(st::SMC_VARLIST, psvVarList));

cnc::WordMemory memoryOf(::st::SM_CNC::SMC_CNC_REF &program) noexcept {
  return {reinterpret_cast<cnc::GCodeWord *>(program.pgc), program.udiBuffer, &program.diReadPos,
          &program.nElements, program.strProgramName.s};
}

cnc::Reader &readerOf(st::SMC_GCODE_READER &reader) noexcept {
  return reinterpret_cast<cnc::Reader &>(reader);
}

} // namespace

namespace st::SM_FileFBs {

::stride::INT SMC_GCodeRead(::stride::Ctx & /*ctx__*/, SMC_GCODE_READER &Reader,
                            ::st::SM_CNC::SMC_CNC_REF &Prog, ::stride::UDINT &udiUsed,
                            SMC_VARLIST *pvl, ::stride::BYTE *pBytes, ::stride::UDINT udiCount,
                            ::stride::BOOL bEnd) {
  const auto *list = reinterpret_cast<const cnc::VariableList *>(pvl);
  int64_t used = 0;
  const cnc::ReadResult result =
      cnc::readWords(readerOf(Reader), memoryOf(Prog), list, pBytes, udiCount, bEnd != 0, used);
  udiUsed = static_cast<::stride::UDINT>(used);
  switch (result) {
  case cnc::ReadResult::More:
  case cnc::ReadResult::Full:
  case cnc::ReadResult::Ended:
    break;
  case cnc::ReadResult::TooSmall:
    return ::st::SM_Error::SMC_ERROR__SMC_RNCF_BUFFER_TOO_SMALL;
  case cnc::ReadResult::Wrong:
    return ::st::SM_Error::SMC_ERROR__SMC_DEC_SYNTAX_ERROR;
  case cnc::ReadResult::Variable:
    return list != nullptr && list->count > 0 && list->first == nullptr
               ? ::st::SM_Error::SMC_ERROR__SMC_RNCF_NOT_VARLIST
               : ::st::SM_Error::SMC_ERROR__SMC_RNCF_VAR_COULDNT_BE_REPLACED;
  }
  return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
}

::stride::BOOL SMC_GCodePut(::stride::Ctx & /*ctx__*/, SMC_GCODE_READER &Reader,
                            ::st::SM_CNC::SMC_CNC_REF &Prog, ::stride::BYTE byLetter,
                            ::stride::LREAL fValue) {
  return static_cast<::stride::BOOL>(
      cnc::putWord(readerOf(Reader), memoryOf(Prog), byLetter, fValue));
}

} // namespace st::SM_FileFBs
