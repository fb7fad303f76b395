// What the commands of stride-can have in common.
#ifndef STRIDE_DRIVERS_CAN_TOOL_TOOL_SUPPORT_HPP
#define STRIDE_DRIVERS_CAN_TOOL_TOOL_SUPPORT_HPP

#include "drivers/can/plan/objects.hpp"
#include "runtime/bus/group_setup.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stride::can {
class SocketCanPort;
}

namespace stride::can::tool {

/// "error: …" on standard error.
void complain(const std::string &text);

/// TRUE once Ctrl-C or SIGTERM has come; they end nothing by themselves after the first call.
bool interrupted();

/// Whether the interface is there and up; else it is said.
bool isUp(SocketCanPort &port, const std::string &interface);

/// "6064h", "0x6064:1", "1018:1": index and subindex in hexadecimal.
std::optional<Object> objectOfText(std::string_view text);
std::string textOf(Object object);

/// Bytes as a number, least byte first; of more than eight the first ones.
uint64_t numberOf(std::span<const uint8_t> bytes);

/// The drive groups on CAN of a built application. Throws app::Error.
std::vector<bus::GroupSetup> canGroups(const std::string &application);

} // namespace stride::can::tool

#endif
