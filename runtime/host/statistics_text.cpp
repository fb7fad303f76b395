#include "runtime/host/statistics_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>

namespace stride::host {

namespace {

/// "12.3", or "-" where nothing was measured.
std::string micros(int64_t ns, bool known) {
  return known ? fmt::format("{:.1f}", static_cast<double>(ns) * 1e-3) : "-";
}

void appendRow(std::string &out, const std::array<std::string, 13> &cells) {
  constexpr std::array<int, 13> kWidths = {16, 10, 8, 8, 9, 9, 9, 9, 9, 9, 9, 11, 11};
  for (size_t i = 0; i < cells.size(); ++i)
    out += i == 0 ? fmt::format("{:<{}}", cells[i], kWidths[i])
                  : fmt::format("{:>{}}", cells[i], kWidths[i]);
  out += '\n';
}

/// Counts by powers of two: below 1 us, 1 to 2 us, 2 to 4 us …
void appendHistogram(std::string &out, const char *title, const task::Histogram &histogram) {
  std::array<uint64_t, task::Histogram::kTopBit> counts{};
  uint64_t most = 0;
  for (size_t b = 0; b < task::Histogram::kBuckets; ++b) {
    size_t power = 0;
    while (power + 1 < counts.size() && (int64_t{1000} << power) <= task::Histogram::lowerEnd(b))
      ++power;
    counts[power] += histogram.count(b);
    most = std::max(most, counts[power]);
  }
  out += fmt::format("  {}\n", title);
  for (size_t power = 0; power < counts.size(); ++power) {
    if (counts[power] == 0)
      continue;
    const auto stars =
        static_cast<size_t>(40.0 * static_cast<double>(counts[power]) / static_cast<double>(most));
    out += fmt::format("    < {:>9} us {:>10}  {}\n", int64_t{1} << power, counts[power],
                       std::string(std::max<size_t>(stars, 1), '*'));
  }
}

} // namespace

std::string statisticsTable(const task::TaskSet &tasks) {
  std::string out;
  appendRow(out, {"task [us]", "cycles", "overrun", "watchdg", "run min", "mean", "p99", "max",
                  "late p50", "p99", "max", "intvl min", "max"});
  for (uint32_t i = 0; i < tasks.count(); ++i) {
    const task::TaskStatistics &statistics = tasks.statistics(i);
    const task::TaskFigures f = statistics.figures();
    const bool any = f.cycles != 0;
    const bool two = f.cycles > 1;
    appendRow(out, {tasks.desc(i).name, std::to_string(f.cycles), std::to_string(f.overruns),
                    std::to_string(f.watchdogViolations), micros(f.minRunNs, any),
                    micros(f.meanRunNs(), any), micros(statistics.runTimes().quantile(0.99), any),
                    micros(f.maxRunNs, any), micros(statistics.latencies().quantile(0.5), any),
                    micros(statistics.latencies().quantile(0.99), any), micros(f.maxLatencyNs, any),
                    micros(f.minIntervalNs, two), micros(f.maxIntervalNs, two)});
  }
  return out;
}

static nlohmann::ordered_json figuresOf(const task::TaskSet &tasks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (uint32_t i = 0; i < tasks.count(); ++i) {
    const task::TaskStatistics &statistics = tasks.statistics(i);
    const task::TaskFigures f = statistics.figures();
    const auto quantiles = [](const task::Histogram &histogram) {
      return nlohmann::ordered_json{{"p50", histogram.quantile(0.5)},
                                    {"p99", histogram.quantile(0.99)},
                                    {"p999", histogram.quantile(0.999)}};
    };
    nlohmann::ordered_json run = quantiles(statistics.runTimes());
    run["min"] = f.minRunNs;
    run["mean"] = f.meanRunNs();
    run["max"] = f.maxRunNs;
    nlohmann::ordered_json late = quantiles(statistics.latencies());
    late["max"] = f.maxLatencyNs;
    list.push_back({{"task", tasks.desc(i).name},
                    {"cycles", f.cycles},
                    {"overruns", f.overruns},
                    {"watchdogViolations", f.watchdogViolations},
                    {"runNs", std::move(run)},
                    {"lateNs", std::move(late)},
                    {"intervalNs", {{"min", f.minIntervalNs}, {"max", f.maxIntervalNs}}}});
  }
  return list;
}

std::string statisticsJson(const std::vector<NamedTasks> &applications) {
  if (applications.size() == 1)
    return figuresOf(*applications.front().tasks).dump(1) + '\n';
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const NamedTasks &one : applications)
    all[one.application] = figuresOf(*one.tasks);
  return all.dump(1) + '\n';
}

std::string histogramText(const task::TaskStatistics &statistics) {
  std::string out;
  appendHistogram(out, "run time", statistics.runTimes());
  appendHistogram(out, "delay of the start", statistics.latencies());
  return out;
}

} // namespace stride::host
