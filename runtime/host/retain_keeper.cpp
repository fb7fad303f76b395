#include "runtime/host/retain_keeper.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <exception>
#include <new>

namespace stride::host {

namespace {

/// How many variables that are not restored are named one by one.
constexpr size_t kMostLines = 20;
/// How often the thread looks whether the tasks have handed over their values.
constexpr auto kLook = std::chrono::milliseconds(2);
/// It waits so long for them, or a period, if that is longer.
constexpr auto kPatience = std::chrono::seconds(2);

/// The task's cycles come around within a period, whatever happens.
bool comesAround(const TaskDesc &task, int64_t periodNs) {
  return (task.kind == TaskKind::Cyclic || task.kind == TaskKind::Freewheeling) &&
         task.intervalNs <= periodNs;
}

/// Whose cycles save a range: its program's task, else the slowest of those that come around.
uint32_t keeperOf(const StrideAppV1 &app, uint32_t task, int64_t periodNs) {
  if (task < app.taskCount)
    return task;
  uint32_t best = kNoIndex;
  for (uint32_t i = 0; i < app.taskCount; ++i) {
    if (comesAround(app.tasks[i], periodNs) &&
        (best == kNoIndex || app.tasks[i].intervalNs > app.tasks[best].intervalNs))
      best = i;
  }
  return best == kNoIndex ? 0 : best;
}

} // namespace

RetainSettings retainSettings(const StrideAppV1 &app) {
  RetainSettings settings;
  if (app.retainFile != nullptr)
    settings.file = app.retainFile;
  if (app.retainPeriodNs > 0)
    settings.periodNs = app.retainPeriodNs;
  return settings;
}

/// One task's variables: three buffers, of which the task fills one, the thread reads one, and one
/// is on the way between them. Nobody waits; the latest wins.
class RetainKeeper::Part {
public:
  Part(std::byte *state, bool everyCycle) : state_(state), everyCycle_(everyCycle) {}

  /// `at`: where the range lies in the values of the whole image.
  void add(const app::RetainRange &range, uint64_t at) {
    ranges_.push_back(range);
    places_.push_back(at);
    bytes_ += range.size;
  }
  /// After all add().
  void allocate() {
    for (std::vector<std::byte> &buffer : buffers_)
      buffer.resize(bytes_);
  }
  /// While the task is in no cycle: the values until it hands some over.
  void begin() noexcept { app::copyRetained(state_, ranges_, buffers_[reading_].data()); }
  bool empty() const { return ranges_.empty(); }
  bool everyCycle() const { return everyCycle_; }

