// Files for programs: the cycle asks, a thread outside of real time waits for the disk.
#ifndef STRIDE_RUNTIME_SYSTEM_FILE_SERVICE_HPP
#define STRIDE_RUNTIME_SYSTEM_FILE_SERVICE_HPP

#include "runtime/system/disk.hpp"
#include "runtime/system/system_api.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <semaphore.h>

namespace stride::system {

/// What files are to the program comes from outside and passes here (host::InputPort).
class Inputs {
public:
  Inputs() = default;
  Inputs(const Inputs &) = delete;
  Inputs &operator=(const Inputs &) = delete;
  virtual ~Inputs() = default;
  virtual void pass(void *value, size_t size) noexcept = 0;
  /// The values are those of a recording: nothing happens on the disk.
  virtual bool replays() const noexcept = 0;
};

struct FileSettings {
  std::string root = "files"; ///< All names are relative to this folder.
  bool anywhere = false;      ///< Names may lead out of it.
  /// In virtual time: what is asked is done at once, in the cycle, and the answer comes so many
  /// cycles of the asking task later, so that runs repeat.
  bool virtualTime = false;
  uint32_t delayCycles = 1;
  uint64_t largest = uint64_t{16} << 20; ///< The largest file that OpenStream reads. [bytes]
};

/// Requests of the tasks of one application. A task claims one of a fixed number of places with an
/// atomic operation, fills it and wakes the thread; it looks for the answer there in later cycles.
/// It never waits for the thread, locks nothing and allocates nothing. There is no thread before
/// something is asked, and none in virtual time, where a cycle may wait for the disk.
class FileService {
public:
  FileService(FileSettings settings, uint32_t tasks, Inputs &inputs);
  FileService(const FileService &) = delete;
  FileService &operator=(const FileService &) = delete;
  ~FileService();

  // From cycles; see SystemApi.
  uint32_t start(const Ctx &ctx, const FileRequest &request) noexcept;
  void poll(const Ctx &ctx, uint32_t number, void *data, uint64_t room,
            FileAnswer &answer) noexcept;
  void ask(const Ctx &ctx, const FileRequest &request, FileAnswer &answer) noexcept;
  void stream(const Ctx &ctx, StreamOp op, uint32_t file, void *data, uint64_t size,
              FileAnswer &answer) noexcept;
  FileError lastError(const Ctx &ctx) const noexcept { return lastErrors_[ctx.taskIndex]; }

  /// Every now and then, not from a cycle: starts the thread once something has been asked. Always
  /// from the same thread, which calls finish(), too.
  void lookAfter();
  /// After the last cycle: waits until everything that was asked has been done, and closes all
  /// files.
  void finish();
  /// What was lost since the last call. Not from a cycle.
  std::vector<std::string> takeNews();

private:
  struct Job;
  struct Stream;
  static constexpr size_t kJobs = 32;
  static constexpr size_t kStreams = 16;

  // In the cycle.
  Job *claim(const Ctx &ctx) noexcept;
  void submit(const Ctx &ctx, Job &job, const FileRequest &request) noexcept;
  void wake() noexcept;
  Job *findJob(uint32_t number) noexcept;
  Job *findAsked(const Ctx &ctx, const FileRequest &request) noexcept;
  bool ready(const Ctx &ctx, const Job &job) const noexcept;
  static void take(Job &job, void *data, uint64_t room, FileAnswer &answer) noexcept;
  void recycle(const Ctx &ctx) noexcept;
  void askNow(const Ctx &ctx, const FileRequest &request, FileAnswer &answer) noexcept;
  Stream *findStream(uint32_t file) noexcept;
  static void use(Stream &stream, StreamOp op, void *data, uint64_t size,
                  FileAnswer &answer) noexcept;
  static void put(Stream &stream, const void *data, uint64_t size, FileAnswer &answer) noexcept;

  // In the thread; in virtual time and at the end in whichever there is.
  void work();
  void workOnce();
  Job *next();
  void execute(Job &job);
  Outcome openStream(const Job &job);
  Outcome closeStream(uint32_t file);
  Outcome finishStream(Stream &stream);
  void finishStreams();
  void drain(Stream &stream);
  void drainAll();
  void sayLosses(const Stream &stream, FileError error, FileError end) noexcept;
  void say(std::string text);

  FileSettings settings_;
  Inputs *inputs_;
  Disk disk_;
  std::unique_ptr<Job[]> jobs_;
  std::unique_ptr<Stream[]> streams_;
  std::vector<FileError> lastErrors_; ///< By task.
  std::atomic<uint64_t> tickets_{0};
  std::atomic<bool> wanted_{false}; ///< There is something to do for a thread.
  std::atomic<bool> ending_{false};
  ::sem_t work_{};       ///< Posted for everything there is to do.
  std::mutex newsMutex_; ///< Between the thread and takeNews(): no cycle.
  std::vector<std::string> news_;
  std::atomic<bool> unsaid_{false}; ///< There was no memory for news.
  std::vector<std::byte> scratch_;
  std::thread thread_;
};

} // namespace stride::system

#endif
