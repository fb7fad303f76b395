// Axis groups as hooks around their tasks.
#ifndef STRIDE_RUNTIME_HOST_AXIS_HOOKS_HPP
#define STRIDE_RUNTIME_HOST_AXIS_HOOKS_HPP

#include "runtime/app/application.hpp"
#include "runtime/bus/group_setup.hpp"
#include "runtime/host/input_port.hpp"
#include "runtime/host/io_hooks.hpp"
#include "runtime/task/task_set.hpp"

#include <memory>
#include <string>
#include <vector>

namespace stride::host {

/// The layouts of AXIS_REF and SMC_AXISGROUP_REF that this program was built with.
app::RuntimeLayouts runtimeLayouts();

/// One hook per axis group of the application, added to the group's task, on buses of that kind,
/// with their I/O devices at `exchanges` and parameters of drives in the folder `files`. Of several
/// groups each has a file of its own: `bus.log` is `bus.GROUP.log`. The hooks must live as long as
/// the tasks. What is measured passes `inputs`. Throws app::Error for an unknown driver, and when
/// the application was built with another AXIS_REF or SMC_AXISGROUP_REF than this program.
std::vector<std::unique_ptr<task::CycleHook>>
addAxisGroups(const app::Application &application, task::TaskSet &tasks, InputPort &inputs,
              bus::BusKind buses, const bus::BusRecording &recording, const std::string &files,
              const IoExchanges &exchanges);

/// The hooks of I/O devices and axis groups, added in the order that a cycle has: inputs, drives,
/// nodes with inputs; the other way round with outputs.
std::vector<std::unique_ptr<task::CycleHook>>
addDevices(const app::Application &application, task::TaskSet &tasks, InputPort &inputs,
           bus::BusKind buses, const bus::BusRecording &recording, const std::string &files);

/// One line about each drive that is in error stop, to be shown at the end of a run; `hooks` are
/// those of addAxisGroups, among others.
std::vector<std::string> errorStops(const std::vector<std::unique_ptr<task::CycleHook>> &hooks);

} // namespace stride::host

#endif
