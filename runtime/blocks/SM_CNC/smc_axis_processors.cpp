// SMC_RecomputeABCSlopes, SMC_SmoothAddAxes, SMC_SmoothBSpline, SMC_LimitDynamics.
#include "runtime/blocks/SM_CNC/stream_block.hpp"
#include "runtime/numeric/cnc/processors/abc_slopes.hpp"
#include "runtime/numeric/cnc/processors/limit_dynamics.hpp"
#include "runtime/numeric/cnc/processors/smooth_add_axes.hpp"
#include "runtime/numeric/cnc/processors/smooth_bspline.hpp"

#include "st/SM_CNC/SMC_ABC_SLOPES_AT_STOP.h"
#include "st/SM_CNC/SMC_LimitDynamics.h"
#include "st/SM_CNC/SMC_RecomputeABCSlopes.h"
#include "st/SM_CNC/SMC_SMOOTHBSPLINE_MODE.h"
#include "st/SM_CNC/SMC_SmoothAddAxes.h"
#include "st/SM_CNC/SMC_SmoothBSpline.h"

namespace cnc = stride::cnc;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

cnc::KnotSpacing spacingOf(int16_t mode) noexcept {
  switch (mode) {
  case ::st::SM_CNC::SMC_SMOOTHBSPLINE_MODE__SMC_SMOOTHBSPLINE_CHORDLENGTH:
    return cnc::KnotSpacing::ChordLength;
  case ::st::SM_CNC::SMC_SMOOTHBSPLINE_MODE__SMC_SMOOTHBSPLINE_CENTRIPETAL:
    return cnc::KnotSpacing::Centripetal;
  default:
    return cnc::KnotSpacing::Uniform;
  }
}

} // namespace

void st::SM_CNC::SMC_RecomputeABCSlopes::body__(::stride::Ctx & /*ctx__*/) {
  cnc::AbcSlopes &slopes = cnc::processorOf<cnc::AbcSlopes>(*this);
  slopes.angle = dAngleTol * kDegree;
  slopes.linearAtStops = modeAtStop == SMC_ABC_SLOPES_AT_STOP__SET_LINEAR;
  cnc::runProcessor<cnc::AbcSlopes>(*this);
}

void st::SM_CNC::SMC_SmoothAddAxes::body__(::stride::Ctx & /*ctx__*/) {
  auto &state = cnc::processorStateOf<cnc::SmoothAddAxes>(*this);
  state.processor.part = dSmoothingPart;
  cnc::runProcessor<cnc::SmoothAddAxes>(*this);
  cnc::settle(state.processor, cnc::queueOf(&Queue), bBusy != 0);
}

void st::SM_CNC::SMC_SmoothBSpline::body__(::stride::Ctx & /*ctx__*/) {
  constexpr uint32_t kMostBit = 31;
  cnc::SmoothBSpline &spline = cnc::processorOf<cnc::SmoothBSpline>(*this);
  spline.unknownFeature = wFeatureFlag > kMostBit;
  spline.features = wFeatureFlag == 0 || wFeatureFlag > kMostBit ? 0 : 1U << wFeatureFlag;
  spline.spacing = spacingOf(eMode);
  cnc::runProcessor<cnc::SmoothBSpline>(*this);
}

void st::SM_CNC::SMC_LimitDynamics::body__(::stride::Ctx & /*ctx__*/) {
  cnc::LimitDynamics &limit = cnc::processorOf<cnc::LimitDynamics>(*this);
  limit.velocity = dMaxVel;
  limit.acceleration = dMaxAccDec;
  limit.axes = wAxis;
  cnc::runProcessor<cnc::LimitDynamics>(*this);
}
