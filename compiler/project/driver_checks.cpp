// What the driver of an axis group has to say of it: `stride check` asks it as the runtime would.

#include "compiler/project/config_reader.hpp"
#include "compiler/project/driver_sections.hpp"
#include "compiler/syntax/st_text.hpp"
#include "drivers/io/registry.hpp"
#include "drivers/registry.hpp"
#include "runtime/bus/group_setup.hpp"

namespace stc {

namespace {

void addAll(const std::vector<ConfigParameter> &parameters, stride::bus::SetupParameters &to) {
  for (const ConfigParameter &parameter : parameters)
    to.add({parameter.name, parameter.text, parameter.number});
}

/// The I/O devices at the bus of an axis group: places in the configuration.
std::vector<size_t> iosOf(const ProjectConfig &config, const AxisGroupConfig &group) {
  std::vector<size_t> ios;
  for (size_t i = 0; i < config.ioDevices.size(); ++i)
    if (equalIgnoringCase(config.ioDevices[i].axisGroup.text, group.name.text))
      ios.push_back(i);
  return ios;
}

/// The configuration of an axis group as its driver gets it at run time. `driver` is that of the
/// group, and must live as long as the result; `cycleSeconds`: of its task.
stride::bus::GroupSetup driverSetup(const ProjectConfig &config, const AxisGroupConfig &group,
                                    const stride::bus::DriverSchema &driver, double cycleSeconds) {
  const BusConfig &bus = config.buses[group.bus];
  stride::bus::GroupSetup setup(driver, cycleSeconds);
  setup.name = group.name.text;
  setup.bus = bus.name.text;
  setup.interfaceType = bus.interfaceType;
  addAll(bus.parameters, setup.busParameters);
  addAll(group.parameters, setup.parameters);
  for (const DriveConfig &drive : group.drives)
    addAll(drive.parameters, setup.addDrive(drive.name.text, drive.id).parameters);
  for (const EncoderConfig &encoder : group.encoders)
    addAll(encoder.parameters, setup.addEncoder(encoder.name.text, encoder.id).parameters);
  for (const size_t index : iosOf(config, group)) {
    const AppConfig::IoDevice &device = config.ioDevices[index].device;
    const stride::io::IoSchema &schema = *stride::drivers::findIoSchema(device.driver);
    stride::bus::IoSetup &io = setup.ios.emplace_back();
    io.name = device.name;
    io.inputBytes = device.inputCount;
    io.outputBytes = device.outputCount;
    io.safeOutputs = device.safeOutputs;
    io.device = index;
    io.parameters =
        stride::bus::SetupParameters({{}, schema.parameters, schema.tables}, cycleSeconds);
    addAll(device.parameters, io.parameters);
  }
  return setup;
}

} // namespace

std::vector<stride::bus::GroupPlanText> busPlans(const ProjectConfig &config) {
  std::vector<stride::bus::GroupPlanText> plans;
  for (const AxisGroupConfig &group : config.axisGroups) {
    const stride::bus::DriverSchema *driver = stride::drivers::findSchema(group.driver);
    if (driver != nullptr && driver->plan != nullptr && group.cycleUs != 0)
      plans.push_back(driver->plan(driverSetup(config, group, *driver, group.cycleUs * 1e-6)));
  }
  return plans;
}

void checkByDriver(const ProjectConfig &config, const AxisGroupConfig &group, double cycleSeconds,
                   Diagnostics &diagnostics) {
  const stride::bus::DriverSchema *driver = stride::drivers::findSchema(group.driver);
  if (driver == nullptr || driver->check == nullptr)
    return;
  stride::bus::GroupFindings findings;
  driver->check(driverSetup(config, group, *driver, cycleSeconds), findings);
  for (const stride::bus::GroupFinding &finding : findings) {
    const std::vector<size_t> ios = iosOf(config, group);
    const Span span = finding.io < ios.size() ? config.ioDevices[ios[finding.io]].name.span
                      : finding.drive < group.drives.size() ? group.drives[finding.drive].name.span
                                                            : group.name.span;
    Diagnostic &d =
        diagnostics.report(finding.isError ? Code::ConfigDriverRefuses : Code::ConfigDriverWarns,
                           span, finding.message, finding.label);
    if (!finding.help.empty())
      d.help(finding.help);
  }
}

} // namespace stc
