// Conditions on variables: of input scripts and of the recorder's trigger.
#ifndef STRIDE_RUNTIME_APP_CONDITION_HPP
#define STRIDE_RUNTIME_APP_CONDITION_HPP

#include "runtime/app/symbols.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace stride::app {

/// How two values of an elementary type are ordered: numbers and times by size, texts by their
/// characters, FALSE before TRUE. Unordered only with a NaN.
std::partial_ordering compareValues(const StrideAppV1 &app, const TypeDesc &type, const void *a,
                                    const void *b) noexcept;

/// What a comparison asks.
enum class Relation : uint8_t { Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual };

/// Resolves an elementary variable. Throws Error: unknown name, not elementary.
Symbol resolveElementary(const SymbolTable &symbols, std::string_view path);
/// Resolves one that is to be written. Throws Error for a constant, too.
Symbol resolveWritable(const SymbolTable &symbols, std::string_view path);
/// What a variable is that cannot be written: "a constant" or what VAR_ACCESS says of it.
const char *whyNotWritten(const Symbol &symbol);
/// The bytes of a literal of the symbol's type, for a comparison: of a subrange any value of its
/// base type. Throws Error.
std::vector<std::byte> comparedBytes(const SymbolTable &symbols, const Symbol &symbol,
                                     std::string_view literal);
/// The bytes of a literal of the symbol's type. Throws Error.
std::vector<std::byte> literalBytes(const SymbolTable &symbols, const Symbol &symbol,
                                    std::string_view literal);

/// A variable compared with a value. Where a pointer on the way to the variable is null it does not
/// hold.
class Comparison {
public:
  /// `symbol` is elementary, `value` of its type.
  Comparison(const SymbolTable &symbols, Symbol symbol, Relation relation,
             std::vector<std::byte> value);

  /// In the cyclic path: neither allocates nor locks.
  bool holds(std::byte *state) const noexcept;

private:
  const StrideAppV1 *app_;
  Symbol symbol_;
  Relation relation_;
  std::vector<std::byte> value_;
};

/// Comparisons joined by NOT, AND and OR.
class Condition {
public:
  /// Deepest nesting.
  static constexpr size_t kMaxDepth = 60;

  /// In postfix order. False: nested too deeply.
  bool add(Comparison comparison);
  void addNot() { steps_.push_back({Step::kNot, 0}); }
  void addAnd() { join(Step::kAnd); }
  void addOr() { join(Step::kOr); }

  /// In the cyclic path: neither allocates nor locks.
  bool holds(std::byte *state) const noexcept;

private:
  struct Step {
    enum Kind : uint8_t { kCompare, kNot, kAnd, kOr } kind;
    size_t comparison;
  };
  void join(Step::Kind kind) {
    steps_.push_back({kind, 0});
    --depth_;
  }

  std::vector<Comparison> comparisons_;
  std::vector<Step> steps_;
  size_t depth_ = 0;
};

} // namespace stride::app

#endif
