// stride csy path

#include "compiler/assets/csy/path_source.hpp"
#include "compiler/cli/commands.hpp"
#include "compiler/plot/xy_plot.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/source/read_source.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace stc::cli {

namespace {

using namespace stride::csy;

std::string shortText(double value) {
  if (value == stride::exact::kInfinity)
    return "no limit";
  const std::string text = fmt::format("{:.3f}", value);
  return text == "-0.000" ? "0.000" : text;
}

std::string speedOf(double value) {
  return value == stride::exact::kInfinity ? shortText(value) : shortText(value) + " mm/s";
}

std::string resultsOf(const CsyPath &path) {
  const uint32_t points = path.trajectory.points;
  std::vector<double> table[3];
  for (size_t i = 0; i < 3; ++i) {
    table[i].resize(2 * size_t{points});
    fillResults(path.trajectory, path.speeds, static_cast<ResultTable>(i), table[i].data());
  }
  std::string text = "  point  type  end of          master     allowed    computed\n";
  for (size_t i = 0; i < points; ++i) {
    const int16_t type = path.table.point[i].type;
    const bool hasBlend = type == 1 || type == 2 || type == 10;
    for (size_t k = 0; k < (i > 0 && hasBlend ? 2U : 1U); ++k) {
      const std::string_view end = i == 0     ? "start"
                                   : hasBlend ? (k == 0 ? "line" : "blend")
                                              : "segment";
      text += fmt::format("  {:<5}  {:>4}  {:<8}  {:>12}{:>12}{:>12}\n",
                          k == 0 ? fmt::format("P{}", i) : std::string(),
                          k == 0 ? fmt::format("{}", type) : std::string(), end,
                          shortText(table[0][2 * i + k]), shortText(table[1][2 * i + k]),
                          shortText(table[2][2 * i + k]));
    }
  }
  return text;
}

std::string describe(const std::string &file, const CsyPath &path) {
  const Trajectory &trajectory = path.trajectory;
  return fmt::format("{}\n"
                     "  points          {} (table of {} words)\n"
                     "  length          {} mm\n"
                     "  points of cams  {}, so that the cams need {}\n"
                     "  closed          {}\n"
                     "  constant speed  {}\n",
                     file, trajectory.points, lengthOfTable(path.table.axes, trajectory.points),
                     shortText(trajectory.length), trajectory.camPoints,
                     trajectory.camPoints + kSpareCamPoints, isClosed(trajectory) ? "yes" : "no",
                     speedOf(constantSpeed(trajectory, path.speeds))) +
         resultsOf(path);
}

/// The path, coloured by the computed speeds where they are limited.
std::string drawingOf(const CsyPath &path) {
  constexpr int kSamples = 64; // of a piece
  plot::Trace trace;
  trace.series.resize(3);
  trace.series[0].name = "X [mm]";
  trace.series[1].name = "Y [mm]";
  trace.series[2].name = "computed speed [mm/s]";
  bool limited = true;
  for (uint32_t i = 0; i < path.trajectory.pieces; ++i) {
    const Piece &piece = path.trajectory.piece[i];
    limited = limited && path.speeds.computed[i] < stride::exact::kInfinity;
    for (int k = 0; k <= kSamples; ++k) {
      const double part = k / double{kSamples};
      const Vector3 place = stride::path::overParameter(piece.shape, part).p;
      trace.time.push_back(piece.start + piece.length * part);
      trace.series[0].values.push_back(place.x);
      trace.series[1].values.push_back(place.y);
      trace.series[2].values.push_back(path.speeds.computed[i]);
    }
  }
  plot::XyPicture picture;
  picture.curves = {{&trace.series[0], &trace.series[1]}};
  picture.color = limited ? &trace.series[2] : nullptr;
  return drawXySvg(trace, picture);
}

} // namespace

int csyPathCommand(const CsyPathOptions &options) {
  Sources sources;
  Diagnostics diagnostics;
  std::string text;
  if (const std::optional<FileId> id = sources.load(options.file, options.file); !id) {
    diagnostics.report(Code::UnreadableFile, {},
                       fmt::format("`{}` cannot be read: {}", options.file, readSourceError()));
  } else if (const std::unique_ptr<CsyPath> path = readCsyPath(sources.file(*id), diagnostics)) {
    text = describe(options.file, *path);
    if (!options.plot.empty() && !writeFile(options.plot, drawingOf(*path)))
      diagnostics.report(Code::CannotWrite, {},
                         fmt::format("`{}` cannot be written: {}", options.plot, lastError()));
  }
  diagnostics.sort();
  const int exitCode = show(diagnostics.all(), sources, options.output);
  if (exitCode == 0)
    print(text);
  return exitCode;
}

} // namespace stc::cli
