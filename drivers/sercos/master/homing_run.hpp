// A reference run that the drive makes by itself: the procedure command S-0-0148. [IEC 61491]
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_HOMING_RUN_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_HOMING_RUN_HPP

#include "drivers/sercos/master/service_wish.hpp"

#include <cstdint>

namespace stride::sercos {

class HomingRun {
public:
  enum class Step : uint8_t {
    Idle,
    Starting, ///< The command is being set.
    Running,
    Ending,    ///< It is being cleared.
    Reference, ///< S-0-0052 is being read …
    Offset,    ///< … and S-0-0150.
    Found,
    Failed,
    Interrupting, ///< Nobody wants it any more, or nothing is heard of it: it is told to stop …
    Stopping,     ///< … and comes to rest.
    Cancelling,   ///< The command is being cleared then.
  };

  /// `timeout`: for a drive that is told to stop to come to rest. [cycles]
  explicit HomingRun(uint32_t timeout) : timeout_(timeout) {}

  /// One cycle. `able`: the drive has torque and follows; without it a run cannot begin or go on.
  /// `rests`: by its positions.
  void step(bool wanted, bool able, bool rests);
  void clear() { *this = HomingRun(timeout_); }

  [[nodiscard]] Step step() const { return step_; }
  /// The drive does not follow its command values.
  [[nodiscard]] bool active() const {
    return step_ != Step::Idle && step_ != Step::Found && step_ != Step::Failed;
  }
  /// Found: the position that the reference mark has in the drive.
  [[nodiscard]] int32_t reference() const { return static_cast<int32_t>(reference_ + offset_); }

  [[nodiscard]] ServiceWish wish() const;
  void answered(const ServiceWish &wish, const ServiceAnswer &answer);

private:
  void go(Step step);
  void giveUp();
  void told(const ServiceAnswer &answer);

  uint32_t timeout_;
  uint32_t cycles_ = 0; ///< In this step.
  bool failed_ = false; ///< That is what it comes to.
  int64_t reference_ = 0;
  int64_t offset_ = 0;
  Step step_ = Step::Idle;
};

} // namespace stride::sercos

#endif
