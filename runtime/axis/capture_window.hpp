// Windows for captured positions. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_CAPTURE_WINDOW_HPP
#define STRIDE_RUNTIME_AXIS_CAPTURE_WINDOW_HPP

#include "runtime/axis/axis_ref.hpp"
#include "runtime/numeric/modulo_wrap.hpp"

namespace stride::axis {

/// Whether there are positions between `first` and `last`, taken in positive direction. On a rotary
/// axis there always are.
inline bool isCaptureWindow(const AxisRef &axis, double first, double last) noexcept {
  return exact::isfinite(first) && exact::isfinite(last) && (first <= last || isRotary(axis));
}

/// Whether `position` is between `first` and `last`, both included. On a rotary axis the window
/// may reach across the start of a turn, and its ends may be outside of the period.
inline bool inCaptureWindow(const AxisRef &axis, double first, double last,
                            double position) noexcept {
  if (!isRotary(axis))
    return position >= first && position <= last;
  const double period = axis.fPositionPeriod;
  if (last - first >= period)
    return true;
  const double from = numeric::wrapPosition(first, period);
  const double to = numeric::wrapPosition(last, period);
  const double place = numeric::wrapPosition(position, period);
  if (from <= to)
    return place >= from && place <= to;
  return place >= from || place <= to;
}

/// The drive's input of a trigger: -1 is the first one.
inline int16_t captureInput(int16_t triggerNumber) noexcept {
  return triggerNumber == -1 ? int16_t{0} : triggerNumber;
}

/// Whether the axis's drive has that input.
inline bool hasCaptureInput(const AxisRef &axis, int16_t input) noexcept {
  return input >= 0 && input < int16_t{decltype(AxisRef::aCapture)::kSize} &&
         ((axis.byCaptureInputs >> input) & 1) != 0;
}

/// Whether a block waits for the input, or has not fetched its result yet.
inline bool isCaptureClaimed(const AxisRef &axis, int16_t input) noexcept {
  return ((axis.byCaptureClaimed >> input) & 1) != 0;
}

/// A block waits for the input, without a window and a latch so far.
inline void claimCapture(AxisRef &axis, int16_t input) noexcept {
  axis.aCapture.v[input] = {};
  axis.byCaptureClaimed = static_cast<uint8_t>(axis.byCaptureClaimed | (1U << input));
}

/// Nobody waits for the input any more.
inline void freeCapture(AxisRef &axis, int16_t input) noexcept {
  axis.aCapture.v[input] = {};
  axis.byCaptureClaimed = static_cast<uint8_t>(axis.byCaptureClaimed & ~(1U << input));
}

} // namespace stride::axis

#endif
