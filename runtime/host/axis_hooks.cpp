#include "runtime/host/axis_hooks.hpp"

#include "drivers/dummy/dummy_drive.hpp"
#include "runtime/app/error.hpp"
#include "runtime/axis/axis_group.hpp"

#include "st/DummyDrive/DUMMY_DRIVE_SIM.h"

#include <fmt/format.h>

#include <algorithm>

namespace stride::host {

namespace {

template <class T> T &at(std::byte *state, uint64_t offset) {
  return *reinterpret_cast<T *>(state + offset);
}

class AxisGroupHook final : public task::CycleHook {
public:
  AxisGroupHook(const StrideAppV1 &app, uint32_t index, std::byte *state,
                std::unique_ptr<axis::AxisDriver> driver, double cycleSeconds)
      : index_(index), name_(app.axisGroups[index].name), bootupErrorOffset_(app.bootupErrorOffset),
        bootupErrorLength_(app.bootupErrorLength),
        group_(std::move(driver), groupOf(app, state), axesOf(app, state), cycleSeconds,
               encodersOf(app, state)) {}

  void beforePous(Ctx &ctx) override {
    group_.executeStart();
    const bool failed = !group_.bootupError().empty();
    if (failed != shown_)
      show(ctx, failed);
  }
  void afterPous(Ctx &) override { group_.executeEnd(); }
  void applicationStopped() override { group_.stopAll(); }
  bool atRest() const override { return group_.atRest(); }
  std::string problem() const override {
    const std::string_view failure = group_.bootupError();
    return failure.empty() ? std::string()
                           : fmt::format("axis group '{}' did not start: {}", name_, failure);
  }

  void rebind(const StrideAppV1 &app, std::byte *state) noexcept override {
    const AxisGroupDesc &group = app.axisGroups[index_];
    group_.rebind(groupOf(app, state));
    for (uint32_t i = 0; i < group.driveCount; ++i)
      group_.rebind(i, axisOf(app, state, i));
    for (uint32_t i = 0; i < group.encoderCount; ++i)
      group_.rebind(i, encoderOf(app, state, i));
    bootupErrorOffset_ = app.bootupErrorOffset;
    bootupErrorLength_ = app.bootupErrorLength;
  }

private:
  axis::AxisGroupRef &groupOf(const StrideAppV1 &app, std::byte *state) const {
    return at<axis::AxisGroupRef>(state, app.axisGroups[index_].groupOffset);
  }
  axis::AxisRef &axisOf(const StrideAppV1 &app, std::byte *state, uint32_t drive) const {
    const uint32_t first = app.axisGroups[index_].firstDrive;
    return at<axis::AxisRef>(state, app.drives[first + drive].axisOffset);
  }
  axis::EncoderRef &encoderOf(const StrideAppV1 &app, std::byte *state, uint32_t encoder) const {
    const uint32_t first = app.axisGroups[index_].firstEncoder;
    return at<axis::EncoderRef>(state, app.encoders[first + encoder].encoderOffset);
  }
  std::vector<axis::AxisRef *> axesOf(const StrideAppV1 &app, std::byte *state) const {
    std::vector<axis::AxisRef *> axes;
    for (uint32_t i = 0; i < app.axisGroups[index_].driveCount; ++i)
      axes.push_back(&axisOf(app, state, i));
    return axes;
  }
  std::vector<axis::EncoderRef *> encodersOf(const StrideAppV1 &app, std::byte *state) const {
    std::vector<axis::EncoderRef *> encoders;
    for (uint32_t i = 0; i < app.axisGroups[index_].encoderCount; ++i)
      encoders.push_back(&encoderOf(app, state, i));
    return encoders;
  }

  /// A new failure, or the end of one, in g_strBootupError.
  void show(Ctx &ctx, bool failed) {
    shown_ = failed;
    if (bootupErrorLength_ == 0)
      return;
    char *text = static_cast<char *>(ctx.state) + bootupErrorOffset_;
    const std::string_view message = group_.bootupError();
    const std::size_t count = std::min<std::size_t>(message.size(), bootupErrorLength_);
    std::copy_n(message.data(), count, text);
    text[count] = 0;
  }

