#include "runtime/host/axis_hooks.hpp"

#include "drivers/axis_drivers.hpp"
#include "runtime/app/error.hpp"
#include "runtime/bus/drive_group.hpp"
#include "runtime/host/error_names.hpp"
#include "runtime/host/group_setups.hpp"
#include "runtime/host/news_ring.hpp"
#include "runtime/host/task_times.hpp"

#include <filesystem>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace stride::host {

namespace {

template <class T> T &at(std::byte *state, uint64_t offset) {
  return *reinterpret_cast<T *>(state + offset);
}

/// What g_strBootupError says: all groups that did not start, one after the other. Groups are
/// served by different tasks; who finds the board taken tries again in the next cycle.
class BootupErrors {
public:
  explicit BootupErrors(uint32_t groups) : messages_(groups) {}

  /// False: not now.
  bool show(uint32_t group, std::string_view message, char *text, uint32_t length) noexcept {
    if (taken_.test_and_set(std::memory_order_acquire))
      return false;
    Message &own = messages_[group];
    own.size = std::min(message.size(), own.text.size());
    std::copy_n(message.data(), own.size, own.text.data());
    size_t end = 0;
    const auto append = [&](std::string_view part) {
      const size_t count = std::min<size_t>(part.size(), length - end);
      std::copy_n(part.data(), count, text + end);
      end += count;
    };
    for (const Message &one : messages_) {
      if (one.size == 0)
        continue;
      if (end != 0)
        append("; ");
      append({one.text.data(), one.size});
    }
    text[end] = 0;
    taken_.clear(std::memory_order_release);
    return true;
  }

private:
  struct Message {
    std::array<char, 255> text{};
    size_t size = 0;
  };
  std::vector<Message> messages_;
  std::atomic_flag taken_;
};

/// The program's time as a driver sees it.
class DriverClock final : public bus::BusClock {
public:
  explicit DriverClock(task::TaskClock &clock) : clock_(&clock) {}
  int64_t nowNs() const noexcept override { return clock_->nowNs(); }
  void sleepUntil(int64_t timeNs) noexcept override { clock_->sleepUntil(timeNs); }
  int64_t monotonicNs(int64_t timeNs) const noexcept override {
    return clock_->monotonicNs(timeNs);
  }

private:
  task::TaskClock *clock_;
};

/// The event tasks that the SYNC of this group raises; its own task waits for it otherwise.
std::vector<uint32_t> tasksOnSync(const StrideAppV1 &app, uint32_t group) {
  std::vector<uint32_t> tasks;
  for (uint32_t i = 0; i < app.taskCount; ++i)
    if (app.tasks[i].sync == group && i != app.axisGroups[group].task)
      tasks.push_back(i);
  return tasks;
}

class AxisGroupHook final : public task::CycleHook, private task::Pacer, private bus::DriverHost {
public:
  AxisGroupHook(const StrideAppV1 &app, uint32_t index, std::byte *state,
                std::unique_ptr<bus::AxisDriver> driver, double cycleSeconds, InputPort &inputs,
                task::TaskSet &tasks, std::shared_ptr<BootupErrors> errors)
      : errors_(std::move(errors)), inputs_(&inputs), tasks_(&tasks),
        onSync_(tasksOnSync(app, index)), realClock_(tasks.realClock()),
        ref_(&groupOf(app, state, index)), index_(index), name_(app.axisGroups[index].name),
        bootupErrorOffset_(app.bootupErrorOffset), bootupErrorLength_(app.bootupErrorLength),
        group_(std::move(driver), *ref_, axesOf(app, state), cycleSeconds, encodersOf(app, state)) {
    const AxisGroupDesc &group = app.axisGroups[index];
    axes_ = axesOf(app, state);
    for (uint32_t i = 0; i < group.driveCount; ++i) {
      names_.emplace_back(app.drives[group.firstDrive + i].name);
      ids_.push_back(app.drives[group.firstDrive + i].driveId);
    }
    stopped_.resize(axes_.size());
    sound_.resize(axes_.size());
    if (!bindGroupData(app, state))
      throw app::Error(fmt::format("the application was built with another layout of what the "
                                   "driver '{}' shares with it (axis group '{}'); build it again "
                                   "with this version of Stride",
                                   group.driverName, name_));
    group_.driver().attach(*this);
    tasks.addHook(group.task, *this);
    if (const TaskDesc &task = app.tasks[group.task]; task.sync == index && task.intervalNs > 0)
      tasks.setPacer(group.task, *this);
  }

