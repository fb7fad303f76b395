// What CNC files of a project become when the application begins.
#include "runtime/blocks/SM_CNC/cnc_layout.hpp"
#include "runtime/blocks/SM_CNC/gcode_layout.hpp"
#include "runtime/numeric/cnc/packed_bytes.hpp"
#include "runtime/numeric/cnc/queue_file.hpp"

#include "st/SM_CNC/SMC_UnpackProgram.h"
#include "st/SM_CNC/SMC_UnpackQueue.h"

namespace cnc = ::stride::cnc;

namespace st::SM_CNC {

SMC_GCODE_WORD *SMC_UnpackProgram(::stride::Ctx & /*ctx__*/, ::stride::BYTE *pText,
                                  ::stride::UDINT udiLength, SMC_GCODE_WORD *pWords,
                                  ::stride::UDINT udiWords, SMC_GCODE_WORD *pVariables) {
  cnc::Unpacker unpacker = cnc::startUnpacking(pText, udiLength);
  for (uint32_t i = 0; i < udiWords; ++i) {
    SMC_GCODE_WORD &word = pWords[i];
    if (!cnc::unpack(unpacker, &word, sizeof word))
      return nullptr;
    word.pAdr = nullptr;
    if (word.byVarType == 0)
      continue;
    if (pVariables == nullptr)
      return nullptr;
    word.pAdr = pVariables->pAdr;
    word.byVarType = pVariables->byVarType;
    ++pVariables;
  }
  return pWords;
}

::stride::BYTE *SMC_UnpackQueue(::stride::Ctx & /*ctx__*/, ::stride::BYTE *pText,
                                ::stride::UDINT udiLength, SMC_GEOINFO *pObjects,
                                ::stride::UDINT udiObjects) {
  cnc::Unpacker unpacker = cnc::startUnpacking(pText, udiLength);
  for (uint32_t i = 0; i < udiObjects; ++i) {
    if (!cnc::unpack(unpacker, &pObjects[i], sizeof pObjects[i]))
      return nullptr;
    cnc::mendFileObject(*cnc::objectOf(&pObjects[i]));
  }
  return reinterpret_cast<::stride::BYTE *>(pObjects);
}

} // namespace st::SM_CNC
