// The tasks of one application: what happens in a cycle, whoever decides when.
#ifndef STRIDE_RUNTIME_TASK_TASK_SET_HPP
#define STRIDE_RUNTIME_TASK_TASK_SET_HPP

#include "runtime/app/abi.h"
#include "runtime/task/cycle_hook.hpp"
#include "runtime/task/cycle_log.hpp"
#include "runtime/task/fault.hpp"
#include "runtime/task/pacer.hpp"
#include "runtime/task/statistics.hpp"

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace stride::task {

/// How long the loops of a cycle may go on.
enum class LoopLimit : uint8_t {
  Budget, ///< A number of iterations: repeatable, for virtual time.
  Clock,  ///< The task's watchdog, or kDefaultCycleLimitNs without one: for the real clock.
};

/// The tasks of one application with their hooks, statistics and the fault that stopped them. The
/// scheduler calls runCycle; cycles of different tasks may run at the same time in different
/// threads, those of one task never.
///
/// When a cycle ends with an exception (or breaks its watchdog), or stop() is called, no POU runs
/// any more. The hooks are told in their own task, and go on until all are at rest.
///
/// In OperatingMode::Stop no POU runs either, but nothing ends: setMode() leads back. Each task
/// takes a mode over at the start of its next cycle.
class TaskSet {
public:
  static constexpr int64_t kDefaultLoopBudget = 1'000'000'000;
  static constexpr int64_t kDefaultCycleLimitNs = 10'000'000'000;
  // What schedulers do when the application has stopped:
  /// How long hooks may take to come to rest.
  static constexpr int64_t kStopLimitNs = 60'000'000'000;
  /// From cycle to cycle of a task without interval.
  static constexpr int64_t kStoppedIntervalNs = 10'000'000;
  /// Tasks with longer intervals run at once, and then so often.
  static constexpr int64_t kLongIntervalNs = 1'000'000'000;

  /// `state` is initialised. A `host` with the log of hostApi() gets one that suits cycles. Throws
  /// app::Error for an application without tasks or with a task that cannot be scheduled.
  TaskSet(const StrideAppV1 &app, std::byte *state, const HostApi &host, LoopLimit limit);
  TaskSet(const TaskSet &) = delete;
  TaskSet &operator=(const TaskSet &) = delete;
  ~TaskSet();

  const StrideAppV1 &app() const { return *app_; }
  uint32_t count() const { return static_cast<uint32_t>(tasks_.size()); }
  const TaskDesc &desc(uint32_t task) const { return app_->tasks[task]; }
  /// Tasks in the order in which they run when they are due together: by priority, then as
  /// declared.
  const std::vector<uint32_t> &order() const { return order_; }
  /// The task with the shortest interval among those that the clock starts, the first one of
  /// several; without any: among events that have an interval, too, else 0.
  uint32_t fastest() const { return fastest_; }
  bool hasEvents() const { return hasEvents_; }
  bool realClock() const { return limit_ == LoopLimit::Clock; }

  /// Before the first cycle. The hooks of a task run around its POUs: before in the order of
  /// adding, after in reverse. They must live as long as the tasks.
  void addHook(uint32_t task, CycleHook &hook);
  /// Before the first cycle: starts that event task in place of its event. It must live as long.
  void setPacer(uint32_t task, Pacer &pacer) { tasks_[task]->pacer = &pacer; }
  /// Null: it has none.
  Pacer *pacer(uint32_t task) const { return tasks_[task]->pacer; }
  /// How long a paced task waits after its last cycle before it runs without its SYNC.
  int64_t paceLimitNs(uint32_t task) const { return desc(task).intervalNs * 3 / 2; }
  /// What carries out raise(), or null; a scheduler sets itself.
  void setRaiser(TaskRaiser *raiser) { raiser_ = raiser; }
  /// Lets an event task run once more, as an edge of its event would. One can wait; what comes
  /// beside it is an overrun. From any task's cycle, but always the same one's.
  void raise(uint32_t task) noexcept {
    if (raiser_ != nullptr && !stopped())
      raiser_->raise(task);
  }
  /// Loop iterations that one cycle may use, with LoopLimit::Budget.
  void setLoopBudget(int64_t budget) { loopBudget_ = budget; }
  /// What the programs' system libraries find in the host. It must live as long as the tasks.
  void setSystem(const SystemApi &system) { host_.system = &system; }
  /// Repeats a run by the real clock in which a loop of this cycle was ended: its loops go as far
  /// as they went there.
  void repeatEndedLoop(const Fault &fault) { repeated_ = fault; }

  /// One cycle: hooks, POUs, hooks; then the watchdog. `startNs` is what the program sees as its
  /// start; `latencyNs` how late that is. Never throws, allocates or locks (but to note a fault).
  void runCycle(uint32_t task, int64_t startNs, int64_t latencyNs) noexcept;
  void addOverruns(uint32_t task, uint64_t count) noexcept;
  /// A cycle of the hooks alone, for a task that would not run soon: it takes the mode over.
  void takeModeOver(uint32_t task, int64_t startNs) noexcept;

  /// RUN or STOP, for all tasks. From any thread, also from a task's cycle: neither allocates,
  /// locks nor waits.
  void setMode(OperatingMode mode) noexcept;
  OperatingMode mode() const noexcept { return mode_.load(std::memory_order_acquire); }
  /// The one that the task has taken over.
  OperatingMode modeOf(uint32_t task) const noexcept {
    return tasks_[task]->mode.load(std::memory_order_acquire);
  }
  /// All tasks have taken the mode over.
  bool modeTaken() const noexcept;
  /// It runs soon by itself, and takes a mode over then.
  bool takesModeSoon(uint32_t task) const noexcept {
    const Task &one = *tasks_[task];
    return one.isShort && (one.comesAround || one.pacer != nullptr);
  }
  /// The task's present cycle is one of takeModeOver(). For the task's own hooks.
  bool takesModeOver(uint32_t task) const noexcept { return tasks_[task]->takesOver; }

  /// Evaluates the event of an event or status task. `nowNs`: for the message of a fault.
  bool eventLevel(uint32_t task, int64_t nowNs) noexcept;

  /// No POU runs any more from now on.
  void stop() noexcept { stopped_.store(true, std::memory_order_release); }
  /// The same, for an exception that did not come from a cycle; the first fault counts.
  void fail(Fault fault) noexcept;
  /// The task's hooks know of it: its POUs do not run. For the task's own hooks.
  bool told(uint32_t task) const noexcept { return tasks_[task]->told; }
  bool stopped() const noexcept { return stopped_.load(std::memory_order_acquire); }
  /// After stop: every hook has been told and is at rest.
  bool atRest() const noexcept;
  std::optional<Fault> fault() const;
  /// Whether there is one.
  bool failed() const noexcept;
  /// The lines that the program has logged in its cycles since the last call (a failed assertion).
  /// From one thread, not a task's.
  std::vector<std::string> takeLog() { return log_.take(); }

  const TaskStatistics &statistics(uint32_t task) const { return tasks_[task]->statistics; }

  /// The hooks get ready for rebind() with this build, while the cycles go on.
  void prepareRebind(const StrideAppV1 &app);
  /// Another build has taken over, with its state there: between two cycles of all tasks. The tasks
  /// of `app` are the same as before in number, order and kind. The hooks are told.
  void rebind(const StrideAppV1 &app, std::byte *state) noexcept;

private:
  struct Task {
    Ctx ctx{};
    std::vector<CycleHook *> hooks;
    Pacer *pacer = nullptr;
    TaskStatistics statistics;
    int64_t startedNs = 0;   ///< Of the clock, not of virtual time.
    uint32_t violations = 0; ///< In a row.
    uint64_t looks = 0;      ///< Fault::looks of this cycle.
    bool told = false;       ///< The hooks know that the application has stopped.
    std::atomic<bool> rest{false};
    bool comesAround = false; ///< Cyclic or freewheeling; online changes keep that.
    bool isShort = false;     ///< Its interval is at most kLongIntervalNs.
    std::atomic<OperatingMode> mode{OperatingMode::Run}; ///< As the hooks know it.
    bool takesOver = false;                              ///< This cycle is the hooks' alone.
  };

  static int64_t refill(Ctx *ctx);
  static void log(Ctx *ctx, uint32_t severity, const char *text);
  bool repeats(uint32_t task, int64_t startNs) const noexcept;
  static StException watchdogIn(const StException &loop, const Task &task,
                                const TaskDesc &desc) noexcept;
  void fail(const StException &exception, uint32_t task, uint64_t cycle, int64_t timeNs) noexcept;
  void tellHooks(Task &task) noexcept;
  void takeMode(Task &task) noexcept;
  void cycle(uint32_t index, int64_t startNs, int64_t latencyNs, bool hooksAlone) noexcept;
  void runPous(uint32_t index, void (*run)(Ctx *), int64_t startNs) noexcept;
  void watch(uint32_t index, int64_t runNs) noexcept;

  const StrideAppV1 *app_;
  HostApi host_;
  LoopLimit limit_;
  std::vector<std::unique_ptr<Task>> tasks_;
  std::vector<uint32_t> order_;
  uint32_t fastest_ = 0;
  bool hasEvents_ = false;
  int64_t loopBudget_ = kDefaultLoopBudget;
  std::optional<Fault> repeated_;
  TaskRaiser *raiser_ = nullptr;
  std::atomic<bool> stopped_{false};
  std::atomic<OperatingMode> mode_{OperatingMode::Run};
  mutable std::mutex faultMutex_;
  std::optional<Fault> fault_;
  CycleLog log_;
};

/// Nanoseconds of the system's monotonic clock.
int64_t monotonicNs() noexcept;

} // namespace stride::task

#endif
