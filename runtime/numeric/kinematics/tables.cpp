#include "runtime/numeric/kinematics/tables.hpp"

#include "runtime/numeric/kinematics/model_tables.hpp"

namespace stride::kinematics {

const ArmTable &tableOf(ArmKind kind) {
  switch (kind) {
  case ArmKind::Gantry2:
    return kGantry2Table;
  case ArmKind::BeltPortal:
    return kBeltPortalTable;
  case ArmKind::Polar:
    return kPolarTable;
  case ArmKind::PolarZ:
    return kPolarZTable;
  case ArmKind::Scara2:
    return kScara2Table;
  case ArmKind::Scara2Z:
    return kScara2ZTable;
  case ArmKind::Scara3:
    return kScara3Table;
  case ArmKind::Scara3Z:
    return kScara3ZTable;
  case ArmKind::ArmRrr:
    return kArmRrrTable;
  case ArmKind::Palletiser:
    return kPalletiserTable;
  case ArmKind::OffsetWristArm:
    return kOffsetWristArmTable;
  case ArmKind::FiveAxisTable:
    return kFiveAxisTableTable;
  case ArmKind::TripodLinear:
    return kTripodLinearTable;
  case ArmKind::TripodRotary:
    return kTripodRotaryTable;
  case ArmKind::BipodRotary:
    return kBipodRotaryTable;
  case ArmKind::Gantry3:
  case ArmKind::None:
  case ArmKind::Count:
    break;
  }
  return kGantry3Table;
}

const HandTable &tableOf(HandKind kind) {
  switch (kind) {
  case HandKind::Wrist2:
    return kWrist2Table;
  case HandKind::Wrist3:
    return kWrist3Table;
  case HandKind::TurningAxis:
  case HandKind::None:
  case HandKind::Count:
    break;
  }
  return kTurningAxisTable;
}

} // namespace stride::kinematics
