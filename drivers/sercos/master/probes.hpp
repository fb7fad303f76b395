// Positions that the drive latches at its probes: the procedure command S-0-0170. [IEC 61491]
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_PROBES_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_PROBES_HPP

#include "drivers/sercos/master/service_wish.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace stride::sercos {

/// Both probes of a drive, with their edges: bit 0 is the positive one of probe 1, bit 1 its
/// negative one, bits 2 and 3 those of probe 2, here and in S-0-0169 and S-0-0179.
class Probes {
public:
  static constexpr size_t kEdges = 4;

  /// `inputs`: edges that the drive has.
  explicit Probes(uint8_t inputs) : inputs_(inputs) {}
  void clear() { *this = Probes(inputs_); }

  /// One cycle: edges at which somebody waits; 0 in between arms one anew.
  void step(uint8_t wanted);

  /// Edges that have come since they were wanted, with their positions.
  [[nodiscard]] uint8_t captured() const { return captured_; }
  [[nodiscard]] int32_t position(size_t edge) const { return positions_[edge]; }

  [[nodiscard]] ServiceWish wish() const;
  void answered(const ServiceWish &wish, const ServiceAnswer &answer);

private:
  enum class Step : uint8_t {
    Off,
    Edges,   ///< S-0-0169 is being written …
    Command, ///< … then S-0-0170 is being set.
    Active,
    Ended, ///< The drive has refused it.
  };
  /// What an enable signal is, and shall be.
  struct Enable {
    bool on = false;
    bool again = false; ///< It must be off before it is on.
  };

  [[nodiscard]] bool wantsProbe(size_t probe) const {
    return (wanted_ >> 2 * probe & 3U & ~(captured_ >> 2 * probe)) != 0;
  }

  std::array<int32_t, kEdges> positions_{};
  std::array<Enable, 2> enables_{};
  uint8_t inputs_;
  uint8_t wanted_ = 0;
  uint8_t captured_ = 0;
  uint8_t seen_ = 0; ///< By S-0-0179, without its position yet.
  Step step_ = Step::Off;
};

} // namespace stride::sercos

#endif