  uint32_t index_;
  std::string name_;
  uint64_t bootupErrorOffset_;
  uint32_t bootupErrorLength_; ///< 0: the application has no g_strBootupError
  axis::AxisGroup group_;
  bool shown_ = false;
};

axis::SetupParameters parametersOf(const StrideAppV1 &app, uint32_t first, uint32_t count) {
  axis::SetupParameters result;
  for (uint32_t i = 0; i < count; ++i) {
    const ParameterDesc &parameter = app.parameters[first + i];
    result.add({parameter.name, parameter.text != nullptr ? parameter.text : "", parameter.number});
  }
  return result;
}

/// The configuration of an axis group as its driver gets it.
axis::GroupSetup setupOf(const StrideAppV1 &app, const AxisGroupDesc &group) {
  axis::GroupSetup setup;
  setup.name = group.name;
  setup.bus = group.busName;
  if (group.bus != kNoIndex) {
    const BusDesc &bus = app.buses[group.bus];
    setup.interfaceType = bus.interfaceType;
    setup.busParameters = parametersOf(app, bus.firstParameter, bus.parameterCount);
  }
  setup.parameters = parametersOf(app, group.firstParameter, group.parameterCount);
  const TaskDesc &task = app.tasks[group.task];
  const bool paced = task.kind == TaskKind::Cyclic || task.kind == TaskKind::Freewheeling;
  setup.cycleSeconds = paced ? static_cast<double>(task.intervalNs) * 1e-9
                             : static_cast<double>(group.cycleUs) * 1e-6;
  for (uint32_t i = 0; i < group.driveCount; ++i) {
    const DriveDesc &drive = app.drives[group.firstDrive + i];
    setup.drives.push_back(
        {drive.name, drive.driveId, parametersOf(app, drive.firstParameter, drive.parameterCount)});
  }
  for (uint32_t i = 0; i < group.encoderCount; ++i) {
    const EncoderDesc &encoder = app.encoders[group.firstEncoder + i];
    setup.encoders.push_back({encoder.name, encoder.encoderId,
                              parametersOf(app, encoder.firstParameter, encoder.parameterCount)});
  }
  return setup;
}

std::unique_ptr<axis::AxisDriver> makeDriver(const AxisGroupDesc &group,
                                             const axis::GroupSetup &setup) {
  const std::string name = group.driverName;
  if (name == "Dummy")
    return dummy::makeDummyDriver(setup);
  throw app::Error(fmt::format("axis group '{}' asks for driver '{}', which this runtime does not "
                               "have; it has 'Dummy (simulated drives)'",
                               group.name, name));
}

/// Lets AXIS_REF.pMS lead to what the driver and the program share about the drive.
void bindData(const DriveDesc &drive, std::byte *state) {
  if (drive.dataLayout == 0)
    return;
  if (drive.dataLayout != ::st::DummyDrive::DUMMY_DRIVE_SIM__layout__)
    throw app::Error(fmt::format("the application was built with another layout of "
                                 "DUMMY_DRIVE_SIM (drive '{}') than this runtime has; build it "
                                 "again with this version of Stride",
                                 drive.name));
  at<axis::AxisRef>(state, drive.axisOffset).pMS = &at<BYTE>(state, drive.dataOffset);
}

} // namespace

app::RuntimeLayouts runtimeLayouts() {
  return {::st::SM_DriveBasic::AXIS_REF__layout__, ::st::SM_DriveBasic::SMC_AXISGROUP_REF__layout__,
          ::st::SM_DriveBasic::SMC_ENCODER_REF__layout__};
}

std::vector<std::unique_ptr<task::CycleHook>> addAxisGroups(const app::Application &application,
                                                            task::TaskSet &tasks) {
  const StrideAppV1 &app = application.description();
  std::vector<std::unique_ptr<task::CycleHook>> hooks;
  for (uint32_t i = 0; i < app.axisGroupCount; ++i) {
    const AxisGroupDesc &group = app.axisGroups[i];
    const axis::GroupSetup setup = setupOf(app, group);
    for (uint32_t d = 0; d < group.driveCount; ++d)
      bindData(app.drives[group.firstDrive + d], application.state());
    hooks.push_back(std::make_unique<AxisGroupHook>(app, i, application.state(),
                                                    makeDriver(group, setup), setup.cycleSeconds));
    tasks.addHook(group.task, *hooks.back());
  }
  return hooks;
}

std::vector<std::string> errorStops(const app::Application &application) {
  const StrideAppV1 &app = application.description();
  std::vector<std::string> lines;
  for (uint32_t i = 0; i < app.driveCount; ++i) {
    const auto &ref = at<axis::AxisRef>(application.state(), app.drives[i].axisOffset);
    if (ref.nAxisState == axis::state::kErrorStop)
      lines.push_back(
          fmt::format("drive '{}' is in error stop: error {}", app.drives[i].name, ref.wFBErrorID));
  }
  return lines;
}

} // namespace stride::host
