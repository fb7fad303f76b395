// Positions that the drive latches at its inputs. [CiA 402-2, 60B8h to 60BDh]
#ifndef STRIDE_DRIVERS_CAN_MASTER_TOUCH_PROBE_HPP
#define STRIDE_DRIVERS_CAN_MASTER_TOUCH_PROBE_HPP

#include <array>
#include <cstddef>
#include <cstdint>

namespace stride::can {

/// One of the drive's two probes: bit 0 of edges is the rising one, bit 1 the falling one.
class TouchProbe {
public:
  static constexpr size_t kEdges = 2;

  /// One cycle. `wanted`: edges at which somebody waits, 0 in between arms one anew. `status`: the
  /// probe's half of 60B9h.
  void step(uint8_t wanted, uint8_t status);
  void clear() { *this = TouchProbe(); }

  /// The probe's half of 60B8h: the first event of each edge.
  [[nodiscard]] uint8_t function() const;
  /// Edges that have been seen since they were wanted, and whose position is not known yet.
  [[nodiscard]] uint8_t seen() const { return seen_; }
  /// The position of an edge that has been seen.
  void latched(size_t edge, uint32_t position);

  /// Edges with a position, as long as they are wanted.
  [[nodiscard]] uint8_t captured() const { return captured_; }
  [[nodiscard]] uint32_t position(size_t edge) const { return positions_[edge]; }

private:
  enum class Step : uint8_t { Off, Disarming, Arming, Armed };

  std::array<uint32_t, kEdges> positions_{};
  uint8_t wanted_ = 0;
  uint8_t edges_ = 0; ///< With which it is armed.
  uint8_t seen_ = 0;
  uint8_t captured_ = 0;
  Step step_ = Step::Off;
};

} // namespace stride::can

#endif
