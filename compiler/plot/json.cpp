#include "compiler/plot/json.hpp"

#include <cmath>
#include <fmt/format.h>

namespace stc::plot {

std::string jsonText(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\' || c == '<' || c == '>' || c == '&' ||
        static_cast<unsigned char>(c) < ' ')
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

void appendJson(std::string &out, const std::vector<double> &values) {
  out += '[';
  for (size_t i = 0; i < values.size(); ++i) {
    if (i != 0)
      out += ',';
    // As short as it is unambiguous.
    out += std::isfinite(values[i]) ? fmt::format("{}", values[i]) : std::string("null");
    if (out.ends_with(".0"))
      out.resize(out.size() - 2);
  }
  out += ']';
}

} // namespace stc::plot
