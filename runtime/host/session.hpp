// One application of `stride run`, from its start to its stop.
#ifndef STRIDE_RUNTIME_HOST_SESSION_HPP
#define STRIDE_RUNTIME_HOST_SESSION_HPP

#include "runtime/host/application_options.hpp"
#include "runtime/host/aside.hpp"
#include "runtime/host/instance.hpp"
#include "runtime/host/online_change.hpp"
#include "runtime/host/options.hpp"
#include "runtime/host/recording.hpp"
#include "runtime/host/script_hook.hpp"
#include "runtime/host/trace_ring.hpp"
#include "runtime/monitor/service.hpp"
#include "runtime/task/real_scheduler.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stride::host {

/// What came of an online change.
struct ChangeResult {
  bool done = false;
  std::vector<std::string> report; ///< What was said about it.
  int64_t pauseNs = 0;             ///< In which no cycle could begin.
};

/// How a session has ended.
struct Ending {
  bool good = true;     ///< Without an exception of the program.
  bool complete = true; ///< All that was asked for has been written.
};

/// One application from its start to its stop. Once its cycles run, nothing but their end stops
/// them: what fails beside them is said and left out.
class Session {
public:
  /// `number`: of the application among those of the run. Throws app::Error for bad input.
  Session(std::unique_ptr<app::Application> application, size_t number, const RunOptions &options,
          const ApplicationOptions &own, const task::RealOptions &realOptions, Messages &messages);

  /// `trace` and `service` may be null. False: an initialiser has failed, which has been said.
  bool start(TraceWriter *trace, monitor::Service *service);
  /// Every now and then: what the cycles leave to others.
  void lookAfter() noexcept;
  bool failed() noexcept { return instance_.tasks().failed(); }
  /// The application in this file takes over, or it is said why not. `acceptLosses`: also when
  /// values are lost, as the run's own option allows.
  ChangeResult change(const std::string &path, bool acceptLosses);
  /// Stops and says what there is to say.
  Ending finish() noexcept;
  std::unique_ptr<app::Application> release() { return instance_.release(); }

  void showStatistics() noexcept;
  const task::TaskSet &tasks() { return instance_.tasks(); }
  const std::string &name() const { return name_; }

private:
  using Tell = std::function<void(const std::string &)>;

  void say(std::string_view line) noexcept;
  void sayFault(const task::Fault &fault) noexcept;
  static bool isWelcome(const OnlineChange &change, bool acceptLosses, const Tell &tell);
  void takeOver(OnlineChange &change, ChangeResult &result, const Tell &tell);
  void finishOutputs(Ending &ending, const std::optional<task::Fault> &fault) noexcept;
  std::optional<task::Fault> exitInstances();

  Messages *messages_;
  const RunOptions *options_;
  const ApplicationOptions *own_;
  size_t number_;
  std::string name_;
  Aside files_;
  Aside news_;
  Aside writing_;
  Aside monitor_;
  Aside showing_;
  Aside ending_;
  Instance instance_;
  TraceWriter *trace_ = nullptr;
  std::unique_ptr<TraceRing> ring_;
  bool traceFailed_ = false; ///< Which has been said.
  std::unique_ptr<Recording> recording_;
  std::optional<script::Script> script_;
  std::optional<ScriptHook> scriptHook_;
  std::unique_ptr<monitor::SymbolServer> served_;
  monitor::Service *service_ = nullptr;
  task::RealScheduler scheduler_; // its threads end before the rest goes
};

} // namespace stride::host

#endif
