#include "drivers/can/tool/frame_text.hpp"

#include "drivers/can/master/frames.hpp"
#include "drivers/can/master/power.hpp"
#include "drivers/can/master/sdo_abort.hpp"
#include "drivers/can/plan/group_plan.hpp"
#include "drivers/can/tool/tool_support.hpp"

#include <array>
#include <fmt/format.h>

namespace stride::can::tool {
namespace {

constexpr unsigned kNodeMask = 0x7F;
std::string_view stateName(unsigned state) {
  switch (state & 0x7F) {
  case 0:
    return "boot-up";
  case 4:
    return "stopped";
  case 5:
    return "operational";
  case 0x7F:
    return "pre-operational";
  default:
    return "in no known state";
  }
}

std::string_view commandName(unsigned command) {
  switch (command) {
  case 0x01:
    return "start";
  case 0x02:
    return "stop";
  case 0x80:
    return "enter pre-operational";
  case 0x81:
    return "reset node";
  case 0x82:
    return "reset communication";
  default:
    return "unknown command";
  }
}

std::string nmt(const Frame &frame) {
  if (frame.length != 2)
    return "NMT of a wrong length";
  const std::string node = frame.data[1] == 0 ? "all" : fmt::format("node {}", frame.data[1]);
  return fmt::format("NMT {}: {}", node, commandName(frame.data[0]));
}

std::string emergency(const Frame &frame, unsigned node) {
  if (frame.length != 8)
    return fmt::format("EMCY of node {} of a wrong length", node);
  const uint32_t code = readNumber(frame, 0, 2);
  return code == 0 ? fmt::format("EMCY of node {}: no error any more", node)
                   : fmt::format("EMCY of node {}: {:04X}h, error register {:02X}h", node, code,
                                 frame.data[2]);
}

std::string sdo(const Frame &frame, unsigned node, bool isRequest) {
  if (frame.length != 8)
    return fmt::format("SDO of node {} of a wrong length", node);
  const Object object{static_cast<uint16_t>(readNumber(frame, 1, 2)), frame.data[3]};
  const unsigned command = frame.data[0] >> 5;
  const std::string who = fmt::format("SDO {} node {}", isRequest ? "to" : "from", node);
  if (command == 4)
    return fmt::format("{}: abort {}, {}", who, textOf(object),
                       abortRow(readNumber(frame, 4, 4)).text);
  if (isRequest && command == 2)
    return fmt::format("{}: read {}", who, textOf(object));
  if (isRequest && command == 1)
    return fmt::format("{}: write {} := {}", who, textOf(object), readNumber(frame, 4, 4));
  if (!isRequest && command == 2)
    return fmt::format("{}: {} is {}", who, textOf(object), readNumber(frame, 4, 4));
  if (!isRequest && command == 3)
    return fmt::format("{}: {} is written", who, textOf(object));
  return fmt::format("{}: a part of a transfer", who);
}

/// Bits of a frame as a number; what is beyond its end is 0.
uint64_t bitsAt(const Frame &frame, size_t first, size_t count) {
  uint64_t value = 0;
  for (size_t i = 0; i < count; ++i) {
    const size_t bit = first + i;
    if (bit / 8 < frame.length && (frame.data[bit / 8] >> bit % 8 & 1) != 0)
      value |= uint64_t{1} << i;
  }
  return value;
}

std::string valueText(Signal signal, uint64_t bits) {
  if (signal == Signal::Statusword)
    return fmt::format("{:04X}h {}", bits, nameOf(powerStateOf(static_cast<uint16_t>(bits))));
  const SignalObject &row = objectOf(signal);
  if (!row.isSigned)
    return fmt::format("{:0{}X}h", bits, row.bits / 4);
  const unsigned unused = 64U - row.bits;
  return fmt::format("{}", static_cast<int64_t>(bits << unused) >> unused);
}

std::string processData(const Frame &frame, const Pdo &pdo, const std::string &drive,
                        std::string_view kind) {
  std::string text = fmt::format("{}{} of {}", kind, pdo.number, drive);
  if (frame.length != pdo.length())
    return text + fmt::format(" has {} bytes, planned are {}", frame.length, pdo.length());
  size_t place = 0;
  std::string_view between = ": ";
  for (const PdoEntry &entry : pdo.mapped()) {
    const Signal signal = signalOf(entry.object);
    const uint64_t bits = bitsAt(frame, place, entry.bits);
    text += between;
    text += signal == Signal::Other ? fmt::format("{} {:X}h", textOf(entry.object), bits)
                                    : fmt::format("{} {}", nameOf(signal), valueText(signal, bits));
    place += entry.bits;
    between = ", ";
  }
  return text;
}

} // namespace

std::vector<KnownDrive> knownNodes(std::span<const bus::GroupSetup> groups) {
  std::vector<KnownDrive> known;
  for (const bus::GroupSetup &group : groups) {
    const GroupPlan plan = planGroup(group);
    for (size_t i = 0; i < plan.drives.size(); ++i)
      if (plan.faults[i].empty())
        known.push_back({group.drives[i].name, plan.drives[i].plan});
    for (size_t i = 0; i < plan.ios.size(); ++i)
      if (plan.ios[i].fault.empty())
        known.push_back({group.ios[i].name, plan.ios[i].plan});
    for (size_t i = 0; i < plan.encoders.size(); ++i)
      if (plan.encoders[i].plan.node != 0)
        known.push_back({group.encoders[i].name, plan.encoders[i].plan});
  }
  return known;
}

std::string describe(const Frame &frame, const std::vector<KnownDrive> &drives) {
  for (const KnownDrive &drive : drives) {
    for (const Pdo &pdo : drive.plan.receivedByDrive())
      if (pdo.cobId == frame.id)
        return processData(frame, pdo, drive.name, "RPDO");
    for (const Pdo &pdo : drive.plan.sentByDrive())
      if (pdo.cobId == frame.id)
        return processData(frame, pdo, drive.name, "TPDO");
  }
  const unsigned node = frame.id & kNodeMask;
  switch (frame.id & ~kNodeMask) {
  case kNmtId:
    return node == 0 ? nmt(frame) : "";
  case kSyncCobId:
    return node == 0 ? "SYNC" : emergency(frame, node);
  case 0x100:
    return node == 0 ? "TIME" : "";
  case kSdoAnswerBase:
    return sdo(frame, node, false);
  case kSdoRequestBase:
    return sdo(frame, node, true);
  case kHeartbeatBase:
    return frame.remote        ? fmt::format("node {} is asked for its state", node)
           : frame.length == 1 ? fmt::format("node {} is {}", node, stateName(frame.data[0]))
                               : fmt::format("heartbeat of node {} of a wrong length", node);
  default:
    break;
  }
  if (frame.id >= kTpdoBase && frame.id < kSdoAnswerBase && node != 0) {
    const unsigned number = (frame.id - kTpdoBase) / 0x100 + 1;
    const bool sent = (frame.id & 0x80) != 0;
    return fmt::format("{}{} of node {}", sent ? "TPDO" : "RPDO", number, node);
  }
  return "";
}

std::string line(const Frame &frame, int64_t timeNs) {
  constexpr int64_t kSecondNs = 1000000000;
  std::string bytes = frame.remote ? " RTR" : "";
  for (const uint8_t byte : frame.bytes())
    bytes += fmt::format(" {:02X}", byte);
  return fmt::format("{:4}.{:06}  {:03X} [{}]{:24}", timeNs / kSecondNs, timeNs % kSecondNs / 1000,
                     frame.id, frame.length, bytes);
}

} // namespace stride::can::tool
