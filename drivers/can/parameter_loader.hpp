// Reads the files with parameters of drives again when a drive begins anew.
#ifndef STRIDE_DRIVERS_CAN_PARAMETER_LOADER_HPP
#define STRIDE_DRIVERS_CAN_PARAMETER_LOADER_HPP

#include "drivers/can/can_setup.hpp"
#include "drivers/can/master/start_up.hpp"
#include "runtime/bus/group_setup.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace stride::can {

/// What the files say now.
struct LoadedParameters {
  std::vector<std::vector<StartStep>> steps; ///< Of the start-up of each node that is drives.
  std::vector<std::string> faults;           ///< Of each drive: why it cannot start.
  std::vector<std::string> notes;            ///< To be said.
};

/// On a real bus a thread of its own reads them, and the cycles go on; in a simulation, whose time
/// stands still meanwhile, they are read by whoever waits for them, so that the same cycles come
/// out each time.
class ParameterLoader {
public:
  explicit ParameterLoader(const bus::GroupSetup &setup);
  ~ParameterLoader();
  ParameterLoader(const ParameterLoader &) = delete;
  ParameterLoader &operator=(const ParameterLoader &) = delete;

  /// Whether any drive of the group has such a file.
  static bool isNeeded(const bus::GroupSetup &setup);

  // In the cyclic path; nothing waits.
  /// The files are read anew.
  void request() noexcept { wanted_.fetch_add(1, std::memory_order_release); }
  /// Whether what was requested last has been read.
  [[nodiscard]] bool poll() noexcept;
  /// poll(): what has been read; it stays until the next request, and may be exchanged for
  /// something else, which is forgotten then.
  [[nodiscard]] LoadedParameters &loaded() { return loaded_; }

private:
  void read() noexcept;

  bus::GroupSetup setup_;
  LoadedParameters loaded_;
  std::atomic<uint32_t> wanted_{0};
  std::atomic<uint32_t> read_{0}; ///< The request that `loaded_` belongs to.
  std::atomic<bool> ends_{false};
  std::thread reader_; ///< Of a real bus.
};

} // namespace stride::can

#endif
