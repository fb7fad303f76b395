// stride-can monitor

#include "drivers/can/socket/socket_can_port.hpp"
#include "drivers/can/tool/commands.hpp"
#include "drivers/can/tool/frame_text.hpp"
#include "drivers/can/tool/tool_support.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fmt/format.h>

namespace stride::can::tool {
int monitor(const MonitorOptions &options) {
  const std::vector<KnownDrive> drives = options.application.empty()
                                             ? std::vector<KnownDrive>()
                                             : knownNodes(canGroups(options.application));
  SocketCanPort port(options.interface, 0);
  if (!isUp(port, options.interface))
    return kBad;
  constexpr int64_t kTenthNs = 100000000;
  const int64_t begin = port.monotonicNs();
  const int64_t end =
      options.seconds > 0 ? begin + static_cast<int64_t>(options.seconds * 1e9) : INT64_MAX;
  std::array<Received, 32> frames;
  int64_t first = -1;
  for (uint64_t seen = 0; !interrupted() && port.monotonicNs() < end;) {
    port.wait(std::min(end, port.monotonicNs() + kTenthNs));
    port.beginCycle();
    const size_t count = port.receive(frames);
    for (size_t i = 0; i < count; ++i) {
      if (first < 0)
        first = frames[i].timeNs;
      const std::string text = describe(frames[i].frame, drives);
      fmt::print("{}  {}\n", line(frames[i].frame, std::max<int64_t>(frames[i].timeNs - first, 0)),
                 text);
      if (++seen == options.count)
        return kGood;
    }
    std::fflush(stdout);
  }
  if (const PortCounters counters = port.counters(); counters.dropped != 0)
    fmt::print(stderr, "warning: {} frames were lost here for want of room\n", counters.dropped);
  return kGood;
}

} // namespace stride::can::tool
