// The way from blocks to a drive's own parameters: AXIS_REF.stChannel. Blocks may be called in
// other tasks than that of the drive group, so whoever wants to ask claims the channel first. Free
// of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_PARAMETER_CHANNEL_HPP
#define STRIDE_RUNTIME_AXIS_PARAMETER_CHANNEL_HPP

#include "runtime/axis/axis_ref.hpp"

namespace stride::axis {

using ParameterChannel = decltype(AxisRef::stChannel);

/// ParameterChannel.byStep.
enum class ChannelStep : uint8_t { Idle = 0, Asked = 1, Driver = 2, Answered = 3 };

/// ParameterChannel.byKind; as ParameterRequest::Kind.
enum class ChannelKind : uint8_t { Read = 0, Write = 1, Describe = 2 };

/// ParameterChannel.byForm; as ParameterForm.
enum class ChannelForm : uint8_t { Number = 0, Bool = 1, Raw = 2 };

/// ParameterChannel.byResult; as ParameterAnswer::Result.
enum class ChannelResult : uint8_t {
  Done = 0,
  Unknown = 1,
  ReadOnly = 2,
  Refused = 3,
  Failed = 4,
  Late = 5,
};

inline ChannelStep channelStep(const ParameterChannel &channel) noexcept {
  return static_cast<ChannelStep>(__atomic_load_n(&channel.byStep, __ATOMIC_ACQUIRE));
}

inline void setChannelStep(ParameterChannel &channel, ChannelStep step) noexcept {
  __atomic_store_n(&channel.byStep, static_cast<uint8_t>(step), __ATOMIC_RELEASE);
}

/// Frees the channel if `claim` still has it.
inline void freeChannel(ParameterChannel &channel, uint32_t claim) noexcept {
  if (claim == 0 || __atomic_load_n(&channel.udiClaim, __ATOMIC_ACQUIRE) != claim)
    return;
  setChannelStep(channel, ChannelStep::Idle);
  __atomic_compare_exchange_n(&channel.udiClaim, &claim, uint32_t{0}, false, __ATOMIC_RELEASE,
                              __ATOMIC_RELAXED);
}

/// Claims the channel and asks. The claim, or 0: the channel is occupied.
inline uint32_t askDrive(AxisRef &axis, ChannelKind kind, int32_t number, ChannelForm form,
                         double value, uint32_t bits = 0) noexcept {
  ParameterChannel &channel = axis.stChannel;
  uint32_t claim = __atomic_add_fetch(&channel.udiClaims, 1U, __ATOMIC_RELAXED);
  if (claim == 0)
    claim = __atomic_add_fetch(&channel.udiClaims, 1U, __ATOMIC_RELAXED);
  uint32_t nobody = 0;
  if (!__atomic_compare_exchange_n(&channel.udiClaim, &nobody, claim, false, __ATOMIC_ACQ_REL,
                                   __ATOMIC_RELAXED))
    return 0;
  channel.bAbandoned = 0;
  channel.byKind = static_cast<uint8_t>(kind);
  channel.diNumber = number;
  channel.byForm = static_cast<uint8_t>(form);
  channel.fValue = value;
  channel.dwValue = bits;
  channel.uiCycles = 0;
  setChannelStep(channel, ChannelStep::Asked);
  return claim;
}

/// What has become of a question.
enum class Asked : uint8_t {
  Waiting,
  Answered, ///< The answer stands in the channel until it is freed.
  Lost,     ///< Somebody else has the channel: the answer was not fetched in time.
};

inline Asked pollDrive(const AxisRef &axis, uint32_t claim) noexcept {
  const ParameterChannel &channel = axis.stChannel;
  if (claim == 0 || __atomic_load_n(&channel.udiClaim, __ATOMIC_ACQUIRE) != claim)
    return Asked::Lost;
  return channelStep(channel) == ChannelStep::Answered ? Asked::Answered : Asked::Waiting;
}

/// The answer has been read, or is not wanted any more. `claim` becomes 0.
inline void leaveDrive(AxisRef &axis, uint32_t &claim) noexcept {
  ParameterChannel &channel = axis.stChannel;
  if (claim != 0 && __atomic_load_n(&channel.udiClaim, __ATOMIC_ACQUIRE) == claim) {
    channel.bAbandoned = 1;
    if (channelStep(channel) == ChannelStep::Answered)
      freeChannel(channel, claim);
  }
  claim = 0;
}

} // namespace stride::axis

#endif
