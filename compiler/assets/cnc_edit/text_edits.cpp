#include "compiler/assets/cnc_edit/text_edits.hpp"

namespace stc::gcode {

std::string editedText(std::string_view text, const std::vector<Edit> &edits) {
  std::string out;
  out.reserve(text.size() + edits.size() * 4);
  size_t at = 0;
  for (const Edit &edit : edits) {
    out += text.substr(at, edit.span.begin - at);
    out += edit.text;
    at = edit.span.end;
  }
  out += text.substr(at);
  return out;
}

} // namespace stc::gcode
