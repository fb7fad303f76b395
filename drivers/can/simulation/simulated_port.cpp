#include "drivers/can/simulation/simulated_port.hpp"

#include <algorithm>

namespace stride::can::simulation {

void SimulatedPort::beginCycle() noexcept {
  timeNs_ += setup_.cycleNs;
  programRuns_ = false;
  bus_.runUntil(timeNs_);
}

SendResult SimulatedPort::send(const Frame &frame, SendClass sendClass) noexcept {
  const ControllerState state = bus_.state(station_);
  if (state == ControllerState::Down || state == ControllerState::BusOff)
    return SendResult::Down;
  if (process_.size() + service_.size() >= setup_.sendQueue)
    return SendResult::QueueFull;
  const int64_t ready = std::max(timeNs_, bus_.nowNs()) + (programRuns_ ? setup_.programNs : 0);
  Queue<Waiting> &queue = sendClass == SendClass::Process ? process_ : service_;
  queue.push({frame, ready});
  bus_.fill(station_);
  return SendResult::Sent;
}

bool SimulatedPort::next(Waiting &waiting) noexcept {
  Queue<Waiting> &queue = process_.empty() ? service_ : process_;
  if (queue.empty())
    return false;
  waiting = queue.front();
  queue.pop();
  return true;
}

void SimulatedPort::forget() noexcept {
  process_.clear();
  service_.clear();
}

size_t SimulatedPort::receive(std::span<Received> frames) noexcept {
  programRuns_ = true;
  size_t taken = 0;
  for (; taken < frames.size() && !received_.empty(); ++taken) {
    frames[taken] = received_.front();
    received_.pop();
  }
  return taken;
}

} // namespace stride::can::simulation
