// Reads, writes and forces variables of a running application by name.
#ifndef STRIDE_RUNTIME_MONITOR_SYMBOL_SERVER_HPP
#define STRIDE_RUNTIME_MONITOR_SYMBOL_SERVER_HPP

#include "runtime/monitor/recorder.hpp"
#include "runtime/monitor/symbol_request.hpp"
#include "runtime/task/task_set.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace stride::monitor {

class SymbolChannel;

/// Is told what requests and forces change in the state, in the cycles.
class WriteLog {
public:
  WriteLog() = default;
  WriteLog(const WriteLog &) = delete;
  WriteLog &operator=(const WriteLog &) = delete;
  virtual ~WriteLog() = default;
  /// These bytes have just been changed, before the POUs or after them. Neither allocates, locks
  /// nor throws.
  virtual void wrote(const std::byte *place, size_t size, bool behindPous) noexcept = 0;
};

/// Serves one application. Requests are prepared outside of the cycles (names resolved, memory
/// allocated) and done by the tasks themselves: writes at the start of a cycle, after the copy of
/// the inputs, reads at its end. So what is read together was there at one moment, the end of a
/// cycle, and the cycle neither allocates nor locks nor waits; its work per cycle is bounded by
/// kValuesPerCycle and kBytesPerCycle.
///
/// Forced variables get their value before the POUs of every task, after the copy of the inputs,
/// and after them, before the copy of the outputs.
///
/// A variable is served by the task that owns it if that one runs periodically, else by the fastest
/// task. All functions may be called from any thread that is not a task's.
class SymbolServer {
public:
  static constexpr size_t kValuesPerRequest = 2000;
  static constexpr size_t kBytesPerRequest = size_t{64} << 10;
  static constexpr size_t kValuesPerCycle = kValuesPerRequest;
  static constexpr size_t kBytesPerCycle = kBytesPerRequest;
  static constexpr size_t kMostForces = 256;
  static constexpr size_t kMostWaiting = 256; ///< Requests per task.

  /// The tasks live longer, and their threads have ended before this does.
  explicit SymbolServer(task::TaskSet &tasks);
  ~SymbolServer();
  SymbolServer(const SymbolServer &) = delete;
  SymbolServer &operator=(const SymbolServer &) = delete;

  /// The hooks that see the end of the cycle: before all other hooks are added.
  void addOuterHooks();
  /// The hooks next to the POUs: after all other hooks.
  void addInnerHooks();

  /// Until the application is changed.
  const app::SymbolTable &symbols() const { return *symbols_; }

  /// Before the first cycle. It lives as long as the tasks' threads.
  void setWriteLog(WriteLog &log);

  /// The values of the names; a structure or an array stands for its parts. Throws app::Error:
  /// unknown name, too much at once, too many requests waiting.
  std::shared_ptr<SymbolRequest> read(const std::vector<std::string> &names);
  /// Throws app::Error, for constants and wrong literals too.
  std::shared_ptr<SymbolRequest> write(const std::vector<NamedValue> &values);
  /// Asks once more for the values of a request that is done. Throws app::Error, also when the
  /// application has been changed since.
  void again(const std::shared_ptr<SymbolRequest> &request);
  /// Waits until it is done; false: it was dropped, or not done in time.
  static bool wait(const SymbolRequest &request, std::chrono::milliseconds limit);
  /// Its values can be shown: done, and of the build that runs now.
  bool valid(const SymbolRequest &request) const;

  /// From the next cycle of each task on. Forcing a forced variable changes its value. Throws
  /// app::Error; then nothing is changed.
  void force(const std::vector<NamedValue> &values);
  /// The variables keep the values they have. Throws app::Error for one that is not forced.
  void release(const std::vector<std::string> &names);
  void releaseAll();
  /// Names and literals in the order of forcing.
  std::vector<NamedValue> forced() const;
  /// All periodic tasks apply what was forced last.
  bool forcesTaken() const;

  /// Records from the next cycle of the fastest task on; the present recorder ends. Null: none.
  void setRecorder(std::shared_ptr<Recorder> recorder);
  std::shared_ptr<Recorder> recorder() const;

  /// No request will be done any more: the tasks' threads have ended.
  void close();

  /// A new build that will take the application's place.
  class Change {
  public:
    Change(Change &&) noexcept;
    ~Change();
    /// Forced variables that the new build does not have, or with another type.
    const std::vector<std::string> &lostForces() const { return lostForces_; }

  private:
    friend class SymbolServer;
    struct Parts;
    Change();
    std::unique_ptr<Parts> parts_;
    std::vector<std::string> lostForces_;
  };
  /// Finds the forced variables in the new build, while the cycles go on. Nothing may be forced or
  /// released until changeApplication().
  Change prepareChange(std::unique_ptr<app::SymbolTable> symbols) const;
  /// It has taken the application's place, as TaskSet::rebind says: while no task is in a cycle.
  /// Waiting requests are dropped, forces and the recorder are carried over.
  void changeApplication(Change &change);
  /// Afterwards, as long as the old build is still there: a recorder that the new one has no
  /// variables for keeps the rows that it has. Without this call it is gone.
  void finishChange(Change &change);

private:
  struct Forced {
    app::Symbol symbol;
    std::vector<std::byte> value;
  };
  friend class SymbolChannel;

  uint32_t taskOf(const app::Symbol &symbol) const;
  bool periodic(uint32_t task) const;
  std::shared_ptr<SymbolRequest> newRequest(std::vector<app::Symbol> symbols);
  void submit(const std::shared_ptr<SymbolRequest> &request);
  void collect();
  void dropAll();
  void publishForces();

  std::unique_ptr<app::SymbolTable> symbols_;
  task::TaskSet *tasks_;
  mutable std::mutex mutex_; // of everything below, among the threads that are no task's
  std::vector<std::unique_ptr<SymbolChannel>> channels_; // by task
  std::vector<std::shared_ptr<SymbolRequest>> waiting_;
  std::vector<Forced> forced_;
  std::shared_ptr<Recorder> recorder_;
  uint64_t build_ = 0;
  bool closed_ = false;
};

} // namespace stride::monitor

#endif
