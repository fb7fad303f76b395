#include "runtime/monitor/symbol_channel.hpp"

#include <cstring>

namespace stride::monitor {

/// The parts at the front of the queue that are due at this end of the cycle, as many as fit.
void SymbolChannel::serve(bool writes, const Ctx &ctx) noexcept {
  auto *state = static_cast<std::byte *>(ctx.state);
  std::size_t values = 0;
  std::size_t bytes = 0;
  std::size_t tail = tail_.load(std::memory_order_relaxed);
  while (tail != head_.load(std::memory_order_acquire)) {
    const SymbolRequest::Part &part = *queue_[tail % queue_.size()];
    SymbolRequest &request = *part.request;
    if (request.writes_ != writes)
      return;
    values += part.last - part.first;
    bytes += part.bytes;
    if (values > SymbolServer::kValuesPerCycle || bytes > SymbolServer::kBytesPerCycle)
      return; // in the next cycle; a single request always fits
    for (std::size_t i = part.first; i != part.last; ++i) {
      SymbolRequest::Value &value = request.values_[request.order_[i]];
      std::byte *memory = request.memory_.data() + value.offset;
      if (writes) {
        value.reached = value.symbol.write(state, memory, value.size);
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

void SymbolChannel::Outer::afterPous(Ctx &ctx) {
  channel_->serve(false, ctx);
  if (const RecorderSlot *slot = channel_->recorder.take())
    if (slot->recorder)
      slot->recorder->sample(ctx.cycleStartNs, static_cast<std::byte *>(ctx.state));
}

void SymbolChannel::Inner::beforePous(Ctx &ctx) {
  channel_->serve(true, ctx);
  if (const ForceList *list = channel_->forces.take())
    for (const SymbolServer::Forced &forced : list->forced)
      forced.symbol.write(static_cast<std::byte *>(ctx.state), forced.value.data(),
                          forced.value.size());
}

void SymbolChannel::Inner::afterPous(Ctx &ctx) {
  if (const ForceList *list = channel_->forces.current())
    for (const SymbolServer::Forced &forced : list->forced)
      forced.symbol.write(static_cast<std::byte *>(ctx.state), forced.value.data(),
                          forced.value.size());
}

} // namespace stride::monitor
