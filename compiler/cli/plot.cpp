#include "compiler/plot/plot.hpp"
#include "compiler/cli/commands.hpp"
#include "compiler/cli/trace_types.hpp"
#include "compiler/plot/xy_plot.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/source/identifier.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <limits>

namespace stc::cli {

namespace {

/// The names in `Drive.f*,Main.n`.
std::vector<std::string> namesOf(std::string_view text) {
  std::vector<std::string> names;
  int depth = 0; // a[1,2] is one name
  std::string name;
  for (size_t i = 0; i <= text.size(); ++i) {
    if (i == text.size() || (text[i] == ',' && depth == 0)) {
      if (!name.empty())
        names.push_back(name);
      name.clear();
      continue;
    }
    depth += text[i] == '[' ? 1 : text[i] == ']' ? -1 : 0;
    if (text[i] != ' ')
      name += text[i];
  }
  return names;
}

/// `Title=Drive.f*,Main.n`, or only the columns.
plot::PanelChoice panelOf(const std::string &text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos)
    return {{}, namesOf(text)};
  return {text.substr(0, equals), namesOf(std::string_view(text).substr(equals + 1))};
}

/// The columns that --xy and --color name. What is wrong, or nothing.
std::string readXy(const PlotOptions &options, const plot::Trace &trace, plot::XyPicture &picture) {
  std::string missing;
  const auto find = [&](const std::string &name) -> const plot::Series * {
    for (const plot::Series &series : trace.series)
      if (equalIgnoringCase(series.name, name))
        return &series;
    missing = name;
    return nullptr;
  };
  for (const std::string &text : options.xy) {
    const std::vector<std::string> names = namesOf(text);
    if (names.size() != 2)
      return fmt::format("`--xy {}` names {} columns; two are drawn against each other", text,
                         names.size());
    picture.curves.push_back({find(names[0]), find(names[1])});
  }
  if (!options.color.empty())
    picture.color = find(options.color);
  return missing.empty() ? std::string()
                         : fmt::format("`{}` has no column `{}`", options.trace, missing);
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
  plot::XyPicture xy;
  if (const std::string wrong = readXy(options, *data, xy); !wrong.empty())
    return showError(Code::BadTrace, wrong);
  const std::string picture = xy.curves.empty()
                                  ? isPage ? plot::drawPage(*data) : plot::drawSvg(*data)
                              : isPage ? plot::drawXyPage(*data, xy)
                                       : plot::drawXySvg(*data, xy);
  if (!writeFile(path, picture))
    return showError(Code::CannotWrite,
                     fmt::format("`{}` cannot be written: {}", path, lastError()));
  return 0;
}

} // namespace stc::cli
