// I/O devices as hooks around the tasks that use them.
#ifndef STRIDE_RUNTIME_HOST_IO_HOOKS_HPP
#define STRIDE_RUNTIME_HOST_IO_HOOKS_HPP

#include "runtime/app/application.hpp"
#include "runtime/host/input_port.hpp"
#include "runtime/task/task_set.hpp"

#include <memory>
#include <vector>

namespace stride::host {

/// One hook per task of an application that has I/O devices. To be added before all other hooks:
/// inputs are there before drives and forces, outputs leave behind them. The hooks must live as
/// long as the tasks, and hold the devices. What devices give passes through `inputs`; where that
/// replays, no device is opened. Throws app::Error for a device that cannot be opened.
std::vector<std::unique_ptr<task::CycleHook>> addIoDevices(const app::Application &application,
                                                           task::TaskSet &tasks, InputPort &inputs);

} // namespace stride::host

#endif
