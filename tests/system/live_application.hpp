// Programs that are built by `stride build`, run cycle by cycle, and changed while they run.
#ifndef STRIDE_TESTS_SYSTEM_LIVE_APPLICATION_HPP
#define STRIDE_TESTS_SYSTEM_LIVE_APPLICATION_HPP

#include "runtime/app/application.hpp"
#include "runtime/app/carry_over.hpp"
#include "runtime/app/symbols.hpp"
#include "runtime/app/value_text.hpp"
#include "runtime/task/fault.hpp"
#include "tests/support/data_stack.hpp"
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace stride::test {

/// Called around the cycles, as axis groups are.
class Around {
public:
  Around() = default;
  Around(const Around &) = delete;
  Around &operator=(const Around &) = delete;
  virtual ~Around() = default;
  virtual void before() = 0;
  virtual void after() = 0;
};

/// One application, and from time to time a new build of it.
class Live {
public:
  /// ST text, or the path of a project's folder.
  explicit Live(const std::string &program) : application_(build(program)) {
    application_->initialise(task::hostApi());
  }

  /// Runs cycles of a task.
  void run(int cycles, uint32_t task = 0) {
    const StrideAppV1 &app = application_->description();
    for (int i = 0; i < cycles; ++i) {
      Ctx ctx = now();
      if (around != nullptr)
        around->before();
      ctx.taskIndex = task;
      app.tasks[task].run(&ctx);
      if (around != nullptr)
        around->after();
      ++cycle_;
    }
  }

  /// Online change.
  void change(const std::string &program) {
    std::unique_ptr<app::Application> next = build(program);
    next->initialise(task::hostApi(), true);
    const app::CarryOver plan(application_->description(), next->description());
    report = plan.report().text(true);
    verdict = plan.report().verdict();
    if (verdict == app::Verdict::Refused)
      throw std::runtime_error(report);
    app::CarryResult result;
    plan.takeOver(now(), application_->state(), next->state(), result);
    events = plan.describe(result, application_->state());
    // Whoever still looks at the old state sees nonsense.
    std::memset(application_->state(), 0xEE, application_->stateBlock().size());
    application_ = std::move(next);
  }

  /// The value as a literal, `NULL` where a pointer on the way is null.
  std::string operator[](const std::string &path) const {
    const app::SymbolTable symbols(application_->description());
    const app::Symbol symbol = symbols.resolve(path);
    std::byte bit{};
    const void *place = symbol.read(application_->state(), bit);
    return place == nullptr
               ? "NULL"
               : app::formatLiteral(application_->description(), symbols.type(symbol), place);
  }
  /// Several values, separated by blanks.
  std::string values(const std::vector<std::string> &paths) const {
    std::string out;
    for (const std::string &path : paths)
      out += (out.empty() ? "" : " ") + (*this)[path];
    return out;
  }

  app::Application &application() { return *application_; }

  Around *around = nullptr;
  std::string report; ///< Of the last change.
  app::Verdict verdict = app::Verdict::Silent;
  std::vector<std::string> events; ///< Of the last change.

private:
  Ctx now() {
    Ctx ctx{};
    ctx.state = application_->state();
    ctx.host = &task::hostApi();
    ctx.taskIntervalNs = application_->description().tasks[0].intervalNs;
    ctx.cycleStartNs = static_cast<int64_t>(cycle_) * ctx.taskIntervalNs;
    ctx.cycle = cycle_;
    ctx.loopBudget = 1'000'000;
    ctx.firstCycle = cycle_ == 0 ? 1 : 0;
    dataStack_.giveTo(ctx);
    return ctx;
  }

  std::unique_ptr<app::Application> build(const std::string &program) {
    const std::string object = "app" + std::to_string(++builds_) + ".so";
    std::string source = program;
    if (program.find('\n') != std::string::npos) {
      source = "Main.st"; // names the global variable list
      writeFile(scratch_.path() / source, program);
    }
    const ProcessResult result =
        runProcess({STRIDE_BINARY_DIR "/stride", "build", source, "-o", object}, scratch_.path());
    if (result.exitCode != 0)
      throw std::runtime_error(result.out + result.err);
    return std::make_unique<app::Application>(
        app::Application::load((scratch_.path() / object).string()));
  }

  ScratchDirectory scratch_;
  int builds_ = 0;
  uint64_t cycle_ = 0;
  std::unique_ptr<app::Application> application_;
  DataStack dataStack_;
};

} // namespace stride::test

#endif
