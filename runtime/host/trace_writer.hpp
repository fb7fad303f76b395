// The trace as CSV.
#ifndef STRIDE_RUNTIME_HOST_TRACE_WRITER_HPP
#define STRIDE_RUNTIME_HOST_TRACE_WRITER_HPP

#include "runtime/app/symbols.hpp"

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace stride::host {

/// Writes one header row (`t`, then the names as given; a name that is not elementary becomes its
/// leaves) and one row per call of row(): t in seconds, then the values. A variable that cannot be
/// reached at the moment (null pointer) leaves its field empty. row() does not allocate.
class TraceWriter {
public:
  /// `out` empty or "-": standard output. Throws app::Error: unknown name, nothing to trace below
  /// a name, file cannot be written.
  TraceWriter(const app::SymbolTable &symbols, const std::vector<std::string> &paths,
              const std::string &out, std::byte *state);
  ~TraceWriter();
  TraceWriter(const TraceWriter &) = delete;
  TraceWriter &operator=(const TraceWriter &) = delete;

  void row(int64_t timeNs);
  /// Flushes everything; throws app::Error when the file could not be written.
  void finish();

  std::size_t columns() const { return columns_.size(); }

private:
  void flush();

  const StrideAppV1 *app_;
  std::byte *state_;
  std::vector<app::Symbol> columns_;
  std::string buffer_;
  std::size_t rowWidth_ = 0;
  std::string name_;
  std::FILE *file_ = nullptr;
  bool failed_ = false;
};

/// Appends a time in seconds without trailing zeros, exact: 0, 0.003, 1.5.
void appendSeconds(int64_t timeNs, std::string &out);

} // namespace stride::host

#endif
