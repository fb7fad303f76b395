#ifndef STRIDE_COMPILER_ASSETS_DXF_PAIRS_HPP
#define STRIDE_COMPILER_ASSETS_DXF_PAIRS_HPP
// The lines of a DXF file: group codes and their values.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"

#include <optional>
#include <string_view>

namespace stc::dxf {

/// A group: what it is, and its value without blanks around it.
struct Pair {
  int32_t code = 0;
  std::string_view value;
  Span span; ///< Of the value.
};

/// Reports what is wrong, once: after the first error there are no others.
class Faults {
public:
  explicit Faults(Diagnostics &diagnostics) : diagnostics_(diagnostics) {}

  void report(Span where, const std::string &message, const std::string &label,
              const std::string &help);
  [[nodiscard]] bool any() const { return any_; }

private:
  Diagnostics &diagnostics_;
  bool any_ = false;
};

/// Reads group after group.
class Pairs {
public:
  /// From `begin` to `end` of the file's text; each is where a group begins.
  Pairs(const SourceFile &file, size_t begin, size_t end, Faults &faults)
      : file_(file), text_(file.text().substr(0, end)), at_(begin), faults_(faults) {}

  /// The next group; nothing at the end, or where a line is none, which is reported.
  std::optional<Pair> next();
  /// Where the next group begins.
  [[nodiscard]] size_t place() const { return at_; }
  [[nodiscard]] Span here() const;

private:
  std::string_view line();

  const SourceFile &file_;
  std::string_view text_;
  size_t at_;
  Faults &faults_;
};

/// Numbers in a drawing are no larger.
inline constexpr double kMostNumber = 1e9;

/// The value as a number; 0 where it is none, or infinite, or larger than kMostNumber, which is
/// reported.
[[nodiscard]] double numberOf(const Pair &pair, Faults &faults);
/// The value as a whole number, likewise.
[[nodiscard]] int32_t integerOf(const Pair &pair, Faults &faults);

} // namespace stc::dxf

#endif // STRIDE_COMPILER_ASSETS_DXF_PAIRS_HPP
