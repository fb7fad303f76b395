// An application with everything that belongs to it while it runs, whatever the clock.
#ifndef STRIDE_RUNTIME_HOST_INSTANCE_HPP
#define STRIDE_RUNTIME_HOST_INSTANCE_HPP

#include "runtime/app/application.hpp"
#include "runtime/app/symbols.hpp"
#include "runtime/bus/group_setup.hpp"
#include "runtime/host/input_port.hpp"
#include "runtime/host/retain_keeper.hpp"
#include "runtime/host/system_services.hpp"
#include "runtime/task/task_set.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stride::host {

/// Application::initialise with what guards a task's cycle, so that a bad pointer or an endless
/// loop in an initialiser or FB_Init is an StException. From a thread with a MemoryGuard.
void initialiseGuarded(app::Application &application, const HostApi &host, bool inCopyCode,
                       bool keepRetains);

/// One run of an application from its initial values to its end.
class Instance {
public:
  /// Throws app::Error for an application that cannot be run.
  Instance(std::unique_ptr<app::Application> application, task::LoopLimit limit);

  /// Before initialise: where inputs pass on their way into the program. It lives longer.
  void setInputs(InputPort &inputs) { inputs_ = &inputs; }

  /// Before initialise: drives are on the buses that the configuration names, not simulated ones.
  void useRealBuses() { buses_ = bus::BusKind::Real; }

  /// Before initialise: what passes the buses is kept, or repeated.
  void recordBuses(bus::BusRecording recording) { recording_ = std::move(recording); }

  /// Before initialise(): the folder for the program's files, in place of the application's own.
  void setFiles(std::string folder) { filesFolder_ = std::move(folder); }

  /// Before initialise(): RETAIN and PERSISTENT variables come from and go to a file. Throws
  /// app::Error where that cannot be read.
  void retain(const RetainSettings &settings, RetainKeeper::Say say);
  /// Null without.
  RetainKeeper *retainKeeper() { return retain_ ? &*retain_ : nullptr; }

  /// Sets the initial values and what is retained, then adds the hooks of the PLC configuration.
  /// Throws StException when an initialiser fails, app::Error for a driver that this runtime does
  /// not have.
  void initialise();

  /// A hook of every task, after the hooks of the PLC configuration: next to the POUs. After
  /// initialise(). It must live as long as this.
  void addToAllTasks(task::CycleHook &hook);

  /// FB_Exit of every instance, after the last cycle; what goes wrong in one of them. A program
  /// that has failed is not called again. Then the program's files are closed.
  std::optional<task::Fault> exit(int64_t timeNs);

  /// What initialisers, FB_Exit and FB_Reinit find in the host.
  const HostApi &initHost() const { return system_.initHost(); }
  /// While the cycles go on: initialises a build that may take over. Throws StException.
  void initialiseFresh(app::Application &fresh);
  /// While the cycles go on: what swap() with this build needs.
  void prepareSwap(const app::Application &fresh);
  /// Between two cycles: another build, with the values of this one, takes its place. Afterwards
  /// `other` is the old one, to which symbols() belong until renewSymbols().
  void swap(std::unique_ptr<app::Application> &other) noexcept;
  /// After swap(): symbols() are those of the build that has taken over.
  void renewSymbols() noexcept;
  /// Gives the application up, after the last cycle.
  std::unique_ptr<app::Application> release() { return std::move(application_); }

  const app::Application &application() const { return *application_; }
  const StrideAppV1 &app() const { return application_->description(); }
  std::byte *state() const { return application_->state(); }
  const app::SymbolTable &symbols() const { return *symbols_; }
  task::TaskSet &tasks() { return tasks_; }

  /// Every now and then while cycles go by the real clock: what they leave to others. From one
  /// thread, not a task's.
  void lookAfter() { system_.lookAfter(); }
  /// What has happened in the cycles since the last call: "warning: …". From one thread, not a
  /// task's.
  std::vector<std::string> takeNews();
  /// What is worth saying at the end of a run, besides the news: "warning: …", "note: …".
  std::vector<std::string> remarks() const;

private:
  std::optional<task::Fault> callExit(int64_t timeNs);

  std::unique_ptr<app::Application> application_;
  std::unique_ptr<app::SymbolTable> symbols_;
  std::unique_ptr<app::SymbolTable> nextSymbols_; ///< From prepareSwap() to renewSymbols().
  SystemServices system_;
  std::string filesFolder_;
  task::TaskSet tasks_;
  std::optional<RetainKeeper> retain_;
  std::vector<std::unique_ptr<task::CycleHook>> hooks_;
  LiveInputs live_;
  InputPort *inputs_ = &live_;
  bus::BusKind buses_ = bus::BusKind::Simulated;
  bus::BusRecording recording_;
};

} // namespace stride::host

#endif
