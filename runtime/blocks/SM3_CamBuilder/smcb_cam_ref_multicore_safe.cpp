// SMCB.CAM_REF_MULTICORE_SAFE: a cam that crosses from one task to others.
#include "runtime/blocks/SM3_CamBuilder/smcb_cam_builder.hpp"

#include "runtime/axis/cam/cam_ref.hpp"

#include "st/SM_Error/SMC_ERROR.h"

namespace {

namespace cam = ::stride::cam;
using SafeCam = ::st::SM3_CamBuilder::CAM_REF_MULTICORE_SAFE;

} // namespace

::st::SM_Error::SMC_ERROR SafeCam::SetCamRef(::stride::Ctx & /*ctx__*/,
                                             ::st::SM_DriveBasic::MC_CAM_REF &camRef) {
  const cam::Curve curve = cam::curveOf(camRef);
  if (curve.form != cam::Form::Segments || cam::checkCurve(curve) != cam::CurveError::None)
    return ::st::SM_Error::SMC_ERROR__SMC_NO_CAM_REF_TYPE;
  if (curve.count > ::stride::motion::mostSegments(nMost))
    return ::st::SM_Error::SMC_ERROR__SMC_CB_TOO_MANY_SEGMENTS;
  cam::SharedWriter writer(::stride::motion::sharedCam(*this));
  if (!writer.isOpen())
    return ::st::SM_Error::SMC_ERROR__SMC_CB_BUSY;
  for (int32_t i = 0; i < curve.count; ++i)
    writer.put(i, static_cast<const cam::Segment *>(curve.data)[i]);
  writer.finish({curve.start, curve.end, curve.count});
  return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
}

::st::SM_Error::SMC_ERROR SafeCam::GetCopy(::stride::Ctx & /*ctx__*/,
                                           ::st::SM_DriveBasic::MC_CAM_REF &camRef,
                                           ::st::SM_DriveBasic::SMC_CAM_SEGMENT *pCamSegments,
                                           ::stride::ULINT arraySize) {
  constexpr uint64_t kMost = 32767; // nElements is an INT
  const uint64_t fitting = arraySize / sizeof(cam::Segment);
  const auto capacity = static_cast<int64_t>(pCamSegments == nullptr ? 0
                                             : fitting > kMost       ? kMost
                                                                     : fitting);
  cam::SharedHead head;
  switch (cam::readShared(::stride::motion::sharedCam(*this),
                          reinterpret_cast<cam::Segment *>(pCamSegments), capacity, head)) {
  case cam::SharedResult::None:
    return ::st::SM_Error::SMC_ERROR__SMC_CB_NO_CAM;
  case cam::SharedResult::TooSmall:
    return ::st::SM_Error::SMC_ERROR__SMC_CB_CAM_REF_TOO_SMALL;
  case cam::SharedResult::Overtaken:
    camRef.nElements = 0;
    return ::st::SM_Error::SMC_ERROR__SMC_CB_BUSY;
  case cam::SharedResult::Good:
    break;
  }
  camRef.pce = reinterpret_cast<decltype(camRef.pce)>(pCamSegments);
  camRef.nMaxElements = static_cast<int16_t>(capacity);
  ::stride::motion::refer(camRef, head);
  return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
}
