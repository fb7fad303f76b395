#include "drivers/can/simulation/faults.hpp"

namespace stride::can::simulation {
namespace {

constexpr uint32_t kMillion = 1'000'000;
constexpr unsigned kBitsOfByte = 8;

} // namespace

/// SplitMix64; by multiplication into the range, whose bias of 2^-40 and less is nobody's concern.
uint64_t Faults::below(uint64_t limit) {
  state_ += 0x9E3779B97F4A7C15ULL;
  uint64_t z = state_;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  z ^= z >> 31U;
  return limit == 0 ? 0 : z % limit;
}

bool Faults::order(const FaultOrder &order) {
  if (ordered_ == kOrders)
    return false;
  orders_[ordered_++] = order;
  return true;
}

void Faults::clear() {
  rates_ = {};
  ordered_ = 0;
}

/// One bit of the bytes, or none where there are none.
void Faults::corrupt(FaultChoice &choice) {
  if (choice.frame.length == 0)
    return;
  const uint64_t bit = below(choice.frame.length * uint64_t{kBitsOfByte});
  uint8_t &byte = choice.frame.data[bit / kBitsOfByte];
  byte = static_cast<uint8_t>(byte ^ (1U << (bit % kBitsOfByte)));
}

FaultChoice Faults::choose(const Frame &frame) {
  FaultChoice choice{Fault::None, 0, frame};
  for (size_t i = 0; i < ordered_; ++i) {
    FaultOrder &order = orders_[i];
    if (order.id != frame.id || order.count == 0)
      continue;
    if (order.skip > 0) {
      --order.skip;
      continue;
    }
    --order.count;
    choice.fault = order.fault;
    choice.delayNs = order.delayNs;
    if (order.fault == Fault::Corrupt) {
      if (order.byte >= 0 && static_cast<size_t>(order.byte) < Frame::kMostBytes)
        choice.frame.data[static_cast<size_t>(order.byte)] ^= order.invert;
      else if (order.length < 0)
        corrupt(choice);
      if (order.length >= 0 && static_cast<size_t>(order.length) <= Frame::kMostBytes)
        choice.frame.length = static_cast<uint8_t>(order.length);
      for (size_t at = choice.frame.length; at < Frame::kMostBytes; ++at)
        choice.frame.data[at] = 0;
    }
    if (order.count == 0) { // its place is free again; the others stay in their order
      for (size_t at = i + 1; at < ordered_; ++at)
        orders_[at - 1] = orders_[at];
      --ordered_;
    }
    return choice;
  }
  if ((rates_.lose | rates_.delay | rates_.duplicate | rates_.corrupt | rates_.disturb) == 0)
    return choice;
  uint64_t chance = below(kMillion);
  const struct {
    uint32_t rate;
    Fault fault;
  } kinds[] = {{rates_.lose, Fault::Lose},
               {rates_.delay, Fault::Delay},
               {rates_.duplicate, Fault::Duplicate},
               {rates_.corrupt, Fault::Corrupt},
               {rates_.disturb, Fault::Disturb}};
  for (const auto &[rate, fault] : kinds) {
    if (chance < rate) {
      choice.fault = fault;
      break;
    }
    chance -= rate;
  }
  if (choice.fault == Fault::Delay)
    choice.delayNs = static_cast<int64_t>(below(static_cast<uint64_t>(rates_.longestDelayNs) + 1));
  if (choice.fault == Fault::Corrupt)
    corrupt(choice);
  return choice;
}

} // namespace stride::can::simulation
