#include "runtime/host/trace_writer.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace stride::host {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18;

} // namespace

TraceWriter::TraceWriter(const app::SymbolTable &symbols, const std::vector<std::string> &paths,
                         const std::string &out)
    : columns_(symbols, paths), row_(columns_.rowSize()), name_(out) {
  buffer_ = columns_.header() + '\n';
  buffer_.reserve(std::max(buffer_.size(), kBufferSize) + columns_.lineWidth());
  const bool toStdout = out.empty() || out == "-";
  file_ = toStdout ? stdout : std::fopen(out.c_str(), "wb");
  if (file_ == nullptr)
    throw app::Error(fmt::format("cannot write '{}': {}", out, std::strerror(errno)));
}

TraceWriter::~TraceWriter() {
  if (file_ != nullptr && file_ != stdout)
    std::fclose(file_);
}

void TraceWriter::row(int64_t timeNs, std::byte *state) {
  columns_.sample(timeNs, state, row_.data());
  row(row_.data());
}

void TraceWriter::row(const std::byte *sampled) {
  if (buffer_.capacity() - buffer_.size() < columns_.lineWidth())
    flush();
  columns_.appendLine(sampled, buffer_);
  buffer_.push_back('\n');
}

void TraceWriter::flush() {
  failed_ = std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size() || failed_;
  buffer_.clear();
}

void TraceWriter::finish() {
  flush();
  failed_ = std::fflush(file_) != 0 || failed_;
  if (file_ != stdout)
    failed_ = std::fclose(file_) != 0 || failed_;
  file_ = nullptr;
  if (failed_)
    throw app::Error(
        fmt::format("cannot write '{}': {}", name_.empty() ? "-" : name_, std::strerror(errno)));
}

} // namespace stride::host
