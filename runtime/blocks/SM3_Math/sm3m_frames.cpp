// SMC_Frame_Mult and the angles of orientations.
#include "runtime/blocks/kinematic_frames.hpp"

#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Math/SMC_Frame_Mult.h"
#include "st/SM3_Math/SMC_Matrix3_ToRollPitchYaw_deg.h"
#include "st/SM3_Math/SMC_Matrix3_ToYawPitchRoll.h"
#include "st/SM3_Math/SMC_Matrix3_ToZYZ_deg.h"

namespace kin = ::stride::kinematics;
using ::stride::numeric::kDegree;

namespace {

/// [°]; false, and zeros, where an element is no number.
bool anglesOf(kin::Convention convention, const ::st::SM3_Math::SMC_Matrix3 &matrix,
              kin::Angles &angles) {
  angles = {0, 0, 0};
  const kin::Matrix<double> turn = kin::fromSt(matrix);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      if (!::stride::exact::isfinite(turn(row, column)))
        return false;
  angles = kin::anglesOf(convention, turn);
  return true;
}

} // namespace

::stride::BOOL st::SM3_Math::SMC_Frame_Mult(::stride::Ctx & /*ctx__*/, SMC_Frame &frDst,
                                            SMC_Frame &frLhs, SMC_Frame &frRhs) {
  kin::toSt(kin::fromSt(frLhs) * kin::fromSt(frRhs), frDst);
  return 1;
}

::stride::BOOL st::SM3_Math::SMC_Matrix3_ToZYZ_deg(::stride::Ctx & /*ctx__*/, SMC_Matrix3 &mR,
                                                   ::stride::LREAL &dA_deg, ::stride::LREAL &dB_deg,
                                                   ::stride::LREAL &dC_deg) {
  kin::Angles angles;
  const bool works = anglesOf(kin::Convention::Zyz, mR, angles);
  dA_deg = angles.a;
  dB_deg = angles.b;
  dC_deg = angles.c;
  return works ? 1 : 0;
}

::stride::BOOL st::SM3_Math::SMC_Matrix3_ToRollPitchYaw_deg(::stride::Ctx & /*ctx__*/,
                                                            SMC_Matrix3 &mR, ::stride::LREAL &dRoll,
                                                            ::stride::LREAL &dPitch,
                                                            ::stride::LREAL &dYaw) {
  kin::Angles angles;
  const bool works = anglesOf(kin::Convention::Zyx, mR, angles);
  dRoll = angles.c;
  dPitch = angles.b;
  dYaw = angles.a;
  return works ? 1 : 0;
}

::stride::BOOL st::SM3_Math::SMC_Matrix3_ToYawPitchRoll(::stride::Ctx & /*ctx__*/, SMC_Matrix3 &mR,
                                                        ::stride::LREAL &dRoll_rad,
                                                        ::stride::LREAL &dPitch_rad,
                                                        ::stride::LREAL &dYaw_rad) {
  kin::Angles angles;
  const bool works = anglesOf(kin::Convention::Zyx, mR, angles);
  dRoll_rad = angles.c * kDegree;
  dPitch_rad = angles.b * kDegree;
  dYaw_rad = angles.a * kDegree;
  return works ? 1 : 0;
}
