// A drive group at run time, which V2.3 calls an axis group: the implicit calls around its task.
#ifndef STRIDE_RUNTIME_BUS_DRIVE_GROUP_HPP
#define STRIDE_RUNTIME_BUS_DRIVE_GROUP_HPP

#include "runtime/axis/axis_ref.hpp"
#include "runtime/axis/encoder.hpp"
#include "runtime/bus/axis_driver.hpp"

#include "st/SM_DriveBasic/SMC_AXISGROUP_REF.h"

#include <memory>
#include <string_view>
#include <vector>

namespace stride::bus {

using AxisGroupRef = ::st::SM_DriveBasic::SMC_AXISGROUP_REF;

/// Serves the drives of one group. All state of the axes is in their AXIS_REF, inside the
/// application object: this object only knows where they are.
///
/// Around the POU calls of the task that the group's sTask names, in every cycle:
/// executeStart(), the POUs, executeEnd().
class DriveGroup {
public:
  /// `axes` and `encoders` in the driver's order. `cycleSeconds` is the task's interval; it becomes
  /// fTaskCycle of every axis. For an event-driven task pass dwCycle. The ratios, periods and
  /// movement types that the axes have now are those of the configuration.
  DriveGroup(std::unique_ptr<AxisDriver> driver, AxisGroupRef &group,
             std::vector<axis::AxisRef *> axes, double cycleSeconds,
             std::vector<axis::EncoderRef *> encoders = {});

  /// The application object has moved: the group, the axis of a drive, or an encoder is there now.
  void rebind(AxisGroupRef &group) noexcept { group_ = &group; }
  void rebind(size_t drive, axis::AxisRef &axis) noexcept {
    axes_[drive] = &axis;
    driver_->bindData(drive, axis.pMS);
  }
  void rebind(size_t index, axis::EncoderRef &encoder) noexcept { encoders_[index] = &encoder; }

  /// At the task's start: reads the drives, starts them up, follows power and errors into the axis
  /// states, and notes the set values with which the cycle begins (fSave*).
  void executeStart();

  /// At the task's end: supervises ownership and limits, brakes axes in errorstop, converts the set
  /// values and sends them.
  void executeEnd();

  /// The application has stopped: brakes all moving axes to errorstop, and tells the driver. Keep
  /// calling executeStart and executeEnd without POUs until atRest().
  void stopAll();

  /// No axis of the group moves, and the driver is at rest.
  [[nodiscard]] bool atRest() const { return axesAtRest() && driver_->atRest(); }

  /// Why the start-up of the group failed, or the restart of one of its drives (SMC3_ReinitDrive),
  /// for g_strBootupError; empty if none did.
  [[nodiscard]] std::string_view bootupError() const { return bootupError_.text(); }

  [[nodiscard]] AxisDriver &driver() { return *driver_; }
  [[nodiscard]] const AxisDriver &driver() const { return *driver_; }

private:
  /// What SMC_ResetAxisGroup goes back to.
  struct Scaling {
    uint32_t denominator;
    int16_t numerator;
    int16_t movementType;
    double period;
  };

  bool resetting() const;
  void startUp();
  void readEncoders();
  StartUp startDrive(size_t index, uint16_t &failure);
  void startFailed(size_t index, std::string_view message);
  void beginReset();
  void brakeAll();
  void stepReset();
  void restart(size_t index, bool keepRatio);
  void serveRestart(size_t index);
  void beginRestart(size_t index);
  void giveUpDrive(size_t index);
  void startAgain(size_t index);
  bool anyPower() const;
  bool axesAtRest() const;
  void serveParameters(size_t index);
  void dropParameters(size_t index);

  std::unique_ptr<AxisDriver> driver_;
  AxisGroupRef *group_;
  std::vector<axis::AxisRef *> axes_;
  std::vector<axis::EncoderRef *> encoders_;
  std::vector<Scaling> configured_;
  std::vector<uint8_t> acknowledged_; ///< Of each axis, 1: its error has been, in this cycle.
  static constexpr size_t kNoDrive = SIZE_MAX;

  Message bootupError_;
  size_t failedDrive_ = kNoDrive; ///< Whose message that is.
  uint32_t resetCycles_ = 0;
};

} // namespace stride::bus

#endif
