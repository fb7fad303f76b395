// Transformations between the coordinates of a CNC program and those of the machine.
#include "runtime/blocks/SM_CNC/cnc_layout.hpp"
#include "runtime/numeric/cnc/orientation.hpp"

#include "st/SM_CNC/SMC_PosInfo_Trf_Apply.h"
#include "st/SM_CNC/SMC_PosInfo_Trf_Inverse.h"

namespace cnc = stride::cnc;
using cnc::Orientation;
using cnc::Position;
using cnc::Vector3;

namespace {

cnc::Turn turnOf(const Position &transformation, Orientation orientation) noexcept {
  const double *const angle = transformation.coordinate + cnc::kAxisA;
  return orientation == Orientation::Axes
             ? cnc::kNoTurn
             : cnc::turnBy(orientation, {angle[0], angle[1], angle[2]});
}

Vector3 shiftOf(const Position &transformation) noexcept {
  const double *const shift = transformation.coordinate;
  return {shift[cnc::kAxisX], shift[cnc::kAxisY], shift[cnc::kAxisZ]};
}

} // namespace

namespace st::SM_CNC {

::stride::BOOL SMC_PosInfo_Trf_Inverse(::stride::Ctx & /*ctx__*/, SMC_POSINFO &piOut,
                                       SMC_POSINFO piIn, int16_t eOriConv) {
  const Orientation orientation = cnc::orientationOf(eOriConv);
  const auto forth = __builtin_bit_cast(Position, piIn);
  const cnc::Turn turn = cnc::inverse(turnOf(forth, orientation));
  auto back = __builtin_bit_cast(Position, piOut);
  for (int32_t axis = cnc::kAxisA; axis < cnc::kAxes; ++axis)
    back.coordinate[axis] = -forth.coordinate[axis];
  if (orientation != Orientation::Axes) {
    double angle[3];
    cnc::anglesOf(orientation, turn, {0.0, 0.0, 0.0}, angle);
    for (int32_t i = 0; i < 3; ++i)
      back.coordinate[cnc::kAxisA + i] = angle[i];
  }
  const Vector3 shift = cnc::apply(turn, shiftOf(forth)) * -1.0;
  back.coordinate[cnc::kAxisX] = shift.x;
  back.coordinate[cnc::kAxisY] = shift.y;
  back.coordinate[cnc::kAxisZ] = shift.z;
  __builtin_memcpy(&piOut, &back, sizeof piOut);
  return 1;
}

::stride::BOOL SMC_PosInfo_Trf_Apply(::stride::Ctx & /*ctx__*/, SMC_VECTOR3D &vDst,
                                     SMC_POSINFO piTrf, SMC_VECTOR3D vSrc, int16_t eOriConv) {
  const auto transformation = __builtin_bit_cast(Position, piTrf);
  const cnc::Turn turn = turnOf(transformation, cnc::orientationOf(eOriConv));
  const Vector3 place =
      shiftOf(transformation) + cnc::apply(turn, __builtin_bit_cast(Vector3, vSrc));
  vDst = __builtin_bit_cast(SMC_VECTOR3D, place);
  return 1;
}

} // namespace st::SM_CNC
