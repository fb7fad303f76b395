// Latching of positions at a drive's inputs: what AXIS_REF demands and what the drive reports.
#ifndef STRIDE_RUNTIME_BUS_CAPTURE_HPP
#define STRIDE_RUNTIME_BUS_CAPTURE_HPP

#include "runtime/axis/axis_ref.hpp"
#include "runtime/bus/axis_driver.hpp"

namespace stride::bus {

/// At the cycle's start: hands latched positions to those who wait for them, the blocks (aCapture)
/// and the program (bStartCapturing). What is outside of a window is dropped; the input is armed
/// anew.
void takeCaptures(axis::AxisRef &axis, const DriveStatus &status) noexcept;
inline void readCaptures(axis::AxisRef &axis, const DriveStatus &status) noexcept {
  if ((axis.byCaptureArmed & status.captured) != 0)
    takeCaptures(axis, status);
}

/// At the cycle's end: says in `command` at which inputs the `driver`'s `drive` shall latch, and
/// looks at the input that the PLC latches for the program (bStartCapturing without bFastLatching).
void demandCaptures(axis::AxisRef &axis, const AxisDriver &driver, size_t drive,
                    DriveCommand &command) noexcept;
inline void writeCaptures(axis::AxisRef &axis, const AxisDriver &driver, size_t drive,
                          DriveCommand &command) noexcept {
  if (axis.byCaptureClaimed != 0 || axis.bStartCapturing != 0)
    demandCaptures(axis, driver, drive, command);
  else
    axis.byCaptureArmed = 0;
}

/// Nobody waits any more: the drive is being given up.
void clearCaptures(axis::AxisRef &axis) noexcept;

} // namespace stride::bus

#endif
