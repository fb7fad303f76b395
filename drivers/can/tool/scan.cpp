// stride-can scan

#include "drivers/can/socket/socket_can_port.hpp"
#include "drivers/can/tool/bus_client.hpp"
#include "drivers/can/tool/commands.hpp"
#include "drivers/can/tool/node_errors.hpp"
#include "drivers/can/tool/tool_support.hpp"

#include <fmt/format.h>

namespace stride::can::tool {
namespace {

std::string profileName(uint64_t deviceType) {
  switch (deviceType & 0xFFFF) {
  case 401:
    return "inputs and outputs (CiA 401)";
  case 402:
    return "drive (CiA 402)";
  case 406:
    return "encoder (CiA 406)";
  case 0:
    return "no profile";
  default:
    return fmt::format("profile {}", deviceType & 0xFFFF);
  }
}

} // namespace

int scan(const ScanOptions &options) {
  SocketCanPort port(options.interface, 0);
  if (!isUp(port, options.interface))
    return kBad;
  BusClient client(port);
  const int64_t timeout = int64_t{options.timeoutMs} * 1000000;
  int found = 0;
  for (int node = options.first; node <= options.last && !interrupted(); ++node) {
    const auto id = static_cast<uint8_t>(node);
    const Transfer type = client.read(id, object::kDeviceType, timeout);
    if (type.timedOut)
      continue;
    if (!isUp(port, options.interface))
      return kBad;
    ++found;
    std::string line = fmt::format("{:3}  {}", node, profileName(numberOf(type.bytes)));
    const char *names[] = {"vendor", "product", "revision", "serial"};
    for (uint8_t sub = 1; sub <= 4; ++sub)
      if (const Transfer part = client.read(id, {object::kIdentity, sub}, timeout); part.done)
        line += fmt::format("  {} {:08X}h", names[sub - 1], numberOf(part.bytes));
    fmt::print("{}\n", line);
    for (const std::string &error :
         errorLines([&](Object object) { return client.read(id, object, timeout); }))
      fmt::print("       {}\n", error);
  }
  if (found == 0)
    fmt::print(stderr, "note: no node has answered\n");
  return kGood;
}

} // namespace stride::can::tool
