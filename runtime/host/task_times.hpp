// <AxisGroup>.bDebug: the times of the task that serves an axis group.
#ifndef STRIDE_RUNTIME_HOST_TASK_TIMES_HPP
#define STRIDE_RUNTIME_HOST_TASK_TIMES_HPP

#include "st/SM_DriveBasic/SMC_AXISGROUP_REF.h"

#include <algorithm>
#include <cstdint>

namespace stride::host {

/// Fills udiTaskMinTime, udiTaskMaxTime (between two starts), udiTaskRunTime and udiTaskMaxRunTime
/// while bDebug is TRUE; its rising edge begins anew. SoftMotion V2.3 manual, section 2.2.2.
class TaskTimes {
public:
  using Group = ::st::SM_DriveBasic::SMC_AXISGROUP_REF;

  /// First in the task's cycle. [ns]
  void begin(Group &group, int64_t nowNs) noexcept {
    const bool first = !measuring_;
    measuring_ = true;
    if (first) {
      group.udiTaskMinTime = group.udiTaskMaxTime = 0;
      group.udiTaskRunTime = group.udiTaskMaxRunTime = 0;
    } else {
      const UDINT between = micros(nowNs - startNs_);
      group.udiTaskMinTime =
          group.udiTaskMinTime == 0 ? between : std::min<UDINT>(group.udiTaskMinTime, between);
      group.udiTaskMaxTime = std::max<UDINT>(group.udiTaskMaxTime, between);
    }
    startNs_ = nowNs;
  }

  /// Last in the task's cycle, after begin. [ns]
  void end(Group &group, int64_t nowNs) noexcept {
    group.udiTaskRunTime = micros(nowNs - startNs_);
    group.udiTaskMaxRunTime = std::max<UDINT>(group.udiTaskMaxRunTime, group.udiTaskRunTime);
  }

  /// bDebug is FALSE: the last values stay.
  void pause() noexcept { measuring_ = false; }
  bool measuring() const noexcept { return measuring_; }

private:
  static UDINT micros(int64_t ns) noexcept {
    return static_cast<UDINT>(std::clamp<int64_t>((ns + 500) / 1000, 0, 0xFFFFFFFF));
  }

  bool measuring_ = false;
  int64_t startNs_ = 0;
};

} // namespace stride::host

#endif
