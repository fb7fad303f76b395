#include "runtime/host/axis_hooks.hpp"

#include "drivers/dummy/dummy_drive.hpp"
#include "runtime/app/error.hpp"
#include "runtime/axis/axis_group.hpp"

#include <fmt/format.h>

namespace stride::host {

namespace {

template <class T> T &at(std::byte *state, uint64_t offset) {
  return *reinterpret_cast<T *>(state + offset);
}

class AxisGroupHook final : public task::CycleHook {
public:
  AxisGroupHook(const StrideAppV1 &app, uint32_t index, std::byte *state,
                std::unique_ptr<axis::AxisDriver> driver)
      : index_(index), name_(app.axisGroups[index].name),
        group_(std::move(driver), groupOf(app, state), axesOf(app, state),
               static_cast<double>(app.tasks[app.axisGroups[index].task].intervalNs) * 1e-9) {}

  void beforePous(Ctx &) override { group_.executeStart(); }
  void afterPous(Ctx &) override { group_.executeEnd(); }
  void applicationStopped() override { group_.stopAll(); }
  bool atRest() const override { return group_.atRest(); }
  std::string problem() const override {
    const std::string &failure = group_.bootupError();
    return failure.empty() ? failure
                           : fmt::format("axis group '{}' did not start: {}", name_, failure);
  }

  void rebind(const StrideAppV1 &app, std::byte *state) noexcept override {
    group_.rebind(groupOf(app, state));
    for (uint32_t i = 0; i < app.axisGroups[index_].driveCount; ++i)
      group_.rebind(i, axisOf(app, state, i));
  }

private:
  axis::AxisGroupRef &groupOf(const StrideAppV1 &app, std::byte *state) const {
    return at<axis::AxisGroupRef>(state, app.axisGroups[index_].groupOffset);
  }
  axis::AxisRef &axisOf(const StrideAppV1 &app, std::byte *state, uint32_t drive) const {
    const uint32_t first = app.axisGroups[index_].firstDrive;
    return at<axis::AxisRef>(state, app.drives[first + drive].axisOffset);
  }
  std::vector<axis::AxisRef *> axesOf(const StrideAppV1 &app, std::byte *state) const {
    std::vector<axis::AxisRef *> axes;
    for (uint32_t i = 0; i < app.axisGroups[index_].driveCount; ++i)
      axes.push_back(&axisOf(app, state, i));
    return axes;
  }

  uint32_t index_;
  std::string name_;
  axis::AxisGroup group_;
};

std::unique_ptr<axis::AxisDriver> makeDriver(const AxisGroupDesc &group) {
  const std::string name = group.driverName;
  if (name == "Dummy")
    return dummy::makeDummyDriver(group.driveCount);
  throw app::Error(fmt::format("axis group '{}' asks for driver '{}', which this runtime does not "
                               "have; it has 'Dummy (simulated drives)'",
                               group.name, name));
}

} // namespace

app::RuntimeLayouts runtimeLayouts() {
  return {::st::SM_DriveBasic::AXIS_REF__layout__,
          ::st::SM_DriveBasic::SMC_AXISGROUP_REF__layout__};
}

std::vector<std::unique_ptr<task::CycleHook>> addAxisGroups(const app::Application &application,
                                                            task::TaskSet &tasks) {
  const StrideAppV1 &app = application.description();
  std::vector<std::unique_ptr<task::CycleHook>> hooks;
  for (uint32_t i = 0; i < app.axisGroupCount; ++i) {
    const AxisGroupDesc &group = app.axisGroups[i];
    hooks.push_back(
        std::make_unique<AxisGroupHook>(app, i, application.state(), makeDriver(group)));
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
