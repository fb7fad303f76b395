// Faults of a simulated bus: by chance, which a seed decides, and on order.
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_FAULTS_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_FAULTS_HPP

#include "drivers/can/port/frame.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace stride::can::simulation {

/// What happens to a frame.
enum class Fault : uint8_t {
  None,
  Lose,      ///< It is on the wire, and nobody takes it: receivers that were too slow.
  Delay,     ///< Receivers have it later than it was on the wire.
  Duplicate, ///< It is there twice: the last bit of the first one was disturbed.
  Corrupt,   ///< Receivers have other bytes, as if no checksum had noticed.
  Disturb,   ///< Somebody notices an error and says so: the sender repeats it by himself.
};

/// How often something happens by chance, per million frames.
struct FaultRates {
  uint32_t lose = 0;
  uint32_t delay = 0;
  uint32_t duplicate = 0;
  uint32_t corrupt = 0;
  uint32_t disturb = 0;
  int64_t longestDelayNs = 0; ///< Delays are between 0 and this. [ns]
};

/// Something that is to happen to frames with an identifier.
struct FaultOrder {
  uint16_t id = 0;
  Fault fault = Fault::None;
  uint32_t skip = 0;   ///< So many frames pass before …
  uint32_t count = 1;  ///< … and it happens to so many.
  int64_t delayNs = 0; ///< Delay: how much. [ns]
  int16_t byte = -1;   ///< Corrupt: this byte …
  uint8_t invert = 0;  ///< … with these bits inverted; byte < 0: by chance.
  int16_t length = -1; ///< Corrupt: the frame has this many bytes then; < 0: as before.
};

/// What happens to one frame.
struct FaultChoice {
  Fault fault = Fault::None;
  int64_t delayNs = 0;
  Frame frame; ///< What receivers have.
};

/// The same seed and the same frames give the same faults.
class Faults {
public:
  explicit Faults(uint64_t seed) : state_(seed) {}

  void set(const FaultRates &rates) { rates_ = rates; }

  /// FALSE: too many orders are open.
  bool order(const FaultOrder &order);

  /// All frames are as they should be from now on.
  void clear();

  FaultChoice choose(const Frame &frame);

  /// A number that chance gives, below `limit`; 0 if that is 0.
  uint64_t below(uint64_t limit);

private:
  void corrupt(FaultChoice &choice);

  static constexpr size_t kOrders = 32;

  FaultRates rates_;
  std::array<FaultOrder, kOrders> orders_{};
  size_t ordered_ = 0;
  uint64_t state_;
};

} // namespace stride::can::simulation

#endif
