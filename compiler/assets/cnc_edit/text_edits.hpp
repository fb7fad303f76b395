#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_TEXT_EDITS_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_TEXT_EDITS_HPP
// Changes of a text that leave everything else as it is: comments, blanks, line ends.

#include "compiler/source/diagnostic.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stc::gcode {

/// The text with the edits carried out. They stand in the order of the text and do not overlap; an
/// empty span inserts.
[[nodiscard]] std::string editedText(std::string_view text, const std::vector<Edit> &edits);

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_TEXT_EDITS_HPP
