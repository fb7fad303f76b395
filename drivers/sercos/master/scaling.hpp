// What the numbers of a drive mean: its scaling, read from it, against the increments of an axis.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_SCALING_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_SCALING_HPP

#include "drivers/sercos/master/drive_config.hpp"

#include <cstdint>

namespace stride::sercos {

// Bits of S-0-0076, S-0-0044 and S-0-0086. [IEC 61491]
namespace scaling {
inline constexpr uint16_t kKind = 0x0007; ///< 0 none (torque: percent), 1 linear, 2 rotational.
inline constexpr uint16_t kLinear = 1;
inline constexpr uint16_t kRotational = 2;
inline constexpr uint16_t kParameters = 0x0008; ///< By factor and exponent, or S-0-0079.
inline constexpr uint16_t kSeconds = 0x0020;    ///< S-0-0044: per second, else per minute.
inline constexpr uint16_t kRadians = 0x0010;    ///< S-0-0044: else turns.
inline constexpr uint16_t kModulo = 0x0080;     ///< S-0-0076: positions go round at S-0-0103.
} // namespace scaling

/// The increments of one turn for which the preferred scaling stands: 0.0001 degrees each.
inline constexpr double kPreferredTurn = 3600000;

/// What start-up has read; the values here are those of drives that do not have the IDN.
struct ScalingFacts {
  int64_t position = 0;         ///< S-0-0076
  int64_t linearFactor = 1;     ///< S-0-0077
  int64_t linearExponent = -7;  ///< S-0-0078
  int64_t turn = 3600000;       ///< S-0-0079
  int64_t modulo = 0;           ///< S-0-0103
  int64_t velocity = 0;         ///< S-0-0044
  int64_t velocityFactor = 1;   ///< S-0-0045
  int64_t velocityExponent = 0; ///< S-0-0046
  int64_t torque = 0;           ///< S-0-0086
  int64_t torqueFactor = 1;     ///< S-0-0093
  int64_t torqueExponent = 0;   ///< S-0-0094

  /// Where a fact of that IDN is kept; null: it is none.
  [[nodiscard]] int64_t *of(Idn idn);
};

/// One unit of S-0-0036 and S-0-0040. [inc/s]
double velocityUnit(const ScalingFacts &facts);
/// One unit of S-0-0080 and S-0-0084. [Nm or N]
double torqueUnit(const ScalingFacts &facts, double rated);
/// Where positions go round; 0: nowhere but at 32 bits. [inc]
uint32_t moduloOf(const ScalingFacts &facts);

/// Positions as the drive has them, and as a counter of 32 bits without any other end.
class PositionCounter {
public:
  /// The drive shows `position`, and so does the counter.
  void begin(uint32_t modulo, int32_t position);
  /// The drive shows that now.
  void show(int32_t position);
  [[nodiscard]] uint32_t counter() const { return counter_; }
  /// What the drive is told to be at `counter`.
  int32_t command(uint32_t counter);
  /// A position of the drive as the counter nearest to where it is now.
  [[nodiscard]] uint32_t counterOf(int32_t position) const;

private:
  [[nodiscard]] int32_t wayTo(int32_t position) const;

  uint32_t modulo_ = 0;
  uint32_t counter_ = 0;
  int32_t shown_ = 0;
  uint32_t told_ = 0;     ///< The counter that the drive has been told last …
  int32_t toldValue_ = 0; ///< … and how.
};

} // namespace stride::sercos

#endif
