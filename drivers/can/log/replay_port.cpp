#include "drivers/can/log/replay_port.hpp"

#include <algorithm>

namespace stride::can::log {
namespace {

/// How far ahead a frame is looked for that is not the next one.
constexpr size_t kAhead = 64;

} // namespace

bool sentByMaster(const Frame &frame, const ReplaySetup &setup) {
  constexpr uint16_t kNode = 0x7F;
  const auto function = static_cast<uint16_t>(frame.id & ~kNode);
  const auto node = static_cast<uint16_t>(frame.id & kNode);
  switch (function) {
  case 0x000: // network management
  case 0x100: // time
  case 0x200:
  case 0x300:
  case 0x400:
  case 0x500:
  case 0x600:
    return true;
  case 0x080:
    return frame.id == setup.syncId;
  case 0x700:
    return frame.remote || node == setup.masterId;
  case 0x780:
    return frame.id == 0x7E5; // LSS
  default:
    return frame.id == setup.syncId;
  }
}

ReplayPort::ReplayPort(const Recording &recording, const ReplaySetup &setup) : setup_(setup) {
  for (const Entry &entry : recording.entries) {
    const bool own = entry.direction == Direction::Unknown ? sentByMaster(entry.frame, setup)
                                                           : entry.direction == Direction::Sent;
    (own ? sent_ : received_).push_back(entry);
    endNs_ = std::max(endNs_, entry.timeNs);
  }
  if (!recording.entries.empty())
    nowNs_ = recording.entries.front().timeNs - setup.cycleNs;
}

void ReplayPort::beginCycle() noexcept {
  ++result_.cycles;
  nowNs_ += setup_.cycleNs;
}

SendResult ReplayPort::send(const Frame &frame, SendClass /*sendClass*/) noexcept {
  const size_t end = std::min(sent_.size(), nextSent_ + kAhead);
  size_t found = nextSent_;
  while (found < end && sent_[found].frame != frame)
    ++found;
  if (found != nextSent_ || found == end) {
    if (result_.different == 0) {
      result_.first = {0, {}, frame, result_.cycles};
      if (nextSent_ < sent_.size()) {
        result_.first.line = sent_[nextSent_].line;
        result_.first.expected = sent_[nextSent_].frame;
      }
    }
    result_.different += found < end ? found - nextSent_ : 1;
  }
  if (found == end)
    return SendResult::Sent;
  nextSent_ = found + 1;
  ++result_.matched;
  if (frame.id == setup_.syncId && !frame.remote)
    nowNs_ = sent_[found].timeNs;
  return SendResult::Sent;
}

size_t ReplayPort::receive(std::span<Received> frames) noexcept {
  size_t taken = 0;
  while (taken < frames.size() && nextReceived_ < received_.size() &&
         received_[nextReceived_].timeNs <= nowNs_) {
    const Entry &entry = received_[nextReceived_++];
    frames[taken++] = {entry.frame, entry.timeNs};
  }
  return taken;
}

bool ReplayPort::done() const noexcept {
  return nextReceived_ == received_.size() && nowNs_ >= endNs_;
}

ReplayResult ReplayPort::result() const noexcept {
  ReplayResult result = result_;
  result.left = sent_.size() - nextSent_;
  return result;
}

} // namespace stride::can::log
