// What a trace records, and how a row of it looks in memory and as CSV.
#ifndef STRIDE_RUNTIME_APP_TRACE_COLUMNS_HPP
#define STRIDE_RUNTIME_APP_TRACE_COLUMNS_HPP

#include "runtime/app/symbols.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stride::app {

/// The variables of a trace and how a row of their values lies in memory: the time, then for each
/// variable whether it can be reached at the moment (a pointer on the way may be null) and its
/// value.
class TraceColumns {
public:
  /// A name that is not elementary becomes its leaves. Throws Error: unknown name, nothing to
  /// trace below a name.
  TraceColumns(const SymbolTable &symbols, const std::vector<std::string> &paths);

  /// The same variables in another build. Throws Error where it lacks one or has another type
  /// for it.
  TraceColumns in(const SymbolTable &symbols) const;

  size_t count() const { return columns_.size(); }
  /// Bytes of a row, a multiple of 8.
  size_t rowSize() const { return rowSize_; }
  /// Longest line of text for a row. [bytes]
  size_t lineWidth() const { return lineWidth_; }

  /// Copies the values as they are now. In the cyclic path: neither allocates nor locks.
  void sample(int64_t timeNs, std::byte *state, std::byte *row) const noexcept;

  /// `t` and the names as given.
  std::string header() const;
  /// Time in seconds, then the values; the field of one that could not be reached is empty.
  /// Allocates only when `out` has no capacity left.
  void appendLine(const std::byte *row, std::string &out) const;

private:
  static constexpr uint64_t kMoves = ~uint64_t{0};
  struct Column {
    Symbol symbol;
    size_t offset; ///< Of the value in a row; the byte before says whether there is one.
    size_t size;
    uint64_t place; ///< In the state; kMoves: to be found anew each time.
  };
  const StrideAppV1 *app_;
  std::vector<Column> columns_;
  size_t rowSize_ = 0;
  size_t lineWidth_ = 0;
};

/// Appends a time in seconds without trailing zeros, exact: 0, 0.003, 1.5.
void appendSeconds(int64_t timeNs, std::string &out);

} // namespace stride::app

#endif
