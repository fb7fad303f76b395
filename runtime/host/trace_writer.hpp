// The trace as CSV.
#ifndef STRIDE_RUNTIME_HOST_TRACE_WRITER_HPP
#define STRIDE_RUNTIME_HOST_TRACE_WRITER_HPP

#include "runtime/monitor/trace_columns.hpp"

#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace stride::host {

using monitor::TraceColumns;

/// Writes a trace: a header line and a line per row.
class TraceWriter {
public:
  /// `out` empty or "-": standard output. Throws app::Error as TraceColumns does, and when the file
  /// cannot be written.
  TraceWriter(const app::SymbolTable &symbols, const std::vector<std::string> &paths,
              const std::string &out);
  ~TraceWriter();
  TraceWriter(const TraceWriter &) = delete;
  TraceWriter &operator=(const TraceWriter &) = delete;

  const TraceColumns &columns() const { return columns_; }
  /// Another build has taken over: `columns` are these columns in it. Between two cycles;
  /// afterwards `columns` are the old ones.
  void swapColumns(TraceColumns &columns) noexcept { std::swap(columns_, columns); }

  /// The values as they are now. Does not allocate.
  void row(int64_t timeNs, std::byte *state);
  /// A row that TraceColumns::sample has made. Does not allocate.
  void row(const std::byte *sampled);
  /// Flushes everything; throws app::Error when the file could not be written.
  void finish();

private:
  void flush();

  TraceColumns columns_;
  std::vector<std::byte> row_;
  std::string buffer_;
  std::string name_;
  std::FILE *file_ = nullptr;
  bool failed_ = false;
};

} // namespace stride::host

#endif
