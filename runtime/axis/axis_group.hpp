// An axis group at run time: the implicit calls around its task.
#ifndef STRIDE_RUNTIME_AXIS_AXIS_GROUP_HPP
#define STRIDE_RUNTIME_AXIS_AXIS_GROUP_HPP

#include "runtime/axis/axis_driver.hpp"
#include "runtime/axis/axis_ref.hpp"

#include "st/SM_DriveBasic/SMC_AXISGROUP_REF.h"

#include <memory>
#include <string>
#include <vector>

namespace stride::axis {

using AxisGroupRef = ::st::SM_DriveBasic::SMC_AXISGROUP_REF;

/// Serves the drives of one group. All state of the axes is in their AXIS_REF, inside the
/// application object: this object only knows where they are.
///
/// Around the POU calls of the task that the group's sTask names, in every cycle:
/// executeStart(), the POUs, executeEnd().
class AxisGroup {
public:
  /// `axes` in the driver's order. `cycleSeconds` is the task's interval; it becomes fTaskCycle of
  /// every axis. For an event-driven task pass dwCycle.
  AxisGroup(std::unique_ptr<AxisDriver> driver, AxisGroupRef &group, std::vector<AxisRef *> axes,
            double cycleSeconds);

  /// The application object has moved: the group, or the axis of a drive, is there now.
  void rebind(AxisGroupRef &group) noexcept { group_ = &group; }
  void rebind(std::size_t drive, AxisRef &axis) noexcept { axes_[drive] = &axis; }

  /// At the task's start: reads the drives, starts them up, follows power and errors into the axis
  /// states, and notes the set values with which the cycle begins (fSave*).
  void executeStart();

  /// At the task's end: supervises ownership and limits, brakes axes in errorstop, converts the set
  /// values and sends them.
  void executeEnd();

  /// The application has stopped with an exception: brakes all moving axes to errorstop. Keep
  /// calling executeStart and executeEnd without POUs until atRest().
  void stopAll();

  /// No axis of the group moves.
  [[nodiscard]] bool atRest() const;

  /// Why start-up failed, for g_strBootupError; empty if it did not.
  [[nodiscard]] const std::string &bootupError() const { return bootupError_; }

  [[nodiscard]] AxisDriver &driver() { return *driver_; }

private:
  void startUp();
  void startFailed(std::size_t index, const std::string &message);
  void readDrive(std::size_t index);
  void supervise(AxisRef &axis);
  void writeDrive(std::size_t index);

  std::unique_ptr<AxisDriver> driver_;
  AxisGroupRef *group_;
  std::vector<AxisRef *> axes_;
  std::string bootupError_;
};

/// Takes the axis from its owner and brakes it to rest in state errorstop, with the larger of the
/// command's deceleration and fSWMaxDeceleration. `reason` is an SMC_ERROR.
void enterErrorStop(AxisRef &axis, int16_t reason) noexcept;

} // namespace stride::axis

#endif
