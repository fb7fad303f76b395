#include "drivers/can/simulation/error_control.hpp"

#include <algorithm>
#include <utility>

namespace stride::can::simulation {
namespace {

constexpr uint16_t kErrorControl = 0x700;
constexpr uint8_t kToggle = 0x80;

} // namespace

ErrorControl::ErrorControl(Dictionary &dictionary)
    : producer_(dictionary.at(0x1017)), guardTime_(dictionary.at(0x100C)),
      lifeFactor_(dictionary.at(0x100D)) {
  for (uint8_t i = 0; i < kWatched; ++i)
    watches_[i].entry = &dictionary.at(0x1016, static_cast<uint8_t>(i + 1));
}

int64_t ErrorControl::Watch::timeNs() const {
  return static_cast<int64_t>(entry->value & 0xFFFFU) * kMillisecond;
}

int64_t ErrorControl::lifeNs() const noexcept {
  return static_cast<int64_t>(guardTime_.value * lifeFactor_.value) * kMillisecond;
}

void ErrorControl::reset(bool boot, int64_t nowNs) noexcept {
  for (Watch &watch : watches_)
    watch.heard = watch.lost = false;
  boot_ = boot;
  heartbeat_ = answer_ = toggle_ = guarded_ = unguarded_ = lost_ = back_ = false;
  configure(nowNs);
}

void ErrorControl::configure(int64_t nowNs) noexcept {
  const auto period = static_cast<int64_t>(producer_.value) * kMillisecond;
  heartbeatNs_ = period > 0 ? nowNs + period : kNever;
  for (Watch &watch : watches_)
    if (watch.timeNs() == 0 || watch.node() == 0)
      watch.heard = watch.lost = false;
}

/// A node is watched once only. [CiA 301, 1016h]
Abort ErrorControl::beforeWrite(const Entry &entry, uint64_t value) const noexcept {
  if (entry.row.index != 0x1016)
    return Abort::None;
  const uint64_t node = value >> 16U & 0xFFU;
  if (value >> 24U != 0 || node > 127)
    return Abort::Value;
  if ((value & 0xFFFFU) == 0 || node == 0)
    return Abort::None;
  for (const Watch &watch : watches_)
    if (watch.entry != &entry && watch.timeNs() != 0 && watch.node() == node)
      return Abort::General;
  return Abort::None;
}

void ErrorControl::receive(const Frame &frame, uint8_t ownId, int64_t nowNs) noexcept {
  const auto node = static_cast<uint8_t>(frame.id & 0x7FU);
  if (frame.remote) {
    if (node != ownId || producer_.value != 0)
      return; // heartbeats and guarding exclude each other
    answer_ = true;
    guarded_ = lifeNs() > 0;
    guardedNs_ = nowNs;
    back_ = back_ || std::exchange(unguarded_, false);
    return;
  }
  if (frame.length != 1)
    return;
  for (Watch &watch : watches_) {
    if (watch.node() != node || node == 0 || watch.timeNs() == 0)
      continue;
    watch.heard = true;
    watch.lastNs = nowNs;
    back_ = back_ || std::exchange(watch.lost, false);
  }
}

void ErrorControl::advance(int64_t nowNs) noexcept {
  if (nowNs >= heartbeatNs_) {
    heartbeat_ = true;
    configure(nowNs);
  }
  for (Watch &watch : watches_)
    if (watch.heard && nowNs - watch.lastNs >= watch.timeNs()) {
      watch.heard = false;
      watch.lost = lost_ = true;
    }
  if (guarded_ && nowNs - guardedNs_ >= lifeNs()) {
    guarded_ = false;
    unguarded_ = lost_ = true;
  }
}

int64_t ErrorControl::nextNs() const noexcept {
  int64_t next = heartbeatNs_;
  for (const Watch &watch : watches_)
    if (watch.heard)
      next = std::min(next, watch.lastNs + watch.timeNs());
  return guarded_ ? std::min(next, guardedNs_ + lifeNs()) : next;
}

bool ErrorControl::transmit(Frame &frame, uint8_t ownId, NmtState state) noexcept {
  if (!boot_ && !heartbeat_ && !answer_)
    return false;
  frame = {};
  frame.id = static_cast<uint16_t>(kErrorControl + ownId);
  frame.length = 1;
  if (std::exchange(boot_, false)) {
    frame.data[0] = 0;
    return true;
  }
  frame.data[0] = static_cast<uint8_t>(state);
  if (std::exchange(heartbeat_, false))
    return true;
  answer_ = false;
  if (std::exchange(toggle_, !toggle_))
    frame.data[0] |= kToggle;
  return true;
}

bool ErrorControl::takeLost() noexcept { return std::exchange(lost_, false); }
bool ErrorControl::takeBack() noexcept { return std::exchange(back_, false); }

} // namespace stride::can::simulation
