#include "runtime/host/group_setups.hpp"

namespace stride::host {
namespace {

void addParameters(const StrideAppV1 &app, uint32_t first, uint32_t count,
                   bus::SetupParameters &to) {
  for (uint32_t i = 0; i < count; ++i) {
    const ParameterDesc &parameter = app.parameters[first + i];
    to.add({parameter.name, parameter.text != nullptr ? parameter.text : "", parameter.number});
  }
}

double cycleSecondsOf(const StrideAppV1 &app, const AxisGroupDesc &group) {
  const TaskDesc &task = app.tasks[group.task];
  const bool paced = task.kind == TaskKind::Cyclic || task.kind == TaskKind::Freewheeling;
  return paced ? static_cast<double>(task.intervalNs) * 1e-9
               : static_cast<double>(group.cycleUs) * 1e-6;
}

} // namespace

bus::GroupSetup groupSetup(const StrideAppV1 &app, const AxisGroupDesc &group,
                           const bus::DriverSchema &schema) {
  bus::GroupSetup setup(schema, cycleSecondsOf(app, group));
  setup.name = group.name;
  setup.bus = group.busName;
  if (group.bus != kNoIndex) {
    const BusDesc &bus = app.buses[group.bus];
    setup.interfaceType = bus.interfaceType;
    addParameters(app, bus.firstParameter, bus.parameterCount, setup.busParameters);
  }
  addParameters(app, group.firstParameter, group.parameterCount, setup.parameters);
  for (uint32_t i = 0; i < group.driveCount; ++i) {
    const DriveDesc &drive = app.drives[group.firstDrive + i];
    addParameters(app, drive.firstParameter, drive.parameterCount,
                  setup.addDrive(drive.name, drive.driveId).parameters);
  }
  for (uint32_t i = 0; i < group.encoderCount; ++i) {
    const EncoderDesc &encoder = app.encoders[group.firstEncoder + i];
    addParameters(app, encoder.firstParameter, encoder.parameterCount,
                  setup.addEncoder(encoder.name, encoder.encoderId).parameters);
  }
  return setup;
}

} // namespace stride::host
