#include "runtime/host/trace_writer.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/value_text.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstring>

namespace stride::host {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18;

/// A name as a CSV field: quoted only where a comma in it (a[1,2]) demands that.
std::string headerField(const std::string &name) {
  return name.find(',') == std::string::npos ? name : '"' + name + '"';
}

} // namespace

void appendSeconds(int64_t timeNs, std::string &out) {
  char buffer[32];
  const int64_t seconds = timeNs / 1000000000;
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, seconds).ptr);
  int64_t fraction = timeNs % 1000000000;
  if (fraction == 0)
    return;
  int digits = 9;
  while (fraction % 10 == 0) {
    fraction /= 10;
    --digits;
  }
  char *end = std::to_chars(buffer, buffer + sizeof buffer, fraction).ptr;
  out.push_back('.');
  out.append(static_cast<std::size_t>(digits) - static_cast<std::size_t>(end - buffer), '0');
  out.append(buffer, end);
}

TraceWriter::TraceWriter(const app::SymbolTable &symbols, const std::vector<std::string> &paths,
                         const std::string &out, std::byte *state)
    : app_(&symbols.app()), state_(state), name_(out) {
  for (const std::string &path : paths) {
    const app::Symbol symbol = symbols.resolve(path);
    std::vector<app::Symbol> leaves = symbols.leaves(symbol);
    if (leaves.empty())
      throw app::Error(fmt::format("symbol '{}': there is no value to trace in a {}", path,
                                   symbols.type(symbol).name));
    for (app::Symbol &leaf : leaves)
      columns_.push_back(std::move(leaf));
  }
  buffer_ = "t";
  rowWidth_ = 32;
  for (const app::Symbol &column : columns_) {
    buffer_ += ',';
    buffer_ += headerField(column.path());
    rowWidth_ += app::csvWidth(symbols.type(column)) + 1;
  }
  buffer_ += '\n';
  buffer_.reserve(std::max(buffer_.size(), kBufferSize) + rowWidth_);
  const bool toStdout = out.empty() || out == "-";
  file_ = toStdout ? stdout : std::fopen(out.c_str(), "wb");
  if (file_ == nullptr)
    throw app::Error(fmt::format("cannot write '{}': {}", out, std::strerror(errno)));
}

TraceWriter::~TraceWriter() {
  if (file_ != nullptr && file_ != stdout)
    std::fclose(file_);
}

void TraceWriter::row(int64_t timeNs) {
  if (buffer_.capacity() - buffer_.size() < rowWidth_)
    flush();
  appendSeconds(timeNs, buffer_);
  for (const app::Symbol &column : columns_) {
    buffer_.push_back(',');
    std::byte bit{};
    if (const void *value = column.read(state_, bit))
      app::appendCsv(*app_, app_->types[column.type()], value, buffer_);
  }
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
