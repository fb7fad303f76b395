#ifndef STRIDE_COMPILER_SOURCE_TOML_SECTIONS_HPP
#define STRIDE_COMPILER_SOURCE_TOML_SECTIONS_HPP
// A TOML file cut into its outermost sections, each as it is written.

#include <array>
#include <string_view>
#include <vector>

namespace stc {

/// The sections of stride.toml that describe the hardware and its axes: PLCopen XML has no elements
/// for them, so that they go through it as they are.
inline constexpr std::array<std::string_view, 6> kHardwareSections = {"image",      "io",  "axis",
                                                                      "axes_group", "csy", "bus"};

/// `[[bus]]` up to the next header, with the comment lines right before it. `[[bus.axis_group]]` is
/// a section of its own with the same name.
struct TomlSectionText {
  std::string_view name; ///< `bus`: the outermost part
  std::string_view text; ///< with the \n at its end, when there is one
};

/// The sections in the order of the text, which must be TOML without errors; what stands before the
/// first header is left out. Views into `text`.
[[nodiscard]] std::vector<TomlSectionText> tomlSections(std::string_view text);

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_TOML_SECTIONS_HPP
