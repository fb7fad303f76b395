// Tasks that write down when they run.
#ifndef STRIDE_TESTS_UNIT_TASK_LOGGED_TASKS_HPP
#define STRIDE_TESTS_UNIT_TASK_LOGGED_TASKS_HPP

#include "runtime/task/virtual_scheduler.hpp"

#include <string>
#include <vector>

namespace stride::test {

using task::LoopLimit;
using task::TaskSet;
using task::VirtualScheduler;

inline constexpr int64_t kMs = 1000000;

/// An application without types: its tasks write to a log that ctx.state points to.
struct Log {
  std::vector<std::string> lines;
  bool go = false;   ///< For events.
  bool open = false; ///< For events.
};

inline Log &logOf(Ctx *ctx) { return *static_cast<Log *>(ctx->state); }

template <char Name> void note(Ctx *ctx) {
  logOf(ctx).lines.push_back(std::string(1, Name) + std::to_string(ctx->cycleStartNs / kMs) +
                             (ctx->firstCycle != 0 ? "!" : ""));
}

inline StrideAppV1 appWith(const std::vector<TaskDesc> &tasks) {
  StrideAppV1 app{};
  app.tasks = tasks.data();
  app.taskCount = static_cast<uint32_t>(tasks.size());
  return app;
}

inline TaskDesc cyclic(const char *name, uint32_t priority, int64_t ms, void (*run)(Ctx *)) {
  return {name, TaskKind::Cyclic, priority, ms * kMs, 0, 0, kNoIndex, run, nullptr};
}

/// Tasks and their scheduler.
struct Scheduled {
  Scheduled(const StrideAppV1 &app, std::byte *state)
      : tasks(app, state, task::hostApi(), LoopLimit::Budget), scheduler(tasks) {}
  Scheduled(const StrideAppV1 &app, Log &log)
      : Scheduled(app, reinterpret_cast<std::byte *>(&log)) {}

  TaskSet tasks;
  VirtualScheduler scheduler;
};

} // namespace stride::test

#endif
