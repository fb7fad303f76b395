// What the numbers on the ring are worth to a drive. [IEC 61491: S-0-0044, S-0-0076, S-0-0160]
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATION_DRIVE_SCALING_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATION_DRIVE_SCALING_HPP

#include "drivers/sercos/simulation/idn_list.hpp"

#include <cstdint>

namespace stride::sercos::simulation {

/// Bits of S-0-0044, S-0-0076, S-0-0086 and S-0-0160.
namespace scaling {
inline constexpr int64_t kMethod = 0x0007; ///< 0: none (increments), 1: linear, 2: rotational.
inline constexpr int64_t kLinear = 1;
inline constexpr int64_t kRotational = 2;
inline constexpr int64_t kParameter = 0x0008; ///< With factors; 0: the preferred ones.
inline constexpr int64_t kSeconds = 0x0020;   ///< Of velocities: per second; 0: per minute.
inline constexpr int64_t kLoad = 0x0040;      ///< At the load, which here is the motor.
inline constexpr int64_t kModulo = 0x0080;    ///< Of positions: with S-0-0103.
} // namespace scaling

/// From what the drive's mechanics count in, increments, to the ring's units and back.
class DriveScaling {
public:
  DriveScaling(double incrementsPerTurn, double incrementsPerMetre)
      : perTurn_(incrementsPerTurn), perMetre_(incrementsPerMetre) {}

  /// As the list has it now.
  void configure(const IdnList &list);

  /// Over any number of turns, without the origin.
  [[nodiscard]] int64_t toRing(double increments) const;
  [[nodiscard]] int64_t toRing(int64_t increments) const;
  [[nodiscard]] int64_t toIncrements(int64_t units) const;
  /// As a telegram has it: within the modulo, or what 32 bits leave of it.
  [[nodiscard]] int64_t wrapped(int64_t units) const;
  /// The shortest way from one position to another that a telegram has.
  [[nodiscard]] int64_t way(int64_t from, int64_t wrappedTo) const;

  [[nodiscard]] double velocity() const { return velocity_; }         ///< [(inc/s)/unit]
  [[nodiscard]] double acceleration() const { return acceleration_; } ///< [(inc/s²)/unit]

private:
  double perTurn_;
  double perMetre_;
  double position_ = 1; ///< [unit/inc]
  double velocity_ = 1;
  double acceleration_ = 1;
  int64_t modulo_ = 0; ///< 0: none.
};

} // namespace stride::sercos::simulation

#endif
