#include "runtime/axis/cam/cam_ref.hpp"

#include "st/SM_Error/SMC_ERROR.h"

namespace stride::cam {
Curve curveOf(const CamRef &cam) noexcept {
  Curve curve;
  curve.start = cam.xStart;
  curve.end = cam.xEnd;
  curve.form = static_cast<Form>(cam.byType);
  curve.element = static_cast<Element>(cam.byVarType);
  curve.cubic = cam.byInterpolationQuality == 3;
  curve.count = cam.nElements;
  if (cam.wCamStructID != kCamStructId || cam.pce == nullptr || cam.nElements <= 0)
    return curve;
  curve.open = curve.form == Form::EvenTable && (cam.byCompatibilityMode & 1U) != 0;
  curve.rise = curve.open ? cam.fRise : 0.0;
  attachElements(curve, cam.pce);
  return curve;
}

int16_t errorOf(CurveError error) noexcept {
  switch (error) {
  case CurveError::None:
    return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
  case CurveError::Scaling:
    return ::st::SM_Error::SMC_ERROR__SMC_CI_SCALING_INCORRECT;
  case CurveError::NoCurve:
    break;
  }
  return ::st::SM_Error::SMC_ERROR__SMC_NO_CAM_REF_TYPE;
}

int16_t checkCam(const CamRef &cam) noexcept { return errorOf(checkCurve(curveOf(cam))); }

} // namespace stride::cam