  /// The task, at the end of a cycle.
  void handOver() noexcept {
    if (!everyCycle_ && !asked_.load(std::memory_order_relaxed))
      return;
    asked_.store(false, std::memory_order_relaxed);
    app::copyRetained(state_, ranges_, buffers_[writing_].data());
    writing_ = between_.exchange(writing_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  // The thread.
  void ask() { asked_.store(true, std::memory_order_relaxed); }
  /// Takes what was handed over; false: nothing new.
  bool take() {
    if ((between_.load(std::memory_order_acquire) & kFresh) == 0)
      return false;
    reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  void collect(std::vector<std::byte> &values) const {
    const std::byte *from = buffers_[reading_].data();
    for (size_t i = 0; i < ranges_.size(); ++i) {
      std::memcpy(values.data() + places_[i], from, ranges_[i].size);
      from += ranges_[i].size;
    }
  }

private:
  static constexpr uint32_t kIndex = 3;
  static constexpr uint32_t kFresh = 4;

  std::byte *state_;
  bool everyCycle_;
  std::vector<app::RetainRange> ranges_;
  std::vector<uint64_t> places_;
  uint64_t bytes_ = 0;
  std::array<std::vector<std::byte>, 3> buffers_;
  std::atomic<bool> asked_{false};
  uint32_t writing_ = 0;             ///< The task's.
  std::atomic<uint32_t> between_{1}; ///< With kFresh: not taken yet.
  uint32_t reading_ = 2;             ///< The thread's.
};

/// The state of one build and all that is needed to save it, also when the build is gone.
struct RetainKeeper::Binding {
  Binding(const StrideAppV1 &app, std::byte *itsState)
      : name(app.name), buildHash(app.buildHash), state(itsState), layout(app, app::kRetained),
        encoded(layout.encode()) {}

  std::string name;
  uint64_t buildHash;
  std::byte *state;
  app::RetainLayout layout;
  std::vector<std::byte> encoded;
  std::vector<std::unique_ptr<Part>> parts; ///< By task; without variables: null.
  bool saved = !layout.empty();
};

class RetainKeeper::TaskHook final : public task::CycleHook {
public:
  void beforePous(Ctx &) override {}
  void afterPous(Ctx &) override {
    if (Part *const part = part_.load(std::memory_order_acquire))
      part->handOver();
  }
  void set(Part *part) noexcept { part_.store(part, std::memory_order_release); }

private:
  std::atomic<Part *> part_{nullptr};
};

RetainKeeper::RetainKeeper(const StrideAppV1 &app, std::byte *state, RetainSettings settings,
                           Say say, app::RetainFiles &files)
    : settings_(std::move(settings)), say_(std::move(say)), store_(settings_.file, files),
      binding_(bind(app, state)) {
  if (binding_->layout.empty())
    return;
  lock_.emplace(settings_.file);
  std::vector<std::string> problems;
  image_ = store_.load(problems);
  for (const std::string &problem : problems)
    say_("warning: retained data: " + problem);
  if (!image_) {
    if (!problems.empty())
      say_(fmt::format("warning: no retained data are left in '{}': all variables start with their "
                       "initial values",
                       settings_.file));
    return;
  }
  // A project without a name in its stride.toml tells its data by their variables alone.
  if (!image_->head.application.empty() && *app.name != 0 && image_->head.application != app.name)
    throw app::Error(fmt::format(
        "the retained data in '{}' belong to application '{}', not to '{}'\n  name another file in "
        "[retain] of stride.toml or with --retain, or give them up with 'stride reset origin'",
        settings_.file, image_->head.application, app.name));
  restore_.emplace(app, binding_->layout, *image_);
}

RetainKeeper::~RetainKeeper() { endThread(); }

std::shared_ptr<RetainKeeper::Binding> RetainKeeper::bind(const StrideAppV1 &app,
                                                          std::byte *state) const {
  auto binding = std::make_shared<Binding>(app, state);
  binding->parts.resize(app.taskCount);
  uint64_t at = 0;
  for (const app::RetainRange &range : binding->layout.ranges()) {
    if (app.taskCount == 0)
      break;
    const uint32_t task = keeperOf(app, range.task, settings_.periodNs);
    if (binding->parts[task] == nullptr)
      binding->parts[task] =
          std::make_unique<Part>(state, !comesAround(app.tasks[task], settings_.periodNs));
    binding->parts[task]->add(range, at);
    at += range.size;
  }
  for (const std::unique_ptr<Part> &part : binding->parts)
    if (part != nullptr)
      part->allocate();
  return binding;
}

void RetainKeeper::restore() {
  if (!restore_)
    return;
  const app::RetainReport report = restore_->apply(binding_->state);
  for (size_t i = 0; i < report.lost.size() && i < kMostLines; ++i)
    say_("warning: retained data: " + report.lost[i]);
  if (report.lost.size() > kMostLines)
    say_(fmt::format("warning: retained data: {} more are not restored",
                     report.lost.size() - kMostLines));
  for (const std::string &note : report.notes)
    say_("note: retained data: " + note);
  restore_.reset();
  image_.reset();
}

void RetainKeeper::addHooks(task::TaskSet &tasks) {
  for (uint32_t i = 0; i < tasks.count(); ++i) {
    hooks_.push_back(std::make_unique<TaskHook>());
    tasks.addHook(i, *hooks_.back());
  }
  publish(*binding_);
}

/// Between two cycles: from now on the tasks hand over what belongs to the binding.
void RetainKeeper::publish(const Binding &binding) noexcept {
  for (const std::unique_ptr<Part> &part : binding.parts)
    if (part != nullptr)
      part->begin();
  for (size_t i = 0; i < hooks_.size() && i < binding.parts.size(); ++i)
    hooks_[i]->set(binding.parts[i].get());
}

void RetainKeeper::prepareChange(const StrideAppV1 &app, std::byte *state) {
  next_ = bind(app, state);
}

void RetainKeeper::change() noexcept { publish(*next_); }

void RetainKeeper::adopt() noexcept {
  const std::lock_guard lock(mutex_);
  // The old one's buffers go with it; no task is in the middle of using them since change().
  binding_ = std::move(next_);
  if (!binding_->layout.empty() && !lock_) {
    // The first build that has something to retain. What is in the file is older than the run.
    try {
      lock_.emplace(settings_.file);
      std::vector<std::string> problems;
      static_cast<void>(store_.load(problems));
    } catch (const std::exception &error) {
      sayNotSaved(error.what());
      // The tasks go on handing over what nobody saves.
      binding_->saved = false;
    }
  }
}

void RetainKeeper::startSaving() {
  thread_ = std::thread([this] { saveLoop(); });
}

void RetainKeeper::endThread() {
  if (!thread_.joinable())
    return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void RetainKeeper::saveLoop() {
  const auto period = std::chrono::nanoseconds(settings_.periodNs);
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, period, [&] { return stopping_; })) {
    try {
      saveOnce(lock);
    } catch (const std::bad_alloc &) { // tried again in the next period
      notSaved("there is not enough memory");
    }
  }
}

/// Asks the tasks for their values and writes them.
void RetainKeeper::saveOnce(std::unique_lock<std::mutex> &lock) {
  const std::shared_ptr<Binding> binding = binding_;
  if (!binding->saved)
    return;
  std::vector<std::byte> values(binding->layout.bytes());
  std::vector<Part *> missing;
  for (const std::unique_ptr<Part> &part : binding->parts) {
    if (part == nullptr)
      continue;
    static_cast<void>(part->take()); // what has become old meanwhile
    part->ask();
    if (!part->everyCycle())
      missing.push_back(part.get());
  }
  const auto end =
      std::chrono::steady_clock::now() +
      std::max<std::chrono::nanoseconds>(std::chrono::nanoseconds(settings_.periodNs), kPatience);
  while (!missing.empty() && std::chrono::steady_clock::now() < end) {
    std::erase_if(missing, [](Part *part) { return part->take(); });
    if (!missing.empty() && wake_.wait_for(lock, kLook, [&] { return stopping_; }))
      return;
  }
  if (binding != binding_)
    return; // another build has taken over meanwhile
  for (const std::unique_ptr<Part> &part : binding->parts)
    if (part != nullptr)
      part->collect(values);
  lock.unlock();
  static_cast<void>(save(*binding, values));
  lock.lock();
}

bool RetainKeeper::save(const Binding &binding, const std::vector<std::byte> &values) noexcept {
  try {
    store_.save(binding.name, binding.buildHash, binding.encoded, values);
    if (failing_)
      say_("note: retained data are saved again");
    failing_ = false;
    return true;
  } catch (const std::bad_alloc &) {
    notSaved("there is not enough memory");
  } catch (const std::exception &error) {
    notSaved(error.what());
  }
  return false;
}

/// Says it once until it works again.
void RetainKeeper::notSaved(const char *reason) noexcept {
  if (!failing_)
    sayNotSaved(reason);
  failing_ = true;
}

/// Also where there is no memory for a text.
void RetainKeeper::sayNotSaved(const char *reason) noexcept {
  try {
    say_(fmt::format("warning: retained data are not saved: {}", reason));
  } catch (const std::bad_alloc &) {
    say_("warning: retained data are not saved: there is not enough memory");
  }
}

bool RetainKeeper::finish() noexcept {
  endThread();
  if (!binding_->saved)
    return true;
  try {
    std::vector<std::byte> values(binding_->layout.bytes());
    app::copyRetained(binding_->state, binding_->layout.ranges(), values.data());
    return save(*binding_, values);
  } catch (const std::bad_alloc &) {
    notSaved("there is not enough memory");
  }
  return false;
}

} // namespace stride::host
