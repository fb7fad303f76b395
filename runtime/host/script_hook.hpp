// An input script in the cycles of a run.
#ifndef STRIDE_RUNTIME_HOST_SCRIPT_HOOK_HPP
#define STRIDE_RUNTIME_HOST_SCRIPT_HOOK_HPP

#include "runtime/script/script.hpp"
#include "runtime/task/cycle_hook.hpp"

namespace stride::host {

/// Steps a script at the start of each cycle of its task, before the POUs.
class ScriptHook final : public task::CycleHook {
public:
  explicit ScriptHook(script::Script &script) : script_(&script) {}
  void beforePous(Ctx &ctx) override {
    script_->step(ctx.cycleStartNs, static_cast<std::byte *>(ctx.state));
  }
  void afterPous(Ctx &) override {}

private:
  script::Script *script_;
};

} // namespace stride::host

#endif
