// I/O devices as hooks around the tasks that use them.
#ifndef STRIDE_RUNTIME_HOST_IO_HOOKS_HPP
#define STRIDE_RUNTIME_HOST_IO_HOOKS_HPP

#include "runtime/app/application.hpp"
#include "runtime/common/io_exchange.hpp"
#include "runtime/host/input_port.hpp"
#include "runtime/task/task_set.hpp"

#include <memory>
#include <vector>

namespace stride::host {

/// Where the I/O devices that are nodes of a bus meet its driver (IoSchema::bus): by the device's
/// place in the configuration; null for others.
using IoExchanges = std::vector<std::shared_ptr<common::IoExchange>>;
IoExchanges ioExchanges(const StrideAppV1 &app);

/// Which devices.
enum class IoPlace : uint8_t {
  Alone, ///< Inputs are there before drives, outputs leave after them.
  OnBus, ///< Nodes of a bus: between its two exchanges in a cycle.
};

/// One hook per task of an application that has such devices. To be added before all other hooks,
/// but for nodes of a bus after those of the axis groups; before forces in any case. The hooks must
/// live as long as the tasks, and hold the devices. What devices give passes through `inputs`;
/// where that replays, no device is opened. Throws app::Error for a device that cannot be opened.
std::vector<std::unique_ptr<task::CycleHook>> addIoDevices(const app::Application &application,
                                                           task::TaskSet &tasks, InputPort &inputs,
                                                           IoPlace place,
                                                           const IoExchanges &exchanges);

} // namespace stride::host

#endif
