// What the runtime does around a task's POUs.
#ifndef STRIDE_RUNTIME_TASK_CYCLE_HOOK_HPP
#define STRIDE_RUNTIME_TASK_CYCLE_HOOK_HPP

#include "runtime/app/abi.h"
#include "runtime/iec/ctx.h"
#include "runtime/task/operating_mode.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace stride::task {

/// Calls before and after the POUs of a task, in every cycle: an axis group's driver. Both run in
/// the cyclic path: no allocation, no lock.
class CycleHook {
public:
  CycleHook() = default;
  CycleHook(const CycleHook &) = delete;
  CycleHook &operator=(const CycleHook &) = delete;
  virtual ~CycleHook() = default;

  virtual void beforePous(Ctx &ctx) = 0;
  virtual void afterPous(Ctx &ctx) = 0;

  /// The PLC has gone into STOP or back to RUN; before beforePous() of the first cycle of the task
  /// in that mode. In STOP the hooks are called without the POUs between them.
  virtual void modeChanged(OperatingMode mode) { (void)mode; }
  /// The application has stopped, with an exception or because the run ends; from now on the hooks
  /// are called without the POUs between them, until all are at rest. Brings its part of the
  /// machine to a safe stop.
  virtual void applicationStopped() {}
  /// Nothing of this hook's part of the machine moves any more.
  virtual bool atRest() const { return true; }
  /// Another build will take over: computes what rebind() needs, while the cycles go on. From one
  /// thread, not a task's.
  virtual void prepareRebind(const StrideAppV1 &app) { (void)app; }
  /// Between two cycles: another build has taken over, with its state there (an online change). The
  /// tasks, axis groups and drives are the same in number and order. After prepareRebind() for
  /// this build. Neither allocates nor throws.
  virtual void rebind(const StrideAppV1 &app, std::byte *state) noexcept {
    (void)app;
    (void)state;
  }
  /// What has happened in the cycles since the last call, to be shown: a cycle itself says nothing,
  /// the output may lock. From one thread, not a task's.
  virtual std::vector<std::string> takeNews() { return {}; }
  /// What keeps this hook's part of the machine from working and was no news yet; empty if nothing
  /// does.
  virtual std::string problem() const { return {}; }
};

} // namespace stride::task

#endif
