#include "compiler/plot/plot.hpp"
#include "compiler/cli/commands.hpp"
#include "compiler/cli/trace_types.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/source/identifier.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <limits>

namespace stc::cli {

namespace {

/// `Title=Drive.f*,Main.n`, or only the columns.
plot::PanelChoice panelOf(const std::string &text) {
  plot::PanelChoice panel;
  const size_t equals = text.find('=');
  if (equals != std::string::npos)
    panel.title = text.substr(0, equals);
  std::string_view rest = text;
  rest.remove_prefix(equals == std::string::npos ? 0 : equals + 1);
  int depth = 0; // a[1,2] is one name
  std::string name;
  for (size_t i = 0; i <= rest.size(); ++i) {
    if (i == rest.size() || (rest[i] == ',' && depth == 0)) {
      if (!name.empty())
        panel.columns.push_back(name);
      name.clear();
      continue;
    }
    depth += rest[i] == '[' ? 1 : rest[i] == ']' ? -1 : 0;
    if (rest[i] != ' ')
      name += rest[i];
  }
  return panel;
}

/// The name that a user gives a panel may match nothing, which is said.
std::string emptyPanel(const plot::Trace &trace) {
  for (const plot::PanelChoice &panel : trace.panels) {
    plot::Trace alone;
    alone.series = trace.series;
    alone.panels = {panel};
    if (plot::arrange(alone).empty())
      return fmt::format("{}", fmt::join(panel.columns, ","));
  }
  return {};
}

std::optional<plot::Trace> readTraceOf(const PlotOptions &options, int &exitCode) {
  const std::optional<std::string> csv = readFile(options.trace);
  if (!csv) {
    exitCode = showError(Code::UnreadableFile,
                         fmt::format("`{}` cannot be read: {}", options.trace, lastError()));
    return std::nullopt;
  }
  plot::TraceError error;
  std::optional<plot::Trace> data = plot::readTrace(*csv, error);
  const auto bad = [&](const std::string &message) {
    exitCode =
        showError(Code::BadTrace, fmt::format("`{}` is not a trace: {}", options.trace, message));
    return std::nullopt;
  };
  if (!data)
    return bad(error.line == 0 ? error.message
                               : fmt::format("line {}: {}", error.line, error.message));
  constexpr double kEver = std::numeric_limits<double>::infinity();
  if (!plot::cut(*data, options.from.value_or(-kEver), options.to.value_or(kEver)))
    return bad("there are no rows between --from and --to");
  return data;
}

} // namespace

int plotCommand(const PlotOptions &options) {
  const std::string path =
      options.out.empty() ? std::filesystem::path(options.trace).replace_extension(".svg").string()
                          : options.out;
  const std::string ending = lowerCase(std::filesystem::path(path).extension().string());
  const bool isPage = ending == ".html" || ending == ".htm";
  if (!isPage && ending != ".svg")
    return showError(Code::CannotWrite,
                     fmt::format("`{}`: pictures are drawn as .svg or .html{}", path,
                                 ending == ".png"
                                     ? "; a .png of an .svg makes for example "
                                       "`rsvg-convert trace.svg -o trace.png` (Debian: "
                                       "librsvg2-bin)"
                                     : ""));
  int exitCode = 0;
  std::optional<plot::Trace> data = readTraceOf(options, exitCode);
  if (!data)
    return exitCode;
  data->title = options.title;
  for (const std::string &panel : options.panels)
    data->panels.push_back(panelOf(panel));
  describeTrace(*data, options.project, options.trace);
  if (const std::string names = emptyPanel(*data); !names.empty())
    return showError(Code::BadTrace, fmt::format("`{}` has no column `{}`", options.trace, names));
  if (!writeFile(path, isPage ? plot::drawPage(*data) : plot::drawSvg(*data)))
    return showError(Code::CannotWrite,
                     fmt::format("`{}` cannot be written: {}", path, lastError()));
  return 0;
}

} // namespace stc::cli
