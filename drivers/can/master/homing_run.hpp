// A reference run that the drive makes by itself. [CiA 402-2, homing mode]
#ifndef STRIDE_DRIVERS_CAN_MASTER_HOMING_RUN_HPP
#define STRIDE_DRIVERS_CAN_MASTER_HOMING_RUN_HPP

#include <cstdint>

namespace stride::can {

/// Switches the drive to homing mode, starts it, watches it, and gives the mode back.
class HomingRun {
public:
  enum class Step : uint8_t {
    Idle,
    Entering, ///< The mode.
    Starting, ///< Bit 4 is up; what the drive said before may still be seen.
    Running,
    Braking, ///< The drive has given up, and is not at rest yet.
    Leaving, ///< The reference is known; the mode of before is awaited.
    Found,
    Failed,
    Cancelling, ///< Nobody wants it any more: it is told to stop, and is not at rest yet.
    Returning,  ///< It is at rest; the mode of before is awaited.
  };

  /// What is known in a cycle.
  struct Facts {
    bool wanted = false;     ///< Somebody wants it to look for its reference.
    bool possible = false;   ///< The drive has the mode.
    bool enabled = false;    ///< It is in operation.
    bool inMode = false;     ///< It shows the mode of homing.
    bool inOther = false;    ///< It shows the mode of before.
    bool modeLate = false;   ///< It does not take the mode that it shall have.
    bool rests = false;      ///< By its positions.
    uint16_t statusword = 0; ///< Of now.
  };

  /// `timeout`: until it has begun to move, or has come to rest. [cycles]
  explicit HomingRun(uint32_t timeout) : timeout_(timeout) {}

  /// One cycle.
  void step(const Facts &facts);
  void clear() { *this = HomingRun(timeout_); }

  [[nodiscard]] Step step() const { return step_; }
  /// 6060h shall be that of homing.
  [[nodiscard]] bool wantsMode() const {
    return step_ == Step::Entering || step_ == Step::Cancelling || start();
  }
  /// Set values are carried out: the drive neither moves by itself nor changes its mode for that.
  [[nodiscard]] bool letsFollow() const {
    return !wantsMode() && step_ != Step::Leaving && step_ != Step::Returning;
  }
  /// Bit 4 of the controlword.
  [[nodiscard]] bool start() const {
    return step_ == Step::Starting || step_ == Step::Running || step_ == Step::Braking;
  }

private:
  void go(Step step);
  void cancel(const Facts &facts);
  void watch(uint16_t statusword);

  uint32_t timeout_;
  uint32_t cycles_ = 0; ///< In this step.
  bool moved_ = false;  ///< The drive has said that it is under way.
  Step step_ = Step::Idle;
};

} // namespace stride::can

#endif
