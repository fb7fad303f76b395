#include "runtime/app/condition.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/layout_index.hpp"
#include "runtime/app/value_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace stride::app {

namespace {

template <class T> std::partial_ordering compareAs(const void *a, const void *b) noexcept {
  T x;
  T y;
  std::memcpy(&x, a, sizeof x);
  std::memcpy(&y, b, sizeof y);
  return x <=> y;
}

template <class T>
std::partial_ordering compareTexts(const void *a, const void *b, uint32_t length) noexcept {
  for (uint32_t i = 0; i < length; ++i) {
    T x;
    T y;
    std::memcpy(&x, static_cast<const std::byte *>(a) + i * sizeof x, sizeof x);
    std::memcpy(&y, static_cast<const std::byte *>(b) + i * sizeof y, sizeof y);
    if (x != y || x == 0)
      return x <=> y;
  }
  return std::partial_ordering::equivalent;
}

} // namespace

std::partial_ordering compareValues(const StrideAppV1 &app, const TypeDesc &type, const void *a,
                                    const void *b) noexcept {
  switch (type.kind) {
  case Kind::BOOL: {
    const bool x = *static_cast<const std::byte *>(a) != std::byte{0};
    const bool y = *static_cast<const std::byte *>(b) != std::byte{0};
    return x <=> y;
  }
  case Kind::SINT:
    return compareAs<int8_t>(a, b);
  case Kind::INT:
    return compareAs<int16_t>(a, b);
  case Kind::DINT:
    return compareAs<int32_t>(a, b);
  case Kind::LINT:
  case Kind::LTIME:
  case Kind::LDATE:
  case Kind::LTOD:
  case Kind::LDT:
    return compareAs<int64_t>(a, b);
  case Kind::USINT:
  case Kind::BYTE:
    return compareAs<uint8_t>(a, b);
  case Kind::UINT:
  case Kind::WORD:
  case Kind::WCHAR:
    return compareAs<uint16_t>(a, b);
  case Kind::ULINT:
  case Kind::LWORD:
    return compareAs<uint64_t>(a, b);
  case Kind::REAL:
    return compareAs<float>(a, b);
  case Kind::LREAL:
    return compareAs<double>(a, b);
  case Kind::STRING:
    return compareTexts<unsigned char>(a, b, type.stringLength);
  case Kind::WSTRING:
    return compareTexts<uint16_t>(a, b, type.stringLength);
  case Kind::CHAR:
    return compareAs<uint8_t>(a, b);
  case Kind::Enum:
    return compareValues(app, app.types[type.element], a, b);
  default: // UDINT, DWORD, TIME, DATE, TOD, DT
    return compareAs<uint32_t>(a, b);
  }
}

Symbol resolveElementary(const SymbolTable &symbols, std::string_view path) {
  Symbol symbol = symbols.resolve(path);
  const TypeDesc &type = symbols.type(symbol);
  if (isElementary(type.kind))
    return symbol;
  const std::vector<Symbol> leaves = symbols.leaves(symbol);
  throw Error(leaves.empty()
                  ? fmt::format("symbol '{}': it is {} and has no value", path, type.name)
                  : fmt::format("symbol '{}': it is {}, not a single value; name one of its "
                                "parts, for example '{}'",
                                path, type.name, leaves.front().path()));
}

const char *whyNotWritten(const Symbol &symbol) {
  return (symbol.flags() & kSymLocated) != 0 ? "READ_ONLY in its VAR_ACCESS" : "a constant";
}

Symbol resolveWritable(const SymbolTable &symbols, std::string_view path) {
  Symbol symbol = resolveElementary(symbols, path);
  if ((symbol.flags() & kSymConstant) != 0)
    throw Error(fmt::format("symbol '{}': it is {}", path, whyNotWritten(symbol)));
  return symbol;
}

std::vector<std::byte> literalBytes(const SymbolTable &symbols, const Symbol &symbol,
                                    std::string_view literal) {
  const TypeDesc &type = symbols.type(symbol);
  std::vector<std::byte> value(type.size);
  parseLiteral(symbols.app(), type, literal, value.data());
  return value;
}

std::vector<std::byte> comparedBytes(const SymbolTable &symbols, const Symbol &symbol,
                                     std::string_view literal) {
  const StrideAppV1 &app = symbols.app();
  const TypeDesc &type = app.types[baseType(app, symbol.type())];
  std::vector<std::byte> value(type.size);
  parseLiteral(app, type, literal, value.data());
  return value;
}

Comparison::Comparison(const SymbolTable &symbols, Symbol symbol, Relation relation,
                       std::vector<std::byte> value)
    : app_(&symbols.app()), symbol_(std::move(symbol)), relation_(relation),
      value_(std::move(value)) {}

bool Comparison::holds(std::byte *state) const noexcept {
  std::byte bit{};
  const void *now = symbol_.read(state, bit);
  if (now == nullptr)
    return false;
  const std::partial_ordering order =
      compareValues(*app_, app_->types[symbol_.type()], now, value_.data());
  switch (relation_) {
  case Relation::Equal:
    return order == 0;
  case Relation::NotEqual:
    return order != 0;
  case Relation::Less:
    return order < 0;
  case Relation::LessEqual:
    return order <= 0;
  case Relation::Greater:
    return order > 0;
  case Relation::GreaterEqual:
    return order >= 0;
  }
  return false;
}

bool Condition::add(Comparison comparison) {
  steps_.push_back({Step::kCompare, comparisons_.size()});
  comparisons_.push_back(std::move(comparison));
  return ++depth_ <= kMaxDepth;
}

bool Condition::holds(std::byte *state) const noexcept {
  uint64_t stack = 0; // the newest value is bit 0
  for (const Step &step : steps_) {
    switch (step.kind) {
    case Step::kCompare:
      stack = stack << 1 | (comparisons_[step.comparison].holds(state) ? 1U : 0U);
      break;
    case Step::kNot:
      stack ^= 1U;
      break;
    case Step::kAnd:
      stack = (stack >> 1) & (stack | ~uint64_t{1});
      break;
    case Step::kOr:
      stack = (stack >> 1) | (stack & 1U);
      break;
    }
  }
  return (stack & 1U) != 0;
}

} // namespace stride::app
