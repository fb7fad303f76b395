#include "runtime/cam/cam_ref.hpp"

#include "st/SM_Error/SMC_ERROR.h"

namespace stride::cam {
namespace {

Scale scaleOf(float tableMin, float tableMax, float editorMin, float editorMax) noexcept {
  return {tableMin, editorMin,
          (double{editorMax} - double{editorMin}) / (double{tableMax} - double{tableMin})};
}

/// Behind `numbers` numbers the table's scaling follows, aligned as a REAL is.
TableScaling scalingOf(const CamRef &cam, int64_t numbers, int64_t size) noexcept {
  const int64_t offset = (numbers * size + 3) / 4 * 4;
  TableScaling scaling;
  __builtin_memcpy(&scaling, cam.pce + offset, sizeof scaling);
  return scaling;
}

} // namespace

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
  if (curve.form == Form::EvenTable || curve.form == Form::PairTable) {
    const int32_t size = sizeOf(curve.element);
    if (size == 0)
      return curve;
    const int64_t numbers =
        curve.form == Form::PairTable ? 2 * int64_t{cam.nElements} : cam.nElements;
    const TableScaling scaling = scalingOf(cam, numbers, size);
    curve.master = scaleOf(scaling.tableMasterMin, scaling.tableMasterMax, scaling.editorMasterMin,
                           scaling.editorMasterMax);
    curve.slave = scaleOf(scaling.tableSlaveMin, scaling.tableSlaveMax, scaling.editorSlaveMin,
                          scaling.editorSlaveMax);
    curve.open = curve.form == Form::EvenTable && (cam.byCompatibilityMode & 1U) != 0;
    curve.rise = cam.fRise;
  }
  curve.data = cam.pce;
  return curve;
}

int16_t checkCam(const CamRef &cam) noexcept {
  switch (checkCurve(curveOf(cam))) {
  case CurveError::None:
    return ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
  case CurveError::Scaling:
    return ::st::SM_Error::SMC_ERROR__SMC_CI_SCALING_INCORRECT;
  case CurveError::NoCurve:
    break;
  }
  return ::st::SM_Error::SMC_ERROR__SMC_NO_CAM_REF_TYPE;
}

} // namespace stride::cam
