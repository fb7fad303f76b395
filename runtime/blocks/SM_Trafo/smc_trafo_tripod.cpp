// SMC_TRAFO_Tripod, SMC_TRAFOF_Tripod.
#include "runtime/numeric/kinematics/parallel.hpp"
#include "runtime/numeric/quarter_turns.hpp"

#include "st/SM_DriveBasic/AXIS_REF.h"
#include "st/SM_Trafo/SMC_TRAFOF_Tripod.h"
#include "st/SM_Trafo/SMC_TRAFO_Tripod.h"

namespace kin = ::stride::kinematics;

namespace {

/// Of either block.
template <class Block> kin::TripodLinear tripodOf(const Block &block) {
  return {.outerRadius = block.dOuterRadius,
          .innerRadius = block.dInnerRadius,
          .rod = block.dLength,
          .lean = 0.0,
          .firstAngle = block.dRotationOffset * ::stride::numeric::kDegree};
}

template <class Block> bool hasRings(const Block &block) {
  return block.dOuterRadius > 0 && block.dInnerRadius >= 0;
}

} // namespace

void st::SM_Trafo::SMC_TRAFO_Tripod::body__(::stride::Ctx & /*ctx__*/) {
  double down[3];
  const bool works =
      hasRings(*this) && tripodOf(*this).inverse(kin::unturned<double>({pi.dX, pi.dY, pi.dZ}), {},
                                                 nullptr, down) == kin::Outcome::Done;
  bError = works ? 0 : 1;
  if (!works)
    return;
  dA = dOffsetA - down[0];
  dB = dOffsetB - down[1];
  dC = dOffsetC - down[2];
}

void st::SM_Trafo::SMC_TRAFOF_Tripod::body__(::stride::Ctx & /*ctx__*/) {
  const double down[] = {dOffsetA - DriveA->fActPosition, dOffsetB - DriveB->fActPosition,
                         dOffsetC - DriveC->fActPosition};
  kin::Frame<double> ring;
  const bool works = hasRings(*this) && tripodOf(*this).forward(down, ring) == kin::Outcome::Done;
  bError = works ? 0 : 1;
  if (!works)
    return;
  dx = ring.place(0);
  dy = ring.place(1);
  dz = ring.place(2);
  dnx = dx / dOuterRadius;
  dny = dy / dOuterRadius;
  dRatioInnerOuter = dInnerRadius / dOuterRadius;
  const double half = dDistance / 2 / dOuterRadius;
  for (int column = 0; column < 3; ++column) {
    const kin::Vector<double> out = kin::thirdOfRing<double>(tripodOf(*this).firstAngle, column);
    for (int strut = 0; strut < 2; ++strut) {
      const int at = 2 * column + strut;
      const double aside = strut == 0 ? -half : half;
      adnxo.v[at] = out(0) - aside * out(1);
      adnyo.v[at] = out(1) + aside * out(0);
      adnxi.v[at] = dnx + dRatioInnerOuter * out(0) - aside * out(1);
      adnyi.v[at] = dny + dRatioInnerOuter * out(1) + aside * out(0);
    }
  }
}
