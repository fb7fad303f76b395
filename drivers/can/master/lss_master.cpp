#include "drivers/can/master/lss_master.hpp"

namespace stride::can {
namespace {

constexpr uint8_t kEverybody = 0x80; ///< In place of a bit: whoever has no number.
constexpr uint8_t kBits = 32;

} // namespace

using lss::request;

std::optional<Frame> LssMaster::ask(uint8_t command, uint32_t value) {
  std::optional<Frame> answer = exchange_(request(command, value), true);
  if (answer && !lss::isAnswer(*answer))
    answer.reset();
  return answer;
}

/// Whether somebody agrees.
bool LssMaster::scan(uint32_t number, uint8_t bit, uint8_t part, uint8_t next) {
  Frame frame = request(lss::kFastScan, number);
  frame.data[5] = bit;
  frame.data[6] = part;
  frame.data[7] = next;
  const std::optional<Frame> answer = exchange_(frame, true);
  return answer && answer->id == kAnswerId && answer->data[0] == lss::kIdentified;
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
    answer =
        exchange_(request(static_cast<uint8_t>(lss::kSelectVendor + part), identity[part]), last);
  }
  if (!answer)
    return LssResult::NoAnswer;
  return answer->data[0] == lss::kSelected ? LssResult::Done : LssResult::WrongAnswer;
}

std::optional<uint8_t> LssMaster::node() {
  const std::optional<Frame> answer = ask(lss::kInquireNode, 0);
  if (!answer || answer->data[0] != lss::kInquireNode)
    return std::nullopt;
  return answer->data[1];
}

LssResult LssMaster::configure(uint8_t command, uint32_t value) {
  const std::optional<Frame> answer = ask(command, value);
  if (!answer)
    return LssResult::NoAnswer;
  return lss::resultOf(*answer, command);
}

LssResult LssMaster::setNode(uint8_t node) { return configure(lss::kConfigureNode, node); }

LssResult LssMaster::store() { return configure(lss::kStore, 0); }

void LssMaster::leave() { (void)exchange_(request(lss::kSwitchGlobal, 0), false); }

} // namespace stride::can