  void beforePous(Ctx &ctx) override {
    if (ref_->bDebug != 0)
      times_.begin(*ref_, measuredNow(ctx));
    else
      times_.pause();
    group_.executeStart();
    const bool failed = !group_.bootupError().empty();
    if (failed != shown_)
      show(ctx, failed);
  }
  void afterPous(Ctx &ctx) override {
    group_.executeEnd();
    if (times_.measuring())
      times_.end(*ref_, measuredNow(ctx));
  }
  void applicationStopped() override {
    for (size_t i = 0; i < axes_.size(); ++i)
      sound_[i] = axes_[i]->nAxisState != axis::state::kErrorStop;
    group_.stopAll();
    for (size_t i = 0; i < axes_.size(); ++i)
      stopped_[i] = sound_[i] && axes_[i]->nAxisState == axis::state::kErrorStop;
  }
  /// One line about each drive that is in error stop.
  void describeErrorStops(std::vector<std::string> &lines) const {
    for (size_t i = 0; i < axes_.size(); ++i) {
      const axis::AxisRef &axis = *axes_[i];
      if (axis.nAxisState != axis::state::kErrorStop)
        continue;
      if (sound_[i] && !stopped_[i] && axis.wFBErrorID == axis::error::kNotCalled)
        continue; // it rested, coupled to another axis, and nobody leads it any more
      lines.push_back(fmt::format(
          "drive '{}' is in error stop: {}", names_[i],
          stopped_[i] ? std::string("it moved when the application stopped, and was braked")
                      : motionErrorText(axis.wFBErrorID)));
      if (axis.wErrorID != 0)
        lines.back() += fmt::format(", error {} of the drive", axis.wErrorID);
      if (!stopped_[i] && axis.wFBErrorID != 0)
        lines.back() += fmt::format("; stride explain {}", axis.wFBErrorID);
    }
  }
  bool atRest() const override { return group_.atRest(); }
  std::vector<std::string> takeNews() override {
    std::vector<std::string> news = news_.take();
    for (std::string &one : news)
      one = fmt::format("axis group '{}'{}", name_, one);
    return news;
  }
  std::string problem() const override {
    char text[320];
    if (const std::string_view failure = bootupError(text); !failure.empty())
      return realClock_ && shown_
                 ? std::string()
                 : fmt::format("axis group '{}'{}{}", name_, whatFailed(), failure);
    bus::Message message;
    group_.driver().problem(message);
    return message.text().empty() ? std::string()
                                  : fmt::format("axis group '{}': {}", name_, message.text());
  }

  void rebind(const StrideAppV1 &app, std::byte *state) noexcept override {
    const AxisGroupDesc &group = app.axisGroups[index_];
    ref_ = &groupOf(app, state, index_);
    group_.rebind(*ref_);
    bindGroupData(app, state);
    for (uint32_t i = 0; i < group.driveCount; ++i) {
      axes_[i] = &axisOf(app, state, i);
      group_.rebind(i, *axes_[i]);
    }
    for (uint32_t i = 0; i < group.encoderCount; ++i)
      group_.rebind(i, encoderOf(app, state, i));
    bootupErrorOffset_ = app.bootupErrorOffset;
    bootupErrorLength_ = app.bootupErrorLength;
  }

private:
  task::Wake wait(int64_t afterNs, int64_t deadlineNs, task::TaskClock &clock) noexcept override {
    DriverClock driverClock(clock);
    const bus::SyncWake wake = group_.driver().waitSync(afterNs, deadlineNs, driverClock);
    return {wake.timeNs, wake.arrived, wake.missed};
  }
  void raise(bus::BusEvent event) noexcept override {
    switch (event) {
    case bus::BusEvent::Sync:
      for (const uint32_t task : onSync_)
        tasks_->raise(task);
      break;
    }
  }
  void say(const bus::Message &news) noexcept override { sayNews(": ", news.text()); }
  void sayNews(std::string_view begin, std::string_view text) noexcept {
    bus::Message all;
    all.set(begin, text);
    news_.put(all.text());
  }

