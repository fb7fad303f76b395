#include "runtime/host/trace_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include <unistd.h>

namespace stride::host {

namespace {

constexpr size_t kBufferSize = size_t{1} << 18;

bool isStandard(const std::string &out) { return out.empty() || out == "-"; }

Output outputOf(const app::TraceColumns &columns, const std::string &out, Output::Wait wait) {
  const size_t capacity =
      std::max(columns.header().size() + 1, kBufferSize) + columns.lineWidth() + 1;
  return isStandard(out) ? Output(STDOUT_FILENO, capacity, wait) : Output(out, capacity, wait);
}

} // namespace

TraceWriter::TraceWriter(const app::SymbolTable &symbols, const std::vector<std::string> &paths,
                         const std::string &out, Output::Wait wait)
    : columns_(symbols, paths), row_(columns_.rowSize()),
      name_(isStandard(out) ? "standard output" : out), output_(outputOf(columns_, out, wait)) {
  output_.append(columns_.header() + '\n');
}

void TraceWriter::row(int64_t timeNs, std::byte *state) {
  columns_.sample(timeNs, state, row_.data());
  row(row_.data());
}

/// What comes after an error is taken and forgotten.
bool TraceWriter::ready() noexcept {
  return output_.error() != 0 || output_.ready(columns_.lineWidth() + 1);
}

void TraceWriter::row(const std::byte *sampled) {
  if (!ready() || output_.error() != 0)
    return;
  columns_.appendLine(sampled, output_.text());
  output_.text().push_back('\n');
}

void TraceWriter::flush() noexcept { static_cast<void>(output_.settle()); }

bool TraceWriter::finish() noexcept {
  incomplete_ = !output_.finish() || incomplete_;
  return !incomplete_;
}

std::string TraceWriter::problem() const {
  if (output_.error() == 0 && !incomplete_)
    return {};
  return fmt::format("cannot write the trace to '{}': {}", name_,
                     output_.error() != 0 ? std::strerror(output_.error()) : "nobody reads it");
}

} // namespace stride::host
