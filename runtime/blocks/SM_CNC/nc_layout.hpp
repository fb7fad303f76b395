// SMC_GSentenceQueue as the numerics see it: the same bytes. Free of the C++ standard library:
// linked into every application.
#ifndef STRIDE_RUNTIME_BLOCKS_SM_CNC_NC_LAYOUT_HPP
#define STRIDE_RUNTIME_BLOCKS_SM_CNC_NC_LAYOUT_HPP

#include "runtime/blocks/same_place.hpp"
#include "runtime/numeric/nc/sentence_queue.hpp"

#include "st/SM_CNC/SMC_GSentenceQueue.h"

namespace stride::nc {

namespace layout {

using Declared = ::st::SM_CNC::SMC_GSentenceQueue;

static_assert(sizeof(SentenceQueue) == sizeof(Declared));
STRIDE_SAME_PLACE(SentenceQueue, variables, Declared, pvl);
STRIDE_SAME_PLACE(SentenceQueue, resume.offset, Declared, liResume);
STRIDE_SAME_PLACE(SentenceQueue, resume.line, Declared, diResumeLine);
STRIDE_SAME_PLACE(SentenceQueue, resume.state, Declared, byResumeState);
STRIDE_SAME_PLACE(SentenceQueue, read, Declared, udiRead);
STRIDE_SAME_PLACE(SentenceQueue, count, Declared, udiCount);
STRIDE_SAME_PLACE(SentenceQueue, error, Declared, iError);
STRIDE_SAME_PLACE(SentenceQueue, request, Declared, byRequest);
STRIDE_SAME_PLACE(SentenceQueue, whole, Declared, bWhole);
STRIDE_SAME_PLACE(SentenceQueue, begun, Declared, bBegun);
STRIDE_SAME_PLACE(SentenceQueue, name, Declared, sName);
STRIDE_SAME_PLACE(SentenceQueue, title, Declared, sTitle);
STRIDE_SAME_PLACE(SentenceQueue, bytes, Declared, abySentences);

} // namespace layout

inline SentenceQueue &sentencesOf(::st::SM_CNC::SMC_GSentenceQueue &queue) noexcept {
  return reinterpret_cast<SentenceQueue &>(queue);
}

} // namespace stride::nc

#endif // STRIDE_RUNTIME_BLOCKS_SM_CNC_NC_LAYOUT_HPP
