// The interface between the process image and a device.
#ifndef STRIDE_RUNTIME_IO_IO_DRIVER_HPP
#define STRIDE_RUNTIME_IO_IO_DRIVER_HPP

#include "runtime/iec/types.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace stride::io {

/// What stride.toml says of a device, for its driver.
struct IoSettings {
  std::string name;
  uint32_t inputBytes = 0;
  uint32_t outputBytes = 0;
  bool loopBack = false;    ///< Simulated: inputs are the outputs.
  uint32_t delayCycles = 0; ///< Simulated: so many cycles later.
  std::string segment;      ///< SharedMemory: its name.
  int64_t timeoutNs =
      0; ///< SharedMemory: the other side shows a sign of life in this time; 0: need not.
};

/// One device. Its bytes are counted from 0 here. The tasks' threads call it in their cycles, each
/// for the bytes that it uses: nothing here allocates, locks, waits or throws. A byte of the
/// outputs is written by one task only.
class IoDriver {
public:
  IoDriver() = default;
  IoDriver(const IoDriver &) = delete;
  IoDriver &operator=(const IoDriver &) = delete;
  virtual ~IoDriver() = default;

  /// What it gives does not follow from what the program does: it belongs into a recording.
  virtual bool isExternal() const noexcept { return true; }
  /// Whether the device answers, as seen at `nowNs` (start of a cycle).
  virtual bool works(int64_t nowNs) noexcept = 0;
  /// Takes inputs; false: there are none to be had just now, those of the last cycle stay.
  virtual bool read(uint32_t first, std::span<BYTE> to) noexcept = 0;
  virtual void write(uint32_t first, std::span<const BYTE> from) noexcept = 0;
  /// The application has stopped; the outputs have their safe values. May be called more than once.
  virtual void stopped() noexcept {}
};

} // namespace stride::io

#endif
