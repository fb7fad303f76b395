// Encoders: from a counter of any width to a position without drift.
#ifndef STRIDE_RUNTIME_AXIS_ENCODER_HPP
#define STRIDE_RUNTIME_AXIS_ENCODER_HPP

#include "st/SM_DriveBasic/SMC_ENCODER_REF.h"

#include <cstdint>

namespace stride::axis {

using EncoderRef = ::st::SM_DriveBasic::SMC_ENCODER_REF;

/// The encoder's way starts at `counter`, its count now.
void synchronizeEncoder(EncoderRef &encoder, uint32_t counter) noexcept;

/// Takes over the encoder's count, which wraps at dwEncoderModulo (0: 2^32), into liActIncrements.
/// The encoder may move by less than half of that between two calls, in either direction. Counts
/// beyond the modulo are taken modulo it.
void updateEncoder(EncoderRef &encoder, uint32_t counter) noexcept;

/// Whether the encoder's ratio, and the period of a rotary one, can be used: both numbers of the
/// ratio > 0, the period between 1 and 2^31 increments.
[[nodiscard]] bool usableEncoder(const EncoderRef &encoder) noexcept;

/// Where the encoder is: of a rotary one in [0, fPositionPeriod). Exact over any number of turns
/// but for the rounding of the result. 0 if the scaling cannot be used. [u]
[[nodiscard]] double encoderPosition(const EncoderRef &encoder) noexcept;

} // namespace stride::axis

#endif
