// `run --record`, `sim --replay`: the inputs of a run in a file.
#ifndef STRIDE_RUNTIME_HOST_RECORDING_HPP
#define STRIDE_RUNTIME_HOST_RECORDING_HPP

#include "runtime/app/application.hpp"
#include "runtime/host/input_port.hpp"
#include "runtime/host/output.hpp"
#include "runtime/monitor/symbol_server.hpp"
#include "runtime/script/script.hpp"
#include "runtime/task/task_set.hpp"

#include <atomic>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stride::host {

/// Notes the order of the cycles and all inputs of a run in which tasks take turns. The cycles
/// write into a ring, another thread writes that to the file. Where it cannot keep up, the
/// recording ends there, which is told; the cycles are never delayed.
class Recording final : public InputPort, public monitor::WriteLog {
public:
  /// Throws app::Error when the file cannot be created.
  explicit Recording(const std::string &path);
  ~Recording() override;

  /// Notes each cycle: before the hooks of inputs, in every task.
  void addHooks(task::TaskSet &tasks);
  /// Before the first cycle: the file begins with the state as it is now, initialised and with its
  /// retained values. `script`: what the replay must be given again, or null.
  void begin(const app::Application &application, const script::Script *script);

  using InputPort::pass;
  void pass(void *value, size_t size) noexcept override;
  /// What others have written into the program's variables is an input, too.
  void wrote(const std::byte *place, size_t size, bool behindPous) noexcept override;

  /// Writes what has come so far. From one thread, not a task's.
  void drain() noexcept;
  /// After the last cycle, with what stopped the run, if something did. False: see problem().
  bool finish(const std::optional<task::Fault> &fault) noexcept;
  /// What is wrong with the recording, or empty.
  std::string problem() const;

private:
  class CycleNote;
  void put(uint32_t mark, std::span<const std::byte> first,
           std::span<const std::byte> second = {}) noexcept;
  void writeBlock(std::initializer_list<std::span<const std::byte>> parts) noexcept;
  void copyIn(uint64_t at, const void *data, size_t size) noexcept;

  std::string path_;
  Output output_;
  bool incomplete_ = false; ///< A reader has not taken the end of it.
  uint64_t checksum_ = 0;   ///< Of what is in the file.
  std::vector<std::byte> ring_;
  std::atomic<uint64_t> put_{0};
  std::atomic<uint64_t> taken_{0};
  std::atomic<bool> full_{false};
  std::atomic<bool> beyond_{false}; ///< Something was written that is not in the state.
  const std::byte *state_ = nullptr;
  uint64_t stateSize_ = 0;
  std::vector<std::unique_ptr<CycleNote>> notes_;
};

/// One cycle of a recording.
struct RecordedCycle {
  uint32_t task = 0;
  bool stopped = false; ///< The application had been stopped before it.
  task::OperatingMode mode = task::OperatingMode::Run;
  bool takesModeOver = false; ///< TaskSet::takeModeOver().
  int64_t startNs = 0;
};

/// Gives the inputs of a recording back.
class Replay final : public InputPort {
public:
  /// Throws app::Error: unreadable, no recording, damaged, of another build of the application or
  /// of another script than that one (or null).
  Replay(const std::string &path, const app::Application &application,
         const script::Script *script);
  ~Replay() override;

  /// The exception that stopped the run.
  const std::optional<task::Fault> &fault() const { return fault_; }
  /// After all other hooks: puts what was written from outside into the variables.
  void addHooks(task::TaskSet &tasks);

  /// The state with which the run began.
  void restoreState(const app::Application &application) const;

  /// The next cycle; nothing at the end of the recording.
  std::optional<RecordedCycle> nextCycle();

  using InputPort::pass;
  void pass(void *value, size_t size) noexcept override;
  bool replays() const noexcept override { return true; }

  /// After the last cycle: a state other than that at the end of the run is a problem.
  void compareEnd(const app::Application &application);
  /// The program has asked for other inputs than it did in the run: what went wrong, or empty.
  const std::string &problem() const { return problem_; }

private:
  class Writes;
  bool take(void *value, size_t size) noexcept;
  void applyWrites(uint32_t mark, std::byte *state) noexcept;
  void readBlocks();
  void findEnd();

  std::string path_;
  std::vector<std::byte> data_;
  size_t state_ = 0; ///< Where it is in data_.
  uint64_t stateSize_ = 0;
  std::string faultFile_;
  std::optional<task::Fault> fault_;
  bool ended_ = false; ///< The file has its end.
  std::optional<uint64_t> endChecksum_;
  std::vector<std::unique_ptr<Writes>> writes_;
  size_t at_ = 0;
  std::string problem_;
};

} // namespace stride::host

#endif
