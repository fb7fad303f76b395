#include "runtime/monitor/symbol_channel.hpp"

#include <cstring>

namespace stride::monitor {

/// The parts at the front of the queue that are due at this end of the cycle, as many as fit.
void SymbolChannel::serve(bool writes, const Ctx &ctx) noexcept {
  auto *state = static_cast<std::byte *>(ctx.state);
  size_t values = 0;
  size_t bytes = 0;
  size_t tail = tail_.load(std::memory_order_relaxed);
  while (tail != head_.load(std::memory_order_acquire)) {
    const SymbolRequest::Part &part = *queue_[tail % queue_.size()];
    SymbolRequest &request = *part.request;
    if (request.writes_ != writes)
      return;
    values += part.last - part.first;
    bytes += part.bytes;
    if (values > SymbolServer::kValuesPerCycle || bytes > SymbolServer::kBytesPerCycle)
      return; // in the next cycle; a single request always fits
    for (size_t i = part.first; i != part.last; ++i) {
      SymbolRequest::Value &value = request.values_[request.order_[i]];
      std::byte *memory = request.memory_.data() + value.offset;
      if (writes) {
        value.reached = store(value.symbol, state, memory, value.size, false);
        continue;
      }
      std::byte bit{};
      const void *now = value.symbol.read(state, bit);
      value.reached = now != nullptr;
      if (now != nullptr)
        std::memcpy(memory, now, value.size);
    }
    request.timeNs_.store(ctx.cycleStartNs, std::memory_order_relaxed);
    tail_.store(++tail, std::memory_order_release);
    // From here on the request belongs to the server, which may free it.
    request.open_.fetch_sub(1, std::memory_order_acq_rel);
  }
}

/// What does not change anything is not told: forces hold in every cycle.
bool SymbolChannel::store(const app::Symbol &symbol, std::byte *state, const std::byte *value,
                          size_t size, bool behindPous) noexcept {
  if (log == nullptr)
    return symbol.write(state, value, size);
  const auto *const place = static_cast<const std::byte *>(symbol.address(state));
  if (place == nullptr)
    return false;
  const std::byte before = *place; // of a single bit: the byte it is in
  const bool differs = size > 1 && std::memcmp(place, value, size) != 0;
  symbol.write(state, value, size);
  if (differs || (size == 1 && *place != before))
    log->wrote(place, size, behindPous);
  return true;
}

void SymbolChannel::applyForces(const ForceList *list, const Ctx &ctx, bool behindPous) noexcept {
  if (list == nullptr)
    return;
  for (const SymbolServer::Forced &forced : list->forced)
    store(forced.symbol, static_cast<std::byte *>(ctx.state), forced.value.data(),
          forced.value.size(), behindPous);
}

void SymbolChannel::Outer::afterPous(Ctx &ctx) {
  channel_->serve(false, ctx);
  if (const RecorderSlot *slot = channel_->recorder.take())
    if (slot->recorder)
      slot->recorder->sample(ctx.cycleStartNs, static_cast<std::byte *>(ctx.state));
}

void SymbolChannel::Inner::beforePous(Ctx &ctx) {
  channel_->serve(true, ctx);
  channel_->applyForces(channel_->forces.take(), ctx, false);
}

void SymbolChannel::Inner::afterPous(Ctx &ctx) {
  channel_->applyForces(channel_->forces.current(), ctx, true);
}

} // namespace stride::monitor
