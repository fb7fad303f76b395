// stride-can lss

#include "drivers/can/master/lss_master.hpp"
#include "drivers/can/socket/socket_can_port.hpp"
#include "drivers/can/tool/commands.hpp"
#include "drivers/can/tool/tool_support.hpp"

#include <array>
#include <fmt/format.h>

namespace stride::can::tool {
namespace {

/// Sends a request and waits for its answer. [ns]
std::optional<Frame> exchange(Port &port, const Frame &request, bool awaits, int64_t timeoutNs) {
  std::array<Received, 32> frames;
  while (port.receive(frames) != 0) { // answers that have come too late
  }
  if (port.send(request, SendClass::Service) != SendResult::Sent)
    return std::nullopt;
  const int64_t end = port.monotonicNs() + timeoutNs;
  while (awaits && port.wait(end)) {
    const size_t count = port.receive(frames);
    for (size_t i = 0; i < count; ++i)
      if (frames[i].frame.id == LssMaster::kAnswerId && frames[i].frame.length == Frame::kMostBytes)
        return frames[i].frame;
  }
  return std::nullopt;
}

std::string identityText(const LssMaster::Identity &identity) {
  return fmt::format("vendor {:08X}h  product {:08X}h  revision {:08X}h  serial {:08X}h",
                     identity[0], identity[1], identity[2], identity[3]);
}

std::string_view resultText(LssResult result) {
  switch (result) {
  case LssResult::NoAnswer:
    return "no answer";
  case LssResult::Refused:
    return "the node refuses it";
  case LssResult::WrongAnswer:
    return "an answer to another question";
  case LssResult::Done:
    break;
  }
  return "done";
}

/// The node that is meant, selected.
std::optional<LssMaster::Identity> found(LssMaster &lss, const LssOptions &options) {
  if (options.identity.empty()) {
    const std::optional<LssMaster::Identity> identity = lss.fastScan();
    if (!identity)
      complain("no node without a node id answers");
    return identity;
  }
  LssMaster::Identity identity{};
  std::copy_n(options.identity.begin(), std::min(options.identity.size(), identity.size()),
              identity.begin());
  const LssResult result = lss.select(identity);
  if (result == LssResult::Done)
    return identity;
  complain(fmt::format("no node is {}: {}", identityText(identity), resultText(result)));
  return std::nullopt;
}

bool change(LssMaster &lss, const LssOptions &options) {
  const LssResult set = lss.setNode(static_cast<uint8_t>(options.node));
  if (set != LssResult::Done) {
    complain(fmt::format("node id {} cannot be set: {}", options.node, resultText(set)));
    return false;
  }
  if (!options.store)
    return true;
  const LssResult stored = lss.store();
  if (stored != LssResult::Done)
    complain(fmt::format("the node id cannot be stored: {}", resultText(stored)));
  return stored == LssResult::Done;
}

} // namespace

int lss(const LssOptions &options) {
  if (options.node != 0 && !options.allowed) {
    complain("this changes a node: add --write");
    return kBad;
  }
  SocketCanPort port(options.interface, 0);
  if (!isUp(port, options.interface))
    return kBad;
  const int64_t timeout = int64_t{options.timeoutMs} * 1000000;
  LssMaster lss(
      [&](const Frame &request, bool awaits) { return exchange(port, request, awaits, timeout); });
  const std::optional<LssMaster::Identity> identity = found(lss, options);
  if (!identity)
    return kBad;
  const std::optional<uint8_t> before = lss.node();
  fmt::print("{}  node id {}\n", identityText(*identity),
             !before || *before == LssMaster::kNoNode ? "none" : std::to_string(*before));
  const bool good = options.node == 0 || change(lss, options);
  lss.leave();
  if (good && options.node != 0)
    fmt::print("node id {}{}\n", options.node,
               !before || *before == LssMaster::kNoNode
                   ? ""
                   : " after the next reset of its communication");
  return good ? kGood : kBad;
}

} // namespace stride::can::tool