  static bus::AxisGroupRef &groupOf(const StrideAppV1 &app, std::byte *state, uint32_t index) {
    return at<bus::AxisGroupRef>(state, app.axisGroups[index].groupOffset);
  }
  /// In virtual time a cycle takes none, so that simulations are repeatable.
  int64_t measuredNow(const Ctx &ctx) noexcept {
    int64_t now = realClock_ ? task::monotonicNs() : ctx.cycleStartNs;
    inputs_->pass(now);
    return now;
  }
  bool bindGroupData(const StrideAppV1 &app, std::byte *state) noexcept {
    const AxisGroupDesc &group = app.axisGroups[index_];
    return group.dataLayout == 0 ||
           group_.driver().bindGroupData(&at<BYTE>(state, group.dataOffset), group.dataLayout);
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

  /// What the group says, with the drive's name before its number.
  template <size_t N> std::string_view bootupError(char (&text)[N]) const {
    const std::string_view message = group_.bootupError();
    for (size_t i = 0; i < axes_.size(); ++i) {
      char number[32];
      const auto end = fmt::format_to_n(number, sizeof number, "drive {}: ", ids_[i]);
      if (const std::string_view begin(number, end.size); message.starts_with(begin)) {
        const auto all = fmt::format_to_n(text, N, "drive {} ({}): {}", names_[i], ids_[i],
                                          message.substr(begin.size()));
        return {text, std::min(all.size, N)};
      }
    }
    return message;
  }

  /// The start-up of the group, or the restart of a drive while the others work.
  std::string_view whatFailed() const {
    constexpr uint16_t kFailed = 1000;
    return ref_->wState >= kFailed ? " did not start: " : ": ";
  }

  /// A new failure, or the end of one, in g_strBootupError.
  void show(Ctx &ctx, bool failed) {
    char text[320];
    const std::string_view failure = bootupError(text);
    if (bootupErrorLength_ != 0 &&
        !errors_->show(index_, failure, static_cast<char *>(ctx.state) + bootupErrorOffset_,
                       bootupErrorLength_))
      return;
    shown_ = failed;
    // Nobody waits for the end of a run by the real clock; a simulation says it there.
    if (failed && realClock_)
      sayNews(whatFailed(), failure);
  }

  std::shared_ptr<BootupErrors> errors_; ///< Of all groups.
  InputPort *inputs_;
  task::TaskSet *tasks_;
  std::vector<uint32_t> onSync_;
  NewsRing news_;
  bool realClock_;
  bus::AxisGroupRef *ref_;
  TaskTimes times_;
  uint32_t index_;
  std::string name_;
  std::vector<axis::AxisRef *> axes_;
  std::vector<std::string> names_; ///< Of the drives.
  std::vector<uint32_t> ids_;
  std::vector<bool> sound_;   ///< Not in error stop when the application stopped.
  std::vector<bool> stopped_; ///< By applicationStopped(), so that it is no error of the program.
  uint64_t bootupErrorOffset_;
  uint32_t bootupErrorLength_; ///< 0: the application has no g_strBootupError
  bus::DriveGroup group_;
  bool shown_ = false;
};

const drivers::DriverEntry &driverOf(const AxisGroupDesc &group) {
  const drivers::DriverEntry *driver = drivers::findDriver(group.driverName);
  if (driver == nullptr)
    throw app::Error(fmt::format("axis group '{}' asks for driver '{}', which this runtime does "
                                 "not have; {}",
                                 group.name, group.driverName, drivers::knownDrivers()));
  return *driver;
}

/// Lets AXIS_REF.pMS lead to what the driver and the program share about the drive.
void bindData(const DriveDesc &drive, const drivers::DriverEntry &driver, std::byte *state) {
  if (drive.dataLayout == 0)
    return;
  const std::string_view type = driver.schema->driveData.type;
  if (drive.dataLayout != driver.driveDataLayout())
    throw app::Error(
        fmt::format("the application was built with another layout of {} (drive '{}') "
                    "than this runtime has; build it again with this version of Stride",
                    type.substr(type.find('.') + 1), drive.name));
  at<axis::AxisRef>(state, drive.axisOffset).pMS = &at<BYTE>(state, drive.dataOffset);
}

/// With the name of the group before its ending, where there are several.
std::string ownFile(const std::string &file, const StrideAppV1 &app, const AxisGroupDesc &group) {
  if (file.empty() || app.axisGroupCount < 2)
    return file;
  std::filesystem::path path(file);
  path.replace_filename(path.stem().string() + "." + group.name + path.extension().string());
  return path.string();
}

void checkRecording(const StrideAppV1 &app, const bus::BusRecording &recording) {
  if (recording.log.empty() && recording.replay.empty())
    return;
  for (uint32_t i = 0; i < app.axisGroupCount; ++i)
    if (driverOf(app.axisGroups[i]).schema->records)
      return;
  throw app::Error(fmt::format("the application has no CAN bus that '{}' could be of",
                               recording.log.empty() ? recording.replay : recording.log));
}

} // namespace

app::RuntimeLayouts runtimeLayouts() {
  return {::st::SM_DriveBasic::AXIS_REF__layout__, ::st::SM_DriveBasic::SMC_AXISGROUP_REF__layout__,
          ::st::SM_DriveBasic::SMC_ENCODER_REF__layout__};
}

std::vector<std::unique_ptr<task::CycleHook>>
addAxisGroups(const app::Application &application, task::TaskSet &tasks, InputPort &inputs,
              bus::BusKind buses, const bus::BusRecording &recording, const std::string &files,
              const IoExchanges &exchanges) {
  const StrideAppV1 &app = application.description();
  std::vector<std::unique_ptr<task::CycleHook>> hooks;
  const auto errors = std::make_shared<BootupErrors>(app.axisGroupCount);
  checkRecording(app, recording);
  for (uint32_t i = 0; i < app.axisGroupCount; ++i) {
    const AxisGroupDesc &group = app.axisGroups[i];
    const drivers::DriverEntry &driver = driverOf(group);
    bus::GroupSetup setup = groupSetup(app, group, *driver.schema);
    setup.kind = buses;
    setup.files = files;
    setup.recording = {ownFile(recording.log, app, group), ownFile(recording.replay, app, group)};
    for (bus::IoSetup &io : setup.ios)
      io.exchange = exchanges[io.device];
    for (uint32_t d = 0; d < group.driveCount; ++d)
      bindData(app.drives[group.firstDrive + d], driver, application.state());
    hooks.push_back(std::make_unique<AxisGroupHook>(app, i, application.state(), driver.make(setup),
                                                    setup.cycleSeconds, inputs, tasks, errors));
  }
  return hooks;
}

std::vector<std::unique_ptr<task::CycleHook>>
addDevices(const app::Application &application, task::TaskSet &tasks, InputPort &inputs,
           bus::BusKind buses, const bus::BusRecording &recording, const std::string &files) {
  const IoExchanges exchanges = ioExchanges(application.description());
  auto hooks = addIoDevices(application, tasks, inputs, IoPlace::Alone, exchanges);
  for (auto &hook : addAxisGroups(application, tasks, inputs, buses, recording, files, exchanges))
    hooks.push_back(std::move(hook));
  for (auto &hook : addIoDevices(application, tasks, inputs, IoPlace::OnBus, exchanges))
    hooks.push_back(std::move(hook));
  return hooks;
}

std::vector<std::string> errorStops(const std::vector<std::unique_ptr<task::CycleHook>> &hooks) {
  std::vector<std::string> lines;
  for (const std::unique_ptr<task::CycleHook> &hook : hooks)
    if (const auto *group = dynamic_cast<const AxisGroupHook *>(hook.get()))
      group->describeErrorStops(lines);
  return lines;
}

} // namespace stride::host
