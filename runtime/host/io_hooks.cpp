#include "runtime/host/io_hooks.hpp"

#include "drivers/io/shared_memory_io.hpp"
#include "drivers/io/simulated_io.hpp"
#include "runtime/app/error.hpp"
#include "runtime/io/process_image.hpp"

#include <fmt/format.h>

#include <span>
#include <string_view>

namespace stride::host {

namespace {

using Devices = std::vector<std::unique_ptr<io::IoDevice>>;

/// Stands for a device whose values come from a recording.
class RecordedIo final : public io::IoDriver {
public:
  bool works(int64_t) noexcept override { return true; }
  bool read(uint32_t, std::span<BYTE>) noexcept override { return false; }
  void write(uint32_t, std::span<const BYTE>) noexcept override {}
};

class PassOn final : public io::InputPass {
public:
  explicit PassOn(InputPort &port) : port_(&port) {}
  void pass(void *value, size_t size) noexcept override { port_->pass(value, size); }

private:
  InputPort *port_;
};

std::unique_ptr<io::IoDriver> makeDriver(const IoDeviceDesc &desc, bool replays) {
  io::IoSettings settings;
  settings.name = desc.name;
  settings.inputBytes = desc.inputCount;
  settings.outputBytes = desc.outputCount;
  settings.loopBack = desc.loopBack != 0;
  settings.delayCycles = desc.delayCycles;
  settings.segment = desc.segment != nullptr ? desc.segment : "";
  settings.timeoutNs = desc.timeoutNs;
  const std::string_view driver = desc.driverName;
  if (driver == "Simulated")
    return io::makeSimulatedIo(settings);
  if (driver == "SharedMemory" && replays)
    return std::make_unique<RecordedIo>();
  if (driver == "SharedMemory")
    return io::makeSharedMemoryIo(settings);
  throw app::Error(fmt::format("I/O device '{}' asks for driver '{}', which this runtime does not "
                               "have; it has 'Simulated' and 'SharedMemory'",
                               desc.name, driver));
}

std::shared_ptr<Devices> openDevices(const StrideAppV1 &app, bool replays) {
  auto devices = std::make_shared<Devices>();
  for (uint32_t i = 0; i < app.ioDeviceCount; ++i) {
    const IoDeviceDesc &desc = app.ioDevices[i];
    auto device = std::make_unique<io::IoDevice>();
    device->name = desc.name;
    device->driver = makeDriver(desc, replays);
    device->index = i;
    device->inputBytes = desc.inputCount;
    device->outputBytes = desc.outputCount;
    device->lostText =
        fmt::format("I/O device '{}' is lost: its outputs have their safe values", desc.name);
    devices->push_back(std::move(device));
  }
  return devices;
}

/// Keeps the devices as long as one of their hooks lives.
class DeviceHook final : public task::CycleHook {
public:
  DeviceHook(const StrideAppV1 &app, std::byte *state, uint32_t task,
             std::shared_ptr<Devices> devices, InputPort &inputs)
      : devices_(std::move(devices)), inputs_(inputs),
        image_(app, state, task, *devices_, inputs_) {}

  void beforePous(Ctx &ctx) override { image_.beforePous(ctx); }
  void afterPous(Ctx &ctx) override { image_.afterPous(ctx); }
  void applicationStopped() override { image_.applicationStopped(); }
  void rebind(const StrideAppV1 &app, std::byte *state) noexcept override {
    image_.rebind(app, state);
  }
  void prepareRebind(const StrideAppV1 &app) override { image_.prepareRebind(app); }
  std::vector<std::string> takeNews() override { return image_.takeNews(); }
  std::string problem() const override { return image_.problem(); }

private:
  std::shared_ptr<Devices> devices_;
  PassOn inputs_;
  io::ImageHook image_;
};

} // namespace

std::vector<std::unique_ptr<task::CycleHook>>
addIoDevices(const app::Application &application, task::TaskSet &tasks, InputPort &inputs) {
  std::vector<std::unique_ptr<task::CycleHook>> hooks;
  const StrideAppV1 &app = application.description();
  if (app.ioDeviceCount == 0)
    return hooks;
  const std::shared_ptr<Devices> devices = openDevices(app, inputs.replays());
  for (uint32_t task = 0; task < app.taskCount; ++task) {
    hooks.push_back(std::make_unique<DeviceHook>(app, application.state(), task, devices, inputs));
    tasks.addHook(task, *hooks.back());
  }
  return hooks;
}

} // namespace stride::host
