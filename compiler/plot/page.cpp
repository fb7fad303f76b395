// A trace as an HTML page: compiler/plot/page.html with the trace as JSON.
#include "compiler/plot/plot.hpp"
#include "runtime/common/text.hpp"

#include <cmath>
#include <fmt/format.h>

namespace stc::plot {

namespace {

constexpr std::string_view kPage =
#include "compiler/plot/page.inc"
    ;

/// A JSON text within an HTML page: nothing in it ends the script.
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

void appendValues(std::string &out, const std::vector<double> &values) {
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

void appendSeries(std::string &out, const Series &series) {
  out += fmt::format("{{\"name\":{},\"bool\":{},", jsonText(series.name), series.isBool);
  if (!series.states.empty()) {
    std::string_view separator = "\"states\":{";
    for (const auto &[value, name] : series.states) {
      out += fmt::format("{}\"{}\":{}", separator, value, jsonText(name));
      separator = ",";
    }
    out += "},";
  }
  out += "\"values\":";
  appendValues(out, series.values);
  out += '}';
}

std::string dataOf(const Trace &trace) {
  std::string out = fmt::format("{{\"axis\":{},\"time\":", jsonText(trace.axis));
  appendValues(out, trace.time);
  out += ",\"panels\":[";
  for (const Panel &panel : arrange(trace)) {
    if (out.back() == '}')
      out += ',';
    out += fmt::format("{{\"title\":{},\"lanes\":{},\"series\":[",
                       jsonText(labelOf(panel.quantity)), panel.lanes);
    for (const Series *series : panel.series) {
      if (series != panel.series.front())
        out += ',';
      appendSeries(out, *series);
    }
    out += "]}";
  }
  return out + "]}";
}

} // namespace

std::string drawPage(const Trace &trace) {
  const std::string title =
      stride::common::escapedMarkup(trace.title.empty() ? std::string("Trace") : trace.title);
  std::string page;
  for (std::string_view rest = kPage; !rest.empty();) {
    const size_t at = rest.find('@');
    page += rest.substr(0, at);
    if (at == std::string_view::npos)
      break;
    rest.remove_prefix(at);
    const auto replaces = [&](std::string_view mark, const std::string &text) {
      if (!rest.starts_with(mark))
        return false;
      page += text;
      rest.remove_prefix(mark.size());
      return true;
    };
    if (!replaces("@TITLE@", title) && !replaces("@DATA@", dataOf(trace))) {
      page += '@';
      rest.remove_prefix(1);
    }
  }
  return page;
}

} // namespace stc::plot
