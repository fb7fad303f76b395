// SMC_RotateQueue2D, SMC_TranslateQueue3D and SMC_ScaleQueue3D.
#include "runtime/blocks/SM_CNC/stream_block.hpp"
#include "runtime/numeric/cnc/processors/transform.hpp"

#include "st/SM_CNC/SMC_RotateQueue2D.h"
#include "st/SM_CNC/SMC_ScaleQueue3D.h"
#include "st/SM_CNC/SMC_TranslateQueue3D.h"

namespace {

namespace cnc = ::stride::cnc;

/// No position in a queue: none of it has been looked at.
constexpr uint32_t kNothing = UINT32_MAX;

template <class Block> void showError(Block &block, cnc::StreamError error) noexcept {
  block.bError = static_cast<::stride::BOOL>(error != cnc::StreamError::None);
  block.wErrorID = static_cast<int16_t>(error);
}

/// As V2.3: on the objects where they are.
template <class Processor, class Block> void runInPlace(Block &block) noexcept {
  cnc::TransformPath &path = cnc::processorOf<Processor>(block);
  block.poqDataOut = block.poqDataIn;
  block.bDone = block.bBusy = 0;
  showError(block, cnc::StreamError::None);
  if (block.bEnable == 0 && block.bReset == 0)
    return;
  cnc::Queue *const queue = cnc::queueOf(block.poqDataIn);
  if (cnc::checkQueue(queue) != cnc::QueueError::None) {
    showError(block, cnc::StreamError::NoQueue);
    return;
  }
  if (block.bTaken == 0 || block.bReset != 0 || cnc::countOf(queue) == 0) {
    path.used = path.wanted;
    if (block.bReset != 0 || cnc::countOf(queue) == 0)
      block.nSeen = queue->writePosition;
    else
      block.nSeen = kNothing;
    block.bTaken = 1;
  }
  if (block.bEnable == 0 || block.bReset != 0)
    return;
  if (!cnc::isUsable(path.used)) {
    showError(block, cnc::StreamError::InvalidParameter);
    block.bTaken = 0;
    return;
  }
  if (block.nSeen != queue->writePosition)
    queue->generator = Processor::kGenerator;
  cnc::transformInPlace(queue, path.used, block.nSeen);
}

template <class Processor, class Block>
void run(Block &block, cnc::TransformKind kind, const cnc::Vector3 &value) noexcept {
  cnc::processorOf<Processor>(block).wanted = {kind, value};
  if (block.pbyBufferOutQueue != nullptr)
    cnc::runProcessor<Processor>(block);
  else
    runInPlace<Processor>(block);
}

} // namespace

void st::SM_CNC::SMC_RotateQueue2D::body__(::stride::Ctx & /*ctx__*/) {
  run<cnc::RotatePath>(*this, cnc::TransformKind::Rotate, {dPhi, 0.0, 0.0});
}

void st::SM_CNC::SMC_TranslateQueue3D::body__(::stride::Ctx & /*ctx__*/) {
  run<cnc::TranslatePath>(*this, cnc::TransformKind::Translate, {vec.dX, vec.dY, vec.dZ});
}

void st::SM_CNC::SMC_ScaleQueue3D::body__(::stride::Ctx & /*ctx__*/) {
  run<cnc::ScalePath>(*this, cnc::TransformKind::Scale, {fScaleFaktor, 0.0, 0.0});
}
