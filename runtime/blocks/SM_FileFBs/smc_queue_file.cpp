// The bytes of queue files for SMC_ReadNCQueue and SMC_WriteNCQueue, which are written in ST.
#include "runtime/blocks/SM_CNC/cnc_layout.hpp"
#include "runtime/numeric/cnc/queue_file.hpp"

#include "st/SM_Error/SMC_ERROR.h"
#include "st/SM_FileFBs/SMC_QueueFileEnd.h"
#include "st/SM_FileFBs/SMC_QueueFileOpen.h"
#include "st/SM_FileFBs/SMC_QueueFilePart.h"

namespace cnc = stride::cnc;

namespace st::SM_FileFBs {

::stride::INT SMC_QueueFileOpen(::stride::Ctx & /*ctx__*/, ::st::SM_CNC::SMC_OUTQUEUE &Queue,
                                ::stride::BYTE *&pTarget, ::stride::UDINT &udiObjects,
                                ::stride::BYTE *pHeader) {
  cnc::QueueFileHeader header{};
  if (cnc::readQueueFileHeader(pHeader, header) != cnc::QueueFileError::None)
    return ::st::SM_Error::SMC_ERROR__SMC_RNCQ_WRONG_VERSION;
  uint32_t places = 0;
  cnc::PathObject *objects = cnc::placesOf(cnc::queueOf(&Queue), places);
  if (objects == nullptr || places < header.count)
    return ::st::SM_Error::SMC_ERROR__SMC_RNCQ_BUFFER_TOO_SMALL;
  pTarget = reinterpret_cast<::stride::BYTE *>(objects);
  udiObjects = header.count;
  return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
}

::stride::BOOL SMC_QueueFileEnd(::stride::Ctx & /*ctx__*/, ::st::SM_CNC::SMC_OUTQUEUE &Queue,
                                ::stride::BYTE *pHeader) {
  cnc::QueueFileHeader header{};
  if (cnc::readQueueFileHeader(pHeader, header) != cnc::QueueFileError::None)
    return 0;
  cnc::setQueueContent(*cnc::queueOf(&Queue), header);
  return 1;
}

::stride::UDINT SMC_QueueFilePart(::stride::Ctx & /*ctx__*/, ::st::SM_CNC::SMC_OUTQUEUE *poq,
                                  ::stride::BYTE *pBuffer, ::stride::UDINT udiOffset,
                                  ::stride::UDINT udiCount) {
  return cnc::writeQueueFilePart(cnc::queueOf(poq), udiOffset, pBuffer, udiCount);
}

} // namespace st::SM_FileFBs
