// Tables of articulated arms.
#include "runtime/numeric/kinematics/arms.hpp"
#include "runtime/numeric/kinematics/model_tables.hpp"

namespace stride::kinematics {

constexpr ArmTable kArmRrrTable = makeArmTable<ArmRrr, false>();
constexpr ArmTable kPalletiserTable = makeArmTable<Palletiser, true>();
constexpr ArmTable kOffsetWristArmTable = makeArmTable<OffsetWristArm, false>();

} // namespace stride::kinematics
