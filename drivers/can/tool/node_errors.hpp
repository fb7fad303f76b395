// The errors of a node, for `stride can scan`.
#ifndef STRIDE_DRIVERS_CAN_TOOL_NODE_ERRORS_HPP
#define STRIDE_DRIVERS_CAN_TOOL_NODE_ERRORS_HPP

#include "drivers/can/tool/bus_client.hpp"

#include <functional>
#include <string>
#include <vector>

namespace stride::can::tool {

/// Reads an object of the node.
using ReadObject = std::function<Transfer(Object)>;

/// Error register (1001h) and list of errors (1003h) of a node, a line each, the newest error
/// first; nothing if the register says that it has none. The list is read up to eight errors; a
/// node without it has its register only. [CiA 301]
std::vector<std::string> errorLines(const ReadObject &read);

} // namespace stride::can::tool

#endif
