// What is computed from the geometry of one path object.
#include "runtime/blocks/SM_CNC/cnc_layout.hpp"
#include "runtime/numeric/cnc/object_shape.hpp"

#include "st/SM_CNC/SMC_CalcEndPnt.h"
#include "st/SM_CNC/SMC_CalcLengthGeo.h"
#include "st/SM_CNC/SMC_CalcStartPnt.h"

namespace cnc = stride::cnc;

namespace {

using Calculation = cnc::ShapeError (*)(cnc::PathObject &) noexcept;

bool calculate(Calculation calculation, st::SM_CNC::SMC_GEOINFO *object) {
  return object != nullptr && calculation(*cnc::objectOf(object)) == cnc::ShapeError::None;
}

} // namespace

namespace st::SM_CNC {

::stride::BOOL SMC_CalcEndPnt(::stride::Ctx & /*ctx__*/, SMC_GEOINFO *pg) {
  return calculate(cnc::calculateEnd, pg);
}

::stride::BOOL SMC_CalcStartPnt(::stride::Ctx & /*ctx__*/, SMC_GEOINFO *pg) {
  return calculate(cnc::calculateStart, pg);
}

::stride::BOOL SMC_CalcLengthGeo(::stride::Ctx & /*ctx__*/, SMC_GEOINFO *pg) {
  return calculate(cnc::calculateLength, pg);
}

} // namespace st::SM_CNC
