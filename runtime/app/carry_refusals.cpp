// What no online change can carry over: other versions, native bodies, drivers and their devices.
#include "runtime/app/carry_report.hpp"

#include "runtime/app/type_match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

namespace stride::app {

namespace {

std::string bytesText(uint32_t first, uint32_t count) {
  return count == 0 ? "none" : fmt::format("byte {} to {}", first, first + count - 1);
}

constexpr const char *kNotGiven = "nothing";

/// A parameter of an I/O device, as stride.toml says it.
std::string parameterText(const StrideAppV1 &app, const IoDeviceDesc &device,
                          std::string_view name) {
  for (uint32_t i = 0; i < device.parameterCount; ++i) {
    const ParameterDesc &parameter = app.parameters[device.firstParameter + i];
    if (name == parameter.name)
      return parameter.text != nullptr ? parameter.text : fmt::format("{}", parameter.number);
  }
  return kNotGiven;
}

} // namespace

void CarryReport::refuse() {
  const StrideAppV1 &a = match_->oldApp();
  const StrideAppV1 &b = match_->newApp();
  if (a.abiVersion != b.abiVersion)
    refusals_.push_back("the builds were made by different versions of Stride");
  const auto differ = [](uint64_t x, uint64_t y) { return x != 0 && y != 0 && x != y; };
  if (differ(a.axisRefLayout, b.axisRefLayout))
    refusals_.push_back("AXIS_REF has other fields in the new build");
  if (differ(a.axisGroupRefLayout, b.axisGroupRefLayout))
    refusals_.push_back("SMC_AXISGROUP_REF has other fields in the new build");
  // A native body relies on all of its fields at once.
  for (const TypePair &pair : match_->pairs()) {
    const TypeDesc &from = a.types[pair.oldType];
    const TypeDesc &to = b.types[pair.newType];
    if (((from.flags | to.flags) & kTypeExternal) != 0 && from.layoutHash != to.layoutHash)
      refusals_.push_back(
          fmt::format("{} has a native body and other fields in the new build", to.name));
  }
  compareAxisGroups();
  compareIoDevices();
}

/// So do the drivers of I/O devices; which bytes the tasks use may change.
void CarryReport::compareIoDevices() {
  const StrideAppV1 &a = match_->oldApp();
  const StrideAppV1 &b = match_->newApp();
  const auto text = [](const char *x) { return std::string_view(x != nullptr ? x : ""); };
  for (uint32_t i = 0; i < std::max(a.ioDeviceCount, b.ioDeviceCount); ++i) {
    if (i >= a.ioDeviceCount || i >= b.ioDeviceCount) {
      const bool gone = i >= b.ioDeviceCount;
      refusals_.push_back(fmt::format("I/O device {} is {} the new build",
                                      (gone ? a : b).ioDevices[i].name,
                                      gone ? "not in" : "only in"));
      continue;
    }
    const IoDeviceDesc &x = a.ioDevices[i];
    const IoDeviceDesc &y = b.ioDevices[i];
    if (!sameName(x.name, y.name)) {
      refusals_.push_back(
          fmt::format("I/O device {} is called '{}' instead of '{}'", i + 1, y.name, x.name));
      continue;
    }
    const auto compare = [&](const char *what, const auto &was, const auto &is) {
      if (was != is)
        refusals_.push_back(
            fmt::format("I/O device {} has another {}: {} instead of {}", x.name, what, is, was));
    };
    compare("driver", text(x.driverName), text(y.driverName));
    compare("place of its inputs", bytesText(x.inputFirst, x.inputCount),
            bytesText(y.inputFirst, y.inputCount));
    compare("place of its outputs", bytesText(x.outputFirst, x.outputCount),
            bytesText(y.outputFirst, y.outputCount));
    for (uint32_t p = 0; p < x.parameterCount; ++p) {
      const char *name = a.parameters[x.firstParameter + p].name;
      compare(fmt::format("`{}`", name).c_str(), parameterText(a, x, name),
              parameterText(b, y, name));
    }
    for (uint32_t p = 0; p < y.parameterCount; ++p)
      if (const char *name = b.parameters[y.firstParameter + p].name;
          parameterText(a, x, name) == kNotGiven)
        compare(fmt::format("`{}`", name).c_str(), std::string(kNotGiven),
                parameterText(b, y, name));
  }
}

namespace {

bool sameDrives(const StrideAppV1 &a, const AxisGroupDesc &x, const StrideAppV1 &b,
                const AxisGroupDesc &y) {
  const DriveDesc *const was = a.drives + x.firstDrive;
  return x.driveCount == y.driveCount &&
         std::equal(was, was + x.driveCount, b.drives + y.firstDrive,
                    [](const DriveDesc &u, const DriveDesc &v) {
                      return sameName(u.name, v.name) && u.driveId == v.driveId;
                    });
}

bool sameEncoders(const StrideAppV1 &a, const AxisGroupDesc &x, const StrideAppV1 &b,
                  const AxisGroupDesc &y) {
  const EncoderDesc *const was = a.encoders + x.firstEncoder;
  return x.encoderCount == y.encoderCount &&
         std::equal(was, was + x.encoderCount, b.encoders + y.firstEncoder,
                    [](const EncoderDesc &u, const EncoderDesc &v) {
                      return sameName(u.name, v.name) && u.encoderId == v.encoderId;
                    });
}

bool sameTask(const StrideAppV1 &a, const AxisGroupDesc &x, const StrideAppV1 &b,
              const AxisGroupDesc &y) {
  if (x.task >= a.taskCount || y.task >= b.taskCount)
    return false;
  const TaskDesc &was = a.tasks[x.task];
  const TaskDesc &is = b.tasks[y.task];
  return sameName(was.name, is.name) && was.intervalNs == is.intervalNs;
}

} // namespace

void CarryReport::compareAxisGroup(const AxisGroupDesc &x, const AxisGroupDesc &y) {
  const StrideAppV1 &a = match_->oldApp();
  const StrideAppV1 &b = match_->newApp();
  const auto refused = [&](const char *what) {
    refusals_.push_back(fmt::format("axis group {} has {} in the new build", x.name, what));
  };
  if (!sameName(x.name, y.name) || !sameName(x.busName, y.busName)) {
    refused("another name");
    return;
  }
  if (!sameName(x.driverName, y.driverName))
    refused("another driver");
  if (x.cycleUs != y.cycleUs)
    refused("another dwCycle");
  if (!sameTask(a, x, b, y))
    refused("another task");
  const bool drives = sameDrives(a, x, b, y);
  if (!drives)
    refused("other drives");
  const bool encoders = sameEncoders(a, x, b, y);
  if (!encoders)
    refused("other encoders");
  const auto compare = [&](const char *kind, const auto &was, const auto &is) {
    compareParameters(fmt::format("{} {}", kind, was.name),
                      {was.firstParameter, was.parameterCount},
                      {is.firstParameter, is.parameterCount});
  };
  compare("axis group", x, y);
  for (uint32_t d = 0; drives && d < x.driveCount; ++d)
    compare("drive", a.drives[x.firstDrive + d], b.drives[y.firstDrive + d]);
  for (uint32_t e = 0; encoders && e < x.encoderCount; ++e)
    compare("encoder", a.encoders[x.firstEncoder + e], b.encoders[y.firstEncoder + e]);
}

/// The drivers go on running: the configuration they were started with must be the same.
void CarryReport::compareAxisGroups() {
  const StrideAppV1 &a = match_->oldApp();
  const StrideAppV1 &b = match_->newApp();
  for (uint32_t i = 0; i < std::max(a.axisGroupCount, b.axisGroupCount); ++i) {
    if (i < a.axisGroupCount && i < b.axisGroupCount) {
      compareAxisGroup(a.axisGroups[i], b.axisGroups[i]);
      continue;
    }
    const bool gone = i >= b.axisGroupCount;
    refusals_.push_back(fmt::format("axis group {} is {} the new build",
                                    (gone ? a : b).axisGroups[i].name,
                                    gone ? "not in" : "only in"));
  }
  for (uint32_t i = 0; i < std::min(a.busCount, b.busCount); ++i)
    compareParameters(fmt::format("bus {}", a.buses[i].name),
                      {a.buses[i].firstParameter, a.buses[i].parameterCount},
                      {b.buses[i].firstParameter, b.buses[i].parameterCount});
}

void CarryReport::compareParameters(const std::string &owner, Section was, Section is) {
  const auto valuesOf = [](const StrideAppV1 &app, Section section) {
    std::map<std::string, std::string> values;
    for (uint32_t i = 0; i < section.count; ++i) {
      const ParameterDesc &parameter = app.parameters[section.first + i];
      values.emplace(parameter.name, parameter.text != nullptr
                                         ? fmt::format("\"{}\"", parameter.text)
                                         : fmt::format("{}", parameter.number));
    }
    return values;
  };
  const std::map<std::string, std::string> before = valuesOf(match_->oldApp(), was);
  const std::map<std::string, std::string> after = valuesOf(match_->newApp(), is);
  const auto say = [&](const std::string &name, const std::string &change) {
    atNextStart_.push_back(
        fmt::format("{}: {} {}; that takes effect at the next start", owner, name, change));
  };
  for (const auto &[name, value] : before) {
    const auto now = after.find(name);
    if (now == after.end())
      say(name, fmt::format("= {} is not given any more", value));
    else if (now->second != value)
      say(name, fmt::format("is {} instead of {}", now->second, value));
  }
  for (const auto &[name, value] : after)
    if (!before.contains(name))
      say(name, fmt::format("= {} is new", value));
}

} // namespace stride::app
