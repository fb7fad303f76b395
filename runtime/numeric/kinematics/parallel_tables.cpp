// Tables of parallel kinematics.
#include "runtime/numeric/kinematics/model_tables.hpp"
#include "runtime/numeric/kinematics/parallel.hpp"

namespace stride::kinematics {

constexpr ArmTable kTripodLinearTable = makeArmTable<TripodLinear, true>();
constexpr ArmTable kTripodRotaryTable = makeArmTable<TripodRotary, true>();
constexpr ArmTable kBipodRotaryTable = makeArmTable<BipodRotary, true>();

} // namespace stride::kinematics
