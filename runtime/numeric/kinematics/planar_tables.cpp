// Tables of portals and of arms whose joints turn about upright axes.
#include "runtime/numeric/kinematics/model_tables.hpp"
#include "runtime/numeric/kinematics/planar_arms.hpp"
#include "runtime/numeric/kinematics/portals.hpp"

namespace stride::kinematics {

constexpr ArmTable kGantry2Table = makeArmTable<Gantry2, true>();
constexpr ArmTable kGantry3Table = makeArmTable<Gantry3, true>();
constexpr ArmTable kBeltPortalTable = makeArmTable<BeltPortal, true>();
constexpr ArmTable kPolarTable = makeArmTable<Polar, true>();
constexpr ArmTable kPolarZTable = makeArmTable<PolarZ, true>();
constexpr ArmTable kScara2Table = makeArmTable<Scara2, true>();
constexpr ArmTable kScara2ZTable = makeArmTable<Scara2Z, true>();
constexpr ArmTable kScara3Table = makeArmTable<Scara3, true>();
constexpr ArmTable kScara3ZTable = makeArmTable<Scara3Z, true>();

} // namespace stride::kinematics
