#include "drivers/can/master/supervision.hpp"

#include "drivers/can/master/frames.hpp"
#include "drivers/can/plan/objects.hpp"

#include <algorithm>

namespace stride::can {
namespace {

constexpr uint32_t kFewestCycles = 3;
constexpr uint32_t kLifeTimeFactor = 3;
constexpr uint8_t kToggleBit = 0x80;

uint32_t limitOf(Supervision::Kind kind, uint32_t period) {
  const uint64_t limit = kind == Supervision::Kind::Guarding ? uint64_t{period} * kLifeTimeFactor
                                                             : (uint64_t{period} * 3 + 1) / 2;
  return static_cast<uint32_t>(std::clamp<uint64_t>(limit, kFewestCycles, UINT32_MAX));
}

} // namespace

Frame nmtFrame(NmtCommand command, uint8_t node) {
  Frame frame = makeFrame(kNmtId, 2);
  frame.data[0] = static_cast<uint8_t>(command);
  frame.data[1] = node;
  return frame;
}

void Supervision::clear() { *this = Supervision(node_); }

void Supervision::begin(Kind kind, uint32_t period) {
  kind_ = kind;
  period_ = period;
  limit_ = limitOf(kind, period);
  silent_ = 0;
  toAsk_ = 0;
  toggle_ = false;
  asks_ = false;
}

void Supervision::received(const Frame &frame) {
  if (frame.length != 1 || frame.remote)
    return;
  const uint8_t state = frame.data[0] & static_cast<uint8_t>(~kToggleBit);
  const bool toggle = (frame.data[0] & kToggleBit) != 0;
  if (frame.data[0] == nmt::kBootUp) {
    ++bootUps_;
    toggle_ = false;
  } else if (kind_ == Kind::Guarding) {
    if (toggle != toggle_) { // an old answer is no sign of life
      ++repeated_;
      return;
    }
    toggle_ = !toggle;
  }
  state_ = state;
  silent_ = 0;
}

void Supervision::cycle() {
  if (kind_ == Kind::None)
    return;
  silent_ = std::min(silent_ + 1, limit_);
  if (kind_ != Kind::Guarding)
    return;
  if (toAsk_ == 0) {
    asks_ = true;
    toAsk_ = period_;
  }
  --toAsk_;
}

Frame Supervision::question() const {
  Frame frame = makeFrame(kHeartbeatBase + node_, 0);
  frame.remote = true;
  return frame;
}

} // namespace stride::can
