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
    Cancelling, ///< Nobody wants it any more.
    Failing,    ///< It has failed, and is being cleared.
  };

  /// One cycle. `able`: the drive has torque and follows; without it a run cannot begin or go on.
  void step(bool wanted, bool able);
  void clear() { *this = HomingRun(); }

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
  int64_t reference_ = 0;
  int64_t offset_ = 0;
  Step step_ = Step::Idle;
};

} // namespace stride::sercos

#endif
