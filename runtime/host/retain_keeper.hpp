// RETAIN and PERSISTENT variables of a running application: loaded at its start, saved while it
// runs and when it stops.
#ifndef STRIDE_RUNTIME_HOST_RETAIN_KEEPER_HPP
#define STRIDE_RUNTIME_HOST_RETAIN_KEEPER_HPP

#include "runtime/app/retain_image.hpp"
#include "runtime/app/retain_store.hpp"
#include "runtime/task/task_set.hpp"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace stride::host {

/// Where and how often.
struct RetainSettings {
  std::string file;
  int64_t periodNs = 10'000'000'000;
};

/// The settings that an application has itself; `file` is empty where it names none.
RetainSettings retainSettings(const StrideAppV1 &app);

/// Every task hands over its own variables at the end of one of its cycles, when that is asked for
/// (tasks without an interval of their own: of every cycle), without waiting for anyone; a thread
/// of its own puts them together and writes the file. What cannot be written is reported once and
/// tried again; it never stops the application.
class RetainKeeper {
public:
  /// Told lines such as "warning: …", also from the thread that saves.
  using Say = std::function<void(std::string_view)>;

  /// Loads the file. Nothing is done with the file, here and later, while the application has
  /// nothing to retain. Throws app::Error: in use by others, unreadable, of another application.
  RetainKeeper(const StrideAppV1 &app, std::byte *state, RetainSettings settings, Say say,
               app::RetainFiles &files = app::systemFiles());
  RetainKeeper(const RetainKeeper &) = delete;
  RetainKeeper &operator=(const RetainKeeper &) = delete;
  ~RetainKeeper();

  /// For Application::initialise.
  bool keepsRetains() const { return restore_ && restore_->keepsRetains(); }
  /// After the initialisation: puts the values back, and says which were not.
  void restore();
  /// Before the first cycle, before the hooks of devices: what they do in a cycle is saved with it.
  void addHooks(task::TaskSet &tasks);
  /// From now on it is saved every period.
  void startSaving();
  /// No task is in a cycle any more: saves what the variables are now. False: it did not succeed.
  bool finish() noexcept;

  /// Online change, while the cycles go on: allocates what change() needs.
  void prepareChange(const StrideAppV1 &app, std::byte *state);
  /// Between two cycles, when the values are in the new state: from now on the tasks hand over the
  /// variables of that build. What a task does not hand over soon, one that waits for an event, is
  /// saved as it is now.
  void change() noexcept;
  /// After change(), while the tasks run: from now on the new build is saved.
  void adopt() noexcept;

private:
  class Part;
  class TaskHook;
  struct Binding;

  std::shared_ptr<Binding> bind(const StrideAppV1 &app, std::byte *state) const;
  void publish(const Binding &binding) noexcept;
  void endThread();
  void saveLoop();
  void saveOnce(std::unique_lock<std::mutex> &lock);
  bool save(const Binding &binding, const std::vector<std::byte> &values) noexcept;
  void notSaved(const char *reason) noexcept;
  void sayNotSaved(const char *reason) noexcept;

  RetainSettings settings_;
  Say say_;
  std::optional<app::RetainLock> lock_;
  app::RetainStore store_;
  std::optional<app::RetainImage> image_;
  std::optional<app::RetainRestore> restore_;
  std::vector<std::unique_ptr<TaskHook>> hooks_; ///< By task.
  std::shared_ptr<Binding> next_;                ///< From prepareChange() to adopt().
  bool failing_ = false;                         ///< The last save did not succeed.

  std::mutex mutex_; ///< Of what follows.
  std::condition_variable wake_;
  std::shared_ptr<Binding> binding_;
  bool stopping_ = false;
  std::thread thread_;
};

} // namespace stride::host

#endif
