#include "runtime/host/system_services.hpp"

#include "runtime/task/fault.hpp"
#include "runtime/task/task_set.hpp"

#include <cstdlib>
#include <ctime>

namespace stride::host {

namespace {

constexpr int64_t kSecondNs = 1'000'000'000;
/// Smaller differences to the system's clock are how late a cycle was.
constexpr int64_t kStepNs = 100'000'000;

int64_t systemClockNs() noexcept {
  ::timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return int64_t{now.tv_sec} * kSecondNs + now.tv_nsec;
}

} // namespace

/// The inputs of the host as the file service knows them.
class SystemServices::Pass final : public system::Inputs {
public:
  explicit Pass(InputPort &port) : port_(&port) {}
  void pass(void *value, size_t size) noexcept override { port_->pass(value, size); }
  bool replays() const noexcept override { return port_->replays(); }

private:
  InputPort *port_;
};

SystemServices::SystemServices(const StrideAppV1 &app, const std::byte *state, bool realClock)
    : realClock_(realClock), said_(app.taskCount), initHost_(task::hostApi()) {
  running_.at = state;
  running_.size = app.stateSize;
  initApi_.size = sizeof(SystemApi);
  initApi_.self = this;
  initApi_.owns = [](void *self, const Ctx *ctx, const void *at, uint64_t size) -> BOOL {
    return static_cast<const SystemServices *>(self)->owns(*ctx, at, size) ? 1 : 0;
  };
  initApi_.wallClock = [](void *self, const Ctx *ctx) {
    return static_cast<SystemServices *>(self)->realClock_ ? systemClockNs() : ctx->cycleStartNs;
  };
  initHost_.system = &initApi_;
  initHost_.self = this;
  initHost_.log = [](Ctx *ctx, uint32_t, const char *text) {
    static_cast<SystemServices *>(ctx->host->self)->log_.put(text);
  };
  cycleApi_ = initApi_;
  cycleApi_.wallClock = [](void *self, const Ctx *ctx) {
    return static_cast<SystemServices *>(self)->wallClock(*ctx);
  };
}

SystemServices::~SystemServices() = default;

std::string SystemServices::filesFolder(const StrideAppV1 &app, const std::string &folder) {
  if (!folder.empty())
    return folder;
  return app.filesRoot != nullptr ? app.filesRoot : system::FileSettings().root;
}

void SystemServices::start(const StrideAppV1 &app, const std::string &folder, InputPort &inputs) {
  system::FileSettings settings;
  settings.root = filesFolder(app, folder);
  settings.anywhere = app.filesAnywhere != 0;
  settings.virtualTime = !realClock_;
  settings.delayCycles = app.filesDelay;
  inputs_ = &inputs;
  pass_ = std::make_unique<Pass>(inputs);
  files_.emplace(settings, app.taskCount, *pass_);
  cycleApi_.fileStart = [](void *self, const Ctx *ctx, const FileRequest *request) {
    return static_cast<SystemServices *>(self)->files_->start(*ctx, *request);
  };
  cycleApi_.filePoll = [](void *self, const Ctx *ctx, uint32_t number, void *data, uint64_t room,
                          FileAnswer *answer) {
    static_cast<SystemServices *>(self)->files_->poll(*ctx, number, data, room, *answer);
  };
  cycleApi_.fileAsk = [](void *self, const Ctx *ctx, const FileRequest *request,
                         FileAnswer *answer) {
    static_cast<SystemServices *>(self)->files_->ask(*ctx, *request, *answer);
  };
  cycleApi_.stream = [](void *self, const Ctx *ctx, StreamOp op, uint32_t file, void *data,
                        uint64_t size, FileAnswer *answer) {
    static_cast<SystemServices *>(self)->files_->stream(*ctx, op, file, data, size, *answer);
  };
  cycleApi_.lastError = [](void *self, const Ctx *ctx) {
    return static_cast<SystemServices *>(self)->files_->lastError(*ctx);
  };
}

void SystemServices::finish() {
  if (files_)
    files_->finish();
}

void SystemServices::setFresh(const std::byte *state, uint64_t size) {
  fresh_.at = state;
  fresh_.size = size;
}

void SystemServices::swap(const StrideAppV1 &app, const std::byte *state) noexcept {
  running_.at = state;
  running_.size = app.stateSize;
  fresh_.at = nullptr;
}

void SystemServices::lookAfter() {
  if (files_)
    files_->lookAfter();
}

std::vector<std::string> SystemServices::takeNews() {
  return files_ ? files_->takeNews() : std::vector<std::string>();
}

bool SystemServices::owns(const Ctx &ctx, const void *at, uint64_t size) const noexcept {
  const auto first = reinterpret_cast<uintptr_t>(at);
  if (first + size < first)
    return false;
  const auto inside = [&](uintptr_t low, uintptr_t high) {
    return first >= low && first + size <= high;
  };
  for (const Range *range : {&running_, &fresh_}) {
    const std::byte *const state = range->at.load(std::memory_order_relaxed);
    if (state != nullptr && state == ctx.state) {
      const auto low = reinterpret_cast<uintptr_t>(state);
      if (inside(low, low + range->size.load(std::memory_order_relaxed)))
        return true;
    }
  }
  // Variables of the calls that are active.
  return inside(task::dataStack().low, reinterpret_cast<uintptr_t>(ctx.dataTop));
}

/// Constant within a cycle. Where somebody has set the system's clock, that is followed.
int64_t SystemServices::wallClock(const Ctx &ctx) noexcept {
  if (!realClock_) {
    int64_t ns = ctx.cycleStartNs;
    if (inputs_->replays())
      inputs_->pass(ns);
    return ns;
  }
  Said &said = said_[ctx.taskIndex];
  if (said.cycle != ctx.cycle)
    said = {ctx.cycle, offsetNow(ctx.cycleStartNs) + ctx.cycleStartNs};
  int64_t ns = said.ns;
  inputs_->pass(ns);
  return ns;
}

int64_t SystemServices::offsetNow(int64_t cycleStartNs) noexcept {
  int64_t offset = offset_.load(std::memory_order_relaxed);
  if (offset != 0 && cycleStartNs - checked_.load(std::memory_order_relaxed) < kSecondNs)
    return offset;
  const int64_t now = systemClockNs() - cycleStartNs;
  if (offset == 0 || std::abs(now - offset) > kStepNs) {
    offset = now;
    offset_.store(offset, std::memory_order_relaxed);
  }
  checked_.store(cycleStartNs, std::memory_order_relaxed);
  return offset;
}

} // namespace stride::host
