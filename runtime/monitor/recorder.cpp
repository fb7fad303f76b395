#include "runtime/monitor/recorder.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stride::monitor {

namespace {

std::optional<app::Comparison> signalOf(const app::SymbolTable &symbols,
                                        const std::optional<TriggerSettings> &trigger) {
  if (!trigger)
    return std::nullopt;
  const app::Symbol symbol = app::resolveElementary(symbols, trigger->name);
  const TypeDesc &type = symbols.type(symbol);
  if (type.kind == Kind::BOOL) {
    if (!trigger->threshold.empty())
      throw app::Error(fmt::format("trigger '{}': a BOOL has no threshold", trigger->name));
    return app::Comparison(symbols, symbol, app::Relation::Equal, {std::byte{1}});
  }
  if (trigger->threshold.empty())
    throw app::Error(fmt::format("trigger '{}': it is {}, not BOOL; give a threshold",
                                 trigger->name, type.name));
  return app::Comparison(symbols, symbol, app::Relation::GreaterEqual,
                         app::comparedBytes(symbols, symbol, trigger->threshold));
}

} // namespace

Recorder::Recorder(const app::SymbolTable &symbols, const RecorderSettings &settings)
    : columns_(std::in_place, symbols, settings.names), trigger_(settings.trigger),
      depth_(settings.rows), behind_(settings.rows), signal_(signalOf(symbols, settings.trigger)) {
  if (columns_->count() == 0)
    throw app::Error("a recording needs at least one variable");
  if (depth_ == 0 || depth_ > kMostBytes / columns_->rowSize())
    throw app::Error(fmt::format("a recording of {} rows is not possible; {} variables leave room "
                                 "for 1 to {}",
                                 depth_, columns_->count(), kMostBytes / columns_->rowSize()));
  if (!(settings.before >= 0.0 && settings.before <= 1.0))
    throw app::Error("the share before the trigger is a number from 0 to 1");
  if (signal_) {
    const auto before = static_cast<size_t>(settings.before * static_cast<double>(depth_));
    behind_ = std::max<size_t>(depth_ - before, 1); // the trigger's own row
    edge_ = settings.trigger->edge;
  }
  memory_.resize(depth_ * columns_->rowSize());
}

bool Recorder::triggers(std::byte *state) noexcept {
  if (!signal_)
    return true;
  const bool now = signal_->holds(state);
  const bool changed = hasLevel_ && now != level_;
  hasLevel_ = true;
  level_ = now;
  switch (edge_) {
  case TriggerEdge::Rising:
    return changed && now;
  case TriggerEdge::Falling:
    return changed && !now;
  case TriggerEdge::High:
    return now;
  case TriggerEdge::Low:
    return !now;
  }
  return false;
}

void Recorder::sample(int64_t timeNs, std::byte *state) noexcept {
  const State before = state_.load(std::memory_order_relaxed);
  if (before == State::Done)
    return;
  if (stop_.load(std::memory_order_acquire)) {
    finish();
    return;
  }
  const uint64_t number = taken_.load(std::memory_order_relaxed);
  columns_->sample(timeNs, state, memory_.data() + number % depth_ * columns_->rowSize());
  taken_.store(number + 1, std::memory_order_relaxed);
  if (before == State::Armed && triggers(state)) {
    triggered_ = true;
    triggerAt_ = number;
    state_.store(State::Triggered, std::memory_order_release);
  }
  if (state_.load(std::memory_order_relaxed) == State::Triggered &&
      number + 1 - triggerAt_ >= behind_)
    finish();
}

uint64_t Recorder::firstRow() const noexcept {
  const uint64_t all = taken();
  return all > depth_ ? all - depth_ : 0;
}

size_t Recorder::rows() const noexcept {
  return state() == State::Done ? static_cast<size_t>(taken() - firstRow()) : 0;
}

std::optional<size_t> Recorder::triggerRow() const noexcept {
  if (state() != State::Done || !signal_ || !triggered_)
    return std::nullopt;
  return static_cast<size_t>(triggerAt_ - firstRow());
}

Recorder::Carry Recorder::in(const app::SymbolTable &symbols) const {
  return {columns_->in(symbols), signalOf(symbols, trigger_)};
}

void Recorder::carryOver(Carry &carry) noexcept {
  std::swap(*columns_, carry.columns_);
  signal_.swap(carry.signal_);
}

void Recorder::detach(std::string reason) {
  if (detached_)
    return;
  if (state() != State::Done)
    endedBy_ = std::move(reason);
  finish();
  header_ = columns_->header();
  lines_.resize(rows());
  for (size_t row = 0; row < lines_.size(); ++row)
    appendRow(row, lines_[row]);
  detached_ = true;
  columns_.reset();
  signal_.reset();
  memory_ = {};
}

void Recorder::appendLine(size_t row, std::string &out) const {
  if (detached_)
    out += lines_[row];
  else
    appendRow(row, out);
}

void Recorder::appendRow(size_t row, std::string &out) const {
  const uint64_t number = firstRow() + row;
  columns_->appendLine(memory_.data() + number % depth_ * columns_->rowSize(), out);
}

} // namespace stride::monitor
