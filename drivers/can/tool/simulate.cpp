// stride-can simulate

#include "drivers/can/can_setup.hpp"
#include "drivers/can/simulated_network.hpp"
#include "drivers/can/simulation/node_host.hpp"
#include "drivers/can/socket/socket_can_port.hpp"
#include "drivers/can/tool/commands.hpp"
#include "drivers/can/tool/tool_support.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace stride::can::tool {
namespace {

/// The group that is meant; null: it is said why there is none.
const bus::GroupSetup *chosen(const std::vector<bus::GroupSetup> &groups,
                              const SimulateOptions &options) {
  std::string names;
  for (const bus::GroupSetup &group : groups) {
    if (options.group.empty() ? groups.size() == 1 : group.name == options.group)
      return &group;
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", group.name);
  }
  if (groups.empty())
    complain(fmt::format("'{}' has no axis group on CAN", options.application));
  else if (options.group.empty())
    complain(fmt::format("which group? add --group; on CAN are {}", names));
  else
    complain(fmt::format("there is no axis group '{}' on CAN; there are {}", options.group, names));
  return nullptr;
}

} // namespace

int simulate(const SimulateOptions &options) {
  const std::vector<bus::GroupSetup> groups = canGroups(options.application);
  const bus::GroupSetup *group = chosen(groups, options);
  if (group == nullptr)
    return kBad;
  const CanSetup setup = canSetup(*group);
  const std::string interface = options.interface.empty() ? setup.interface : options.interface;
  SocketCanPort port(interface, setup.bitRate);
  if (!isUp(port, interface))
    return kBad;
  SimulatedNodes nodes = simulatedNodes(*group);
  const int64_t begin = port.monotonicNs();
  const int64_t end =
      options.seconds > 0 ? begin + static_cast<int64_t>(options.seconds * 1e9) : INT64_MAX;
  simulation::NodeHost host(port);
  size_t count = 0;
  for (const auto &drive : nodes.drives)
    if (drive != nullptr) {
      host.add(*drive, begin);
      ++count;
    }
  for (const auto &encoder : nodes.encoders) {
    host.add(*encoder, begin);
    ++count;
  }
  for (const auto &io : nodes.ios)
    if (io != nullptr) {
      host.add(*io, begin);
      ++count;
    }
  if (nodes.syncDevice != nullptr) {
    host.add(*nodes.syncDevice, begin);
    ++count;
  }
  fmt::print("{} nodes on {}\n", count, interface);
  std::fflush(stdout);
  constexpr int64_t kTenthNs = 100000000;
  for (int64_t now = begin; !interrupted() && now < end; now = port.monotonicNs()) {
    port.beginCycle();
    host.step(now);
    port.wait(std::min({end, now + kTenthNs, host.nextNs()}));
  }
  return kGood;
}

} // namespace stride::can::tool
