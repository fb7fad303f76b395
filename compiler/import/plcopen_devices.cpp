// The device tree of CODESYS V3 in PLCopen XML: drives become simulated ones.
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/plcopen_context.hpp"
#include "compiler/import/project_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

namespace stc::import::plcopen {

namespace {

/// Parameters of drives of CODESYS V3 that have the names of those of stride.toml.
constexpr std::array<std::string_view, 6> kDriveParameters = {
    "dwRatioTechUnitsDenom", "iRatioTechUnitsNum", "fSWMaxVelocity",
    "fSWMaxAcceleration",    "fSWMaxDeceleration", "fSWMaxJerk"};

/// All elements Parameter below a device.
void collectParameters(const Node &node, std::vector<Node> &out) {
  for (const Node &each : children(node))
    if (localName(each) == "Parameter")
      out.push_back(each);
    else
      collectParameters(each, out);
}

/// As TOML has numbers, which knows neither `.5` nor `007`; empty: the text is none.
std::string tomlNumber(const std::string &text) {
  char *end = nullptr;
  const long long whole = std::strtoll(text.c_str(), &end, 10);
  const bool fits = whole != std::numeric_limits<long long>::max() &&
                    whole != std::numeric_limits<long long>::min();
  if (!text.empty() && *end == '\0' && fits)
    return fmt::format("{}", whole);
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value) ? fmt::format("{}", value)
                                                               : std::string();
}

} // namespace

void readDevice(Context &context, const Node &configuration, std::vector<DriveSetup> &drives) {
  std::vector<Node> parameters;
  collectParameters(extra(configuration, "Device"), parameters);
  if (parameters.empty())
    return;
  const std::string name = attribute(configuration, "name");
  DriveSetup drive;
  drive.name = name;
  drive.origin = context.originOf(configuration);
  for (const Node &each : parameters) {
    const std::string key = textOf(child(each, "Name"));
    const std::string value(trimmed(textOf(child(each, "Value"))));
    const auto *const known =
        std::find_if(kDriveParameters.begin(), kDriveParameters.end(),
                     [&](std::string_view parameter) { return sameName(parameter, key); });
    const std::string number = tomlNumber(value);
    if (known != kDriveParameters.end() && !number.empty())
      drive.parameters.push_back({std::string(*known), number, Certainty::Guessed,
                                  "the drive of CODESYS V3, whose units may be others"});
  }
  const size_t others = parameters.size() - drive.parameters.size();
  if (drive.parameters.empty() || !isName(name)) {
    context.leftOut(configuration, fmt::format("device {}", name),
                    fmt::format("its parameters ({}): hardware is configured in stride.toml",
                                parameters.size()));
    return;
  }
  drive.parameters.insert(
      drive.parameters.begin(),
      {"wDriveId", fmt::format("{}", drives.size() + 1), Certainty::Guessed, "its order"});
  if (others != 0)
    context.leftOut(configuration, fmt::format("drive {}", name),
                    fmt::format("its other parameters ({})", others));
  drives.push_back(std::move(drive));
}

void addDrives(Context &context, std::vector<DriveSetup> drives, const std::string &task) {
  if (drives.empty())
    return;
  DriveGroupSetup group;
  group.name = "Axes";
  group.origin = drives.front().origin;
  if (!task.empty())
    group.parameters.push_back(
        {"sTask", tomlText(task), Certainty::Guessed, "the first task with an interval"});
  group.drives = std::move(drives);
  BusSetup bus;
  bus.name = "SoftMotion";
  bus.origin = group.origin;
  bus.groups.push_back(std::move(group));
  context.model().buses.push_back(std::move(bus));
}

} // namespace stc::import::plcopen
