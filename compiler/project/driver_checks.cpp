// What the driver of an axis group has to say of it: `stride check` asks it as the runtime would.

#include "compiler/project/config_reader.hpp"
#include "compiler/project/driver_sections.hpp"
#include "drivers/registry.hpp"
#include "runtime/bus/group_setup.hpp"

namespace stc {

namespace {

void addAll(const std::vector<ConfigParameter> &parameters, stride::bus::SetupParameters &to) {
  for (const ConfigParameter &parameter : parameters)
    to.add({parameter.name, parameter.text, parameter.number});
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
    const Span span = finding.drive < group.drives.size() ? group.drives[finding.drive].name.span
                                                          : group.name.span;
    Diagnostic &d =
        diagnostics.report(finding.isError ? Code::ConfigDriverRefuses : Code::ConfigDriverWarns,
                           span, finding.message, finding.label);
    if (!finding.help.empty())
      d.help(finding.help);
  }
}

} // namespace stc
