// What a frame means, in words.
#ifndef STRIDE_DRIVERS_CAN_TOOL_FRAME_TEXT_HPP
#define STRIDE_DRIVERS_CAN_TOOL_FRAME_TEXT_HPP

#include "drivers/can/plan/pdo_plan.hpp"
#include "drivers/can/port/frame.hpp"
#include "runtime/bus/group_setup.hpp"

#include <span>
#include <string>
#include <vector>

namespace stride::can::tool {

/// A drive whose PDOs are known.
struct KnownDrive {
  std::string name;
  DrivePlan plan;
};

/// All nodes of these groups, as far as they can be at their buses.
std::vector<KnownDrive> knownNodes(std::span<const bus::GroupSetup> groups);

/// "TPDO1 of X: statusword 0627h operation enabled, position 12345". By the predefined connection
/// set; PDOs by the drives' plans. Whatever the frame is, there is a text.
std::string describe(const Frame &frame, const std::vector<KnownDrive> &drives);

/// "0.001234  181  [6] 27 06 39 30 00 00".
std::string line(const Frame &frame, int64_t timeNs);

} // namespace stride::can::tool

#endif
