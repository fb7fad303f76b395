// The objects that every CANopen node has. [CiA 301, communication profile area]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_COMMUNICATION_ROWS_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_COMMUNICATION_ROWS_HPP

#include "drivers/can/simulation/canopen_node.hpp"

#include <vector>

namespace stride::can::simulation {

/// Those, and the device's own. Texts are the setup's, which must stay where they are.
std::vector<ObjectRow> allRows(const NodeSetup &setup, const DeviceRows &device);

/// What 1010h and 1011h are told, so that nobody stores or restores by mistake.
inline constexpr uint32_t kSave = 0x65766173;
inline constexpr uint32_t kLoad = 0x64616F6C;

} // namespace stride::can::simulation

#endif
