#include "runtime/host/axis_hooks.hpp"

#include "drivers/dummy/dummy_drive.hpp"
#include "runtime/app/error.hpp"
#include "runtime/axis/axis_group.hpp"

#include <fmt/format.h>

namespace stride::host {

namespace {

class AxisGroupHook final : public task::CycleHook {
public:
  AxisGroupHook(std::string name, std::unique_ptr<axis::AxisDriver> driver,
                axis::AxisGroupRef &group, std::vector<axis::AxisRef *> axes, double cycleSeconds)
      : name_(std::move(name)), group_(std::move(driver), group, std::move(axes), cycleSeconds) {}

  void beforePous(Ctx &) override { group_.executeStart(); }
  void afterPous(Ctx &) override { group_.executeEnd(); }
  void applicationStopped() override { group_.stopAll(); }
  bool atRest() const override { return group_.atRest(); }
  std::string problem() const override {
    const std::string &failure = group_.bootupError();
    return failure.empty() ? failure
                           : fmt::format("axis group '{}' did not start: {}", name_, failure);
  }

private:
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

template <class T> T &at(std::byte *state, uint64_t offset) {
  return *reinterpret_cast<T *>(state + offset);
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
    std::vector<axis::AxisRef *> axes;
    for (uint32_t d = 0; d < group.driveCount; ++d)
      axes.push_back(
          &at<axis::AxisRef>(application.state(), app.drives[group.firstDrive + d].axisOffset));
    const double cycleSeconds = static_cast<double>(app.tasks[group.task].intervalNs) * 1e-9;
    hooks.push_back(std::make_unique<AxisGroupHook>(
        group.name, makeDriver(group),
        at<axis::AxisGroupRef>(application.state(), group.groupOffset), std::move(axes),
        cycleSeconds));
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
