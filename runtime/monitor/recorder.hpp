// Records variables in every cycle, around an event.
#ifndef STRIDE_RUNTIME_MONITOR_RECORDER_HPP
#define STRIDE_RUNTIME_MONITOR_RECORDER_HPP

#include "runtime/app/condition.hpp"
#include "runtime/app/trace_columns.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stride::monitor {

/// When a trigger comes. Its signal is a BOOL, or whether a variable is at or above a threshold.
enum class TriggerEdge : uint8_t {
  Rising,  ///< The signal becomes TRUE.
  Falling, ///< The signal becomes FALSE.
  High,    ///< The signal is TRUE.
  Low,     ///< The signal is FALSE.
};

/// What makes a recording begin.
struct TriggerSettings {
  std::string name;
  TriggerEdge edge = TriggerEdge::Rising;
  std::string threshold; ///< An ST literal; empty for a BOOL.
};

/// What is recorded.
struct RecorderSettings {
  std::vector<std::string> names;         ///< A structure or an array stands for its parts.
  size_t rows = 1000;                     ///< Rows of a complete recording.
  double before = 0.0;                    ///< Share of the rows before the trigger, 0 … 1.
  std::optional<TriggerSettings> trigger; ///< Without one it begins at once.
};

/// A ring of rows, filled by one task at the end of its cycles until the trigger has come and the
/// rows after it are there. Read by another thread when it is done.
class Recorder {
public:
  static constexpr size_t kMostBytes = size_t{256} << 20;

  enum class State : uint8_t { Armed, Triggered, Done };

  /// Allocates everything. Throws app::Error: unknown names, a bad threshold, too many rows.
  Recorder(const app::SymbolTable &symbols, const RecorderSettings &settings);

  /// At the end of a cycle; neither allocates nor locks.
  void sample(int64_t timeNs, std::byte *state) noexcept;

  State state() const noexcept { return state_.load(std::memory_order_acquire); }
  /// Done at the next sample(), with the rows that there are.
  void stop() noexcept { stop_.store(true, std::memory_order_release); }
  /// Done at once: nobody calls sample() at this moment.
  void finish() noexcept { state_.store(State::Done, std::memory_order_release); }

  /// What it records, in another build of the application.
  class Carry {
  private:
    friend class Recorder;
    Carry(app::TraceColumns columns, std::optional<app::Comparison> signal)
        : columns_(std::move(columns)), signal_(std::move(signal)) {}
    app::TraceColumns columns_;
    std::optional<app::Comparison> signal_;
  };
  /// For an online change, unless it is detached. Throws app::Error where the other build lacks a
  /// variable or has another type for it.
  Carry in(const app::SymbolTable &symbols) const;
  /// Goes on in the other build: nobody calls sample() at this moment. Afterwards `carry` holds
  /// what leads into the old one.
  void carryOver(Carry &carry) noexcept;
  /// Done, with its rows as text: the build that they come from may go. Nobody calls sample() any
  /// more. `reason`: why it has ended early.
  void detach(std::string reason);
  bool detached() const noexcept { return detached_; }
  /// Why it has ended before its time; empty: it has not.
  const std::string &endedBy() const noexcept { return endedBy_; }
  /// Rows taken so far, also those that the ring has lost since.
  uint64_t taken() const noexcept { return taken_.load(std::memory_order_relaxed); }

  /// Rows that can be read; 0 until it is done.
  size_t rows() const noexcept;
  /// The row that the trigger came with; nothing without a trigger, or if it did not come.
  std::optional<size_t> triggerRow() const noexcept;
  /// `t` and the names, as in every trace.
  std::string header() const { return detached_ ? header_ : columns_->header(); }
  /// Appends the CSV line of a row, the oldest is 0.
  void appendLine(size_t row, std::string &out) const;

private:
  void appendRow(size_t row, std::string &out) const;
  bool triggers(std::byte *state) noexcept;
  uint64_t firstRow() const noexcept;

  std::optional<app::TraceColumns> columns_; ///< Until it is detached.
  std::optional<TriggerSettings> trigger_;
  size_t depth_;
  size_t behind_; ///< Rows from the trigger on.
  std::optional<app::Comparison> signal_;
  TriggerEdge edge_ = TriggerEdge::Rising;
  bool hasLevel_ = false;
  bool level_ = false; ///< The signal in the last cycle.
  bool triggered_ = false;
  uint64_t triggerAt_ = 0; ///< Number of the row.
  std::vector<std::byte> memory_;
  std::atomic<uint64_t> taken_{0};
  std::atomic<State> state_{State::Armed};
  std::atomic<bool> stop_{false};
  bool detached_ = false;
  std::string header_;             ///< When it is detached.
  std::vector<std::string> lines_; ///< When it is detached.
  std::string endedBy_;
};

} // namespace stride::monitor

#endif
