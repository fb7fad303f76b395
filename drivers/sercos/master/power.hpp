// Torque on and off, from the master's side. [IEC 61491, S-0-0134 and S-0-0135]
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_POWER_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_POWER_HPP

#include "drivers/sercos/protocol/words.hpp"

#include <cstdint>

namespace stride::sercos {

/// What a drive shall do.
enum class PowerTarget : uint8_t {
  Off,    ///< It stops as well as it can, then it has no torque.
  Halt,   ///< Under torque, standing.
  Follow, ///< Its command values.
};

/// Leads a drive by the bits 15 to 13 of its control word. A shutdown by an error is over when the
/// drive says so and somebody has acknowledged it.
class PowerControl {
public:
  /// `timeout`: to get or lose torque. [cycles]
  explicit PowerControl(uint32_t timeout) : timeout_(timeout) {}

  void clear() { *this = PowerControl(timeout_); }
  /// The status word of this cycle.
  void seen(uint16_t statusWord);
  /// What is wanted in this cycle.
  void demand(PowerTarget target, bool acknowledge);

  /// Bits 15 to 13.
  [[nodiscard]] uint16_t control() const { return control_; }
  [[nodiscard]] bool torque() const { return ready_ == Ready::Operational; }
  /// It follows its command values, or has done so since it has torque and was told to.
  [[nodiscard]] bool started() const { return started_; }
  /// A shutdown that nobody has acknowledged.
  [[nodiscard]] bool fault() const { return fault_; }
  /// TRUE once: the error is still there, and is to be reset (S-0-0099).
  bool takeReset() {
    const bool wanted = reset_;
    reset_ = false;
    return wanted;
  }
  /// It does not get or lose torque as it shall; until it is acknowledged it stays off.
  [[nodiscard]] bool stuck() const { return stuck_; }

private:
  uint32_t timeout_;
  uint32_t waited_ = 0;
  uint32_t left_ = 0; ///< It has lost its torque by itself: until it may have it again. [cycles]
  uint16_t control_ = 0;
  Ready ready_ = Ready::Not;
  bool present_ = false; ///< The error, by the status word.
  bool follows_ = false; ///< The same of command values.
  bool started_ = false;
  bool fault_ = false;
  bool reset_ = false;
  bool tried_ = false;        ///< This acknowledgement has had its reset.
  bool acknowledged_ = false; ///< The error, since it came.
  bool stuck_ = false;
};

} // namespace stride::sercos

#endif
