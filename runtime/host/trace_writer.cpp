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

TraceColumns::TraceColumns(const app::SymbolTable &symbols, const std::vector<std::string> &paths)
    : app_(&symbols.app()), rowSize_(sizeof(int64_t)), lineWidth_(32) {
  for (const std::string &path : paths) {
    const app::Symbol symbol = symbols.resolve(path);
    std::vector<app::Symbol> leaves = symbols.leaves(symbol);
    if (leaves.empty())
      throw app::Error(fmt::format("symbol '{}': there is no value to trace in a {}", path,
                                   symbols.type(symbol).name));
    for (app::Symbol &leaf : leaves) {
      const TypeDesc &type = symbols.type(leaf);
      lineWidth_ += app::csvWidth(type) + 1;
      const std::size_t offset = (rowSize_ + type.align) / type.align * type.align;
      columns_.push_back({std::move(leaf), offset, type.size});
      rowSize_ = offset + type.size;
    }
  }
  rowSize_ = (rowSize_ + 7) / 8 * 8;
}

TraceColumns TraceColumns::in(const app::SymbolTable &symbols) const {
  std::vector<std::string> paths;
  for (const Column &column : columns_)
    paths.push_back(column.symbol.path());
  TraceColumns other(symbols, paths);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const TypeDesc &was = app_->types[columns_[i].symbol.type()];
    const bool same = other.columns_.size() == columns_.size() &&
                      symbols.type(other.columns_[i].symbol).layoutHash == was.layoutHash;
    if (!same)
      throw app::Error(fmt::format("'{}', which is traced, is no longer a {}",
                                   columns_[i].symbol.path(), was.name));
  }
  return other;
}

void TraceColumns::sample(int64_t timeNs, std::byte *state, std::byte *row) const noexcept {
  std::memcpy(row, &timeNs, sizeof timeNs);
  for (const Column &column : columns_) {
    std::byte bit{};
    const void *value = column.symbol.read(state, bit);
    row[column.offset - 1] = std::byte{value != nullptr};
    if (value != nullptr)
      std::memcpy(row + column.offset, value, column.size);
  }
}

std::string TraceColumns::header() const {
  std::string line = "t";
  for (const Column &column : columns_) {
    line += ',';
    line += headerField(column.symbol.path());
  }
  return line;
}

void TraceColumns::appendLine(const std::byte *row, std::string &out) const {
  int64_t timeNs = 0;
  std::memcpy(&timeNs, row, sizeof timeNs);
  appendSeconds(timeNs, out);
  for (const Column &column : columns_) {
    out.push_back(',');
    if (row[column.offset - 1] != std::byte{0})
      app::appendCsv(*app_, app_->types[column.symbol.type()], row + column.offset, out);
  }
}

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
