#ifndef STRIDE_COMPILER_SOURCE_SYNTHETIC_SOURCE_HPP
#define STRIDE_COMPILER_SOURCE_SYNTHETIC_SOURCE_HPP
// Structured Text that Stride writes for the checker: PLC configuration, cams, tests, events.

#include "compiler/source/span.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stc {

/// A text that nobody has written, which knows of its parts what they stand for: what is wrong in
/// one is shown there.
class SyntheticSource {
public:
  /// A part and the place in what the user has written.
  struct Part {
    uint32_t begin = 0;
    uint32_t end = 0;
    Span origin;
  };

  /// `name`: as messages would show it (`<plc>/Drive_Configuration_Data.st`). A list of global
  /// variables gets its name from it.
  explicit SyntheticSource(std::string name) : name_(std::move(name)) {}

  /// Appends text that stands for nothing of the user's.
  void add(std::string_view text) { text_ += text; }
  /// Appends text that stands for what is at `origin`.
  void add(std::string_view text, Span origin) {
    const auto begin = static_cast<uint32_t>(text_.size());
    text_ += text;
    parts_.push_back({begin, static_cast<uint32_t>(text_.size()), origin});
  }

  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] const std::string &name() const { return name_; }
  [[nodiscard]] const std::string &text() const { return text_; }
  /// In the order of the text.
  [[nodiscard]] const std::vector<Part> &parts() const { return parts_; }

private:
  std::string name_;
  std::string text_;
  std::vector<Part> parts_;
};

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_SYNTHETIC_SOURCE_HPP
