#include "runtime/host/test_run.hpp"

#include "runtime/app/application.hpp"
#include "runtime/app/error.hpp"
#include "runtime/app/symbols.hpp"
#include "runtime/host/axis_hooks.hpp"
#include "runtime/host/exit_code.hpp"
#include "runtime/host/instance.hpp"
#include "runtime/host/output.hpp"
#include "runtime/host/st_backtrace.hpp"
#include "runtime/host/system_services.hpp"
#include "runtime/host/test_report.hpp"
#include "runtime/iec/assert.h"
#include "runtime/task/task_set.hpp"
#include "runtime/task/task_thread.hpp"

#include <algorithm>
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>

namespace stride::host {

namespace {

/// More failures of one test are counted only by the first ones.
constexpr size_t kMostFailures = 50;
/// Of one assertion: one that fails in each cycle would hide all that follow.
constexpr size_t kMostOfPlace = 3;

/// A test as `stride test` names it: INDEX;CYCLE;TIMEOUT;LINE;NAME;FILE, times in ns.
struct Plan {
  int32_t index = 0;
  int64_t cycleNs = 0; ///< 0: the task's
  int64_t timeoutNs = 0;
  uint32_t line = 0;
  std::string name;
  std::string file;
};

Plan parsePlan(const std::string &text) {
  Plan plan;
  const char *at = text.data();
  const char *const end = at + text.size();
  const auto number = [&](auto &value) {
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || next == end || *next != ';')
      throw app::Error(fmt::format("--test '{}': not INDEX;CYCLE;TIMEOUT;LINE;NAME;FILE", text));
    at = next + 1;
  };
  number(plan.index);
  number(plan.cycleNs);
  number(plan.timeoutNs);
  number(plan.line);
  const std::string rest(at, end);
  plan.name = rest.substr(0, rest.find(';'));
  plan.file = rest.substr(std::min(rest.size(), plan.name.size() + 1));
  return plan;
}

/// The tasks of one test; assertions come here through the host's table.
class TestTasks : public task::TaskSet {
public:
  TestTasks(const StrideAppV1 &app, std::byte *state, TestResult &result)
      : TaskSet(app, state, table(), task::LoopLimit::Budget), result_(&result) {}

private:
  static HostApi table() {
    HostApi api = task::hostApi();
    api.log = log;
    return api;
  }
  static void log(Ctx *ctx, uint32_t severity, const char *text) {
    if (severity != kAssertionFailed) {
      task::hostApi().log(ctx, severity, text);
      return;
    }
    auto *tasks = static_cast<TestTasks *>(static_cast<TaskSet *>(ctx->host->self));
    const auto *assertion = reinterpret_cast<const FailedAssertion *>(text);
    if (!tasks->isShown(*assertion)) {
      ++tasks->result_->omitted;
      return;
    }
    TestFailure failure;
    failure.kind = assertion->function;
    failure.expected = assertion->expected;
    failure.actual = assertion->actual;
    failure.message = assertion->message;
    failure.file = assertion->file;
    failure.line = assertion->line;
    failure.column = assertion->col;
    failure.cycle = ctx->cycle;
    failure.timeNs = ctx->cycleStartNs;
    tasks->result_->failures.push_back(std::move(failure));
  }

  [[nodiscard]] bool isShown(const FailedAssertion &assertion) const {
    const std::vector<TestFailure> &failures = result_->failures;
    const auto ofPlace = std::count_if(failures.begin(), failures.end(), [&](const auto &failure) {
      return failure.line == assertion.line && failure.column == assertion.col &&
             failure.file == assertion.file;
    });
    return failures.size() < kMostFailures && static_cast<size_t>(ofPlace) < kMostOfPlace;
  }

  TestResult *result_;
};

class TestRun {
public:
  TestRun(const std::string &application, const std::string &files, const Plan &plan,
          Messages &messages)
      : messages_(&messages), plan_(plan),
        application_(app::Application::load(application, runtimeLayouts())),
        system_(application_.description(), application_.state(), false) {
    result_.name = plan.name;
    result_.file = plan.file;
    result_.line = plan.line;
    system_.start(application_.description(), files, inputs_);
  }

