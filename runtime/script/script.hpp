// Input scripts: variables written and forced at given times and on conditions.
#ifndef STRIDE_RUNTIME_SCRIPT_SCRIPT_HPP
#define STRIDE_RUNTIME_SCRIPT_SCRIPT_HPP

#include "runtime/app/condition.hpp"
#include "runtime/task/cycle_hook.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stride::task {
class TaskSet;
} // namespace stride::task

namespace stride::script {

/// Values that variables keep whatever the program writes, of a set of variables known before the
/// run. A hook to be added to every task, after the hooks that copy inputs and outputs. One
/// thread sets and releases; the tasks' threads apply.
class FixedForces final : public task::CycleHook {
public:
  /// Before the run. Returns the variable's number; the same for the same path.
  size_t add(const app::Symbol &symbol);

  /// `value` lives as long as this.
  void set(size_t number, const std::vector<std::byte> &value) noexcept;
  void release(size_t number) noexcept;

  /// Goes on with the variables of `fresh`. The values are those in force there.
  void takeOver(FixedForces &fresh) noexcept { forced_.swap(fresh.forced_); }
  /// The value in force, or null.
  const std::byte *value(size_t number) const noexcept {
    return forced_[number]->value.load(std::memory_order_acquire);
  }

  void beforePous(Ctx &ctx) override { apply(static_cast<std::byte *>(ctx.state)); }
  void afterPous(Ctx &ctx) override { apply(static_cast<std::byte *>(ctx.state)); }

private:
  struct Forced {
    app::Symbol symbol;
    size_t size = 0;
    std::atomic<const std::byte *> value{nullptr}; ///< null: not forced
  };
  void apply(std::byte *state) const noexcept;

  std::vector<std::unique_ptr<Forced>> forced_;
};

/// A script, read and checked (docs/scripts.md says what stands in it). It is stepped between
/// cycles; all of its memory is there before the first step.
class Script {
public:
  /// Throws app::Error with a line `FILE:LINE:COL: …` per mistake. `file` is for messages.
  Script(const app::SymbolTable &symbols, std::string_view text, std::string file);
  /// Reads the file. Throws app::Error.
  static Script fromFile(const app::SymbolTable &symbols, const std::string &file);

  /// The same script for another build. Throws app::Error where that does not fit the script.
  Script in(const app::SymbolTable &symbols) const;
  /// Another build has taken over: goes on with `fresh`, which in() made, where this has come to.
  /// Between two cycles; afterwards `fresh` is good for nothing.
  void takeOver(Script &fresh) noexcept;

  const std::string &text() const { return text_; }
  const std::string &file() const { return file_; }

  /// Whose mode `stop` and `start` switch; they live longer. Without it these do nothing.
  void switchModeOf(task::TaskSet &tasks) { tasks_ = &tasks; }

  /// Does what is due at that time. Neither allocates nor locks.
  void step(int64_t timeNs, std::byte *state) noexcept;
  /// The next time for which something waits; the largest number without one.
  int64_t nextNs() const noexcept;

  /// Applies what the script forces; to be added to every task.
  task::CycleHook &forces() { return *forces_; }

  /// After the run, "warning: …": what the script still waited for, what it could not write.
  std::vector<std::string> remarks() const;

private:
  friend class ScriptReader;

  struct Position {
    uint32_t line = 0;
    uint32_t column = 0;
  };
  enum class Does : uint8_t {
    Write,
    Force,
    Release,
    Stop,
    Start,
    WaitAt,
    WaitFor,
    WaitUntil,
    WaitUntilNot
  };
  struct Step {
    Does does = Does::Write;
    Position at;
    app::Symbol symbol;           ///< Write
    size_t forced = 0;            ///< Force, Release: its number in forces_
    std::vector<std::byte> value; ///< Write, Force
    int64_t timeNs = 0;           ///< WaitAt, WaitFor
    app::Condition condition;     ///< WaitUntil, WaitUntilNot
    int64_t failedNs = -1;        ///< Write: first time that it was not possible
  };
  /// Steps in their order: a rule, a sequence, or the steps outside of both.
  struct Thread {
    std::vector<Step> steps;
    bool repeats = false;
    size_t next = 0;
    int64_t sinceNs = -1; ///< WaitFor: when it began
  };

  static bool passes(const Thread &thread, const Step &step, int64_t timeNs,
                     std::byte *state) noexcept;
  void act(Step &step, int64_t timeNs, std::byte *state) noexcept;

  std::string file_;
  std::string text_;
  std::vector<Thread> threads_;
  std::unique_ptr<FixedForces> forces_;
  task::TaskSet *tasks_ = nullptr;
};

} // namespace stride::script

#endif
