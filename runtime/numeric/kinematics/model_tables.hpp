// The tables of all arms and hands, for tableOf.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_MODEL_TABLES_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_MODEL_TABLES_HPP

#include "runtime/numeric/kinematics/tables.hpp"

namespace stride::kinematics {

// planar_tables.cpp
extern const ArmTable kGantry2Table;
extern const ArmTable kGantry3Table;
extern const ArmTable kBeltPortalTable;
extern const ArmTable kPolarTable;
extern const ArmTable kPolarZTable;
extern const ArmTable kScara2Table;
extern const ArmTable kScara2ZTable;
extern const ArmTable kScara3Table;
extern const ArmTable kScara3ZTable;
// arm_tables.cpp
extern const ArmTable kArmRrrTable;
extern const ArmTable kPalletiserTable;
extern const ArmTable kOffsetWristArmTable;
// parallel_tables.cpp
extern const ArmTable kTripodLinearTable;
extern const ArmTable kTripodRotaryTable;
extern const ArmTable kBipodRotaryTable;
// hand_tables.cpp
extern const ArmTable kFiveAxisTableTable;
extern const HandTable kTurningAxisTable;
extern const HandTable kWrist2Table;
extern const HandTable kWrist3Table;

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_MODEL_TABLES_HPP
