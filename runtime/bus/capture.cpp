#include "runtime/bus/capture.hpp"

#include "runtime/axis/capture_window.hpp"
#include "runtime/axis/increments.hpp"

namespace stride::bus {
namespace {

constexpr size_t kInputs = DriveStatus::kCaptureInputs;
static_assert(kInputs == decltype(axis::AxisRef::aCapture)::kSize);

uint8_t bit(size_t input) { return static_cast<uint8_t>(1U << input); }

bool programWaits(const axis::AxisRef &axis) {
  return axis.bStartCapturing != 0 && axis.bCaptureOccurred == 0;
}

bool programWaitsAt(const axis::AxisRef &axis, size_t input) {
  return programWaits(axis) && axis.tiTriggerInput.bFastLatching != 0 &&
         axis::captureInput(axis.tiTriggerInput.iTriggerNumber) == static_cast<int>(input);
}

void captureForProgram(axis::AxisRef &axis, double position) {
  if (axis.bCaptureWindowActive != 0 &&
      !axis::inCaptureWindow(axis, axis.fFirstCapturePosition, axis.fLastCapturePosition, position))
    return;
  axis.fCaptPosition = position;
  axis.bCaptureOccurred = 1;
}

/// The inputs at which somebody waits.
uint8_t wantedInputs(const axis::AxisRef &axis) {
  if (axis.byCaptureClaimed == 0 && !programWaits(axis))
    return 0;
  uint8_t wanted = 0;
  for (size_t i = 0; i < kInputs; ++i) {
    const bool blockWaits =
        axis::isCaptureClaimed(axis, static_cast<int16_t>(i)) && axis.aCapture.v[i].bOccurred == 0;
    if (blockWaits || programWaitsAt(axis, i))
      wanted = static_cast<uint8_t>(wanted | bit(i));
  }
  return wanted;
}

} // namespace

void takeCaptures(axis::AxisRef &axis, const DriveStatus &status) noexcept {
  const uint8_t latched = axis.byCaptureArmed & status.captured;
  axis.byCaptureArmed = axis.byCaptureArmed & static_cast<uint8_t>(~latched);
  for (size_t i = 0; latched != 0 && i < kInputs; ++i) {
    if ((latched & bit(i)) == 0)
      continue;
    const double position = axis::positionOf(axis, status.capturedPosition[i]);
    if (programWaitsAt(axis, i))
      captureForProgram(axis, position);
    auto &capture = axis.aCapture.v[i];
    if (!axis::isCaptureClaimed(axis, static_cast<int16_t>(i)) || capture.bOccurred != 0)
      continue;
    if (capture.bWindow != 0 &&
        !axis::inCaptureWindow(axis, capture.fFirstPosition, capture.fLastPosition, position))
      continue;
    capture.fPosition = position;
    capture.bOccurred = 1;
  }
}

void demandCaptures(axis::AxisRef &axis, const AxisDriver &driver, size_t drive,
                    DriveCommand &command) noexcept {
  const auto &trigger = axis.tiTriggerInput;
  if (programWaits(axis) && trigger.bFastLatching == 0 && trigger.bInput != 0)
    captureForProgram(axis, axis.fActPosition);
  const uint8_t wanted = wantedInputs(axis);
  if (wanted == 0) {
    axis.byCaptureArmed = 0;
    return;
  }
  // The drive forgets its last latch before it is armed anew.
  const uint8_t fresh = static_cast<uint8_t>(~driver.status(drive).captured);
  axis.byCaptureArmed = wanted & static_cast<uint8_t>(axis.byCaptureArmed | fresh);
  command.capture = axis.byCaptureArmed;
}

void clearCaptures(axis::AxisRef &axis) noexcept {
  axis.byCaptureArmed = 0;
  axis.byCaptureClaimed = 0;
  for (auto &capture : axis.aCapture.v)
    capture = {};
}

} // namespace stride::bus
