#include "runtime/task/cycle_gate.hpp"

#include <utility>

namespace stride::task {

CycleGate::CycleGate(std::vector<uint32_t> ranks, bool turns)
    : ranks_(std::move(ranks)), turns_(turns),
      inside_(std::make_unique<std::atomic<uint32_t>[]>(ranks_.size())),
      wake_(std::make_unique<std::condition_variable[]>(ranks_.size() + 1)),
      waiting_(ranks_.size() + 1, false) {}

void CycleGate::enter(uint32_t task) {
  if (turns_) {
    enterTurn(ranks_[task] + 1);
    return;
  }
  for (;;) {
    inside_[task].store(1);
    if (held_.load() == 0)
      return;
    inside_[task].store(0);
    inside_[task].notify_all();
    held_.wait(1);
  }
}

void CycleGate::leave(uint32_t task) {
  if (!turns_) {
    inside_[task].store(0);
    if (held_.load() != 0)
      inside_[task].notify_all();
    return;
  }
  release();
}

void CycleGate::hold() {
  if (turns_) {
    enterTurn(0);
    return;
  }
  held_.store(1);
  for (size_t i = 0; i < ranks_.size(); ++i)
    inside_[i].wait(1);
}

void CycleGate::release() {
  if (!turns_) {
    held_.store(0);
    held_.notify_all();
    return;
  }
  const std::lock_guard lock(mutex_);
  busy_ = false;
  for (size_t rank = 0; rank < waiting_.size(); ++rank) {
    if (!waiting_[rank])
      continue;
    waiting_[rank] = false; // it is its turn now
    busy_ = true;
    wake_[rank].notify_one();
    return;
  }
}

void CycleGate::enterTurn(uint32_t rank) {
  std::unique_lock lock(mutex_);
  if (!busy_) {
    busy_ = true;
    return;
  }
  waiting_[rank] = true;
  wake_[rank].wait(lock, [&] { return !waiting_[rank]; });
}

} // namespace stride::task
