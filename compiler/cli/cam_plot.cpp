// Drawing a cam.

#include "compiler/cli/cam.hpp"
#include "compiler/plot/plot.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace stc::cli {

namespace {

using namespace stride::cam;
using namespace plot;

constexpr double kSamples = 2000; // over the whole cam
constexpr int kLeast = 16;        // of a piece

/// "mm/°²" of "mm" and "°".
std::string unitOf(const CamSource &cam, std::string_view power) {
  const std::string slave = cam.slaveUnit.empty() ? "u" : cam.slaveUnit;
  const std::string master = cam.masterUnit.empty() ? "u" : cam.masterUnit;
  return power.empty() ? slave : fmt::format("{}/{}{}", slave, master, power.substr(1));
}

std::string labelOf(const FileTappet &tappet) {
  static constexpr std::string_view kPasses[] = {"\xE2\x86\x92", "\xE2\x86\x94", "\xE2\x86\x90"};
  static constexpr std::string_view kActions[] = {"on", "off", "invert", "timed"};
  return fmt::format("{} {} {}", tappet.group, kPasses[tappet.pass], kActions[tappet.action]);
}

} // namespace

std::string drawCam(const LoadedCam &cam) {
  Trace trace;
  trace.axis = fmt::format("Master [{}]", cam.source.masterUnit.empty() ? std::string("u")
                                                                        : cam.source.masterUnit);
  const auto series = [&](std::string_view name, std::string_view title, std::string_view power) {
    Series &added = trace.series.emplace_back();
    added.name = name;
    added.quantity = Quantity{std::string(title), unitOf(cam.source, power)};
  };
  series("slave", "Position", "");
  series("slave velocity at master velocity 1", "Velocity", " ");
  series("slave acceleration at master velocity 1", "Acceleration", " \xC2\xB2");
  series("slave jerk at master velocity 1", "Jerk", " \xC2\xB3");
  const double length = cam.source.end - cam.source.start;
  for (const Segment &segment : cam.segments) {
    const int steps =
        std::max(kLeast, static_cast<int>(kSamples * (segment.end - segment.start) / length));
    for (int i = 0; i <= steps; ++i) { // both sides of a joint
      const double x =
          i == steps ? segment.end : segment.start + (segment.end - segment.start) * i / steps;
      const Point at = evaluateSegment(segment, x);
      trace.time.push_back(x);
      trace.series[0].values.push_back(at.y);
      trace.series[1].values.push_back(at.v);
      trace.series[2].values.push_back(at.a);
      trace.series[3].values.push_back(at.j);
    }
  }
  for (const FileTappet &tappet : cam.source.tappets)
    trace.marks.push_back({tappet.x, labelOf(tappet)});
  return drawSvg(trace);
}

} // namespace stc::cli
