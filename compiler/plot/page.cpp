// A trace as an HTML page: compiler/plot/page.html with the trace as JSON.
#include "compiler/plot/json.hpp"
#include "compiler/plot/plot.hpp"
#include "runtime/common/text.hpp"

#include <fmt/format.h>

namespace stc::plot {

namespace {

constexpr std::string_view kPage =
#include "compiler/plot/page.inc"
    ;

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
  appendJson(out, series.values);
  out += '}';
}

std::string dataOf(const Trace &trace) {
  std::string out = fmt::format("{{\"axis\":{},\"time\":", jsonText(trace.axis));
  appendJson(out, trace.time);
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
