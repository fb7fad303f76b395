#include "drivers/can/log/recorder.hpp"

#include <algorithm>

namespace stride::can::log {

Recorder::Recorder(size_t room) : entries_(room + 1) {}

void Recorder::put(const Entry &entry) noexcept {
  const size_t end = end_.load(std::memory_order_relaxed);
  const size_t next = (end + 1) % entries_.size();
  if (next == first_.load(std::memory_order_acquire)) {
    lost_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  entries_[end] = entry;
  end_.store(next, std::memory_order_release);
}

bool Recorder::take(Entry &entry) noexcept {
  const size_t first = first_.load(std::memory_order_relaxed);
  if (first == end_.load(std::memory_order_acquire))
    return false;
  entry = entries_[first];
  first_.store((first + 1) % entries_.size(), std::memory_order_release);
  return true;
}

void RecordedPort::beginCycle() noexcept {
  timeNs_ += cycleNs_;
  port_.beginCycle();
}

SendResult RecordedPort::send(const Frame &frame, SendClass sendClass) noexcept {
  const SendResult result = port_.send(frame, sendClass);
  if (result == SendResult::Sent)
    recorder_.put({.timeNs = timeNs_, .frame = frame, .direction = Direction::Sent});
  return result;
}

size_t RecordedPort::receive(std::span<Received> frames) noexcept {
  const size_t taken = port_.receive(frames);
  int64_t latest = timeNs_;
  for (const Received &one : frames.first(taken)) {
    recorder_.put({.timeNs = std::min(one.timeNs, timeNs_),
                   .frame = one.frame,
                   .direction = Direction::Received});
    latest = std::max(latest, one.timeNs);
  }
  timeNs_ = latest; // the next cycle is after that
  return taken;
}

} // namespace stride::can::log
