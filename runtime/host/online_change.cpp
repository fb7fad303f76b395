#include "runtime/host/online_change.hpp"

#include "runtime/app/error.hpp"
#include "runtime/host/axis_hooks.hpp"
#include "runtime/host/st_backtrace.hpp"
#include "runtime/task/task_kind.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <utility>

namespace stride::host {

namespace {

/// Another spelling of the path, so that the loader does not take the old file for the new one: it
/// knows files of this process by their names. The digits of a number that counts up, "/." is a one
/// and "/" a zero: a path must not grow with every change, its length is limited.
std::string spelledAnew(const std::string &path) {
  static std::atomic<uint64_t> spellings{0};
  const std::filesystem::path given(path);
  std::string folder = given.has_parent_path() ? given.parent_path().string() : ".";
  for (uint64_t number = ++spellings; number != 0; number >>= 1)
    folder += (number & 1) != 0 ? "/." : "/";
  return folder + '/' + given.filename().string();
}

std::string intervalText(int64_t ns) {
  if (ns == 0)
    return "none";
  for (const auto &[unit, name] : {std::pair{1'000'000'000, "s"}, {1'000'000, "ms"}, {1'000, "us"}})
    if (ns % unit == 0)
      return fmt::format("{}{}", ns / unit, name);
  return fmt::format("{}ns", ns);
}

std::string syncText(const StrideAppV1 &app, uint32_t group) {
  return group == kNoIndex ? std::string("none")
                           : fmt::format("{}.bSync", app.axisGroups[group].name);
}

std::string coreText(uint32_t core) {
  return core == kNoIndex ? "the one of the run" : std::to_string(core);
}

} // namespace

OnlineChange::OnlineChange(Instance &instance, const std::string &path) : instance_(&instance) {
  const std::string spelled = spelledAnew(path);
  try {
    fresh_ = std::make_unique<app::Application>(app::Application::load(spelled, runtimeLayouts()));
  } catch (const app::Error &error) { // in the words of the user
    std::string text = error.what();
    for (size_t at = 0; (at = text.find(spelled, at)) != std::string::npos;)
      text.replace(at, spelled.size(), path);
    throw app::Error(text);
  }
  try {
    instance.initialiseFresh(*fresh_);
  } catch (const StException &exception) {
    throw app::Error(describeWithCalls(task::Fault{exception, "initialisation", 0, 0}));
  }
  instance.prepareSwap(*fresh_);
  plan_ = std::make_unique<app::CarryOver>(instance.app(), fresh_->description());
  verdict_ = plan_->report().verdict();
  compareTasks();
}

/// The threads and the schedule stay as they are.
void OnlineChange::compareTasks() {
  const StrideAppV1 &was = instance_->app();
  const StrideAppV1 &is = fresh_->description();
  const auto refuse = [&](std::string reason) {
    refusals_.push_back(std::move(reason));
    verdict_ = app::Verdict::Refused;
  };
  if (was.taskCount != is.taskCount) {
    refuse(fmt::format("it has {} tasks instead of {}", is.taskCount, was.taskCount));
    return;
  }
  for (uint32_t i = 0; i < was.taskCount; ++i) {
    const TaskDesc &a = was.tasks[i];
    const TaskDesc &b = is.tasks[i];
    if (std::strcmp(a.name, b.name) != 0) {
      refuse(fmt::format("task {} is called '{}' instead of '{}'", i + 1, b.name, a.name));
      continue;
    }
    const auto differs = [&](const char *what, const std::string &now, const std::string &before) {
      refuse(fmt::format("task '{}' has another {}: {} instead of {}", a.name, what, now, before));
    };
    if (a.kind != b.kind)
      differs("kind", task::kindName(b.kind), task::kindName(a.kind));
    if (a.intervalNs != b.intervalNs)
      differs("interval", intervalText(b.intervalNs), intervalText(a.intervalNs));
    if (a.priority != b.priority)
      differs("priority", std::to_string(b.priority), std::to_string(a.priority));
    if (a.sync != b.sync)
      differs("SYNC", syncText(is, b.sync), syncText(was, a.sync));
    if (a.core != b.core)
      differs("processor", coreText(b.core), coreText(a.core));
  }
}

std::string OnlineChange::report(bool all) const {
  std::string text;
  for (const std::string &refusal : refusals_)
    text += refusal + '\n';
  // What would be kept does not matter then.
  if (refusals_.empty() || plan_->report().verdict() == app::Verdict::Refused)
    text += plan_->report().text(all);
  return text;
}

bool OnlineChange::apply(int64_t timeNs) {
  Ctx now{};
  now.host = &instance_->initHost();
  now.cycleStartNs = timeNs;
  now.loopBudget = task::TaskSet::kDefaultLoopBudget;
  std::optional<StException> exception;
  const app::CarryOver::Taken taken =
      plan_->takeOver(now, instance_->state(), fresh_->state(), result_,
                      [&exception](void (*hook)(Ctx *), Ctx &ctx) {
                        exception = task::guardedCall(hook, ctx);
                        return !exception;
                      });
  if (taken == app::CarryOver::Taken::ExitFailed) {
    events_.push_back(describeWithCalls({*exception, "FB_Exit", 0, timeNs}));
    return false;
  }
  if (result_.total() != 0)
    events_ = plan_->describe(result_, instance_->state());
  instance_->swap(fresh_);
  if (taken == app::CarryOver::Taken::ReinitFailed)
    instance_->tasks().fail({*exception, "FB_Reinit", 0, timeNs});
  return true;
}

std::vector<std::string> OnlineChange::events() const { return events_; }

} // namespace stride::host
