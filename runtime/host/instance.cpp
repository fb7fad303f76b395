#include "runtime/host/instance.hpp"

#include "runtime/host/axis_hooks.hpp"

#include <fmt/format.h>

namespace stride::host {

void initialiseGuarded(app::Application &application, const HostApi &host, bool inCopyCode,
                       bool keepRetains) {
  application.initialise(host, inCopyCode, keepRetains, [](void (*init)(Ctx *), Ctx &ctx) {
    ctx.loopBudget = task::TaskSet::kDefaultLoopBudget;
    if (const std::optional<StException> exception = task::guardedCall(init, ctx))
      throw *exception;
  });
}

Instance::Instance(std::unique_ptr<app::Application> application, task::LoopLimit limit)
    : application_(std::move(application)),
      symbols_(std::make_unique<app::SymbolTable>(application_->description())),
      system_(application_->description(), application_->state(), limit == task::LoopLimit::Clock),
      tasks_(application_->description(), application_->state(), task::hostApi(), limit) {}

void Instance::retain(const RetainSettings &settings, RetainKeeper::Say say) {
  retain_.emplace(app(), state(), settings, std::move(say));
}

void Instance::initialise() {
  system_.start(app(), filesFolder_, *inputs_);
  tasks_.setSystem(system_.cycleApi());
  initialiseGuarded(*application_, system_.initHost(), false, retain_ && retain_->keepsRetains());
  if (retain_) {
    retain_->restore();
    retain_->addHooks(tasks_);
  }
  application_->settle();
  for (std::unique_ptr<task::CycleHook> &hook :
       addDevices(*application_, tasks_, *inputs_, buses_, recording_,
                  SystemServices::filesFolder(app(), filesFolder_)))
    hooks_.push_back(std::move(hook));
}

void Instance::addToAllTasks(task::CycleHook &hook) {
  for (uint32_t task = 0; task < tasks_.count(); ++task)
    tasks_.addHook(task, hook);
}

void Instance::initialiseFresh(app::Application &fresh) {
  system_.setFresh(fresh.state(), fresh.description().stateSize);
  initialiseGuarded(fresh, system_.initHost(), true, false);
}

void Instance::prepareSwap(const app::Application &fresh) {
  nextSymbols_ = std::make_unique<app::SymbolTable>(fresh.description());
  tasks_.prepareRebind(fresh.description());
  if (retain_)
    retain_->prepareChange(fresh.description(), fresh.state());
}

void Instance::swap(std::unique_ptr<app::Application> &other) noexcept {
  application_.swap(other);
  tasks_.rebind(app(), state());
  system_.swap(app(), state());
  if (retain_)
    retain_->change();
}

void Instance::renewSymbols() noexcept {
  symbols_ = std::move(nextSymbols_);
  if (retain_)
    retain_->adopt();
}

std::optional<task::Fault> Instance::exit(int64_t timeNs) {
  std::optional<task::Fault> fault = callExit(timeNs);
  system_.finish();
  return fault;
}

std::optional<task::Fault> Instance::callExit(int64_t timeNs) {
  if (app().exit == nullptr || tasks_.fault())
    return std::nullopt;
  Ctx ctx{};
  ctx.state = state();
  ctx.host = &system_.initHost();
  ctx.cycleStartNs = timeNs;
  ctx.loopBudget = task::TaskSet::kDefaultLoopBudget;
  if (const std::optional<StException> exception = task::guardedCall(app().exit, ctx))
    return task::Fault{*exception, "end of the run", 0, timeNs};
  return std::nullopt;
}

std::vector<std::string> Instance::takeNews() {
  std::vector<std::string> lines = system_.takeLog();
  for (std::string &line : tasks_.takeLog())
    lines.push_back(std::move(line));
  for (const std::string &news : system_.takeNews())
    lines.push_back(fmt::format("warning: {}", news));
  for (const std::unique_ptr<task::CycleHook> &hook : hooks_)
    for (const std::string &news : hook->takeNews())
      lines.push_back(fmt::format("warning: {}", news));
  return lines;
}

std::vector<std::string> Instance::remarks() const {
  std::vector<std::string> lines;
  for (const std::unique_ptr<task::CycleHook> &hook : hooks_)
    if (const std::string problem = hook->problem(); !problem.empty())
      lines.push_back(fmt::format("warning: {}", problem));
  for (const std::string &line : errorStops(hooks_))
    lines.push_back(fmt::format("note: {}", line));
  return lines;
}

} // namespace stride::host