  TestResult run() {
    const auto start = std::chrono::steady_clock::now();
    try {
      initialiseGuarded(application_, system_.initHost(), false, false);
      cycles();
    } catch (const StException &exception) {
      fail("exception", describeWithCalls({exception, "initialisation", 0, 0}));
    }
    system_.finish();
    for (const std::string &line : system_.takeLog())
      messages_->say(line);
    for (const std::string &news : system_.takeNews())
      messages_->say({"warning: ", news});
    result_.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(result_);
  }

private:
  void cycles() {
    const app::SymbolTable symbols(application_.description());
    std::byte *const state = application_.state();
    symbols.resolve("Test__Run.which__").write(state, &plan_.index, sizeof plan_.index);
    const BOOL *const done = doneOf(symbols);

    // The same application, with the cycle time of this test.
    StrideAppV1 description = application_.description();
    std::vector<TaskDesc> descs(description.tasks, description.tasks + description.taskCount);
    if (plan_.cycleNs != 0)
      descs[0].intervalNs = plan_.cycleNs;
    description.tasks = descs.data();
    const int64_t cycleNs = descs[0].intervalNs;

    TestTasks tasks(description, state, result_);
    tasks.setSystem(system_.cycleApi());
    const auto devices = addDevices(application_, tasks, inputs_, bus::BusKind::Simulated, {},
                                    SystemServices::filesFolder(description, {}));
    for (int64_t timeNs = 0;; timeNs += cycleNs) {
      if (done != nullptr && timeNs >= plan_.timeoutNs) {
        fail("timeout",
             fmt::format("not done after {:g} s", static_cast<double>(plan_.timeoutNs) * 1e-9));
        return;
      }
      tasks.runCycle(0, timeNs, 0);
      ++result_.cycles;
      result_.timeNs = timeNs;
      if (const std::optional<task::Fault> fault = tasks.fault()) {
        fail("exception", describeWithCalls(*fault));
        return;
      }
      if (done == nullptr || *done)
        break;
    }
    exit(cycleNs);
  }

  /// FB_Exit of all instances.
  void exit(int64_t cycleNs) {
    if (application_.description().exit == nullptr)
      return;
    Ctx ctx{};
    ctx.state = application_.state();
    ctx.host = &system_.initHost();
    ctx.cycleStartNs = result_.timeNs + cycleNs;
    ctx.loopBudget = task::TaskSet::kDefaultLoopBudget;
    if (const auto exception = task::guardedCall(application_.description().exit, ctx))
      fail("exception", describeWithCalls({*exception, "end of the test", 0, ctx.cycleStartNs}));
  }

  /// The output Done of the test; null: it has none.
  const BOOL *doneOf(const app::SymbolTable &symbols) {
    try {
      const app::Symbol symbol = symbols.resolve(fmt::format("Test__Run.t{}__.Done", plan_.index));
      if (symbols.type(symbol).kind == Kind::BOOL && (symbol.flags() & kSymOutput) != 0)
        return static_cast<const BOOL *>(symbol.address(application_.state()));
    } catch (const app::Error &) { // there is none
    }
    return nullptr;
  }

  void fail(const char *kind, std::string text) {
    TestFailure failure;
    failure.kind = kind;
    failure.text = std::move(text);
    failure.cycle = result_.cycles;
    failure.timeNs = result_.timeNs;
    result_.failures.push_back(std::move(failure));
  }

  Messages *messages_;
  Plan plan_;
  app::Application application_;
  LiveInputs inputs_;
  SystemServices system_;
  TestResult result_;
};

/// What cannot be printed shows in the exit code.
void tell(const std::string &text) { std::fputs(shownOn(stdout, text).c_str(), stdout); }

void writeReport(const std::string &path, const std::string &text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush())
    throw app::Error(fmt::format("'{}' cannot be written", path));
}

} // namespace

void TestCommand::declare(CLI::App &command) {
  command.add_option("APP", application_, "The application that 'stride test' made")->required();
  command.add_option("--root", root_, "Folder of the sources")->type_name("FOLDER");
  command.add_option("--files", files_, "Folder for the program's files")->type_name("FOLDER");
  command.add_option("--suite", suite_, "Name of the project")->type_name("NAME");
  command.add_option("--junit", junit_, "JUnit XML file to write")->type_name("FILE");
  command.add_option("--test", tests_, "INDEX;CYCLE;TIMEOUT;LINE;NAME;FILE (may be repeated)")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("TEST");
}

int TestCommand::run(Messages &messages) {
  std::vector<Plan> plans;
  for (const std::string &text : tests_)
    plans.push_back(parsePlan(text));
  tell(fmt::format("running {} test{}\n", plans.size(), plans.size() == 1 ? "" : "s"));
  std::vector<TestResult> results;
  size_t failed = 0;
  task::runOnTaskThread([&] {
    const task::MemoryGuard guard;
    for (const Plan &plan : plans) {
      tell(fmt::format("test {} ... ", plan.name));
      std::fflush(stdout);
      results.push_back(TestRun(application_, files_, plan, messages).run());
      const TestResult &result = results.back();
      tell(result.failures.empty() ? "ok\n" : "FAILED\n");
      failed += result.failures.empty() ? 0 : 1;
      for (const TestFailure &failure : result.failures)
        tell(describeFailure(failure, root_));
      if (result.omitted != 0)
        tell(fmt::format("  {}\n", describeOmitted(result.omitted)));
      std::fflush(stdout);
    }
  });
  tell(fmt::format("\ntest result: {}. {} passed; {} failed\n", failed == 0 ? "ok" : "FAILED",
                   results.size() - failed, failed));
  if (!junit_.empty())
    writeReport(junit_, junitXml(suite_, results));
  return failed == 0 ? kExitOk : kExitBadInput;
}

} // namespace stride::host
