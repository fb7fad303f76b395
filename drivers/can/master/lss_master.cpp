#include "drivers/can/master/lss_master.hpp"

#include "drivers/can/master/frames.hpp"

namespace stride::can {
namespace {

constexpr uint8_t kSwitchGlobal = 0x04;
constexpr uint8_t kConfigureNode = 0x11;
constexpr uint8_t kStore = 0x17;
constexpr uint8_t kSelectVendor = 0x40; ///< And three more: product, revision, serial number.
constexpr uint8_t kSelected = 0x44;
constexpr uint8_t kIdentified = 0x4F;
constexpr uint8_t kFastScan = 0x51;
constexpr uint8_t kInquireNode = 0x5E;
constexpr uint8_t kEverybody = 0x80; ///< In place of a bit: whoever has no number.
constexpr uint8_t kBits = 32;

Frame request(uint8_t command, uint32_t value) {
  Frame frame = makeFrame(LssMaster::kRequestId, Frame::kMostBytes);
  frame.data[0] = command;
  writeNumber(frame, 1, 4, value);
  return frame;
}

} // namespace

std::optional<Frame> LssMaster::ask(uint8_t command, uint32_t value) {
  std::optional<Frame> answer = exchange_(request(command, value), true);
  if (answer && (answer->id != kAnswerId || answer->length != Frame::kMostBytes))
    answer.reset();
  return answer;
}

/// Whether somebody agrees.
bool LssMaster::scan(uint32_t number, uint8_t bit, uint8_t part, uint8_t next) {
  Frame frame = request(kFastScan, number);
  frame.data[5] = bit;
  frame.data[6] = part;
  frame.data[7] = next;
  const std::optional<Frame> answer = exchange_(frame, true);
  return answer && answer->id == kAnswerId && answer->data[0] == kIdentified;
}

std::optional<LssMaster::Identity> LssMaster::fastScan() {
  if (!scan(0, kEverybody, 0, 0))
    return std::nullopt;
  Identity identity{};
  for (size_t at = 0; at < identity.size(); ++at) {
    const auto part = static_cast<uint8_t>(at);
    uint32_t &number = identity[part];
    for (uint8_t bit = kBits; bit-- > 0;) // nobody has a 0 here: it is a 1
      if (!scan(number, bit, part, part))
        number |= uint32_t{1} << bit;
    const auto next = static_cast<uint8_t>((part + 1) % identity.size());
    if (!scan(number, 0, part, next))
      return std::nullopt;
  }
  return identity;
}

LssResult LssMaster::select(const Identity &identity) {
  leave();
  std::optional<Frame> answer;
  for (size_t part = 0; part < identity.size(); ++part) {
    const bool last = part + 1U == identity.size();
    answer = exchange_(request(static_cast<uint8_t>(kSelectVendor + part), identity[part]), last);
  }
  if (!answer)
    return LssResult::NoAnswer;
  return answer->data[0] == kSelected ? LssResult::Done : LssResult::WrongAnswer;
}

std::optional<uint8_t> LssMaster::node() {
  const std::optional<Frame> answer = ask(kInquireNode, 0);
  if (!answer || answer->data[0] != kInquireNode)
    return std::nullopt;
  return answer->data[1];
}

LssResult LssMaster::configure(uint8_t command, uint32_t value) {
  const std::optional<Frame> answer = ask(command, value);
  if (!answer)
    return LssResult::NoAnswer;
  if (answer->data[0] != command)
    return LssResult::WrongAnswer;
  return answer->data[1] == 0 ? LssResult::Done : LssResult::Refused;
}

LssResult LssMaster::setNode(uint8_t node) { return configure(kConfigureNode, node); }

LssResult LssMaster::store() { return configure(kStore, 0); }

void LssMaster::leave() { (void)exchange_(request(kSwitchGlobal, 0), false); }

} // namespace stride::can
