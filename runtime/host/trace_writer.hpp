// The trace as CSV.
#ifndef STRIDE_RUNTIME_HOST_TRACE_WRITER_HPP
#define STRIDE_RUNTIME_HOST_TRACE_WRITER_HPP

#include "runtime/app/trace_columns.hpp"
#include "runtime/host/output.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace stride::host {

/// Writes a trace: a header line and a line per row. What cannot be written ends the trace, not
/// the run: see problem().
class TraceWriter {
public:
  /// `out` empty or "-": standard output. Throws app::Error as TraceColumns does, and when the file
  /// cannot be created.
  TraceWriter(const app::SymbolTable &symbols, const std::vector<std::string> &paths,
              const std::string &out, Output::Wait wait = Output::Wait::Always);

  const app::TraceColumns &columns() const { return columns_; }
  /// Another build has taken over: `columns` are these columns in it. Between two cycles;
  /// `columns` gets the old ones.
  void swapColumns(app::TraceColumns &columns) noexcept { std::swap(columns_, columns); }
  /// Whether there is room for a row; with Output::Wait::Always there always is.
  bool ready() noexcept;
  /// While ready(): a row with the values as they are now.
  void row(int64_t timeNs, std::byte *state);
  /// The same, with the values that TraceColumns::sample() took. Neither allocates.
  void row(const std::byte *sampled);
  /// Writes the rest of what there is, for something else that follows; may wait a little.
  void flush() noexcept;
  /// Writes the rest and closes the file. False: something is missing, see problem().
  bool finish() noexcept;
  /// Why the trace is not complete: "cannot write 'a.csv': …"; empty while it is.
  std::string problem() const;

private:
  app::TraceColumns columns_;
  std::vector<std::byte> row_;
  std::string name_;
  Output output_;
  bool incomplete_ = false;
};

} // namespace stride::host

#endif
