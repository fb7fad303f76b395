#include "runtime/host/io_hooks.hpp"

#include "drivers/io/io_drivers.hpp"
#include "runtime/app/error.hpp"
#include "runtime/io/process_image.hpp"

#include <fmt/format.h>

#include <span>

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

const drivers::IoDriverEntry &driverOf(const IoDeviceDesc &desc) {
  const drivers::IoDriverEntry *driver = drivers::findIoDriver(desc.driverName);
  if (driver == nullptr)
    throw app::Error(
        fmt::format("I/O device '{}' asks for driver '{}', which this runtime does not "
                    "have; {}",
                    desc.name, desc.driverName, drivers::knownIoDrivers()));
  return *driver;
}

io::IoSettings settingsOf(const StrideAppV1 &app, const IoDeviceDesc &desc,
                          const io::IoSchema &schema,
                          std::shared_ptr<common::IoExchange> exchange) {
  io::IoSettings settings;
  settings.name = desc.name;
  settings.exchange = std::move(exchange);
  settings.inputBytes = desc.inputCount;
  settings.outputBytes = desc.outputCount;
  settings.parameters = common::SetupParameters({{}, schema.parameters, schema.tables});
  for (uint32_t i = 0; i < desc.parameterCount; ++i) {
    const ParameterDesc &parameter = app.parameters[desc.firstParameter + i];
    settings.parameters.add(
        {parameter.name, parameter.text != nullptr ? parameter.text : "", parameter.number});
  }
  return settings;
}

std::unique_ptr<io::IoDriver> makeDriver(const StrideAppV1 &app, const IoDeviceDesc &desc,
                                         const drivers::IoDriverEntry &driver, bool replays,
                                         std::shared_ptr<common::IoExchange> exchange) {
  if (driver.schema->external && replays)
    return std::make_unique<RecordedIo>();
  return driver.make(settingsOf(app, desc, *driver.schema, std::move(exchange)));
}

bool isOnBus(const IoDeviceDesc &desc) { return !driverOf(desc).schema->bus.empty(); }

std::shared_ptr<Devices> openDevices(const StrideAppV1 &app, bool replays, IoPlace place,
                                     const IoExchanges &exchanges) {
  auto devices = std::make_shared<Devices>();
  for (uint32_t i = 0; i < app.ioDeviceCount; ++i) {
    const IoDeviceDesc &desc = app.ioDevices[i];
    if (isOnBus(desc) != (place == IoPlace::OnBus))
      continue;
    auto device = std::make_unique<io::IoDevice>();
    device->name = desc.name;
    const drivers::IoDriverEntry &driver = driverOf(desc);
    device->driver = makeDriver(app, desc, driver, replays, exchanges[i]);
    device->external = driver.schema->external;
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
  void modeChanged(task::OperatingMode mode) override { image_.modeChanged(mode); }
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

IoExchanges ioExchanges(const StrideAppV1 &app) {
  IoExchanges exchanges;
  for (uint32_t i = 0; i < app.ioDeviceCount; ++i) {
    const IoDeviceDesc &desc = app.ioDevices[i];
    exchanges.push_back(
        isOnBus(desc) ? std::make_shared<common::IoExchange>(desc.inputCount, desc.outputCount)
                      : nullptr);
  }
  return exchanges;
}

std::vector<std::unique_ptr<task::CycleHook>> addIoDevices(const app::Application &application,
                                                           task::TaskSet &tasks, InputPort &inputs,
                                                           IoPlace place,
                                                           const IoExchanges &exchanges) {
  std::vector<std::unique_ptr<task::CycleHook>> hooks;
  const StrideAppV1 &app = application.description();
  const std::shared_ptr<Devices> devices = openDevices(app, inputs.replays(), place, exchanges);
  if (devices->empty())
    return hooks;
  for (uint32_t task = 0; task < app.taskCount; ++task) {
    hooks.push_back(std::make_unique<DeviceHook>(app, application.state(), task, devices, inputs));
    tasks.addHook(task, *hooks.back());
  }
  return hooks;
}

} // namespace stride::host
