// PCS_1 and PCS_2 on belts and tables: where they are, and movements in them.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_CARRIERS_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_CARRIERS_HPP

#include "runtime/blocks/SM3_Robotics/requests.hpp"

namespace stride::robotics {

/// The systems that can be on a carrier, PCS_1 and PCS_2.
inline constexpr int32_t kCarriers = 2;

/// Which of them a system is, 1 or 2; 0: it is none of these, or does not move.
int32_t carrierOf(const GroupRef &group, int16_t system) noexcept;

/// The SMC_COORD_SYSTEM of one of them, 1 or 2.
int16_t systemNumber(int32_t carrier) noexcept;

/// Looks where the carriers are in this cycle; other groups whose tools are carriers go on before.
void lookAtCarriers(Ctx &ctx, GroupRef &group);

/// How far a carrier (1 or 2) is since its system is tracked, and how it moves. [u], [°]
motion::State stateOfCarrier(const GroupRef &group, int32_t carrier) noexcept;

/// The system on it, in the machine.
group::MovingSystem systemOn(const GroupRef &group, int32_t carrier);

/// Where a moving system is in WCS now.
kinematics::Frame<double> systemInWorld(const GroupRef &group, int32_t carrier);

/// Puts PCS_1 or PCS_2 on a carrier, from now on. An SMC_ERROR.
int16_t setCarrier(GroupRef &group, int16_t system,
                   const ::st::SM3_Robotics::SMC_GROUP_CARRIER &on);

/// Puts PCS_1 or PCS_2 on another group's tool, from now on. An SMC_ERROR.
int16_t setMaster(Ctx &ctx, GroupRef &group, int16_t system, GroupRef *master,
                  const ::st::SM3_Robotics::MC_COORD_REF &onTool);

/// Whether movements are in PCS_1 or PCS_2, or will be.
bool isInUse(const GroupRef &group, int16_t system) noexcept;

/// In which moving system (1 or 2) a request's path is; 0: in the machine's.
int32_t carrierOf(const GroupRef &group, const Request &request) noexcept;

/// The path of the movements that come is in a moving system, or, with 0, in the machine's.
void changeSystem(GroupRef &group, const GroupArm &arm, int32_t carrier, const Request &request);

/// The leg of a movement along a path that moves, or begins where one moved. An SMC_ERROR.
int16_t carriedLeg(GroupRef &group, const GroupArm &arm, const Request &request,
                   const group::MoreAxes &more, group::Leg &leg);

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_CARRIERS_HPP
