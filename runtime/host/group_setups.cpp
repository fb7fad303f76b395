#include "runtime/host/group_setups.hpp"

#include "drivers/io/registry.hpp"
#include "runtime/common/text.hpp"

namespace stride::host {
namespace {

void addParameters(const StrideAppV1 &app, uint32_t first, uint32_t count,
                   bus::SetupParameters &to) {
  for (uint32_t i = 0; i < count; ++i) {
    const ParameterDesc &parameter = app.parameters[first + i];
    to.add({parameter.name, parameter.text != nullptr ? parameter.text : "", parameter.number});
  }
}

/// I/O devices that are nodes of the group's bus.
void addIos(const StrideAppV1 &app, const AxisGroupDesc &group, bus::GroupSetup &setup) {
  for (uint32_t i = 0; i < app.ioDeviceCount; ++i) {
    const IoDeviceDesc &desc = app.ioDevices[i];
    const io::IoSchema *schema = drivers::findIoSchema(desc.driverName);
    if (schema == nullptr || schema->bus != setup.schema->name)
      continue;
    bus::IoSetup io;
    io.name = desc.name;
    io.inputBytes = desc.inputCount;
    io.outputBytes = desc.outputCount;
    if (desc.safeOutputs != nullptr)
      io.safeOutputs.assign(desc.safeOutputs, desc.safeOutputs + desc.outputCount);
    io.device = i;
    io.parameters =
        bus::SetupParameters({{}, schema->parameters, schema->tables}, setup.cycleSeconds);
    addParameters(app, desc.firstParameter, desc.parameterCount, io.parameters);
    if (common::lowerCase(io.parameters.text("axis_group")) == common::lowerCase(group.name))
      setup.ios.push_back(std::move(io));
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
  addIos(app, group, setup);
  return setup;
}

} // namespace stride::host
