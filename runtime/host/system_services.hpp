// What the host offers to the system libraries of one application.
#ifndef STRIDE_RUNTIME_HOST_SYSTEM_SERVICES_HPP
#define STRIDE_RUNTIME_HOST_SYSTEM_SERVICES_HPP

#include "runtime/app/application.hpp"
#include "runtime/host/input_port.hpp"
#include "runtime/system/file_service.hpp"
#include "runtime/system/system_api.h"
#include "runtime/task/cycle_log.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stride::host {

/// Memory, clock and files for one application, also over online changes.
class SystemServices {
public:
  /// `realClock`: what the clock says is read from the system; else 1970 plus the virtual time.
  SystemServices(const StrideAppV1 &app, const std::byte *state, bool realClock);
  SystemServices(const SystemServices &) = delete;
  SystemServices &operator=(const SystemServices &) = delete;
  ~SystemServices();

  /// The folder for the program's files: `folder`, or if that is empty the application's own.
  static std::string filesFolder(const StrideAppV1 &app, const std::string &folder);
  /// Before the first cycle; `folder`: for the program's files, empty: the application's own.
  /// `inputs` lives longer.
  void start(const StrideAppV1 &app, const std::string &folder, InputPort &inputs);
  /// After the last cycle: files are closed.
  void finish();

  /// For cycles, once it has started.
  const SystemApi &cycleApi() const { return cycleApi_; }
  /// The whole table for initialisers, FB_Exit and FB_Reinit, which have no files.
  const HostApi &initHost() const { return initHost_; }

  /// Another build, which is being initialised; null: none.
  void setFresh(const std::byte *state, uint64_t size);
  /// The other build has taken over: between two cycles.
  void swap(const StrideAppV1 &app, const std::byte *state) noexcept;

  /// Every now and then while the cycles go on, from one thread that is not a task's.
  void lookAfter();
  std::vector<std::string> takeNews();
  /// The lines that initialisers, FB_Exit and FB_Reinit have logged since the last call.
  std::vector<std::string> takeLog() { return log_.take(); }

private:
  class Pass;
  /// What the clock said in a task's cycle.
  struct Said {
    uint64_t cycle = ~uint64_t{0};
    int64_t ns = 0;
  };
  struct Range {
    std::atomic<const std::byte *> at{nullptr};
    std::atomic<uint64_t> size{0};
  };

  bool owns(const Ctx &ctx, const void *at, uint64_t size) const noexcept;
  int64_t wallClock(const Ctx &ctx) noexcept;
  int64_t offsetNow(int64_t cycleStartNs) noexcept;

  bool realClock_;
  Range running_;
  Range fresh_;
  std::vector<Said> said_;          ///< By task.
  std::atomic<int64_t> offset_{0};  ///< From the start of the run to 1970; 0: not known.
  std::atomic<int64_t> checked_{0}; ///< When that was compared with the system's clock.
  InputPort *inputs_ = nullptr;
  std::unique_ptr<Pass> pass_;
  std::optional<system::FileService> files_;
  SystemApi cycleApi_{};
  SystemApi initApi_{};
  HostApi initHost_;
  task::CycleLog log_;
};

} // namespace stride::host

#endif
