#include "runtime/app/trace_columns.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/value_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstring>

namespace stride::app {

namespace {

/// A name as a CSV field: quoted only where a comma in it (a[1,2]) demands that.
std::string headerField(const std::string &name) {
  return name.find(',') == std::string::npos ? name : '"' + name + '"';
}

/// memcpy whose usual sizes are single instructions.
void copyValue(std::byte *to, const std::byte *from, size_t size) noexcept {
  switch (size) {
  case 1:
    *to = *from;
    break;
  case 2:
    std::memcpy(to, from, 2);
    break;
  case 4:
    std::memcpy(to, from, 4);
    break;
  case 8:
    std::memcpy(to, from, 8);
    break;
  default:
    std::memcpy(to, from, size);
    break;
  }
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
  out.append(static_cast<size_t>(digits) - static_cast<size_t>(end - buffer), '0');
  out.append(buffer, end);
}

TraceColumns::TraceColumns(const SymbolTable &symbols, const std::vector<std::string> &paths)
    : app_(&symbols.app()), rowSize_(sizeof(int64_t)), lineWidth_(32) {
  for (const std::string &path : paths) {
    const Symbol symbol = symbols.resolve(path);
    std::vector<Symbol> leaves = symbols.leaves(symbol);
    if (leaves.empty())
      throw Error(fmt::format("symbol '{}': there is no value to trace in a {}", path,
                              symbols.type(symbol).name));
    for (Symbol &leaf : leaves) {
      const TypeDesc &type = symbols.type(leaf);
      lineWidth_ += csvWidth(type) + 1;
      const size_t offset = (rowSize_ + type.align) / type.align * type.align;
      const uint64_t place = leaf.fixedOffset().value_or(kMoves);
      columns_.push_back({std::move(leaf), offset, type.size, place});
      rowSize_ = offset + type.size;
    }
  }
  rowSize_ = (rowSize_ + 7) / 8 * 8;
}

TraceColumns TraceColumns::in(const SymbolTable &symbols) const {
  std::vector<std::string> paths;
  for (const Column &column : columns_)
    paths.push_back(column.symbol.path());
  TraceColumns other(symbols, paths);
  for (size_t i = 0; i < columns_.size(); ++i) {
    const TypeDesc &was = app_->types[columns_[i].symbol.type()];
    const bool same = other.columns_.size() == columns_.size() &&
                      symbols.type(other.columns_[i].symbol).layoutHash == was.layoutHash;
    if (!same)
      throw Error(fmt::format("'{}', which is traced, is no longer a {}", columns_[i].symbol.path(),
                              was.name));
  }
  return other;
}

void TraceColumns::sample(int64_t timeNs, std::byte *state, std::byte *row) const noexcept {
  std::memcpy(row, &timeNs, sizeof timeNs);
  for (const Column &column : columns_) {
    if (column.place != kMoves) {
      row[column.offset - 1] = std::byte{1};
      copyValue(row + column.offset, state + column.place, column.size);
      continue;
    }
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
      appendCsv(*app_, app_->types[column.symbol.type()], row + column.offset, out);
  }
}

} // namespace stride::app
