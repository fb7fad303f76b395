// The functions for queues of path objects, and SMC_ShowQueue.
#include "runtime/blocks/SM_CNC/cnc_layout.hpp"

#include "st/SM_CNC/SMC_APPENDOBJ.h"
#include "st/SM_CNC/SMC_DELETEOBJ.h"
#include "st/SM_CNC/SMC_GETCOUNT.h"
#include "st/SM_CNC/SMC_GETOBJ.h"
#include "st/SM_CNC/SMC_GETOBJFROMEND.h"
#include "st/SM_CNC/SMC_GetHistoryCount.h"
#include "st/SM_CNC/SMC_GetLastObj.h"
#include "st/SM_CNC/SMC_GetObjFromHistory.h"
#include "st/SM_CNC/SMC_OutQueueInit.h"
#include "st/SM_CNC/SMC_OutQueueIsSyncing.h"
#include "st/SM_CNC/SMC_OutQueue_IsFull.h"
#include "st/SM_CNC/SMC_RESTOREQUEUE.h"
#include "st/SM_CNC/SMC_SetObj.h"
#include "st/SM_CNC/SMC_SetQueueCapacity.h"
#include "st/SM_CNC/SMC_ShowQueue.h"

namespace cnc = stride::cnc;

static ::stride::UINT shortened(uint32_t count) {
  return static_cast<::stride::UINT>(count < UINT16_MAX ? count : UINT16_MAX);
}

namespace st::SM_CNC {

SMC_GEOINFO *SMC_APPENDOBJ(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *POQ, SMC_GEOINFO *PGI) {
  return cnc::declared(cnc::append(cnc::queueOf(POQ), cnc::objectOf(PGI)));
}

::stride::BOOL SMC_DELETEOBJ(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *POQ, ::stride::UINT N) {
  return cnc::removeAt(cnc::queueOf(POQ), N);
}

::stride::UINT SMC_GETCOUNT(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *POQ) {
  return shortened(cnc::countOf(cnc::queueOf(POQ)));
}

SMC_GEOINFO *SMC_GETOBJ(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *POQ, ::stride::UINT N) {
  return cnc::declared(cnc::objectAt(cnc::queueOf(POQ), N));
}

SMC_GEOINFO *SMC_GETOBJFROMEND(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *POQ, ::stride::UINT N) {
  return cnc::declared(cnc::objectFromEnd(cnc::queueOf(POQ), N));
}

SMC_GEOINFO *SMC_GetLastObj(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *poq) {
  return cnc::declared(cnc::objectFromEnd(cnc::queueOf(poq), 0));
}

::stride::BOOL SMC_SetObj(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *poq, ::stride::UINT N,
                          SMC_GEOINFO *pgi) {
  return cnc::replaceAt(cnc::queueOf(poq), N, cnc::objectOf(pgi));
}

::stride::BOOL SMC_RESTOREQUEUE(::stride::Ctx & /*ctx__*/, ::stride::BOOL Enable,
                                SMC_OUTQUEUE *POQ) {
  return Enable != 0 && cnc::restore(cnc::queueOf(POQ));
}

::stride::BOOL SMC_OutQueueInit(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *poq) {
  return cnc::clear(cnc::queueOf(poq));
}

::stride::BOOL SMC_SetQueueCapacity(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *poq,
                                    ::stride::UDINT nSizeInBytes) {
  return cnc::setSize(cnc::queueOf(poq), nSizeInBytes);
}

::stride::BOOL SMC_OutQueue_IsFull(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE &oq) {
  return cnc::isFull(cnc::queueOf(&oq));
}

::stride::BOOL SMC_OutQueueIsSyncing(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *poq) {
  return cnc::isSyncing(cnc::queueOf(poq));
}

::stride::UINT SMC_GetHistoryCount(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *poq) {
  return shortened(cnc::historyOf(cnc::queueOf(poq)));
}

SMC_GEOINFO *SMC_GetObjFromHistory(::stride::Ctx & /*ctx__*/, SMC_OUTQUEUE *poq, ::stride::DINT N) {
  const cnc::Queue *queue = cnc::queueOf(poq);
  return cnc::declared(N < 0 ? cnc::objectOfHistory(queue, ~static_cast<uint32_t>(N))
                             : cnc::objectAt(queue, static_cast<uint32_t>(N)));
}

void SMC_ShowQueue::body__(::stride::Ctx & /*ctx__*/) {
  const cnc::Queue *queue = bEnable != 0 ? cnc::queueOf(poq) : nullptr;
  iNumberElements = shortened(cnc::countOf(queue));
  iMaxNumberElements = shortened(cnc::capacityOf(queue));
  uint32_t n = 0;
  for (SMC_GEOINFO *&object : apGI.v)
    object = cnc::declared(cnc::objectAt(queue, n++));
}

} // namespace st::SM_CNC
