#include "runtime/host/trace_ring.hpp"

#include <algorithm>

namespace stride::host {

TraceRing::TraceRing(const app::TraceColumns &columns, size_t rows)
    : columns_(&columns), rows_(std::max<size_t>(rows, 1)), rowSize_(columns.rowSize()),
      memory_(rows_ * rowSize_) {}

void TraceRing::afterPous(Ctx &ctx) {
  const uint64_t number = taken_.load(std::memory_order_relaxed);
  if (number - written_.load(std::memory_order_acquire) >= rows_) {
    lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    return;
  }
  columns_->sample(ctx.cycleStartNs, static_cast<std::byte *>(ctx.state), place(number));
  taken_.store(number + 1, std::memory_order_release);
}

void TraceRing::drain(TraceWriter &writer) {
  const uint64_t taken = taken_.load(std::memory_order_acquire);
  for (uint64_t number = written_.load(std::memory_order_relaxed);
       number != taken && writer.ready(); ++number) {
    writer.row(place(number));
    written_.store(number + 1, std::memory_order_release);
  }
}

} // namespace stride::host
