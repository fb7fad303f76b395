// The interface between the process image and a device.
#ifndef STRIDE_RUNTIME_IO_IO_DRIVER_HPP
#define STRIDE_RUNTIME_IO_IO_DRIVER_HPP

#include "runtime/common/io_exchange.hpp"
#include "runtime/common/setup_parameters.hpp"
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
  common::SetupParameters parameters; ///< Of its schema.
  /// Where the driver of its bus has its bytes (IoSchema::bus); null: it is on none.
  std::shared_ptr<common::IoExchange> exchange;
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

  /// Whether the device answers, as seen at `nowNs` (start of a cycle).
  virtual bool works(int64_t nowNs) noexcept = 0;
  /// It does not work because it has not started up yet: no loss.
  virtual bool starts() noexcept { return false; }
  /// Takes inputs; false: there are none to be had just now, those of the last cycle stay.
  virtual bool read(uint32_t first, std::span<BYTE> to) noexcept = 0;
  virtual void write(uint32_t first, std::span<const BYTE> from) noexcept = 0;
  /// A simulated device with a world that the inputs in the image stand for: these bytes are what
  /// somebody has written there since the last read.
  virtual void sense(uint32_t /*first*/, std::span<const BYTE> /*image*/) noexcept {}
  /// IO_DEVICE.bFault. TRUE: the device simulates its loss, and works() will tell of it; FALSE: it
  /// cannot, and counts as lost at once.
  virtual bool simulateFault(bool /*fault*/) noexcept { return false; }
  /// The application has stopped; the outputs have their safe values. May be called more than once.
  virtual void stopped() noexcept {}
};

} // namespace stride::io

#endif
